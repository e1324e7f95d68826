#include "tilelight/objects.h"

#include "aligned.h"
#include "try.h"

#include "tilelight/gbuffer.h"

#include <stdlib.h>
#include <string.h>

tl_status tl_objects_add(tl_objects *objects, uint32_t id, const char *name, tl_error *err)
{
    const size_t size = strlen(name) + 1;
    if (id == 0 || (objects->count > 0 && objects->of[objects->count - 1].id >= id))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "object %u is out of order: ids are above 0 and rise", id);
    tl_object *grown = realloc(objects->of, (objects->count + (size_t)1) * sizeof *grown);
    if (grown)
        objects->of = grown;
    char *copy = malloc(size);
    if (!grown || !copy) {
        free(copy);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the names of objects");
    }
    memcpy(copy, name, size);
    objects->of[objects->count++] = (tl_object){id, copy};
    return TL_OK;
}

tl_status tl_objects_copy(const tl_objects *from, tl_objects *to, tl_error *err)
{
    tl_status status = TL_OK;
    for (uint32_t i = 0; i < from->count; i++)
        TRY(tl_objects_add(to, from->of[i].id, from->of[i].name, err));
done:
    return status;
}

void tl_objects_clear(tl_objects *objects)
{
    for (uint32_t i = 0; i < objects->count; i++)
        free(objects->of[i].name);
    free(objects->of);
    *objects = (tl_objects){0};
}

tl_status tl_ids_add(tl_gbuffer *gbuffer, tl_error *err)
{
    const size_t size = (size_t)gbuffer->pitch * gbuffer->rows * sizeof *gbuffer->ids;
    if (gbuffer->ids)
        return TL_OK;
    gbuffer->ids = tl_aligned_alloc(size);
    if (!gbuffer->ids)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for ids of objects (%zu MB)",
                       size >> 20);
    memset(gbuffer->ids, 0, size);
    return TL_OK;
}

tl_status tl_ids_copy(const tl_gbuffer *from, tl_gbuffer *to, tl_error *err)
{
    tl_status status = TL_OK;
    if (!from->ids)
        return TL_OK;
    TRY(tl_ids_add(to, err));
    memcpy(to->ids, from->ids, (size_t)to->pitch * to->rows * sizeof *to->ids);
    TRY(tl_objects_copy(&from->objects, &to->objects, err));
done:
    return status;
}
