/* Options of the sky, in place of what the lights say. */
#ifndef TL_SKY_OPTIONS_H
#define TL_SKY_OPTIONS_H

#include "tilelight/lights.h"
#include "tilelight/report.h"

#include <argp.h>

typedef struct sky_choice {
    const char
        *image; /* a map of latitude and longitude; "none": no sky; NULL: what the lights say */
    double intensity,
        light;       /* below 0: what the lights say, but for a map that is chosen here: 1 */
    double rotation; /* degrees; NAN alike, but 0 */
} sky_choice;

sky_choice sky_choice_default(void);

/* Makes it that of the lights. Fails as reading a picture does, with TL_ERR_ARGUMENT where there is no sky
 * that could be brighter, shine or turn, or with TL_ERR_MEMORY. */
tl_status sky_choose(const sky_choice *choice, tl_light_set *lights, tl_error *err);

/* Its input is a sky_choice. */
extern const struct argp sky_argp;

#endif
