/* The workers of a batch. */
#ifndef TL_BATCH_RUN_H
#define TL_BATCH_RUN_H

#include "batch_progress.h"
#include "batch_state.h"

/* How many workers suit the machine. */
uint32_t batch_usual_in_flight(void);

/* Does all items of a batch that is ready for it, in_flight at a time: those that fail have a result that says so, those that were
 * not begun have BATCH_LEFT. b->tally.stopped says why, unless a signal came (interrupts.h). Fails with
 * TL_ERR_MEMORY where no worker starts. */
tl_status batch_run(batch *b, batch_progress *progress, tl_error *err);

#endif
