/* What items write, and by which lights, from patterns for all of them; and whether that fits together. */
#ifndef TL_ITEM_OUTPUTS_H
#define TL_ITEM_OUTPUTS_H

#include "items.h"

/* Gives every item an output of each pattern. Fails with TL_ERR_ARGUMENT where a pattern does not tell
 * several items apart, or needs a frame that an item lacks; TL_ERR_MEMORY. */
tl_status tl_item_outputs_fill(tl_item_list *list,
                               const char *const *patterns,
                               size_t count,
                               tl_error *err);

/* Gives every item without lights those of the pattern. Fails likewise, but for one file for all. */
tl_status tl_item_lights_fill(tl_item_list *list, const char *pattern, tl_error *err);

/* Fails with TL_ERR_ARGUMENT, naming both, where an output is written twice or is an input or lights file
 * too; TL_ERR_MEMORY. */
tl_status tl_item_outputs_check(const tl_item_list *list, tl_error *err);

#endif
