#include "figures.h"

#include "pair_flops.h"

#include <math.h>
#include <stddef.h>

#define TIME(name) #name, offsetof(tl_bench_record, name##_ms)
const tl_bench_time tl_bench_times[] = {
    {TIME(frame), "a whole frame, from lights in world space to radiance on the host"},
    {TIME(kernel_cull), "the culling kernels, from profiling events"},
    {TIME(kernel_shade), "the shading kernel, from profiling events"},
    {TIME(post), "tone curve and rounding to 8 bits, on the host"},
};
#undef TIME
const int tl_bench_time_count = sizeof tl_bench_times / sizeof tl_bench_times[0];

#define RATIO(name) #name, offsetof(tl_bench_record, turns.name)
const tl_bench_time tl_bench_ratios[] = {
    {RATIO(frame), "whole frames"},
    {RATIO(cull), "the culling kernels"},
    {RATIO(shade), "the shading kernels"},
};
#undef RATIO
const int tl_bench_ratio_count = sizeof tl_bench_ratios / sizeof tl_bench_ratios[0];

const tl_summary *tl_bench_time_of(const tl_bench_time *time, const tl_bench_record *record)
{
    return (const tl_summary *)(const void *)((const char *)record + time->offset);
}

static double pixels(const tl_bench_record *r)
{
    return (double)r->of.scene_options.width * r->of.scene_options.height;
}

static double stored_pixels(const tl_bench_record *r)
{
    return (double)r->pitch * r->rows;
}

/* Seconds of shading: events, else the stage on the host. */
static double shade_seconds(const tl_bench_record *r)
{
    const double ms = r->kernel_shade_ms.median;
    return ms > 0.0 ? 1e-3 * ms : 1e-3 * r->frame_ms.median;
}

static double ns_per_pair(const tl_bench_record *r)
{
    return r->counts.pair_count ? 1e6 * r->frame_ms.median / (double)r->counts.pair_count
                                : (double)NAN;
}

static double ns_per_lit_pair(const tl_bench_record *r)
{
    return r->pairs.lit ? 1e6 * r->frame_ms.median / (double)r->pairs.lit : (double)NAN;
}

static double megapixels(const tl_bench_record *r)
{
    return 1e-3 * pixels(r) / r->frame_ms.median;
}

static double bytes_of_shading(const tl_bench_record *r)
{
    return (r->pixel_bytes + 3 * sizeof(float)) * stored_pixels(r) +
           4.0 * (double)r->counts.list_length;
}

/* Culling reads what positions are stored in and writes the lists that shading reads. */
static double bytes_moved(const tl_bench_record *r)
{
    return bytes_of_shading(r) + r->depth_bytes * stored_pixels(r) +
           4.0 * (double)r->counts.list_length;
}

/* A pair that the light does not reach costs its test. */
static double flops_of_shading(const tl_bench_record *r)
{
    return (double)TL_FLOPS_OF_TEST * (double)r->counts.pair_count +
           (double)(TL_FLOPS_OF_PAIR - TL_FLOPS_OF_TEST) * (double)r->pairs.in_range;
}

static double gflops_per_second(const tl_bench_record *r)
{
    return 1e-9 * flops_of_shading(r) / shade_seconds(r);
}

static double gbytes_per_second(const tl_bench_record *r)
{
    return 1e-9 * bytes_of_shading(r) / shade_seconds(r);
}

static double flops_per_byte(const tl_bench_record *r)
{
    return flops_of_shading(r) / bytes_of_shading(r);
}

static double share_of_flops(const tl_bench_record *r)
{
    return r->peaks.flops > 0.0 ? flops_of_shading(r) / shade_seconds(r) / r->peaks.flops
                                : (double)NAN;
}

static double share_of_bytes(const tl_bench_record *r)
{
    return r->peaks.bytes > 0.0 ? bytes_of_shading(r) / shade_seconds(r) / r->peaks.bytes
                                : (double)NAN;
}

const tl_figure tl_figures[] = {
    {"ns_per_pair", "frame time per pair that culling lists, padding included", 0, ns_per_pair},
    {"ns_per_lit_pair", "frame time per pair with light to see", 0, ns_per_lit_pair},
    {"mpixel_per_s", "pixels of the picture by frame time", 0, megapixels},
    {"bytes_moved", "G-buffer and picture once, depth and lists twice", 0, bytes_moved},
    {"flops_per_byte", "of shading", 0, flops_per_byte},
    {"gflop_per_s",
     "of shading: a test for each listed pair, the rest of a pair for each in range", 0,
     gflops_per_second},
    {"gbyte_per_s", "of shading: planes, lists, picture", 0, gbytes_per_second},
    {"share_of_peak_flops", "gflop_per_s by what nothing but fma reaches", 1, share_of_flops},
    {"share_of_peak_bytes", "gbyte_per_s by what nothing but memory reaches", 1,
     share_of_bytes},
};
const int tl_figure_count = sizeof tl_figures / sizeof tl_figures[0];

int tl_figure_is_possible(const tl_figure *figure, double value)
{
    static const double slack = 1.05;
    return !figure->is_share || !(value > slack);
}
