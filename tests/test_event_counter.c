/* Are events of this process counted, those of its threads too, and is it said why others are not? */
#define _GNU_SOURCE
#include "testing.h"

#include "event_counter.h"

#include <linux/perf_event.h>
#include <pthread.h>
#include <sys/mman.h>

enum { PAGES = 2000, PAGE_SIZE = 4096, THREADS = 3 };

/* What every machine counts: the first touch of a page is one. */
static const tl_event page_faults = {"page faults", PERF_TYPE_SOFTWARE,
                                     PERF_COUNT_SW_PAGE_FAULTS};

static void *touch_pages(void *unused)
{
    const size_t size = (size_t)PAGES * PAGE_SIZE;
    volatile char *memory =
        mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(memory != MAP_FAILED);
    (void)unused;
    /* Large pages would need fewer touches. */
    madvise((void *)(uintptr_t)memory, size, MADV_NOHUGEPAGE);
    for (size_t i = 0; i < PAGES; i++)
        memory[i * PAGE_SIZE] = 1;
    munmap((void *)(uintptr_t)memory, size);
    return NULL;
}

static double faults_of_threads(tl_event_counter *counter, int thread_count)
{
    pthread_t threads[THREADS];
    double before = 0.0, after = 0.0;
    tl_error err;
    ASSERT_OK(tl_event_counter_read(counter, &before, &err), err);
    for (int i = 0; i < thread_count; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, touch_pages, NULL), 0);
    for (int i = 0; i < thread_count; i++)
        pthread_join(threads[i], NULL);
    if (thread_count == 0)
        touch_pages(NULL);
    ASSERT_OK(tl_event_counter_read(counter, &after, &err), err);
    return after - before;
}

static void threads_that_begin_later_count(void **state)
{
    tl_event_counter *counter = NULL;
    tl_error err;
    (void)state;
    if (tl_event_counter_open(&page_faults, &counter, &err) != TL_OK) {
        print_message("%s\n", err.message);
        skip();
    }
    const double alone = faults_of_threads(counter, 0);
    const double threads = faults_of_threads(counter, THREADS);
    /* Stacks and the library fault a little beside. */
    if (alone < PAGES || alone > 1.5 * PAGES || threads < THREADS * PAGES ||
        threads > 1.5 * THREADS * PAGES)
        fail_msg("%g faults alone, %g of %d threads, %d pages each", alone, threads, THREADS,
                 PAGES);
    tl_event_counter_close(counter);
}

static void an_event_that_is_not_there_has_a_reason(void **state)
{
    static const tl_event none = {"events of no kind", PERF_TYPE_SOFTWARE, 1u << 20};
    tl_event_counter *counter = NULL;
    tl_error err;
    (void)state;
    assert_int_equal(tl_event_counter_open(&none, &counter, &err), TL_ERR_UNSUPPORTED);
    assert_null(counter);
    assert_non_null(strstr(err.message, "events of no kind cannot be counted: "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_that_begin_later_count),
        cmocka_unit_test(an_event_that_is_not_there_has_a_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
