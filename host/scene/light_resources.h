/* What the lights of a set share: falloff tables and pictures; and how one is refused. */
#ifndef TL_LIGHT_RESOURCES_H
#define TL_LIGHT_RESOURCES_H

#include "tilelight/lights.h"

/* Fails with TL_ERR_FORMAT and a sentence that names the light, by its index and its name. */
tl_status tl_light_refuse(const tl_light *light,
                          size_t index,
                          const char *source,
                          tl_error *err,
                          const char *format,
                          ...) TL_PRINTF_LIKE(5, 6);

void tl_light_resources_clear(tl_light_set *set);

/* Whether light `index` has the table, the picture and the profile that its type and its falloff call for,
 * and no other. Fails with TL_ERR_FORMAT, as tl_light_set_check. */
tl_status tl_light_resources_check(const tl_light_set *set,
                                   size_t index,
                                   const char *source,
                                   tl_error *err);

/* The same of the sky. */
tl_status tl_light_sky_check(const tl_light_set *set, const char *source, tl_error *err);

#endif
