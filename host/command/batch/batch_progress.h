/* How far a batch is, for who watches. */
#ifndef TL_BATCH_PROGRESS_H
#define TL_BATCH_PROGRESS_H

#include "batch_state.h"

/* All zero but for the kind to begin with. */
typedef struct batch_progress {
    batch_progress_kind kind; /* never BATCH_PROGRESS_AUTO */
    double start_s, told_s;   /* when it began, and was told last */
    size_t told;              /* items that had ended then */
} batch_progress;

/* For what was chosen. */
batch_progress batch_progress_begin(batch_progress_kind chosen);

/* Tells it, where that is due: of so many items, whose outcomes are in `of`. `ends`: it is the last time. */
void batch_progress_tell(batch_progress *progress,
                         size_t count,
                         const size_t of[BATCH_OUTCOME_COUNT],
                         bool ends);

/* That it ends with frames that failed, in a sentence. */
void batch_progress_fail(const batch_progress *progress, const char *sentence);

#endif
