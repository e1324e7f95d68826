/* Frames that a shading kernel is checked on: the scenes of benchmarks in small and odd sizes, dressed
 * so that together they use everything a kernel may be handed. */
#ifndef TL_CHECK_FRAMES_H
#define TL_CHECK_FRAMES_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* How many there are; frames go by their index. */
extern const int tl_check_frame_count;

/* A word, and what is in the frame. */
const char *tl_check_frame_name(int index);
const char *tl_check_frame_meaning(int index);

typedef struct tl_checked_frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    float light_cutoff; /* lx, as in tl_lighting_options */
} tl_checked_frame;

/* Makes the frame; the same floats on every machine whose sin, exp2 and log are. *out is all zero
 * before; the caller releases it with tl_checked_frame_clear. Fails with TL_ERR_MEMORY. */
tl_status tl_check_frame_make(int index, tl_checked_frame *out, tl_error *err);

/* Leaves it all zero. Accepts that. */
void tl_checked_frame_clear(tl_checked_frame *frame);

#endif
