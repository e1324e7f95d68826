#define _GNU_SOURCE
/* Is a frame with shadows lit the same by every width, path and the twin, within what is derived for it, and
 * as from its file? Do lights pay for shadows that ask for some, and no others? */
#include "frames.h"

#include "prepared.h"

#include "tilelight/capture.h"
#include "tilelight/check.h"
#include "tilelight/gbuffer_file.h"

enum { WIDTH = 320, HEIGHT = 180 };

typedef struct frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
} frame;

static void take(frame *f, const char *scene)
{
    const char *source = getenv("TILELIGHT_SOURCE");
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT, .all_shadows = true};
    char *path = NULL;
    tl_error err;
    *f = (frame){.gbuffer = NULL};
    assert_true(asprintf(&path, "%s/%s", source ? source : ".", scene) > 0);
    ASSERT_OK(tl_capture(path, &options, &f->gbuffer, &f->lights, NULL, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(f->gbuffer, path, false, NULL, &err), err);
    assert_true(f->gbuffer->shadows.count > 0);
    free(path);
}

static void release(frame *f)
{
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

static tl_image *lit(tl_device *device, const frame *f, const tl_lighting_options *options)
{
    tl_image *image = image_like(f->gbuffer);
    light_frame(options->precision == TL_PRECISION_TWIN ? NULL : device, options, f->gbuffer,
                &f->lights, image);
    return image;
}

static const struct {
    tl_precision precision;
    tl_path path;
    uint32_t width;
} ways[] = {
    {TL_PRECISION_FLOAT, TL_PATH_CPU, 16}, {TL_PRECISION_FLOAT, TL_PATH_CPU, 8},
    {TL_PRECISION_FLOAT, TL_PATH_CPU, 4},  {TL_PRECISION_FLOAT, TL_PATH_CPU, 1},
    {TL_PRECISION_FLOAT, TL_PATH_GPU, 1},
};
static const uint32_t filters[] = {1, 2, 5};

static void every_way_has_the_same_bits(void **state)
{
    frame f;
    take(&f, "data/nine-lights.gltf");
    for (size_t k = 0; k < COUNT_OF(filters); k++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.shadow_filter = filters[k];
        options.precision = TL_PRECISION_TWIN;
        tl_image *want = lit(*state, &f, &options);
        for (size_t i = 0; i < (k == 1 ? COUNT_OF(ways) : 1); i++) {
            char name[64];
            options.precision = ways[i].precision;
            options.path = ways[i].path;
            options.vector_width = ways[i].width;
            tl_image *got = lit(*state, &f, &options);
            snprintf(name, sizeof name, "filter %u, way %zu", filters[k], i);
            assert_same_image(got, want, name);
            tl_image_destroy(got);
        }
        tl_image_destroy(want);
    }
    release(&f);
}

static void kernels_are_within_bounds(void **state)
{
    frame f;
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    const tl_lighting_options options = tl_lighting_options_default();
    take(&f, "data/nine-lights.gltf");
    ASSERT_OK(tl_check_create(f.gbuffer, &f.lights, 0.0f, TL_COSINE_STABLE, &check, &err), err);
    tl_image *got = lit(*state, &f, &options);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    print_message("largest of what is allowed: %.3f\n", report.worst.ratio);
    if (report.failed_count > 0)
        fail_msg("%u pixels outside; (%u, %u) %u: got %.9g, allowed %.9g to %.9g",
                 (unsigned)report.failed_count, report.worst.x, report.worst.y,
                 report.worst.channel, (double)report.worst.got, report.worst.low,
                 report.worst.high);
    /* A frame without its shadows is not. */
    for (size_t i = 0; i < f.lights.count; i++)
        f.lights.lights[i].casts_shadow = 0;
    tl_image *without = lit(*state, &f, &options);
    ASSERT_OK(tl_check_image(check, without, NULL, &report, &err), err);
    assert_true(report.failed_count > 100);
    tl_image_destroy(without);
    tl_image_destroy(got);
    tl_check_destroy(check);
    release(&f);
}

static void files_keep_the_picture(void **state)
{
    char path[512];
    frame f, back = {.gbuffer = NULL};
    tl_error err;
    const tl_lighting_options options = tl_lighting_options_default();
    take(&f, "data/nine-lights.gltf");
    scratch_path(path, sizeof path, "shadows-lit.exr");
    ASSERT_OK(tl_gbuffer_write(path, f.gbuffer, &f.lights, &err), err);
    ASSERT_OK(tl_gbuffer_read(path, &back.gbuffer, &back.lights, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(back.gbuffer, path, false, NULL, &err), err);
    tl_image *want = lit(*state, &f, &options), *got = lit(*state, &back, &options);
    assert_same_image(got, want, "from its file");
    tl_image_destroy(got);
    tl_image_destroy(want);
    release(&back);
    release(&f);
}

static tl_prepared prepared_of(const frame *f, tl_notices *notices)
{
    tl_prepared p = {.memory_size = 0};
    tl_error err;
    ASSERT_OK(tl_prepare(f->gbuffer, &f->lights, &(tl_prepare_options){.tile_size = 16},
                         notices, &p, &err),
              err);
    return p;
}

static void count_notice(void *context, const char *text)
{
    *(int *)context += strstr(text, "without the shadow") != NULL;
}

/* Lights that ask for none leave no trace in what kernels are built with, nor in their buffers; those that
 * ask for a map that is not there are told of, unless they give no light. */
static void only_askers_pay(void **state)
{
    frame f;
    int told = 0;
    tl_notices notices = {count_notice, &told};
    (void)state;
    take(&f, "data/nine-lights.gltf");
    tl_prepared with = prepared_of(&f, &notices);
    assert_true(with.needs.shapes & TL_SHAPE_SHADOW);
    assert_int_equal(told, 0);
    for (size_t i = 0; i < f.lights.count; i++)
        f.lights.lights[i].casts_shadow = 0;
    tl_prepared off = prepared_of(&f, &notices);
    tl_shadow_maps_clear(&f.gbuffer->shadows);
    tl_prepared never = prepared_of(&f, &notices);
    assert_int_equal(told, 0);
    assert_memory_equal(&off.needs, &never.needs, sizeof off.needs);
    assert_memory_equal(&off.frame, &never.frame, sizeof off.frame);
    assert_int_equal(tl_prepared_lights_size(&off), tl_prepared_lights_size(&never));
    assert_memory_equal(off.lights, never.lights, tl_prepared_lights_size(&off));
    assert_int_equal(off.needs.shapes, 0);
    f.lights.lights[0].casts_shadow = 1;
    tl_prepared asked = prepared_of(&f, &notices);
    assert_int_equal(told, 1);
    assert_memory_equal(&asked.needs, &never.needs, sizeof asked.needs);
    f.lights.lights[0].intensity = 0.0f;
    tl_prepared black = prepared_of(&f, &notices);
    assert_int_equal(told, 1);
    tl_prepared_clear(&black);
    tl_prepared_clear(&asked);
    tl_prepared_clear(&never);
    tl_prepared_clear(&off);
    tl_prepared_clear(&with);
    release(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_askers_pay),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(kernels_are_within_bounds),
        cmocka_unit_test(files_keep_the_picture),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
