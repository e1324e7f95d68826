/* Frames that readers have made, lit: what fuzzers of captures and of lights end in. */
#ifndef TL_FUZZ_FRAME_H
#define TL_FUZZ_FRAME_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* Checks that a frame is what a reader of captures promises: its camera passes tl_camera_check, one repair
 * leaves nothing for a second, and its pixels in full float are in range. */
void fuzz_repair(tl_gbuffer *gbuffer);

/* Lights a repaired frame by the float twin and in double, unless that takes too long; every value must be a
 * finite number. Lights have passed tl_light_set_check. */
void fuzz_light(const tl_gbuffer *gbuffer, const tl_light_set *lights);

#endif
