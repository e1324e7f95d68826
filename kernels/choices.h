/* What tiles choose for themselves: effects that some lights of a frame call for and others do not. A tile
 * computes those that a light on it calls for.
 *
 * Where a choice is open (TL_CHOICES), the section `calls_at` of the lights has a word per light, the bits
 * of what it calls for. A light that does not call for an effect adds the same bits with and without it: the
 * share of a cone that is all of space is exactly 1, a lobe of no colour adds exactly 0, and a light without
 * a shape is lit as where no light has one. So what a tile chooses cannot show, and a tile may compute more
 * than its lights call for.
 *
 * Closed where all lights agree, or --effects all asks for everything: then nothing is looked up. */
#ifndef TL_CHOICES_H
#define TL_CHOICES_H

#include "frame.h"

enum tl_choice {
    TL_CHOICE_CONES = 1, /* spots: the light has a cone */
    TL_CHOICE_LOBES = 2, /* specular: the light has a specular lobe */
    TL_CHOICE_SHAPES = 4 /* shapes: the light has a shape */
};

#ifdef __OPENCL_C_VERSION__
/* What the lights on a tile call for, as bits of tl_choice: those of its list and those that reach
 * everything. */
TL_INLINE uint calls_of_tile(const tl_frame *frame,
                             __global const tl_view_light *lights,
                             __global const uint *list,
                             uint start,
                             uint end)
{
    __global const uint *calls =
        (__global const uint *)lights + (size_t)frame->calls_at * (TL_SECTION_ROW / 4);
    uint called = 0;
    for (uint i = 0; i < frame->global_count; i++)
        called |= calls[i];
    for (uint i = start; i < end; i++)
        called |= calls[list[i]];
    return called;
}
#endif

#endif
