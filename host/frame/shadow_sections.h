/* Shadow maps of lights as sections behind the lights. */
#ifndef TL_SHADOW_SECTIONS_H
#define TL_SHADOW_SECTIONS_H

#include "prepared.h"

/* The map that a light asks for, NULL where it asks for none or the G-buffer has none of it. */
const tl_shadow_map *tl_shadow_of(const tl_gbuffer *gbuffer, const tl_light *light);

/* Adds the texels of a map and its tl_view_shadow, which begins at row *at. filter: 1 to
 * TL_MOST_SHADOW_FILTER. Fails as tl_section_add does. */
tl_status tl_shadow_section_add(const tl_gbuffer *gbuffer,
                                const tl_shadow_map *map,
                                uint32_t filter,
                                tl_prepared *prepared,
                                tl_u32 *at,
                                tl_error *err);

#endif
