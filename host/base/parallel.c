#define _GNU_SOURCE
#include "parallel.h"

#include "tilelight/report.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { MAX_THREADS = 256, RANGES_PER_THREAD = 8 };

typedef struct job {
    void (*work)(void *context, size_t begin, size_t end);
    void *context;
    size_t count, range;
    atomic_size_t next;
    atomic_ullong helped_ns; /* processor time of threads that were started for it */
} job;

static _Thread_local double helped_s;

unsigned tl_thread_count(void)
{
    const char *limit = getenv("TILELIGHT_THREADS");
    const long wanted = limit ? strtol(limit, NULL, 10) : 0;
    cpu_set_t allowed;
    if (wanted >= 1 && wanted <= MAX_THREADS)
        return (unsigned)wanted;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        return 1;
    const int processors = CPU_COUNT(&allowed);
    return processors < 1 ? 1u : processors > MAX_THREADS ? MAX_THREADS : (unsigned)processors;
}

static void take_ranges(job *shared)
{
    for (;;) {
        const size_t begin = atomic_fetch_add(&shared->next, shared->range);
        if (begin >= shared->count)
            return;
        const size_t left = shared->count - begin;
        shared->work(shared->context, begin,
                     begin + (left < shared->range ? left : shared->range));
    }
}

static void *help(void *argument)
{
    job *const shared = argument;
    take_ranges(shared);
    atomic_fetch_add(&shared->helped_ns, (unsigned long long)(1e9 * tl_thread_seconds()));
    return NULL;
}

double tl_parallel_seconds(void)
{
    return helped_s;
}

void tl_parallel(size_t count,
                 size_t grain,
                 void (*work)(void *context, size_t begin, size_t end),
                 void *context)
{
    pthread_t threads[MAX_THREADS];
    const size_t thread_count = tl_thread_count();
    const size_t even = count / (thread_count * RANGES_PER_THREAD) + 1;
    job shared = {.work = work, .context = context, .count = count};
    size_t started = 0;

    shared.range = even > grain ? even : grain ? grain : 1;
    atomic_init(&shared.next, 0);
    atomic_init(&shared.helped_ns, 0);
    while (started + 1 < thread_count && (started + 1) * shared.range < count &&
           pthread_create(&threads[started], NULL, help, &shared) == 0)
        started++;
    take_ranges(&shared);
    while (started > 0)
        pthread_join(threads[--started], NULL);
    helped_s += 1e-9 * (double)atomic_load(&shared.helped_ns);
}
