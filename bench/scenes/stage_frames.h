/* Pairs of a frame and the same one with a stage more, to say what that costs: as much work as it ever is. */
#ifndef TL_STAGE_FRAMES_H
#define TL_STAGE_FRAMES_H

#include "effect_frames.h"

/* Pairs go by their index; of each, a word and a phrase that says how much there is of the stage. */
extern const int tl_stage_count;
tl_effect_frame_row tl_stage_about(int index);

/* Whether both pictures of a pair have the same bits. */
int tl_stage_keeps_bits(int index);

/* What of its light is written beside the picture: terms (tl_lighting_options.split), and groups of lights,
 * each lit alone, the lights by turns. */
uint32_t tl_stage_split(int index);
uint32_t tl_stage_group_count(int index);

/* *with may borrow the G-buffer of *without: clear it first; else it is a part of that. Fails with TL_ERR_ARGUMENT (a size out of range) or
 * TL_ERR_MEMORY; then both are all zero. */
tl_status tl_stage_make(int index,
                        uint32_t width,
                        uint32_t height,
                        tl_effect_frame *without,
                        tl_effect_frame *with,
                        tl_error *err);

#endif
