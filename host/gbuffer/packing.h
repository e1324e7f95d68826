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

/* at: the pixel, counted in the planes. */
static inline tl_words tl_words_at(const tl_word_planes *planes, size_t at)
{
    tl_words words = {{0}};
    for (uint32_t i = 0; i < planes->layout->word_count; i++) {
        const void *from = planes->of[i];
        const uint32_t bytes = planes->layout->words[i].bytes;
        if (from)
            words.of[i] = bytes == 4   ? ((const uint32_t *)from)[at]
                          : bytes == 2 ? ((const uint16_t *)from)[at]
                                       : ((const uint8_t *)from)[at];
    }
    return words;
}

static inline void tl_words_put(const tl_word_planes *planes, size_t at, tl_words words)
{
    for (uint32_t i = 0; i < planes->layout->word_count; i++) {
        void *to = planes->of[i];
        const uint32_t bytes = planes->layout->words[i].bytes;
        if (!to)
            continue;
        if (bytes == 4)
            ((uint32_t *)to)[at] = words.of[i];
        else if (bytes == 2)
            ((uint16_t *)to)[at] = (uint16_t)words.of[i];
        else
            ((uint8_t *)to)[at] = (uint8_t)words.of[i];
    }
}

/* The words of a pixel where nothing was hit. Cannot fail. */
tl_words tl_sky_words(const tl_camera *camera, enum tl_layout_name layout, uint32_t present);

/* Whether the layout's convention of depth is one of this camera; a reason where it is not. Fails with
 * TL_ERR_UNSUPPORTED. */
tl_status tl_layout_suits(const tl_camera *camera, enum tl_layout_name layout, tl_error *err);

#endif
