#include "part_options.h"

#include "layout.h"

#include <string.h>

/* Frames of this layout that have these planes. */
typedef struct stored {
    uint32_t layout, present;
} stored;

/* Of words up to the last that the attribute is stored in: channels without bits are not. */
static uint32_t words_up_to(const tl_attribute *attribute)
{
    uint32_t count = 0;
    for (int i = 0; i < 3; i++)
        if (attribute->channels[i].bits != 0 && attribute->channels[i].word >= count)
            count = attribute->channels[i].word + 1;
    return count;
}

/* Whether attributes of two kinds of frame are read alike: the same bits of the same words, and these at the
 * same place, for as much stands before them. */
static int same_attribute(stored a,
                          const tl_attribute *of_a,
                          stored b,
                          const tl_attribute *of_b)
{
    if (memcmp(of_a, of_b, sizeof *of_a) != 0)
        return 0;
    for (uint32_t i = 0; i < words_up_to(of_a); i++)
        if (word_bytes(&tl_layouts[a.layout], a.present, i) !=
            word_bytes(&tl_layouts[b.layout], b.present, i))
            return 0;
    return 1;
}

static int same_positions(stored a, stored b)
{
    return same_attribute(a, &tl_layouts[a.layout].depth, b, &tl_layouts[b.layout].depth);
}

static int same_positions_and_normals(stored a, stored b)
{
    const tl_layout *of_a = &tl_layouts[a.layout], *of_b = &tl_layouts[b.layout];
    return same_positions(a, b) && of_a->normal_space == of_b->normal_space &&
           same_attribute(a, &of_a->normal, b, &of_b->normal);
}

/* The first layout whose frames of no planes but the base are read as `frame` is; itself where none is. */
static stored first_like(const tl_kernel_options *frame, int (*are_alike)(stored, stored))
{
    const stored own = {frame->layout, frame->present};
    for (uint32_t layout = 0; layout <= own.layout; layout++) {
        const stored first = {layout, TL_GROUP_BASE};
        if (are_alike(first, own))
            return first;
    }
    return own;
}

/* Culling reads where surfaces are. */
static tl_kernel_options options_to_cull(const tl_kernel_options *frame)
{
    const stored read = first_like(frame, same_positions);
    return (tl_kernel_options){.width = frame->width,
                               .by_pixel = frame->by_pixel,
                               .real_double = frame->real_double,
                               .orthographic = frame->orthographic,
                               .layout = read.layout,
                               .present = read.present,
                               .spots = frame->spots};
}

/* Surroundings are made of depths and normals. */
static tl_kernel_options options_to_occlude(const tl_kernel_options *frame)
{
    const stored read = first_like(frame, same_positions_and_normals);
    return (tl_kernel_options){.width = frame->width,
                               .by_pixel = frame->by_pixel,
                               .real_double = frame->real_double,
                               .orthographic = frame->orthographic,
                               .layout = read.layout,
                               .present = read.present,
                               .surroundings = frame->surroundings};
}

/* Blending reads pictures alone. */
static tl_kernel_options options_to_blend(const tl_kernel_options *frame)
{
    return (tl_kernel_options){
        .width = frame->width, .by_pixel = frame->by_pixel, .real_double = frame->real_double};
}

static tl_kernel_options options_to_shade(const tl_kernel_options *frame)
{
    return *frame;
}

tl_kernel_options tl_part_options(tl_program_part part, const tl_kernel_options *frame)
{
    static tl_kernel_options (*const of[TL_PART_COUNT])(const tl_kernel_options *) = {
        [TL_PART_CULL] = options_to_cull,
        [TL_PART_OCCLUDE] = options_to_occlude,
        [TL_PART_SHADE] = options_to_shade,
        [TL_PART_BLEND] = options_to_blend,
    };
    return of[part](frame);
}
