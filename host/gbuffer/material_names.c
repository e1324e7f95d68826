#define _POSIX_C_SOURCE 200809L /* strdup */
#include "tilelight/gbuffer.h"

#include <stdlib.h>
#include <string.h>

void tl_material_names_clear(tl_material_names *names)
{
    for (uint32_t i = 0; i < names->count; i++)
        free(names->of[i]);
    free(names->of);
    *names = (tl_material_names){0};
}

tl_status tl_material_names_add(tl_material_names *names, const char *name, tl_error *err)
{
    char *copy = strdup(name);
    char **grown = copy ? realloc(names->of, (names->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(copy);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the names of materials");
    }
    names->of = grown;
    names->of[names->count++] = copy;
    return TL_OK;
}

tl_status tl_material_names_copy(const tl_material_names *from,
                                 tl_material_names *to,
                                 tl_error *err)
{
    tl_material_names made = {0};
    for (uint32_t i = 0; i < from->count; i++) {
        const tl_status status = tl_material_names_add(&made, from->of[i], err);
        if (status != TL_OK) {
            tl_material_names_clear(&made);
            return status;
        }
    }
    tl_material_names_clear(to);
    *to = made;
    return TL_OK;
}
