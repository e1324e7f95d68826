/* Do vector widths 1, 4, 8 and 16 and the C compiler give the same bits, in float and in double?
 *
 * Every light is tried on every pixel: hard on hard, hard on random, random on random. Nothing is culled, which
 * in every width tests/test_layouts_lit.c does. */
#include "hard_pixels.h"
#include "rich_lights.h"

#include "reference.h"
#include "tilelight/layouts.h"

static const uint32_t widths[] = {8, 1, 4, 16};

/* What is tried. Metal, models and spots do not know of projections, nor spots of models: each is tried
 * once. A build takes seconds, so that not all is tried with all, but each with each other. */
typedef struct bits_case {
    tl_precision precision;
    uint32_t present;
    enum tl_shading_model model;
    tl_projection projection;
    int spots;
    void (*make_sky)(
        tl_light_set *set); /* and with it lights of every kind of shape; or NULL */
    uint32_t tried;         /* bit i: widths[i] */
} bits_case;

/* A row for every model, and pixels of all. */
static void mix_models(tl_gbuffer *g, tl_light_set *lights)
{
    tl_error err;
    for (int model = 0; model < TL_MODEL_COUNT; model++) {
        tl_material_row row = tl_material_row_default();
        row.index = (uint32_t)model + 1;
        row.model = (enum tl_shading_model)model;
        if (model == TL_MODEL_WARD_ANISOTROPIC) {
            row.given = TL_TAKES_ROUGHNESS | TL_TAKES_ACROSS;
            row.roughness = 0.25f;
            row.across = 0.75f;
        }
        ASSERT_OK(tl_light_set_add_material(lights, &row, &err), err);
    }
    for (uint32_t i = 0; i < g->pitch * g->rows; i++)
        set_pixel(g, TL_BRDF, i, (float)(i % (TL_MODEL_COUNT + 1)));
}

static void widths_agree(tl_device *device, const bits_case *of)
{
    const tl_arithmetic arithmetic =
        of->precision == TL_PRECISION_DOUBLE ? TL_TWIN_DOUBLE : TL_TWIN_FLOAT;
    tl_light_set lights = {0};
    tl_gbuffer *g = hard_frame(of->projection, of->present, &lights);
    tl_image *want = image_like(g), *got = image_like(g);
    tl_prepared prepared = {0};
    tl_error err;
    lights.model = of->model;
    if (of->present & TL_GROUP_BRDF)
        mix_models(g, &lights);
    if (of->spots)
        make_hard_spots(&lights);
    if (of->make_sky) {
        make_rich(&lights);
        of->make_sky(&lights);
    }
    ASSERT_OK(tl_light_set_check(&lights, "hard", &err), err);
    ASSERT_OK(tl_prepare(g, &lights, &(tl_prepare_options){.tile_size = 16, .box_count = 1},
                         NULL, &prepared, &err),
              err);
    tl_reference_light(&prepared, g, arithmetic, want);
    for (size_t w = 0; w < COUNT_OF(widths); w++) {
        tl_lighting_options options = tl_lighting_options_default();
        char what[64];
        if (!(of->tried >> w & 1))
            continue;
        options.precision = of->precision;
        options.vector_width = widths[w];
        options.cull = TL_CULL_NONE;
        snprintf(what, sizeof what, "precision %d, width %u, projection %d", of->precision,
                 widths[w], of->projection);
        light_frame(device, &options, g, &lights, got);
        assert_same_image(got, want, what);
    }
    tl_prepared_clear(&prepared);
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

/* Every width in float, the narrowest and the widest in double, and each precision under each projection. */
static void every_width_agrees(void **state)
{
    static const bits_case cases[] = {
        {.precision = TL_PRECISION_FLOAT,
         .projection = TL_PERSPECTIVE,
         .present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
         .tried = 5},
        {.precision = TL_PRECISION_FLOAT,
         .projection = TL_ORTHOGRAPHIC,
         .present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
         .tried = 10},
        {.precision = TL_PRECISION_DOUBLE,
         .projection = TL_PERSPECTIVE,
         .present = TL_GROUP_BASE | TL_GROUP_PHONG,
         .tried = 8},
        {.precision = TL_PRECISION_DOUBLE,
         .projection = TL_ORTHOGRAPHIC,
         .present = TL_GROUP_BASE | TL_GROUP_PHONG,
         .tried = 2},
    };
    const tl_device_info info = tl_device_describe(*state);
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        if (cases[i].precision == TL_PRECISION_FLOAT || info.has_double)
            widths_agree(*state, &cases[i]);
}

/* One frame of all models, pixel by pixel, and two of one each: the text is the same for all. */
static void every_width_agrees_by_every_model(void **state)
{
    widths_agree(*state, &(bits_case){.precision = TL_PRECISION_FLOAT,
                                      .present = TL_GROUP_BASE | TL_GROUP_PHONG |
                                                 TL_GROUP_BRDF | TL_GROUP_TANGENT,
                                      .tried = 3});
    widths_agree(*state, &(bits_case){.precision = TL_PRECISION_FLOAT,
                                      .present = TL_GROUP_BASE | TL_GROUP_PHONG,
                                      .model = TL_MODEL_BLINN_PHONG_NORMALIZED,
                                      .tried = 4});
    widths_agree(*state, &(bits_case){.precision = TL_PRECISION_FLOAT,
                                      .present = TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
                                      .model = TL_MODEL_METAL_ROUGH,
                                      .tried = 8});
}

/* Every sixth light is none: metal has both. */
static void metal_and_spots_agree(void **state)
{
    bits_case of = {.precision = TL_PRECISION_FLOAT,
                    .present = TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
                    .spots = 1,
                    .tried = 10};
    widths_agree(*state, &of);
    of.precision = TL_PRECISION_DOUBLE;
    of.present = TL_GROUP_BASE | TL_GROUP_PHONG;
    of.tried = 1;
    if (tl_device_describe(*state).has_double)
        widths_agree(*state, &of);
}

/* Hard pixels in a layout whose specular colours are grey, lit by lights of one colour each. */
static tl_gbuffer *one_color_frame(tl_projection projection, tl_light_set *lights)
{
    tl_gbuffer *g = hard_frame(projection, TL_GROUP_BASE | TL_GROUP_PHONG, lights), *packed;
    tl_error err;
    ASSERT_OK(tl_gbuffer_repair(g, "hard", false, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_pack(g, TL_LAYOUT_ISPC_REVERSED, &packed, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(packed, "hard", false, NULL, &err), err);
    tl_gbuffer_destroy(g);
    lights->model = TL_MODEL_BLINN_PHONG_NORMALIZED;
    for (size_t i = 0; i < lights->count; i++)
        lights->lights[i].specular = lights->lights[i].diffuse = 0.75f;
    return packed;
}

static tl_u32 prepares_one_color(const tl_gbuffer *g, const tl_light_set *lights)
{
    tl_prepared prepared = {0};
    tl_error err;
    ASSERT_OK(tl_prepare(g, lights, &(tl_prepare_options){.tile_size = 16, .box_count = 1},
                         NULL, &prepared, &err),
              err);
    const tl_u32 found = prepared.needs.one_color;
    tl_prepared_clear(&prepared);
    return found;
}

/* Every light on every pixel, so that nothing is built to cull. */
static void light_with(tl_device *device,
                       tl_precision precision,
                       uint32_t width,
                       tl_path path,
                       const tl_gbuffer *g,
                       const tl_light_set *lights,
                       tl_image *image)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = precision;
    options.vector_width = width;
    options.path = path;
    options.cull = TL_CULL_NONE;
    light_frame(device, &options, g, lights, image);
}

/* One build each, and as many lights as can have shapes. */
static void every_width_agrees_on_shapes(void **state)
{
    bits_case of = {.precision = TL_PRECISION_FLOAT,
                    .present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION,
                    .spots = 1,
                    .make_sky = make_gradient_sky,
                    .tried = 1};
    widths_agree(*state, &of);
    of.make_sky = make_image_sky;
    of.tried = 2;
    widths_agree(*state, &of);
    of.precision = TL_PRECISION_DOUBLE;
    of.tried = 1;
    if (tl_device_describe(*state).has_double)
        widths_agree(*state, &of);
}

/* And both paths, every tile size and culling: lists with and without such lights. */
static void shapes_know_nothing_of_tiles(void **state)
{
    static const struct {
        tl_path path;
        uint32_t tile_size;
        tl_cull cull;
    } ways[] = {{TL_PATH_CPU, 8, TL_CULL_SPLIT},
                {TL_PATH_CPU, 64, TL_CULL_NONE},
                {TL_PATH_CPU, 16, TL_CULL_RECT},
                {TL_PATH_GPU, 16, TL_CULL_DEPTH}};
    tl_light_set lights = {0};
    tl_gbuffer *g = hard_frame(TL_PERSPECTIVE,
                               TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION, &lights);
    tl_image *want = image_like(g), *got = image_like(g);
    make_hard_spots(&lights);
    make_rich(&lights);
    make_gradient_sky(&lights);
    light_with(NULL, TL_PRECISION_TWIN, 0, TL_PATH_AUTO, g, &lights, want);
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.vector_width = ways[i].path == TL_PATH_CPU ? widths[0] : 0;
        options.path = ways[i].path;
        options.tile_size = ways[i].tile_size;
        options.cull = ways[i].cull;
        light_frame(*state, &options, g, &lights, got);
        assert_same_image(got, want, ways[i].path == TL_PATH_CPU ? "by tiles" : "by pixels");
    }
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

static void widths_agree_where_lobes_share_a_colour(void **state)
{
    tl_light_set lights = {0};
    tl_gbuffer *g = one_color_frame(TL_PERSPECTIVE, &lights);
    tl_image *want = image_like(g), *got = image_like(g);
    assert_int_equal(prepares_one_color(g, &lights), 1);
    light_with(NULL, TL_PRECISION_TWIN, 0, TL_PATH_AUTO, g, &lights, want);
    for (size_t w = 0; w < 2; w++) {
        light_with(*state, TL_PRECISION_FLOAT, widths[w], TL_PATH_CPU, g, &lights, got);
        assert_same_image(got, want, "one colour, by tiles");
    }
    light_with(*state, TL_PRECISION_FLOAT, 0, TL_PATH_GPU, g, &lights, got);
    assert_same_image(got, want, "one colour, by pixels");
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

/* And it is a short cut: with one light that has two colours, and reaches nothing, the picture is that of two
 * sums, to the rounding of each. */
static void one_colour_is_two_sums_at_once(void **state)
{
    tl_light_set lights = {0};
    tl_gbuffer *g = one_color_frame(TL_PERSPECTIVE, &lights);
    tl_image *once = image_like(g), *twice = image_like(g);
    tl_light nowhere = tl_light_default();
    tl_error err;
    (void)state;
    light_with(NULL, TL_PRECISION_TWIN, 0, TL_PATH_AUTO, g, &lights, once);
    nowhere.position[2] = 1e10f;
    nowhere.range = nowhere.specular = 0.5f;
    ASSERT_OK(tl_light_set_add(&lights, &nowhere, &err), err);
    assert_int_equal(prepares_one_color(g, &lights), 0);
    light_with(NULL, TL_PRECISION_TWIN, 0, TL_PATH_AUTO, g, &lights, twice);
    for (unsigned c = 0; c < 3; c++)
        for (size_t i = 0; i < (size_t)once->pitch * once->rows; i++) {
            const float a = tl_image_plane(once, c)[i], b = tl_image_plane(twice, c)[i];
            /* Some 150 lights, u = 2^-24 for each of three steps and for each sum. */
            if (!(fabsf(a - b) <= 0x1p-24f * (150.0f + 8.0f) * fabsf(b)))
                fail_msg("%a in one sum, %a in two", (double)a, (double)b);
        }
    lights.count--;
    assert_int_equal(prepares_one_color(g, &lights), 1);
    lights.model = TL_MODEL_PHONG;
    assert_int_equal(prepares_one_color(g, &lights), 0);
    tl_light_set_clear(&lights);
    tl_image_destroy(once);
    tl_image_destroy(twice);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_agrees),
        cmocka_unit_test(every_width_agrees_by_every_model),
        cmocka_unit_test(one_colour_is_two_sums_at_once),
        cmocka_unit_test(widths_agree_where_lobes_share_a_colour),
        cmocka_unit_test(metal_and_spots_agree),
        cmocka_unit_test(every_width_agrees_on_shapes),
        cmocka_unit_test(shapes_know_nothing_of_tiles),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
