/* Lights that are linked to objects: which pixels they are kept from.
 *
 * Each link of a frame has a bit of the words that stand behind the lights, a word a pixel for each 32 links:
 * set where the pixel's object is not one that the light is for. Objects are told apart by the host
 * (host/frame/links.c), by ids of 32 bits: here nothing is compared and nothing rounds, so every precision
 * has the same selection. A light adds exactly nothing to a pixel that it is kept from. */
#ifndef TL_LINK_H
#define TL_LINK_H

#include "frame.h"
#include "needs.h"

#ifdef __OPENCL_C_VERSION__
#    include "block.h"
#    define WORDS_OF_BLOCK(from, pitch) load_ints((__global const uchar *)(from), pitch)
#else
#    define WORDS_OF_BLOCK(from, pitch) ((void)(pitch), GATHER_WORDS(from, 0))
#endif

/* Lanes that a light with this shape is for. numbers: the buffer of lights; at: of the lanes' block in the
 * planes that are there. */
TL_INLINE mask lanes_of_link(
    const tl_frame *frame, tl_needs needs, tl_numbers numbers, tl_view_shape shape, size_t at)
{
    const tl_u32 link = shape.spot_and_link >> 1;
    if (!(needs.shapes & TL_SHAPE_LINK) || link == 0)
        return EVERY_LANE;
    const tl_view_links links =
        *(TL_GLOBAL const tl_view_links *)(numbers + ((size_t)frame->shapes_at - 1) * 4);
    const size_t before =
        (size_t)((link - 1) / 32) * links.rows + (size_t)(frame->first_row - frame->buffer_row);
    const word32 words = WORDS_OF_BLOCK(
        numbers + (size_t)links.words_at * 4 + before * frame->pitch + at, frame->pitch);
    return WORD_TO_REAL((words >> ((link - 1) % 32)) & 1u) < R(0.5);
}

#endif
