/* Work on all processors. */
#ifndef TL_PARALLEL_H
#define TL_PARALLEL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Calls work(context, begin, end) for ranges that together cover [0, count) once, on as many
 * threads as the process may use, and returns when all are done. Ranges are at least `grain` long
 * but for the last. TILELIGHT_THREADS in the environment limits the threads. Falls back to the
 * calling thread where no thread can be started; cannot fail. */
void tl_parallel(size_t count,
                 size_t grain,
                 void (*work)(void *context, size_t begin, size_t end),
                 void *context);

/* Seconds of processor time that other threads have taken for what this thread gave to tl_parallel. */
double tl_parallel_seconds(void);

/* How many threads tl_parallel uses, at least 1. */
unsigned tl_thread_count(void);

#ifdef __cplusplus
}
#endif

#endif
