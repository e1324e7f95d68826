/* Pixels from the word planes of a frame, as they are packed. OpenCL only. */
#ifndef TL_LOAD_PIXEL_H
#define TL_LOAD_PIXEL_H

#include "block.h"
#include "unpack.h"

/* The layout of the build: what is read from it is a constant. */
TL_INLINE tl_layout layout_of_build(void)
{
    return tl_layouts[TL_LAYOUT];
}

/* A block of one plane, `pitch` numbers from row to row. */
TL_INLINE word32 load_word(__global const uchar *from, uint bytes, uint pitch)
{
    if (bytes == 1)
        return load_bytes(from, pitch);
    if (bytes == 2)
        return load_shorts(from, pitch);
    return load_ints(from, pitch);
}

/* planes: the frame's word planes, of plane_size numbers each. at: the block's first pixel. */
TL_INLINE tl_words load_words(const tl_layout *layout,
                              __global const uchar *planes,
                              size_t plane_size,
                              size_t at,
                              uint pitch)
{
    tl_words words;
    size_t before = 0;
#pragma unroll
    for (uint i = 0; i < TL_MAX_WORDS; i++) {
        const uint bytes = word_bytes(layout, TL_PRESENT, i);
        words.of[i] = 0;
        if (bytes != 0)
            words.of[i] = load_word(planes + before * plane_size + at * bytes, bytes, pitch);
        before += bytes;
    }
    return words;
}

#endif
