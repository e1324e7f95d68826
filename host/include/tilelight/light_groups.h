/* Groups of lights: those that have the same `group` in a set. */
#ifndef TL_LIGHT_GROUPS_H
#define TL_LIGHT_GROUPS_H

#include "lights.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One of them, and how many lights are in it. */
typedef struct tl_light_group {
    const char *name; /* in the set */
    size_t light_count;
} tl_light_group;

/* All groups of a set, each once, by the bytes of their names: *out, [*count], which the caller frees; NULL
 * and 0 where no light is in one. Fails with TL_ERR_MEMORY. */
tl_status tl_light_groups_find(const tl_light_set *set,
                               tl_light_group **out,
                               size_t *count,
                               tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
