/* What a picture is found to be off by, in the terms of a goal. */
#ifndef TL_PROMISE_MEASURE_H
#define TL_PROMISE_MEASURE_H

#include "windows.h"

/* What pictures of a frame are held against. */
typedef struct tl_yardstick {
    tl_sample *sample;   /* owned */
    tl_windows *windows; /* owned; NULL unless the goal is FLIP */
    uint32_t side;       /* of a pixel, in samples */
} tl_yardstick;

/* guide: a picture of the frame (tl_sample_draw). The caller clears *out. Fails as tl_prepare does. */
tl_status tl_yardstick_make(const tl_goal *goal,
                            const tl_gbuffer *gbuffer,
                            const tl_light_set *lights,
                            const tl_image *guide,
                            tl_yardstick *out,
                            tl_error *err);

/* Leaves it all zero. */
void tl_yardstick_clear(tl_yardstick *of);

/* How many pixels the reference was lit at, or samples of them, windows' surroundings included. */
uint64_t tl_yardstick_pixels(const tl_yardstick *of);

/* doubt: of the bound (bound.h). image: of the frame's size. RMS for goals that have no error of their own.
 * Fails with TL_ERR_MEMORY. */
tl_status tl_measure(const tl_goal *goal,
                     const tl_yardstick *by,
                     const tl_image *image,
                     double doubt,
                     tl_estimate *out,
                     tl_error *err);

#endif
