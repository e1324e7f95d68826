/* Frames that show what choosing effects is worth: five from the plainest to the richest, and pairs of a
 * frame and the same one with an effect that none of its tiles uses.
 *
 * All five have one G-buffer's planes, as programs with one fixed G-buffer write them: specular colour,
 * exponent, occlusion and emission, which in the plainer frames say nothing. */
#ifndef TL_EFFECT_FRAMES_H
#define TL_EFFECT_FRAMES_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* All zero to begin with; released with tl_effect_frame_clear. */
typedef struct tl_effect_frame {
    tl_gbuffer *gbuffer; /* repaired */
    int borrows;         /* 1: the G-buffer is another frame's */
    tl_light_set lights;
} tl_effect_frame;

typedef struct tl_effect_frame_row {
    const char *name; /* of the five a word, of a pair the word of the effect */
    /* a phrase: what is in it; of a pair, how the effect is there, unused */
    const char *meaning;
} tl_effect_frame_row;

/* The five, the plainest first; frames go by their index. */
extern const int tl_effect_frame_count;
tl_effect_frame_row tl_effect_frame_about(int index);

/* Fails with TL_ERR_ARGUMENT (a size out of range) or TL_ERR_MEMORY; then *out is all zero. */
tl_status tl_effect_frame_make(
    int index, uint32_t width, uint32_t height, tl_effect_frame *out, tl_error *err);

/* The pairs, likewise. */
extern const int tl_unused_effect_count;
tl_effect_frame_row tl_unused_effect_about(int index);

/* *with differs from *without by the effect, and is the same picture. It may borrow the other's G-buffer:
 * clear it first. Fails in the same way. */
tl_status tl_unused_effect_make(int index,
                                uint32_t width,
                                uint32_t height,
                                tl_effect_frame *without,
                                tl_effect_frame *with,
                                tl_error *err);

/* *to, all zero, has copies of the lights and borrows the G-buffer. Fails with TL_ERR_MEMORY. */
tl_status tl_effect_frame_alike(const tl_effect_frame *frame,
                                tl_effect_frame *to,
                                tl_error *err);

/* Leaves it all zero. Accepts that. */
void tl_effect_frame_clear(tl_effect_frame *frame);

#endif
