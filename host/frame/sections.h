/* Sections of the buffer of lights: what stands behind lights and cones, in rows of TL_SECTION_ROW bytes. */
#ifndef TL_SECTIONS_H
#define TL_SECTIONS_H

#include "prepared.h"

/* Bytes of a light and its cone. */
#define TL_LIGHT_AND_CONE (sizeof(tl_view_light) + sizeof(tl_view_spot))

/* Makes prepared->lights of at least `size` bytes; keeps what is in them. Fails with TL_ERR_MEMORY. */
tl_status tl_sections_reserve(tl_prepared *prepared, size_t size, tl_error *err);

/* Appends a section of `size` bytes, filled up with zeroes to whole rows, once all lights of the frame are
 * there. *at becomes the row at which it begins, *memory (may be NULL) where that is: zeroes, the caller's to
 * fill until the next section, which may move all of them. Fails with TL_ERR_MEMORY, or TL_ERR_ARGUMENT where
 * rows do not count that far; then there is no such section. */
tl_status tl_section_add(
    tl_prepared *prepared, size_t size, tl_u32 *at, void **memory, tl_error *err);

/* What stands at a row of the buffer. */
void *tl_section_at(const tl_prepared *prepared, tl_u32 row);

#endif
