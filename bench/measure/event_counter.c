#define _GNU_SOURCE /* syscall */
#include "event_counter.h"

#include "try.h"

#include <stdlib.h>

struct tl_event_counter {
    const tl_event *event;
    int file;
};

#ifdef __linux__
#    include <errno.h>
#    include <linux/perf_event.h>
#    include <string.h>
#    include <sys/syscall.h>
#    include <unistd.h>

const tl_event tl_cache_misses = {"misses of the last cache", PERF_TYPE_HARDWARE,
                                  PERF_COUNT_HW_CACHE_MISSES};

/* glibc has no function for it. */
static int open_event(const tl_event *event)
{
    struct perf_event_attr attributes = {.size = sizeof attributes,
                                         .type = event->type,
                                         .config = event->config,
                                         .inherit = 1,
                                         .exclude_kernel = 1,
                                         .exclude_hv = 1,
                                         .read_format = PERF_FORMAT_TOTAL_TIME_ENABLED |
                                                        PERF_FORMAT_TOTAL_TIME_RUNNING};
    static const int this_thread = 0, any_processor = -1, no_group = -1;
    return (int)syscall(SYS_perf_event_open, &attributes, this_thread, any_processor, no_group,
                        PERF_FLAG_FD_CLOEXEC);
}

static const char *reason_of(int error)
{
    switch (error) {
    case ENOENT:
    case EOPNOTSUPP:
    case ENODEV: return "this machine has no such counter, as most virtual ones";
    case EACCES:
    case EPERM:
        return "not allowed here (kernel.perf_event_paranoid, or the container's rules)";
    case ENOSYS: return "this system has no perf_event_open";
    default: return strerror(error);
    }
}

tl_status tl_event_counter_open(const tl_event *event, tl_event_counter **out, tl_error *err)
{
    tl_event_counter *made = malloc(sizeof *made);
    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a counter");
    *made = (tl_event_counter){.event = event, .file = open_event(event)};
    if (made->file < 0) {
        const int error = errno;
        free(made);
        return tl_fail(err, TL_ERR_UNSUPPORTED, "%s cannot be counted: %s", event->name,
                       reason_of(error));
    }
    *out = made;
    return TL_OK;
}

tl_status tl_event_counter_read(const tl_event_counter *counter, double *out, tl_error *err)
{
    struct {
        uint64_t count, enabled, running; /* ns */
    } now;
    if (read(counter->file, &now, sizeof now) != (ssize_t)sizeof now || now.running == 0)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "%s were not counted: others had the counters",
                       counter->event->name);
    *out = (double)now.count * ((double)now.enabled / (double)now.running);
    return TL_OK;
}

void tl_event_counter_close(tl_event_counter *counter)
{
    if (!counter)
        return;
    close(counter->file);
    free(counter);
}

#else

const tl_event tl_cache_misses = {"misses of the last cache", 0, 0};

tl_status tl_event_counter_open(const tl_event *event, tl_event_counter **out, tl_error *err)
{
    (void)out;
    return tl_fail(err, TL_ERR_UNSUPPORTED, "%s are counted on Linux alone", event->name);
}

tl_status tl_event_counter_read(const tl_event_counter *counter, double *out, tl_error *err)
{
    (void)out;
    return tl_fail(err, TL_ERR_UNSUPPORTED, "%s were not counted", counter->event->name);
}

void tl_event_counter_close(tl_event_counter *counter)
{
    free(counter);
}

#endif
