/* Sets of frames, in the grammar that Fileseq made common: "1-100x5,3,-10--5". */
#ifndef TL_FRAME_SET_H
#define TL_FRAME_SET_H

#include "tilelight/error.h"

#include <stddef.h>
#include <stdint.h>

#define TL_MOST_FRAMES 10000000u     /* in one set */
#define TL_FARTHEST_FRAME 999999999L /* from 0, on either side */

/* In the order in which they are asked for, each once. All zero is a valid empty set; released with
 * tl_frames_clear. */
typedef struct tl_frames {
    int32_t *of; /* [count] */
    size_t count;
} tl_frames;

/* Items between commas, spaces ignored:
 *
 *   7        a frame; -7 as well
 *   1-10     all from 1 to 10; 10-1 backwards
 *   1-10x3   every third of them, from the first
 *   1-10y3   the others
 *   1-10:3   every third, then what every second adds, then the rest: the whole shows early
 *
 * A frame that comes again is left out. Fails with TL_ERR_ARGUMENT, saying which item is none, for one whose
 * step is 0 or leads away from its end, for a set without frames, and for more than TL_MOST_FRAMES;
 * TL_ERR_MEMORY. *out is replaced on success and left alone on failure. */
tl_status tl_frames_parse(const char *text, tl_frames *out, tl_error *err);

/* The same set in as few items as runs of one step allow, in its order: what tl_frames_parse takes. The
 * caller frees *out. Fails with TL_ERR_MEMORY. */
tl_status tl_frames_format(const tl_frames *frames, char **out, tl_error *err);

/* Leaves an empty set. Accepts an empty one. */
void tl_frames_clear(tl_frames *frames);

#endif
