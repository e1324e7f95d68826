/* What outputs of a batch's items were, and would be, made from (host/batch/record.h). */
#ifndef TL_BATCH_RECORD_H
#define TL_BATCH_RECORD_H

#include "batch_state.h"
#include "record.h"

/* Of the options that show in outputs, as they were given to `root`, whose part the frame's are. The caller
 * frees *out. frame: with its kernel read. Fails with TL_ERR_MEMORY. */
tl_status batch_options_text(const struct argp *root,
                             int argc,
                             char **argv,
                             const frame_options *frame,
                             char **out,
                             tl_error *err);

/* Of an item as it is now. Any thread may call. Fails as tl_record_of. */
tl_status batch_record_of(const batch *b,
                          const tl_item *item,
                          char record[TL_RECORD_SIZE],
                          tl_error *err);

/* X(name, why an output is made) */
#define TL_BATCH_REASONS(X)                                                                   \
    X(BATCH_UP_TO_DATE_IS, "is up to date")                                                   \
    X(BATCH_IS_MISSING, "is not there")                                                       \
    X(BATCH_SAYS_NOTHING, "does not say what it was made from")                               \
    X(BATCH_IS_OUTDATED, "was made from other files, by other options or by another version") \
    X(BATCH_IS_FORCED, "is up to date, but made all the same")

typedef enum batch_reason {
#define BATCH_REASON_NAME(name, why) name,
    TL_BATCH_REASONS(BATCH_REASON_NAME)
#undef BATCH_REASON_NAME
} batch_reason;

extern const char *const batch_reasons[];

/* Why an item would be made: of its first output that stands in the way of its being up to date; *output is
 * that one. */
batch_reason batch_reason_of(const batch *b,
                             const tl_item *item,
                             const char record[TL_RECORD_SIZE],
                             const char **output);

#endif
