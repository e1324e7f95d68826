/* What the lights of a set share: falloff tables and pictures. */
#ifndef TL_LIGHT_RESOURCES_H
#define TL_LIGHT_RESOURCES_H

#include "tilelight/lights.h"

void tl_light_resources_clear(tl_light_set *set);

/* Whether light `index` has the table and the picture that its type and its falloff call for, and no
 * other. Fails with TL_ERR_FORMAT, as tl_light_set_check. */
tl_status tl_light_resources_check(const tl_light_set *set,
                                   size_t index,
                                   const char *source,
                                   tl_error *err);

/* The same of the sky. */
tl_status tl_light_sky_check(const tl_light_set *set, const char *source, tl_error *err);

#endif
