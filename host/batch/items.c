#include "items.h"

#include "frame_set.h"

#include <stdlib.h>

static tl_status grow(tl_item_list *list, tl_error *err)
{
    const size_t capacity = list->capacity ? 2 * list->capacity : 64;
    if (list->count == TL_MOST_FRAMES)
        return tl_fail(err, TL_ERR_ARGUMENT, "more than %u frames in one batch",
                       TL_MOST_FRAMES);
    if (list->count < list->capacity)
        return TL_OK;
    tl_item *grown = realloc(list->of, capacity * sizeof *grown);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu frames", capacity);
    list->of = grown;
    list->capacity = capacity;
    return TL_OK;
}

tl_status tl_items_add(tl_item_list *list, tl_item *item, tl_error *err)
{
    const tl_status status = grow(list, err);
    if (status != TL_OK) {
        tl_item_clear(item);
        return status;
    }
    list->of[list->count++] = *item;
    *item = (tl_item){.name = NULL};
    return TL_OK;
}

void tl_item_clear(tl_item *item)
{
    for (size_t i = 0; i < item->output_count; i++)
        free(item->outputs[i]);
    free(item->outputs);
    free(item->lights);
    free(item->input);
    free(item->name);
    *item = (tl_item){.name = NULL};
}

void tl_items_clear(tl_item_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        tl_item_clear(&list->of[i]);
    free(list->of);
    *list = (tl_item_list){.of = NULL};
}
