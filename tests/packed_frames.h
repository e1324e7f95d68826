/* Frames in every layout: random ones, and ones whose positions are anywhere. */
#ifndef TL_PACKED_FRAMES_H
#define TL_PACKED_FRAMES_H

#include "frames.h"

#include "packing.h"

/* Every plane that the layout has a place for; a Phong material where it can. Repaired. */
static inline tl_gbuffer *packed_gbuffer(const tl_camera *camera,
                                         enum tl_layout_name layout,
                                         uint32_t seed)
{
    const uint32_t can = tl_layout_planes(layout);
    const uint32_t material = can & TL_GROUP_PHONG ? TL_GROUP_PHONG : TL_GROUP_METAL_ROUGH;
    tl_gbuffer *from = random_gbuffer(
        camera, TL_GROUP_BASE | material | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, seed);
    tl_gbuffer *packed = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_repair(from, "random", false, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_pack(from, layout, &packed, NULL, &err), err);
    tl_gbuffer_destroy(from);
    return packed;
}

static inline size_t gbuffer_bytes(const tl_gbuffer *g)
{
    return (size_t)g->pitch * g->rows * tl_gbuffer_pixel_size(g);
}

/* The bits of one channel of the pixel `at`, and how to change them. */
static inline uint32_t channel_bits(const tl_gbuffer *g, size_t at, tl_channel c)
{
    const tl_word_planes planes = tl_word_planes_of(g);
    return field_of(tl_words_at(&planes, at).of[c.word], c.shift, c.bits);
}

static inline void set_channel_bits(tl_gbuffer *g, size_t at, tl_channel c, uint32_t bits)
{
    const tl_word_planes planes = tl_word_planes_of(g);
    const uint32_t ones = c.bits == 32 ? ~0u : (1u << c.bits) - 1u;
    tl_words words = tl_words_at(&planes, at);
    words.of[c.word] = (words.of[c.word] & ~(ones << c.shift)) | (bits & ones) << c.shift;
    tl_words_put(&planes, at, words);
}

/* Stored positions leave their rays: the highest bits of the mantissas of x and y become random ones, so
 * each moves by up to half of what it is. Nothing moves where depth is stored. Repaired. */
static inline void move_positions(tl_gbuffer *g, uint32_t seed)
{
    const tl_attribute *depth = &tl_layouts[g->layout].depth;
    tl_error err;
    for (uint32_t y = 0; y < g->camera.height && TL_IS_POSITION(depth->code); y++)
        for (uint32_t x = 0; x < g->camera.width; x++)
            for (int axis = 0; axis < 2; axis++) {
                const tl_channel c = depth->channels[axis];
                const size_t at = (size_t)y * g->pitch + x;
                const uint32_t shift = c.number == TL_NUMBER_HALF ? 7 : 20;
                const uint32_t flips = (uint32_t)uniform(&seed, 0.0f, 8.0f) << shift;
                set_channel_bits(g, at, c, channel_bits(g, at, c) ^ flips);
            }
    ASSERT_OK(tl_gbuffer_repair(g, "moved", false, NULL, &err), err);
}

/* Every bit is random, which no pixel is safe from. Repaired. */
static inline void scramble(tl_gbuffer *g, uint32_t seed)
{
    tl_error err;
    for (size_t i = 0; i < gbuffer_bytes(g) / 4; i++) {
        uniform(&seed, 0.0f, 1.0f);
        memcpy(g->planes + 4 * i, &seed, 4);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "bits", false, NULL, &err), err);
}

#endif
