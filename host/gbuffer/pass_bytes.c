#include "pass_bytes.h"

#include "frame.h"
#include "layout.h"
#include "tile_rect.h"

static uint32_t words_of(const tl_attribute *attribute)
{
    uint32_t words = 0;
    for (int i = 0; attribute->code && i < 3; i++)
        if (attribute->channels[i].bits)
            words |= 1u << attribute->channels[i].word;
    return words;
}

/* Attributes that the kernels take from a frame with these planes (kernels/unpack.h, pixel.h). */
tl_pass_words tl_pass_words_of(enum tl_layout_name layout, uint32_t present, bool specular)
{
    const tl_layout *l = &tl_layouts[layout];
    tl_pass_words words = {.positions = words_of(&l->depth)};
    words.surfaces = words.positions | words_of(&l->normal);
    words.colors = words_of(&l->albedo);
    if (present & TL_HAS(TL_SHININESS) && specular)
        words.surfaces |= words_of(&l->shininess);
    if (present & TL_THREE(TL_SPECULAR_R) && specular)
        words.colors |= words_of(&l->specular);
    if (present & TL_GROUP_METAL_ROUGH) {
        words.colors |= words_of(&l->metallic);
        if (specular)
            words.surfaces |= words_of(&l->roughness);
    }
    if (present & TL_GROUP_OCCLUSION)
        words.colors |= words_of(&l->occlusion);
    if (present & TL_GROUP_EMISSIVE)
        words.colors |= words_of(&l->emissive);
    if (present & TL_GROUP_BRDF)
        words.surfaces |= words_of(&l->brdf);
    if (present & TL_GROUP_TANGENT)
        words.surfaces |= words_of(&l->tangent);
    return words;
}

uint32_t tl_words_size(enum tl_layout_name layout, uint32_t words)
{
    uint32_t size = 0;
    for (uint32_t i = 0; i < tl_layouts[layout].word_count; i++)
        if (words & 1u << i)
            size += tl_layouts[layout].words[i].bytes;
    return size;
}

static uint32_t stored_words(enum tl_layout_name layout, uint32_t present)
{
    uint32_t words = 0;
    for (uint32_t i = 0; i < tl_layouts[layout].word_count; i++)
        if (word_bytes(&tl_layouts[layout], present, i))
            words |= 1u << i;
    return words;
}

tl_pass_bytes tl_culling_bytes(const tl_frame_extent *of)
{
    const tl_pass_words words = tl_pass_words_of(of->layout, of->present, of->specular);
    const double light_size = sizeof(tl_view_light);
    const double rect_size = TL_RECT_PLANE_COUNT * sizeof(int32_t);
    const double boxes = TL_MAX_BOXES * 6 * sizeof(float);
    const double bits = TL_LIGHT_BLOCK / 8;
    const double count_and_place = 3 * sizeof(uint32_t);
    return (tl_pass_bytes){
        .words = of->pixels * tl_words_size(of->layout, words.positions),
        /* light_rects reads lights and writes rectangles, cull_rows reads both */
        .lights = of->lights * 2.0 * (light_size + rect_size),
        .tiles = of->tiles * 2.0 * (boxes + bits + count_and_place),
        .lists = of->list_entries * sizeof(uint32_t),
    };
}

tl_pass_bytes tl_shading_bytes(const tl_frame_extent *of)
{
    return (tl_pass_bytes){
        .words = of->pixels * tl_words_size(of->layout, stored_words(of->layout, of->present)),
        .lights = of->lights * sizeof(tl_view_light),
        .tiles = of->tiles * 2.0 * sizeof(uint32_t), /* where their lists start and end */
        .lists = of->list_entries * sizeof(uint32_t),
        .radiance = of->pixels * 3.0 * sizeof(float),
    };
}

double tl_pass_bytes_sum(const tl_pass_bytes *bytes)
{
    return bytes->words + bytes->lights + bytes->tiles + bytes->lists + bytes->radiance;
}
