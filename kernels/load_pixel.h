/* Pixels from the word planes of a frame, as they are packed. OpenCL only. */
#ifndef TL_LOAD_PIXEL_H
#define TL_LOAD_PIXEL_H

#include "block.h"
#include "choices.h"
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

/* planes: the frame's word planes, of plane_size numbers each. at: the block's first pixel. wanted: which
 * words, bits 1 << word; the others are 0. */
TL_INLINE tl_words load_some_words(const tl_layout *layout,
                                   uint wanted,
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
        if (bytes != 0 && (wanted >> i & 1u))
            words.of[i] = load_word(planes + before * plane_size + at * bytes, bytes, pitch);
        before += bytes;
    }
    return words;
}

/* All words; what a build does not use of them is not loaded. */
TL_INLINE tl_words load_words(const tl_layout *layout,
                              __global const uchar *planes,
                              size_t plane_size,
                              size_t at,
                              uint pitch)
{
    return load_some_words(layout, ~0u, planes, plane_size, at, pitch);
}

/* The words that hold some of these planes, bits 1 << word. */
TL_INLINE uint words_of(const tl_layout *layout, uint planes)
{
    uint words = 0;
#pragma unroll
    for (uint i = 0; i < TL_MAX_WORDS; i++)
        if (word_bytes(layout, planes, i) != 0)
            words |= 1u << i;
    return words;
}

/* The words that shading reads. Where a tile has chosen to do without lobes, planes that only plain ones
 * are for are left out. */
TL_INLINE uint words_read(const tl_layout *layout, tl_needs needs)
{
    const uint planes = TL_PRESENT & ~TL_IDLE;
    const uint without_lobes = planes & ~(TL_GROUP_PHONG | TL_HAS(TL_ROUGHNESS));
    if ((needs.choices & TL_CHOICE_LOBES) && !needs.specular)
        return words_of(layout, without_lobes);
    return words_of(layout, planes);
}

/* The words that depth or a position is read from, bits 1 << word. */
TL_INLINE uint depth_words(const tl_layout *layout)
{
    uint words = 0;
#pragma unroll
    for (uint i = 0; i < 3; i++)
        if (layout->depth.channels[i].bits != 0)
            words |= 1u << layout->depth.channels[i].word;
    return words;
}

/* Asks for the same rows of the tile to the right, which is next as a rule: a processor's own prefetching
 * does not follow a line of 64 bytes in each of dozens of rows. words: which, bits 1 << word. first: the
 * first pixel of a row of blocks. */
TL_INLINE void ask_for_next(const tl_layout *layout,
                            uint words,
                            __global const uchar *planes,
                            size_t first,
                            const tl_frame *frame)
{
    const size_t plane_size = (size_t)frame->rows * frame->pitch;
    for (uint column = 0; column < frame->tile_size; column += BYTES_PER_LINE / 4) {
        const size_t next = first + frame->tile_size + column;
        size_t before = 0;
#pragma unroll
        for (uint i = 0; i < TL_MAX_WORDS; i++) {
            const uint bytes = word_bytes(layout, TL_PRESENT, i);
            if (bytes != 0 && (words >> i & 1u))
                ASK_FOR_ROWS(planes + before * plane_size + next * bytes, frame->pitch * bytes,
                             0);
            before += bytes;
        }
    }
}

#endif
