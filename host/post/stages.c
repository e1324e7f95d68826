#include "stage.h"

#include "bloom_plan.h"
#include "layout.h"

const tl_post_stage_row tl_post_stage_rows[TL_POST_STAGE_COUNT] = {
#define ROW(name, word, reads, meaning) [name] = {word, reads, meaning},
    TL_POST_STAGES(ROW)
#undef ROW
};

enum { PICTURE = 3 * sizeof(float) };

/* Words of the G-buffer that depth or normals are in, once; planes of edges, written and read. */
static double bytes_of_edges(const tl_edge_options *o, const tl_gbuffer *g)
{
    const tl_layout *layout = &tl_layouts[g->layout];
    const uint32_t planes =
        (o->depth ? TL_HAS(TL_DEPTH) : 0) |
        (o->normals ? TL_HAS(TL_NORMAL_X) | TL_HAS(TL_NORMAL_Y) | TL_HAS(TL_NORMAL_Z) : 0);
    const double edge_planes = (o->depth ? 1.0 : 0.0) + (o->normals ? 3.0 : 0.0);
    double words = 0.0;
    for (uint32_t i = 0; i < layout->word_count; i++)
        words += word_bytes(layout, planes & g->present, i);
    return words + 2.0 * edge_planes * sizeof(float) + 2.0 * PICTURE;
}

/* Small pictures: written by the bright pass, by each of the taps' passes read and written, read at the end.
 * */
static double bytes_of_bloom(const tl_bloom_options *o)
{
    const uint32_t side = o->side ? o->side : TL_DEFAULT_BLOOM_SIDE;
    const double width = (double)(o->width > 0.0f ? o->width : TL_DEFAULT_BLOOM_WIDTH);
    const double of_small = PICTURE / (double)(side * side);
    return 3.0 * PICTURE + (2.0 + 4.0 * tl_bloom_plan_for(width, side).passes) * of_small;
}

/* Read, written as wide as it was and as tall as it will be, read again, and written. */
static double bytes_of_scale(const tl_post_options *o, const tl_gbuffer *g)
{
    const uint32_t side = tl_samples_side(g->samples);
    const double across = (double)o->width * side / g->camera.width,
                 down = (double)o->height * side / g->camera.height;
    return o->width > 0 ? PICTURE * (1.0 + 2.0 * down + across * down) : 0.0;
}

double tl_post_bytes(const tl_post_options *options,
                     const tl_gbuffer *gbuffer,
                     int has_no_colors)
{
    double bytes = options->mend ? PICTURE * (has_no_colors ? 3.0 : 1.0) : 0.0;
    if (options->edges.normals || options->edges.depth)
        bytes += bytes_of_edges(&options->edges, gbuffer);
    if (options->bloom.strength > 0.0f)
        bytes += bytes_of_bloom(&options->bloom);
    return bytes + bytes_of_scale(options, gbuffer);
}
