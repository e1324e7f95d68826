/* What a batch would do: --dry-run. */
#ifndef TL_BATCH_PLAN_H
#define TL_BATCH_PLAN_H

#include "batch_state.h"
#include "report_options.h"

/* Says on standard output of each item, in their order, whether it would be made and why, or why it cannot be;
 * with --json as one object. Fails with TL_ERR_DIFFERENT where one cannot be, and TL_ERR_WRITE. */
tl_status batch_plan(const batch *b, const report_options *report, tl_error *err);

#endif
