/* What pictures, falloff tables and skies may give where the place they are looked up at is uncertain. */
#ifndef TL_ALLOWANCE_MAP_H
#define TL_ALLOWANCE_MAP_H

#include "rough.h"

/* Of a picture in the buffer of lights, in direction d, which is uncertain by `moved`, in any direction, in
 * d's unit. is_projected: as kernels/texture.h says, else around. */
void tl_map_allowance(const tl_prepared *prepared,
                      const tl_view_map *map,
                      int is_projected,
                      vec3 d,
                      double moved,
                      interval out[3]);

/* Of the profile of a light in direction d, as above; {1, 1} of one without. */
interval tl_profile_allowance(const tl_prepared *prepared,
                              const tl_view_shape *shape,
                              vec3 d,
                              double moved);

/* Of a falloff table at these distances. */
interval tl_table_allowance(const tl_prepared *prepared,
                            const tl_view_shape *shape,
                            double fade,
                            interval distance);

/* Of a sky that is not of one colour, along a ray. */
void tl_sky_allowance(const tl_prepared *prepared, vec3 ray, double moved, interval out[3]);

#endif
