/* Events that the processor or the system counts for this process, where it is allowed to know. */
#ifndef TL_EVENT_COUNTER_H
#define TL_EVENT_COUNTER_H

#include "tilelight/error.h"

#include <stdint.h>

/* As perf_event_open(2) has them. */
typedef struct tl_event {
    const char *name; /* what messages call it: "misses of the last cache" */
    uint32_t type;
    uint64_t config;
} tl_event;

/* Accesses that the last cache could not serve: each fetches a line of TL_LINE_SIZE bytes. What
 * hardware prefetches, and what is written back, is not among them on every processor. */
extern const tl_event tl_cache_misses;
enum { TL_LINE_SIZE = 64 };

typedef struct tl_event_counter tl_event_counter;

/* Counts from here on, in user mode, for the calling thread and the threads that begin later: to be
 * opened before a device is. The caller releases *out with tl_event_counter_close. Fails with
 * TL_ERR_UNSUPPORTED, saying why the event is not to be had (no such counter, as in most virtual
 * machines; not allowed, as in most containers; another system than Linux), or TL_ERR_MEMORY. */
tl_status tl_event_counter_open(const tl_event *event, tl_event_counter **out, tl_error *err);

/* How many since it was opened. Where counters were shared out among more events than there are,
 * extrapolated from the time that this one was on. Fails with TL_ERR_UNSUPPORTED where it never was. */
tl_status tl_event_counter_read(const tl_event_counter *counter, double *out, tl_error *err);

/* Accepts NULL. */
void tl_event_counter_close(tl_event_counter *counter);

#endif
