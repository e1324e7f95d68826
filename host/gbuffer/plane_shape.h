/* The shape of a plane in memory: of a G-buffer's and of the picture's beside it. */
#ifndef TL_PLANE_SHAPE_H
#define TL_PLANE_SHAPE_H

#include "tilelight/gbuffer.h"

static inline uint32_t tl_plane_rows(uint32_t height)
{
    return (height + TL_PADDING - 1) / TL_PADDING * TL_PADDING;
}

/* Rows that are multiples of 2048 bytes apart want the same few sets of a cache, those of 2048 and
 * 7680 px: they get TL_PADDING more. */
static inline uint32_t tl_plane_pitch(uint32_t width)
{
    const uint32_t pitch = (width + TL_PADDING - 1) / TL_PADDING * TL_PADDING;
    return pitch * sizeof(float) % 2048 == 0 ? pitch + TL_PADDING : pitch;
}

#endif
