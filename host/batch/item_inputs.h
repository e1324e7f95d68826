/* Inputs as they are written, to items. */
#ifndef TL_ITEM_INPUTS_H
#define TL_ITEM_INPUTS_H

#include "frame_set.h"
#include "items.h"

/* Adds what `input` stands for (item_list.h): inputs and names, without outputs or lights. frames: NULL where
 * none were asked for. Fails as tl_items_list. */
tl_status tl_item_inputs_add(tl_item_list *list,
                             const char *input,
                             const tl_frames *frames,
                             tl_error *err);

/* A file's name without folder and suffix. The caller frees it; NULL: out of memory. */
char *tl_item_name(const char *path);

#endif
