/* Words of pixels in host memory, and what a layout needs of its G-buffer. */
#ifndef TL_PACKING_H
#define TL_PACKING_H

#include "unpack.h"
#include "view.h"

#include "tilelight/layouts.h"

/* Where the words of a G-buffer stand; NULL: not stored. */
typedef struct tl_word_planes {
    const tl_layout *layout;
    void *of[TL_MAX_WORDS];
} tl_word_planes;

static inline tl_word_planes tl_word_planes_of(const tl_gbuffer *gbuffer)
{
    tl_word_planes planes = {.layout = &tl_layouts[gbuffer->layout]};
    for (uint32_t i = 0; i < planes.layout->word_count; i++)
        planes.of[i] = tl_gbuffer_words(gbuffer, i);
    return planes;
}

/* at: the pixel, counted in the planes. 0 where the word is not stored. */
static inline uint32_t tl_word_at(const tl_word_planes *planes, uint32_t word, size_t at)
{
    const void *from = planes->of[word];
    const uint32_t bytes = planes->layout->words[word].bytes;
    if (!from)
        return 0;
    return bytes == 4   ? ((const uint32_t *)from)[at]
           : bytes == 2 ? ((const uint16_t *)from)[at]
                        : ((const uint8_t *)from)[at];
}

static inline void tl_word_put(const tl_word_planes *planes,
                               uint32_t word,
                               size_t at,
                               uint32_t value)
{
    void *to = planes->of[word];
    const uint32_t bytes = planes->layout->words[word].bytes;
    if (!to)
        return;
    if (bytes == 4)
        ((uint32_t *)to)[at] = value;
    else if (bytes == 2)
        ((uint16_t *)to)[at] = (uint16_t)value;
    else
        ((uint8_t *)to)[at] = (uint8_t)value;
}

static inline tl_words tl_words_at(const tl_word_planes *planes, size_t at)
{
    tl_words words = {{0}};
    for (uint32_t i = 0; i < planes->layout->word_count; i++)
        words.of[i] = tl_word_at(planes, i, at);
    return words;
}

static inline void tl_words_put(const tl_word_planes *planes, size_t at, tl_words words)
{
    for (uint32_t i = 0; i < planes->layout->word_count; i++)
        tl_word_put(planes, i, at, words.of[i]);
}

/* What is the same for every pixel that is unpacked. */
typedef struct tl_unpacking {
    const tl_gbuffer *from;
    tl_word_planes words; /* of `from` */
    tl_frame frame;
    tl_needs needs;
} tl_unpacking;

tl_unpacking tl_unpacking_of(const tl_gbuffer *from);

/* Pixels [begin, end) of a row in full float, as float kernels read them. to[p]: [end - begin] of plane p,
 * NULL where it is not wanted. Cannot fail. */
void tl_unpack_span(const tl_unpacking *unpacking,
                    uint32_t row,
                    uint32_t begin,
                    uint32_t end,
                    float *const to[TL_PLANE_COUNT]);

/* Whether a frame may have these planes and no others: every group whole, one kind of material. Fails
 * with TL_ERR_ARGUMENT. */
tl_status tl_planes_check(uint32_t present, tl_error *err);

/* The words of a pixel where nothing was hit. Cannot fail. */
tl_words tl_sky_words(const tl_camera *camera, enum tl_layout_name layout, uint32_t present);

/* Whether the layout's convention of depth is one of this camera; a reason where it is not. Fails with
 * TL_ERR_UNSUPPORTED. */
tl_status tl_layout_suits(const tl_camera *camera, enum tl_layout_name layout, tl_error *err);

#endif
