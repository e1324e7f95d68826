/* Is a frame with ambient occlusion lit the same by several widths, by path, tile, band and the twin, and does it
 * dim ambient light alone, times the capture's own occlusion? Do only frames pay for it that ask for it? */
#include "occlusion_scenes.h"

#include "tilelight/check.h"
#include "tilelight/layouts.h"

static const shape room[] = {{SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                             {SHAPE_SPHERE, {-0.6, 0.5, 0.0}, {0.5, 0.0, 0.0}},
                             {SHAPE_BOX, {0.7, 0.4, 0.2}, {0.4, 0.4, 0.4}}};

/* Sizes that are no multiples of patches or tiles; some sky. */
static tl_gbuffer *room_frame(tl_projection projection, uint32_t more_planes)
{
    static const double eye[3] = {0.4, 1.5, 3.5}, target[3] = {0.0, 0.7, 0.0};
    static const double up[3] = {0.0, 1.0, 0.0};
    tl_camera camera = tl_camera_look_at(eye, target, up, 0.9, 150, 101, 0.1, 20.0);
    tl_error err;
    camera.projection = projection;
    if (projection == TL_ORTHOGRAPHIC) {
        camera.left *= 4.0f;
        camera.right *= 4.0f;
        camera.bottom *= 4.0f;
        camera.top *= 4.0f;
    }
    tl_gbuffer *g = cast_frame(&camera, (shapes){room, COUNT_OF(room)}, more_planes);
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        if (tl_gbuffer_plane(g, TL_DEPTH)[i] < INFINITY)
            set_pixel(g, TL_OCCLUSION, i, 0.25f + 0.5f * (float)(i % 2));
    ASSERT_OK(tl_gbuffer_repair(g, "room", false, NULL, &err), err);
    return g;
}

static const tl_light_set ambient_alone = {.ambient = {0.7f, 0.5f, 0.3f},
                                           .occlusion_radius = 0.6f};

static tl_image *lit(tl_device *device,
                     const tl_gbuffer *g,
                     const tl_light_set *lights,
                     const tl_lighting_options *options)
{
    tl_image *image = image_like(g);
    light_frame(options->precision == TL_PRECISION_TWIN ? NULL : device, options, g, lights,
                image);
    return image;
}

static const struct {
    const char *name;
    tl_path path;
    uint32_t width, tile;
} ways[] = {
    {"4 lanes", TL_PATH_CPU, 4, 16},      {"1 lane", TL_PATH_CPU, 1, 16},
    {"the gpu path", TL_PATH_GPU, 1, 16}, {"tiles of 8", TL_PATH_CPU, 0, 8},
    {"tiles of 64", TL_PATH_CPU, 0, 64},
};

static void every_way_has_the_same_bits(void **state)
{
    static const tl_projection projections[] = {TL_PERSPECTIVE, TL_ORTHOGRAPHIC};
    for (size_t p = 0; p < COUNT_OF(projections); p++) {
        tl_gbuffer *g = room_frame(projections[p], 0);
        tl_lighting_options options = tl_lighting_options_default();
        options.precision = TL_PRECISION_TWIN;
        tl_image *want = lit(*state, g, &ambient_alone, &options);
        options.precision = TL_PRECISION_FLOAT;
        for (size_t i = 0; i < (p == 0 ? COUNT_OF(ways) : 1); i++) {
            options.path = ways[i].path;
            options.vector_width = ways[i].width;
            options.tile_size = ways[i].tile;
            tl_image *got = lit(*state, g, &ambient_alone, &options);
            assert_same_image(got, want, ways[i].name);
            tl_image_destroy(got);
        }
        tl_image_destroy(want);
        tl_gbuffer_destroy(g);
    }
}

/* A frame in bands: pixels at their borders are dimmed by what stands in the next one. */
static void bands_do_not_show(void **state)
{
    tl_gbuffer *g = room_frame(TL_PERSPECTIVE, 0);
    tl_light_set lights = ambient_alone;
    tl_light lamps[64];
    tl_lighting_options options = tl_lighting_options_default();
    tl_lighting_counts counts;
    for (size_t i = 0; i < COUNT_OF(lamps); i++) {
        lamps[i] = tl_light_default();
        lamps[i].range = 6.0f;
    }
    lights.lights = lamps;
    lights.count = COUNT_OF(lamps);
    tl_image *want = image_like(g), *got = image_like(g);
    counts = light_frame(*state, &options, g, &lights, want);
    options.memory_limit = counts.device_bytes - 4096;
    counts = light_frame(*state, &options, g, &lights, got);
    assert_true(counts.band_count > 1);
    assert_same_image(got, want, "in bands");
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_gbuffer_destroy(g);
}

static void layouts_have_the_same_bits(void **state)
{
    static const enum tl_layout_name layouts[] = {TL_LAYOUT_FLOAT_POSITION, TL_LAYOUT_ISPC};
    tl_gbuffer *g = room_frame(TL_PERSPECTIVE, 0);
    for (size_t i = 0; i < COUNT_OF(layouts); i++) {
        tl_gbuffer *packed = NULL;
        tl_error err;
        tl_lighting_options options = tl_lighting_options_default();
        ASSERT_OK(tl_gbuffer_pack(g, layouts[i], &packed, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_repair(packed, "packed", false, NULL, &err), err);
        tl_image *got = lit(*state, packed, &ambient_alone, &options);
        options.precision = TL_PRECISION_TWIN;
        tl_image *want = lit(*state, packed, &ambient_alone, &options);
        assert_same_image(got, want, tl_layout_word(layouts[i]));
        tl_image_destroy(want);
        tl_image_destroy(got);
        tl_gbuffer_destroy(packed);
    }
    tl_gbuffer_destroy(g);
}

/* Every value is the ambient light's, times the capture's occlusion, times the share. */
static void it_dims_ambient_light_alone(void **state)
{
    tl_gbuffer *g = room_frame(TL_PERSPECTIVE, TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE);
    const tl_lighting_options options = tl_lighting_options_default();
    size_t dimmed = 0;
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        if (tl_gbuffer_plane(g, TL_DEPTH)[i] < INFINITY)
            set_pixel(g, TL_EMISSIVE_R, i, 0.125f);
    g->neutral = 0;
    surrounded s = surround(g, ambient_alone.occlusion_radius, 0, TL_TWIN_FLOAT);
    tl_image *got = lit(*state, g, &ambient_alone, &options);
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++)
            for (unsigned c = 0; c < 3; c++) {
                const size_t at = (size_t)y * g->pitch + x;
                const float own = tl_gbuffer_plane(g, TL_OCCLUSION)[at];
                const float sent = c == 0 ? 0.125f : 0.0f;
                const float want = own * s.share[at] * ambient_alone.ambient[c] + sent;
                if (isinf(tl_gbuffer_plane(g, TL_DEPTH)[at]))
                    continue;
                dimmed += s.share[at] < 0.9f;
                if (!(fabsf(tl_image_plane(got, c)[at] - want) <= 4.0f * 0x1p-24f))
                    fail_msg("pixel (%u, %u), channel %u: %.9g, want %.9g", x, y, c,
                             (double)tl_image_plane(got, c)[at], (double)want);
            }
    assert_true(dimmed > 300);
    tl_image_destroy(got);
    tl_prepared_clear(&s.prepared);
    tl_gbuffer_destroy(g);
}

static void count_notice(void *context, const char *text)
{
    *(int *)context += strstr(text, "ambient occlusion is for nothing") != NULL;
}

static tl_prepared prepared_of(const tl_gbuffer *g, const tl_light_set *lights, int *told)
{
    const tl_notices notices = {count_notice, told};
    tl_prepared p = {.memory_size = 0};
    tl_error err;
    ASSERT_OK(tl_prepare(g, lights, &(tl_prepare_options){.tile_size = 16}, &notices, &p, &err),
              err);
    return p;
}

/* Frames that ask for none, or have no ambient light to keep from anything, are built and uploaded as if
 * there were no such effect; the second are told of. */
static void only_askers_pay(void **state)
{
    tl_gbuffer *g = room_frame(TL_PERSPECTIVE, 0);
    const tl_light_set off = {.ambient = {0.7f, 0.5f, 0.3f}}, dark = {.occlusion_radius = 1.0f},
                       neither = {.occlusion_radius = 0.0f};
    int told = 0;
    (void)state;
    tl_prepared with = prepared_of(g, &ambient_alone, &told),
                without = prepared_of(g, &off, &told);
    assert_int_equal(told, 0);
    assert_int_equal(with.needs.surroundings, 1);
    assert_true(with.planes_size > 0);
    assert_int_equal(without.needs.surroundings, 0);
    assert_int_equal(without.frame.surroundings_at, 0);
    assert_int_equal(without.sections_size, 0);
    assert_int_equal(tl_prepared_buffer_size(&without), 0);
    tl_prepared unlit = prepared_of(g, &dark, &told), plain = prepared_of(g, &neither, &told);
    assert_int_equal(told, 1);
    assert_memory_equal(&unlit.needs, &plain.needs, sizeof plain.needs);
    assert_memory_equal(&unlit.frame, &plain.frame, sizeof plain.frame);
    assert_int_equal(tl_prepared_buffer_size(&unlit), tl_prepared_buffer_size(&plain));
    tl_prepared_clear(&plain);
    tl_prepared_clear(&unlit);
    tl_prepared_clear(&without);
    tl_prepared_clear(&with);
    tl_gbuffer_destroy(g);
}

/* Every value within what is derived; without it, or with another number of samples, not. */
static void kernels_are_within_bounds(void **state)
{
    tl_gbuffer *g = room_frame(TL_PERSPECTIVE, TL_GROUP_OCCLUSION);
    const tl_light_set plain = {.ambient = {0.7f, 0.5f, 0.3f}};
    tl_lighting_options options = tl_lighting_options_default();
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    ASSERT_OK(tl_check_create(g, &ambient_alone, 0.0f, TL_COSINE_STABLE, &check, &err), err);
    tl_image *got = lit(*state, g, &ambient_alone, &options);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    print_message("largest of what is allowed: %.3f\n", report.worst.ratio);
    assert_int_equal(report.failed_count, 0);
    tl_image *without = lit(*state, g, &plain, &options);
    ASSERT_OK(tl_check_image(check, without, NULL, &report, &err), err);
    assert_true(report.failed_count > 1000);
    options.occlusion_samples = 16;
    tl_image *fewer = lit(*state, g, &ambient_alone, &options);
    ASSERT_OK(tl_check_image(check, fewer, NULL, &report, &err), err);
    assert_true(report.failed_count > 1000);
    ASSERT_OK(tl_check_occlusion(check, 16, &err), err);
    ASSERT_OK(tl_check_image(check, fewer, NULL, &report, &err), err);
    assert_int_equal(report.failed_count, 0);
    tl_image_destroy(fewer);
    tl_image_destroy(without);
    tl_image_destroy(got);
    tl_check_destroy(check);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_askers_pay),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(bands_do_not_show),
        cmocka_unit_test(layouts_have_the_same_bits),
        cmocka_unit_test(it_dims_ambient_light_alone),
        cmocka_unit_test(kernels_are_within_bounds),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
