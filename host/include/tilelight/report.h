/* What a function tells its caller beside its result: sentences worth reading, and how long each
 * stage took. Both are optional: NULL is accepted wherever a pointer to one is. */
#ifndef TL_REPORT_H
#define TL_REPORT_H

#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { TL_MAX_STAGES = 32 };

/* Wall time per stage, in the order in which stages first ended. */
typedef struct tl_timings {
    int count;
    struct {
        const char *name; /* a string literal, such as "read" or "shade" */
        double ms;
    } stages[TL_MAX_STAGES];
} tl_timings;

/* Seconds on a clock that only goes forward, the same for every process. */
double tl_seconds(void);

/* Seconds of processor time that this process has taken, all threads together. */
double tl_processor_seconds(void);

/* Seconds of processor time that the calling thread has taken. */
double tl_thread_seconds(void);

/* When this process began, on the clock of tl_seconds: before its program was loaded. To be asked
 * for while there is one thread. Where loading had to wait for a disk or a processor, up to 10 ms
 * late or early, which is how closely the system knows; else exact to a millisecond. */
double tl_process_start(void);

/* Adds the time since `start` (from tl_seconds) to stage `name`. Beyond TL_MAX_STAGES names it
 * is dropped. Returns the time now, so that stages chain. Cannot fail. */
double tl_timings_end(tl_timings *timings, const char *name, double start);

/* Adds a time that was measured otherwise. Cannot fail. */
void tl_timings_add(tl_timings *timings, const char *name, double ms);

/* Receives sentences that are no errors: what was assumed, ignored or repaired. */
typedef struct tl_notices {
    void (*say)(void *context, const char *sentence); /* NULL: silence */
    void *context;
} tl_notices;

void tl_notice(const tl_notices *notices, const char *format, ...) TL_PRINTF_LIKE(2, 3);

#ifdef __cplusplus
}
#endif

#endif
