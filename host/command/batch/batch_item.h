/* One item of a batch, from its input to its outputs. */
#ifndef TL_BATCH_ITEM_H
#define TL_BATCH_ITEM_H

#include "batch_state.h"

/* Does what there is to do; any number of threads at a time, each with an item of its own. *outcome is of what
 * succeeds: BATCH_LEFT where another process is at it, and it is to be asked for again. Fails as reading,
 * lighting and writing do. */
tl_status batch_item_make(batch *b, const tl_item *item, batch_outcome *outcome, tl_error *err);

/* Fails with TL_ERR_ARGUMENT where an output is of a kind that holds no record of what it was made from. */
tl_status batch_items_check(const tl_item_list *items, tl_error *err);

#endif
