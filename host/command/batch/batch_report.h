/* What a batch came to. */
#ifndef TL_BATCH_REPORT_H
#define TL_BATCH_REPORT_H

#include "batch_progress.h"
#include "batch_state.h"
#include "report_options.h"

/* On standard error: how many frames were lit, were up to date, failed or were left, and each that failed; with
 * `report`, the times, or all of it as JSON on standard output. Fails with TL_ERR_DIFFERENT where
 * a frame failed, what stopped the batch where something did, and TL_ERR_WRITE. */
tl_status batch_report(batch *b,
                       const batch_progress *progress,
                       const report_options *report,
                       tl_error *err);

#endif
