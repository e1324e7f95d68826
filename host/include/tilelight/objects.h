/* Objects of a scene that a G-buffer tells apart: an id a pixel, and names of ids. */
#ifndef TL_OBJECTS_H
#define TL_OBJECTS_H

#include "error.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct tl_gbuffer;

typedef struct tl_object {
    uint32_t id; /* not 0 */
    char *name;  /* owned */
} tl_object;

/* Names, by rising ids; owned. All zero is none. */
typedef struct tl_objects {
    uint32_t count;
    tl_object *of; /* [count] */
} tl_objects;

/* Appends one, with a copy of its name. Fails with TL_ERR_ARGUMENT where the id is not above the last, or
 * TL_ERR_MEMORY. */
tl_status tl_objects_add(tl_objects *objects, uint32_t id, const char *name, tl_error *err);

/* *to, none to begin with, gets what `from` has. Fails with TL_ERR_MEMORY. */
tl_status tl_objects_copy(const tl_objects *from, tl_objects *to, tl_error *err);

/* Leaves none. */
void tl_objects_clear(tl_objects *objects);

/* Gives a G-buffer, or a layer, ids of 0: gbuffer->ids. Fails with TL_ERR_MEMORY. */
tl_status tl_ids_add(struct tl_gbuffer *gbuffer, tl_error *err);

/* Gives `to`, of the same size, the ids and names that `from` has, if any. Fails with TL_ERR_MEMORY. */
tl_status tl_ids_copy(const struct tl_gbuffer *from, struct tl_gbuffer *to, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
