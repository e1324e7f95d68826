/* The sky of a lights file. */
#ifndef TL_SKY_READ_H
#define TL_SKY_READ_H

#include "light_values.h"

/* Fails with TL_ERR_FORMAT, or as reading a picture does. */
tl_status tl_sky_read(const tl_place *at, json_t *sky, tl_light_set *set, tl_error *err);

#endif
