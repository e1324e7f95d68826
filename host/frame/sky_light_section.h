/* The sky's light on surfaces as kernels look it up (kernels/sky_light.h). */
#ifndef TL_SKY_LIGHT_SECTION_H
#define TL_SKY_LIGHT_SECTION_H

#include "prepared.h"

/* Adds a tl_view_sky_light, and the tables that prepared->needs ask for, as sections, at frame.sky_light_at, of
 * the map prepared->sky_map, which it makes, or finds again, where the frame's sky is another. What a surface has of it is 4e30 at most:
 * texels are cut, and scaled where that much comes on average. Fails as tl_section_add and tl_sky_map_of
 * do. */
tl_status tl_sky_light_add(const tl_camera *camera,
                           const tl_light_set *lights,
                           tl_prepared *prepared,
                           tl_error *err);

#endif
