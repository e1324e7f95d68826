/* What a batch does: items, one a frame, each lit from one file to one or more. */
#ifndef TL_ITEMS_H
#define TL_ITEMS_H

#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* All zero is empty; the list owns every text. */
typedef struct tl_item {
    char *name;    /* of the input without folder and suffix, or as a manifest calls it */
    int32_t frame; /* where it has one */
    bool has_frame;
    char *input;    /* a path */
    char *lights;   /* a path; NULL: none were named for it */
    char **outputs; /* [output_count] paths, at least 1 in a list that is whole */
    size_t output_count;
} tl_item;

/* All zero is a valid empty list; released with tl_items_clear. */
typedef struct tl_item_list {
    tl_item *of; /* [count] */
    size_t count, capacity;
    size_t all_count; /* of the whole, which this is a shard of */
} tl_item_list;

/* Moves `item` into the list, also where it fails: it is empty afterwards. Fails with TL_ERR_MEMORY, or
 * TL_ERR_ARGUMENT for more than TL_MOST_FRAMES. */
tl_status tl_items_add(tl_item_list *list, tl_item *item, tl_error *err);

/* Releases what the item has. Accepts an empty one. */
void tl_item_clear(tl_item *item);

/* Leaves an empty list. Accepts an empty one. */
void tl_items_clear(tl_item_list *list);

#endif
