/* Pictures of a light set as kernels look them up. */
#ifndef TL_MAP_H
#define TL_MAP_H

#include "prepared.h"

/* Forgets where pictures of the frame before stood. Fails with TL_ERR_MEMORY. */
tl_status tl_maps_begin(const tl_light_set *lights, tl_prepared *prepared, tl_error *err);

/* Makes *map show image `number` (1 and above) of the set, in a section that all maps of it share. Its
 * directions are the caller's. Pixels are multiplied with `scale`. Fails as tl_section_add does. */
tl_status tl_map_show(const tl_light_set *lights,
                      uint32_t number,
                      double scale,
                      tl_prepared *prepared,
                      tl_view_map *map,
                      tl_error *err);

/* A direction of world space, times `scale`, in view space. */
void tl_map_direction(const tl_camera *camera,
                      const double world[3],
                      double scale,
                      float view[3]);

#endif
