/* Options of how a frame is lit. */
#ifndef TL_LIGHTING_OPTIONS_H
#define TL_LIGHTING_OPTIONS_H

#include "light_control_options.h"
#include "sky_options.h"
#include "tilelight/lighting.h"

#include <argp.h>
#include <stdbool.h>

typedef struct lighting_choice {
    tl_lighting_options options;
    const char *device; /* NULL: the default one */
    const char *lights; /* a lights file; NULL: what the frame brings */
    const char
        *chosen; /* an option that was given and that promises choose themselves; NULL: none */
    double occlusion_radius; /* m, of ambient occlusion; below 0: what the lights say */
    bool groups; /* groups of lights are written by themselves, as aov_options.h says */
    sky_choice sky;
    light_controls controls; /* of the lights, wherever they are from */
    bool strict; /* refuse pixels that would have to be repaired */
} lighting_choice;

lighting_choice lighting_choice_default(void);

/* Its input is a lighting_choice. */
extern const struct argp lighting_argp;

#endif
