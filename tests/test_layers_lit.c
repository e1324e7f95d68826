/* Are layers lit as the frames that they are and blended over what lies behind, with the same bits by every
 * path and width, in bands, and by the twin? Are fewer of them the nearest, and do frames without pay
 * nothing?
 *
 * The oracle lights each layer alone, as a frame without layers, and blends in double. */
#include "layered_frames.h"

#include "lighting_state.h"

#include "tilelight/check.h"

enum { WIDTH = 130, HEIGHT = 75, LAYERS = 3, LAMPS = 40 };
static const uint32_t present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION;
static const double tolerance =
    1e-5; /* of radiance beside that of the picture's brightest pixel */

typedef struct frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
} frame;

static frame take(uint32_t layers)
{
    uint32_t seed = 5;
    tl_error err;
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    frame f = {.gbuffer = layered_gbuffer(&camera, present, layers, 11)};
    for (int i = 0; i < LAMPS; i++) {
        tl_light light = random_light(&camera, &seed, 1.0f, 6.0f);
        if (i % 4 == 0)
            aim_at_random(&light, &seed);
        ASSERT_OK(tl_light_set_add(&f.lights, &light, &err), err);
    }
    f.lights.ambient[1] = 0.125f;
    f.lights.sky[2] = 0.75f;
    return f;
}

static void release(frame *f)
{
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

static tl_image *lit(tl_device *device,
                     const tl_lighting_options *options,
                     const tl_gbuffer *gbuffer,
                     const tl_light_set *lights)
{
    tl_image *image = image_like(gbuffer);
    const int on_host =
        options->precision == TL_PRECISION_TWIN || options->precision == TL_PRECISION_REFERENCE;
    light_frame(on_host ? NULL : device, options, gbuffer, lights, image);
    return image;
}

static const struct {
    tl_path path;
    uint32_t width, tile;
    tl_cull cull;
    uint64_t memory; /* bytes; 0: no limit */
} ways[] = {
    {TL_PATH_CPU, 16, 16, TL_CULL_SPLIT, 0},
    {TL_PATH_CPU, 16, 16, TL_CULL_SPLIT, 12000},
    {TL_PATH_CPU, 4, 8, TL_CULL_NONE, 0},
    {TL_PATH_GPU, 1, 32, TL_CULL_DEPTH, 0},
};

static void every_way_has_the_same_bits(void **state)
{
    frame f = take(LAYERS);
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = TL_PRECISION_TWIN;
    tl_image *want = lit(NULL, &options, f.gbuffer, &f.lights);
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        char name[32];
        options.precision = TL_PRECISION_FLOAT;
        options.path = ways[i].path;
        options.vector_width = ways[i].width;
        options.tile_size = ways[i].tile;
        options.cull = ways[i].cull;
        options.memory_limit = ways[i].memory;
        tl_image *got = image_like(f.gbuffer);
        const tl_lighting_counts counts =
            light_frame(*state, &options, f.gbuffer, &f.lights, got);
        snprintf(name, sizeof name, "way %zu", i);
        assert_same_image(got, want, name);
        assert_int_equal(counts.band_count > 1, ways[i].memory > 0);
        tl_image_destroy(got);
    }
    tl_image_destroy(want);
    release(&f);
}

/* The same surfaces as a frame that is no layer; the caller destroys it. */
static tl_gbuffer *plain(const tl_gbuffer *from)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create_packed(&from->camera, from->layout, from->present, &g, &err),
              err);
    memcpy(g->planes, from->planes, (size_t)g->pitch * g->rows * tl_gbuffer_pixel_size(g));
    ASSERT_OK(tl_gbuffer_repair(g, "plain", false, NULL, &err), err);
    return g;
}

/* [3][rows][pitch] in double, blended from frames that are lit by themselves; the caller frees it. */
static double *oracle(const frame *f, uint32_t count)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = TL_PRECISION_REFERENCE;
    options.layers = 0;
    tl_image *behind = lit(NULL, &options, f->gbuffer, &f->lights);
    const size_t pixels = (size_t)behind->pitch * behind->rows;
    double *seen = malloc(3 * pixels * sizeof *seen);
    assert_non_null(seen);
    for (size_t at = 0; at < 3 * pixels; at++)
        seen[at] = (double)behind->planes[at];
    for (uint32_t i = count; i-- > 0;) {
        const tl_gbuffer *layer = f->gbuffer->layers.of[i];
        tl_gbuffer *alone = plain(layer);
        tl_image *image = lit(NULL, &options, alone, &f->lights);
        for (size_t at = 0; at < 3 * pixels; at++) {
            const double a = (double)layer->opacity[at % pixels];
            seen[at] = a * (double)image->planes[at] + (1.0 - a) * seen[at];
        }
        tl_image_destroy(image);
        tl_gbuffer_destroy(alone);
    }
    tl_image_destroy(behind);
    return seen;
}

static void assert_near(const tl_image *got, const double *want, const char *what)
{
    const size_t pixels = (size_t)got->pitch * got->rows;
    double most = 1.0, worst = 0.0;
    for (size_t at = 0; at < 3 * pixels; at++)
        most = fmax(most, want[at]);
    for (uint32_t y = 0; y < got->height; y++)
        for (uint32_t x = 0; x < got->width; x++)
            for (unsigned c = 0; c < 3; c++) {
                const size_t at = c * pixels + (size_t)y * got->pitch + x;
                const double off = fabs((double)got->planes[at] - want[at]) / most;
                worst = fmax(worst, off);
                if (!(off <= tolerance))
                    fail_msg("%s: pixel (%u, %u), channel %u: %.9g, want %.9g", what, x, y, c,
                             (double)got->planes[at], want[at]);
            }
    print_message("%s: off by %.2g at most\n", what, worst);
}

static void layers_are_lit_as_frames_and_blended(void **state)
{
    frame f = take(LAYERS);
    for (uint32_t count = 0; count <= LAYERS; count++) {
        tl_lighting_options options = tl_lighting_options_default();
        char name[32];
        options.layers = count;
        double *want = oracle(&f, count);
        tl_image *got = lit(*state, &options, f.gbuffer, &f.lights);
        snprintf(name, sizeof name, "the nearest %u layers", count);
        assert_near(got, want, name);
        tl_image_destroy(got);
        options.precision = TL_PRECISION_REFERENCE;
        got = lit(NULL, &options, f.gbuffer, &f.lights);
        assert_near(got, want, "the reference");
        tl_image_destroy(got);
        free(want);
    }
    release(&f);
}

static void packed_layers_are_lit_like_the_twin(void **state)
{
    frame f = take(LAYERS);
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *packed = packed_layers(f.gbuffer, TL_LAYOUT_COMPACT_16);
    tl_image *got = lit(*state, &options, packed, &f.lights);
    options.precision = TL_PRECISION_TWIN;
    tl_image *want = lit(NULL, &options, packed, &f.lights);
    assert_same_image(got, want, "packed");
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(packed);
    release(&f);
}

static void pictures_are_within_bounds(void **state)
{
    frame f = take(LAYERS);
    tl_lighting_options options = tl_lighting_options_default();
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    ASSERT_OK(tl_check_create(f.gbuffer, &f.lights, 0.0f, TL_COSINE_STABLE, &check, &err), err);
    tl_image *got = lit(*state, &options, f.gbuffer, &f.lights);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    print_message("largest of what is allowed: %.3f\n", report.worst.ratio);
    assert_int_equal(report.failed_count, 0);
    assert_true(report.worst.ratio > 0.0);
    tl_image_destroy(got);
    /* A picture of fewer layers is another one; a check of fewer is of that. */
    options.layers = LAYERS - 1;
    got = lit(*state, &options, f.gbuffer, &f.lights);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    assert_true(report.failed_count > WIDTH * HEIGHT / 4);
    tl_check_layers(check, LAYERS - 1);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    assert_int_equal(report.failed_count, 0);
    tl_image_destroy(got);
    tl_check_destroy(check);
    release(&f);
}

/* What a run leaves behind. */
typedef struct trace {
    char build[1024];
    tl_explanation of;
    tl_lighting_counts counts;
    uint32_t lightings; /* for layers */
} trace;

/* Twice, with nothing more the second time; device: NULL for the twin. */
static trace traced(tl_device *device, const frame *f, uint32_t layers)
{
    trace t;
    tl_lighting_options options = tl_lighting_options_default();
    tl_lighting *lighting = NULL;
    tl_image *image = image_like(f->gbuffer), *again = image_like(f->gbuffer);
    tl_lighting_counts first;
    tl_error err;
    options.layers = layers;
    options.precision = device ? TL_PRECISION_FLOAT : TL_PRECISION_TWIN;
    ASSERT_OK(tl_lighting_create(device, &options, &lighting, &err), err);
    ASSERT_OK(
        tl_lighting_run(lighting, f->gbuffer, &f->lights, again, NULL, NULL, &first, &err),
        err);
    ASSERT_OK(
        tl_lighting_run(lighting, f->gbuffer, &f->lights, image, NULL, NULL, &t.counts, &err),
        err);
    assert_int_equal(t.counts.device_bytes, first.device_bytes);
    assert_same_image(image, again, "once more");
    tl_lighting_build_options(lighting, t.build, sizeof t.build);
    tl_lighting_explain(lighting, &t.of);
    t.lightings = lighting->layer_capacity;
    assert_int_equal(lighting->lit != NULL, device && t.lightings > 0);
    tl_lighting_destroy(lighting);
    tl_image_destroy(again);
    tl_image_destroy(image);
    return t;
}

static void frames_without_layers_pay_nothing(void **state)
{
    frame with = take(LAYERS), without = take(0);
    const trace none = traced(*state, &without, TL_MOST_LAYERS);
    const trace off = traced(*state, &with, 0), on = traced(*state, &with, TL_MOST_LAYERS);
    const uint64_t effect = TL_ON(TL_EFFECT_TRANSLUCENCY);
    assert_string_equal(none.build, off.build);
    assert_string_equal(none.build, on.build); /* of its surfaces */
    assert_int_equal(none.counts.device_bytes, off.counts.device_bytes);
    assert_true(on.counts.device_bytes > off.counts.device_bytes);
    assert_int_equal(none.lightings, 0);
    assert_int_equal(off.lightings, 0);
    assert_int_equal(on.lightings, LAYERS);
    assert_int_equal(none.counts.layer_count + off.counts.layer_count, 0);
    assert_int_equal(on.counts.layer_count, LAYERS);
    assert_true(on.counts.layer_list_length > 0);
    assert_int_equal(none.counts.list_length, on.counts.list_length);
    assert_int_equal((none.of.effects | off.of.effects) & effect, 0);
    assert_int_equal(on.of.effects, off.of.effects | effect);
    release(&without);
    release(&with);
}

/* What a layer alone calls for is told of the frame. */
static void effects_of_layers_are_told(void **state)
{
    frame f = take(1);
    tl_error err;
    (void)state;
    float *occlusion = tl_gbuffer_plane(f.gbuffer, TL_OCCLUSION);
    for (size_t at = 0; at < (size_t)f.gbuffer->pitch * f.gbuffer->rows; at++)
        occlusion[at] = 1.0f;
    ASSERT_OK(tl_gbuffer_repair(f.gbuffer, "dull", false, NULL, &err), err);
    assert_true(f.gbuffer->neutral & TL_GROUP_OCCLUSION);
    const trace off = traced(NULL, &f, 0), on = traced(NULL, &f, 1);
    assert_false(off.of.effects >> TL_EFFECT_OCCLUSION & 1u);
    assert_true(on.of.effects >> TL_EFFECT_OCCLUSION & 1u);
    assert_false(on.of.idle & TL_GROUP_OCCLUSION);
    release(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(layers_are_lit_as_frames_and_blended),
        cmocka_unit_test(packed_layers_are_lit_like_the_twin),
        cmocka_unit_test(pictures_are_within_bounds),
        cmocka_unit_test(frames_without_layers_pay_nothing),
        cmocka_unit_test(effects_of_layers_are_told),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
