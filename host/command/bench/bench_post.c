#include "bench_post.h"

#include "bench_json.h"
#include "console.h"
#include "effect_frames.h"
#include "json_values.h"
#include "tilelight/post.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Thresholds are shares of what the automatic exposure brings to 1. */
static const struct {
    tl_post_stage stage;
    const char *meaning;
    tl_post_options options;
    int is_spoiled; /* 1: a pixel of the picture is no number */
} rows_of_stages[] = {
    {TL_POST_MEND, "of a picture of colours", {.mend = 1}, 0},
    {TL_POST_MEND, "of one with a pixel that is none", {.mend = 1}, 1},
    {TL_POST_EDGES, "in normals and depth", {.edges = {.normals = 1, .depth = 1}}, 0},
    {TL_POST_EDGES, "in normals alone", {.edges = {.normals = 1}}, 0},
    {TL_POST_EDGES, "in depth alone", {.edges = {.depth = 1}}, 0},
    {TL_POST_BLOOM, "6 px wide, at a quarter", {.bloom = {0.3f, 1.0f, 0.5f, 6.0f, 4}}, 0},
    {TL_POST_BLOOM, "6 px wide, at half", {.bloom = {0.3f, 1.0f, 0.5f, 6.0f, 2}}, 0},
    {TL_POST_BLOOM, "where nothing is bright", {.bloom = {0.3f, 1e20f, 0.5f, 6.0f, 4}}, 0},
    {TL_POST_SCALE, "to 640 x 360, by mitchell", {.width = 640, .height = 360}, 0},
    {TL_POST_SCALE,
     "to 640 x 360, by lanczos3",
     {.width = 640, .height = 360, .filter = TL_FILTER_LANCZOS3},
     0},
};
enum { ROW_COUNT = sizeof rows_of_stages / sizeof rows_of_stages[0] };

/* Codes of 8 bits, which leave the device in place of the picture, or are made of it. */
static const struct {
    const char *meaning;
    tl_look look;
    int on_host;
} rows_of_codes[] = {
    {"by aces, on the device", {.tone = TL_TONE_ACES}, 0},
    {"by aces, on the host", {.tone = TL_TONE_ACES}, 1},
    {"by agx and blue noise, on the device",
     {.tone = TL_TONE_AGX, .dither = TL_DITHER_BLUE_NOISE},
     0},
    {"by agx and blue noise, on the host",
     {.tone = TL_TONE_AGX, .dither = TL_DITHER_BLUE_NOISE},
     1},
};
enum {
    CODE_ROW_COUNT = sizeof rows_of_codes / sizeof rows_of_codes[0],
    BYTES_FOR_CODES = 3 * sizeof(float) + 3 /* per pixel, read and written */
};

/* A stage at work on copies of a lit picture. */
typedef struct post_bench {
    bench_session *session;
    const tl_sampling_rule *rule;
    tl_lighting_options lighting;
    tl_effect_frame frame;
    tl_image *lit, *image;
    float exposed;         /* what radiance is 1 once exposed */
    tl_post_counts counts; /* of the last run */
    tl_samples wall_ms, kernel_ms;
} post_bench;

static tl_status light(post_bench *b, tl_error *err)
{
    const tl_camera *camera = &b->frame.gbuffer->camera;
    tl_lighting *lighting = NULL;
    tl_status status = TL_OK;
    TRY(tl_image_create(camera->width, camera->height, &b->lit, err));
    TRY(tl_image_create(camera->width, camera->height, &b->image, err));
    TRY(tl_lighting_create(b->session->device, &b->lighting, &lighting, err));
    TRY(tl_lighting_run(lighting, b->frame.gbuffer, &b->frame.lights, b->lit, NULL, NULL, NULL,
                        err));
    b->exposed = exp2f(-tl_image_auto_exposure(b->lit));
done:
    tl_lighting_destroy(lighting);
    return status;
}

/* The lit picture again, in memory of its size: stages may have given it another. */
static tl_status copy_lit(post_bench *b, tl_error *err)
{
    if (b->image->width != b->lit->width || b->image->height != b->lit->height) {
        tl_image_destroy(b->image);
        b->image = NULL;
        const tl_status status = tl_image_create(b->lit->width, b->lit->height, &b->image, err);
        if (status != TL_OK)
            return status;
    }
    memcpy(b->image->planes, b->lit->planes,
           3 * (size_t)b->lit->pitch * b->lit->rows * sizeof(float));
    return TL_OK;
}

static tl_status run_once(
    post_bench *b, tl_post *post, int row, double *wall, double *kernel, tl_error *err)
{
    const tl_status copied = copy_lit(b, err);
    if (copied != TL_OK)
        return copied;
    if (rows_of_stages[row].is_spoiled)
        b->image->planes[0] = NAN;
    const double start = tl_seconds();
    const tl_status status =
        tl_post_run(post, b->frame.gbuffer, &b->image, NULL, NULL, &b->counts, err);
    *wall = 1e3 * (tl_seconds() - start);
    *kernel = status == TL_OK ? b->counts.device_ms[rows_of_stages[row].stage] : 0.0;
    return status;
}

static tl_status sample(post_bench *b, tl_post *post, int row, tl_error *err)
{
    tl_status status = TL_OK;
    double wall, kernel;
    TRY(run_once(b, post, row, &wall, &kernel, err)); /* compiles, and makes buffers */
    const double start = tl_seconds();
    do {
        TRY(run_once(b, post, row, &wall, &kernel, err));
        TRY(tl_samples_add(&b->wall_ms, wall, err));
        TRY(tl_samples_add(&b->kernel_ms, kernel, err));
    } while (!tl_sampling_done(b->rule, &b->wall_ms, start));
done:
    return status;
}

/* What a picture without anything bright has to be read for. */
static double bytes_of(const post_bench *b, int row)
{
    if (rows_of_stages[row].stage == TL_POST_BLOOM && !b->counts.is_bright)
        return 3.0 * sizeof(float);
    return tl_post_bytes(&rows_of_stages[row].options, b->frame.gbuffer,
                         rows_of_stages[row].is_spoiled);
}

static void tell(
    const post_bench *b, const char *name, const char *meaning, double bytes, json_t *to)
{
    const tl_summary wall = tl_samples_summarize(&b->wall_ms),
                     kernel = tl_samples_summarize(&b->kernel_ms);
    const double pixels = (double)b->lit->width * b->lit->height;
    const double floor_ms = 1e3 * bytes * pixels / b->session->peaks.copy_bytes;
    if (b->session->table)
        fprintf(b->session->table, "%-10s %9.2f %9.2f %9.1f %9.2f %7.2f %6zu  %s\n", name,
                wall.median, kernel.median, bytes, floor_ms, kernel.median / floor_ms,
                wall.count, meaning);
    json_array_append_new(to, json_pack("{ss ss so so sf sf}", "name", name, "meaning", meaning,
                                        "ms", tl_bench_json_summary(&wall), "kernel_ms",
                                        tl_bench_json_summary(&kernel), "bytes_per_pixel",
                                        bytes, "floor_ms", floor_ms));
}

static tl_status measure(post_bench *b, int row, json_t *to, tl_error *err)
{
    tl_post_options options = rows_of_stages[row].options;
    tl_post *post = NULL;
    tl_status status = TL_OK;
    options.bloom.threshold *= b->exposed;
    tl_samples_clear(&b->wall_ms);
    tl_samples_clear(&b->kernel_ms);
    TRY(tl_post_create(b->session->device, &b->lighting, &options, &post, err));
    TRY(sample(b, post, row, err));
    tell(b, tl_post_stage_rows[rows_of_stages[row].stage].word, rows_of_stages[row].meaning,
         bytes_of(b, row), to);
done:
    tl_post_destroy(post);
    return status;
}

static tl_status make_codes(post_bench *b, tl_post *post, int row, uint8_t *rgb, tl_error *err)
{
    const float exposure = tl_image_auto_exposure(b->lit);
    double kernel = 0.0;
    tl_status status = TL_OK;
    const double start = tl_seconds();
    if (rows_of_codes[row].on_host)
        tl_image_to_rgb8(b->lit, exposure, rows_of_codes[row].look, rgb);
    else
        TRY(tl_post_codes(post, b->lit, exposure, rows_of_codes[row].look, rgb, NULL, &kernel,
                          err));
    const double wall = 1e3 * (tl_seconds() - start);
    TRY(tl_samples_add(&b->wall_ms, wall, err));
    TRY(tl_samples_add(&b->kernel_ms, kernel > 0.0 ? kernel : wall, err));
done:
    return status;
}

static tl_status measure_codes(post_bench *b, int row, json_t *to, tl_error *err)
{
    static const tl_post_options nothing = {.mend = 0};
    uint8_t *const rgb = malloc(3 * (size_t)b->lit->width * b->lit->height);
    tl_post *post = NULL;
    tl_status status = TL_OK;
    if (!rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for codes of a picture"));
    TRY(tl_post_create(b->session->device, &b->lighting, &nothing, &post, err));
    TRY(make_codes(b, post, row, rgb, err)); /* compiles */
    tl_samples_clear(&b->wall_ms);
    tl_samples_clear(&b->kernel_ms);
    const double start = tl_seconds();
    do {
        TRY(make_codes(b, post, row, rgb, err));
    } while (!tl_sampling_done(b->rule, &b->wall_ms, start));
    tell(b, "codes", rows_of_codes[row].meaning, BYTES_FOR_CODES, to);
done:
    tl_post_destroy(post);
    free(rgb);
    return status;
}

tl_status bench_post_stages(bench_session *session,
                            const tl_bench_case *of,
                            const tl_sampling_rule *rule,
                            json_t *rows,
                            tl_status (*keep)(void *context, tl_error *err),
                            void *context,
                            tl_error *err)
{
    post_bench b = {.session = session, .rule = rule, .lighting = of->lighting};
    const tl_bench_scene_options *size = &of->scene_options;
    tl_status status = TL_OK;
    console_stage("running pictures through what follows lighting");
    TRY(bench_session_peaks(session, err));
    TRY(tl_effect_frame_make(tl_effect_frame_count - 1, size->width, size->height, &b.frame,
                             err));
    TRY(light(&b, err));
    console_stage(NULL);
    if (session->table)
        fprintf(session->table,
                "\nwhat stages after lighting cost\n%-10s %9s %9s %9s %9s %7s %6s\n", "", "ms",
                "kernel ms", "bytes/px", "floor ms", "ratio", "runs");
    for (int row = 0; row < ROW_COUNT + CODE_ROW_COUNT; row++) {
        TRY(row < ROW_COUNT ? measure(&b, row, rows, err)
                            : measure_codes(&b, row - ROW_COUNT, rows, err));
        TRY(keep(context, err));
    }
done:
    tl_samples_clear(&b.wall_ms);
    tl_samples_clear(&b.kernel_ms);
    tl_image_destroy(b.lit);
    tl_image_destroy(b.image);
    tl_effect_frame_clear(&b.frame);
    return status;
}
