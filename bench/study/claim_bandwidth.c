#include "claims.h"

#include "bandwidth_model.h"
#include "pass_bytes.h"
#include "tilelight/layouts.h"

#include <math.h>

/* 10^9 bytes a second. */
static double by_model(double targets, double bits)
{
    const tl_bandwidth_variables variables = tl_bandwidth_variables_default();
    return 1e-9 * tl_bandwidth(&variables, tl_targets_alike(targets, bits));
}

/* Table 2 follows from this. */
static double by_table(double targets, double bits)
{
    return 1e-9 * tl_bandwidth_rounded(tl_targets_alike(targets, bits).read);
}

/* The same size, rate and number of lights, each on all pixels. */
static double of_our_passes(enum tl_layout_name layout)
{
    const tl_bandwidth_variables v = tl_bandwidth_variables_default();
    const double tile = tl_lighting_options_default().tile_size;
    const double pixels = v.width * v.height, tiles = pixels / (tile * tile);
    const tl_frame_extent extent = {.layout = layout,
                                    .present = tl_layout_planes(layout) &
                                               (TL_GROUP_BASE | TL_GROUP_PHONG),
                                    .specular = true,
                                    .pixels = pixels,
                                    .tiles = tiles,
                                    .lights = v.shading_passes,
                                    .list_entries = tiles * v.shading_passes};
    const tl_pass_bytes culling = tl_culling_bytes(&extent),
                        shading = tl_shading_bytes(&extent);
    return 1e-9 * v.frames_per_second *
           (tl_pass_bytes_sum(&culling) + tl_pass_bytes_sum(&shading));
}

tl_status tl_claim_bandwidth(const tl_claim_options *options,
                             tl_claim_figures *out,
                             tl_error *err)
{
    static const struct {
        enum tl_layout_name layout;
        double targets, bits; /* that the article would count */
    } ours[] = {{TL_LAYOUT_MERLIN, 2.0, 32.0},
                {TL_LAYOUT_TUTORIAL, 3.0, 32.0},
                {TL_LAYOUT_SHADERX2_128, 4.0, 32.0},
                {TL_LAYOUT_SHADERX2_128, 2.0, 64.0}};
    tl_claim_figures made = {.count = 0};
    (void)options, (void)err;
    for (double targets = 2.0; targets <= 4.0; targets += 1.0)
        for (double bits = 32.0; bits <= 128.0; bits *= 2.0)
            tl_claim_add(&made, "GB/s", by_table(targets, bits), by_table(targets, bits),
                         by_model(targets, bits), "%.0f targets of %.0f bits, by equation 6",
                         targets, bits);
    for (size_t i = 0; i < sizeof ours / sizeof ours[0]; i++)
        tl_claim_add(&made, "GB/s", by_table(ours[i].targets, ours[i].bits),
                     by_table(ours[i].targets, ours[i].bits), of_our_passes(ours[i].layout),
                     "%.0f targets of %.0f bits: our passes with the layout %s",
                     ours[i].targets, ours[i].bits, tl_layout_word(ours[i].layout));
    *out = made;
    return TL_OK;
}
