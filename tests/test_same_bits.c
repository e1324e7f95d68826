/* Do vector widths 1, 4, 8 and 16 and the C compiler give the same bits, in float and in double?
 *
 * Every light is tried on every pixel: hard on hard, hard on random, random on random. */
#include "hard_pixels.h"

#include "reference.h"

static void every_width_agrees(tl_device *device,
                               tl_precision precision,
                               uint32_t present,
                               enum tl_shading_model model)
{
    static const uint32_t widths[] = {1, 4, 8, 16};
    const tl_arithmetic arithmetic =
        precision == TL_PRECISION_DOUBLE ? TL_TWIN_DOUBLE : TL_TWIN_FLOAT;
    for (int projection = 0; projection < 2; projection++) {
        tl_light_set lights = {0};
        tl_gbuffer *g = hard_frame((tl_projection)projection, present, &lights);
        tl_image *want = image_like(g), *got = image_like(g);
        tl_prepared prepared = {0};
        tl_error err;
        lights.model = model;
        ASSERT_OK(tl_prepare(g, &lights, 16, 1, 0.0f, NULL, &prepared, &err), err);
        tl_reference_light(&prepared, g, arithmetic, want);
        for (size_t w = 0; w < COUNT_OF(widths); w++) {
            tl_lighting_options options = tl_lighting_options_default();
            char what[64];
            options.precision = precision;
            options.vector_width = widths[w];
            snprintf(what, sizeof what, "precision %d, width %u, projection %d", precision,
                     widths[w], projection);
            light_frame(device, &options, g, &lights, got);
            assert_same_image(got, want, what);
        }
        tl_prepared_clear(&prepared);
        tl_light_set_clear(&lights);
        tl_image_destroy(want);
        tl_image_destroy(got);
        tl_gbuffer_destroy(g);
    }
}

static void every_width_agrees_in_float(void **state)
{
    every_width_agrees(*state, TL_PRECISION_FLOAT,
                       TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
                       TL_MODEL_PHONG);
}

static void every_width_agrees_by_every_model(void **state)
{
    for (int model = TL_MODEL_PHONG + 1; model < TL_MODEL_COUNT; model++)
        every_width_agrees(*state, TL_PRECISION_FLOAT, TL_GROUP_BASE | TL_GROUP_PHONG,
                           (enum tl_shading_model)model);
}

static void every_width_agrees_on_metal(void **state)
{
    every_width_agrees(*state, TL_PRECISION_FLOAT, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
                       TL_MODEL_PHONG);
}

static void every_width_agrees_in_double(void **state)
{
    const tl_device_info info = tl_device_describe(*state);
    if (info.has_double)
        every_width_agrees(*state, TL_PRECISION_DOUBLE, TL_GROUP_BASE | TL_GROUP_PHONG,
                           TL_MODEL_PHONG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_agrees_in_float),
        cmocka_unit_test(every_width_agrees_by_every_model),
        cmocka_unit_test(every_width_agrees_on_metal),
        cmocka_unit_test(every_width_agrees_in_double),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
