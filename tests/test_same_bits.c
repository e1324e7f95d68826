/* Do vector widths 1, 4, 8 and 16 and the C compiler give the same bits, in float and in double?
 *
 * Every light is tried on every pixel: hard on hard, hard on random, random on random. */
#include "frames.h"

#include "reference.h"

enum { WIDTH = 61, HEIGHT = 40, RANDOM_LIGHT_COUNT = 64 };

/* Case i makes pixel i, and a light at `offset` (view space) from the surface there. In m. */
static const struct {
    const char *name;
    float depth, normal[3], shininess, offset[3], range;
} cases[] = {
    {"light in the surface point", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 0}, 1.0f},
    {"light a denormal away", 1e-40f, {0, 0, 1}, 10.0f, {0, 0, 1e-40f}, 1.0f},
    {"denormal square of the distance", 1e-20f, {0, 0, 1}, 10.0f, {0, 0, 1e-21f}, 1.0f},
    {"denormal square of the range", 1e-21f, {0, 0, 1}, 10.0f, {0, 0, 5e-23f}, 1e-22f},
    {"light 1 mm away", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 1e-3f}, 1.0f},
    {"denormal shininess", 4.0f, {0, 0, 1}, 1e-40f, {0, 0, 1}, 2.0f},
    {"exponent 0", 4.0f, {0, 0, 1}, 0.0f, {0.5f, 0, 1}, 2.0f},
    {"exponent 0, grazing", 4.0f, {0, 0, 1}, 0.0f, {1, 0, 1e-6f}, 2.0f},
    {"exponent 10000, in the peak", 4.0f, {0, 0, 1}, 10000.0f, {0, 0, 1}, 2.0f},
    {"exponent 10000, off the peak", 4.0f, {0, 0, 1}, 10000.0f, {0.02f, 0, 1}, 2.0f},
    {"exponent 10000, grazing", 4.0f, {0, 0, 1}, 10000.0f, {1, 0, 1e-6f}, 2.0f},
    {"light behind the surface", 4.0f, {0, 0, 1}, 10.0f, {0, 0, -1}, 2.0f},
    {"normal away from the eye", 4.0f, {0, 0, -1}, 10.0f, {0, 0, -1}, 2.0f},
    {"no normal", 4.0f, {0, 0, 0}, 10.0f, {0, 0, 1}, 2.0f},
    {"tiny normal", 4.0f, {0, 0, 1e-17f}, 10.0f, {0, 0, 1}, 2.0f},
    {"light exactly at its range", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 1}, 1.0f},
    {"light one ulp within its range", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 1}, 0x1.000002p0f},
    {"light in the eye", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 4}, 5.0f},
    {"square of the distance near overflow", 1e17f, {0, 0, 1}, 10.0f, {0, 0, 1}, 1e17f},
    {"nothing hit", INFINITY, {0, 0, 0}, 0.0f, {0, 0, 0}, 1.0f},
};

/* At the origin and along -z: view space is world space, so the cases keep their bits. */
static tl_camera plain_camera(tl_projection projection)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    /* A narrow view, so that (0, 0, 1) faces the eye everywhere. */
    tl_camera camera = tl_camera_look_at(eye, target, up, 0.02, WIDTH, HEIGHT, 1e-30, 1e30);
    camera.projection = projection;
    return camera;
}

static void place_case(tl_gbuffer *g, tl_light_set *lights, uint32_t i)
{
    const tl_camera *camera = &g->camera;
    const float z = isinf(cases[i].depth) ? 1.0f : cases[i].depth;
    const float scale = camera->projection == TL_PERSPECTIVE ? z : 1.0f;
    const float step = (camera->right - camera->left) / (float)WIDTH;
    const float surface[3] = {(camera->left + ((float)i + 0.5f) * step) * scale,
                              (camera->top - 0.5f * step) * scale, -z};
    tl_light light = tl_light_default();
    tl_error err;

    set_pixel(g, TL_DEPTH, i, cases[i].depth);
    for (int axis = 0; axis < 3; axis++) {
        set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), i, cases[i].normal[axis]);
        light.position[axis] = surface[axis] + cases[i].offset[axis];
    }
    for (int p = TL_ALBEDO_R; p <= TL_SPECULAR_B; p++)
        set_pixel(g, (enum tl_plane)p, i, isinf(cases[i].depth) ? 0.0f : 0.5f);
    set_pixel(g, TL_SHININESS, i, cases[i].shininess);
    light.range = cases[i].range;
    for (int falloff = 0; falloff < TL_FALLOFF_COUNT; falloff++) {
        light.falloff = (tl_falloff)falloff;
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

/* A sun, a lamp without a range, ambient light and a sky beside the cases. */
static void add_global_lights(tl_light_set *lights)
{
    tl_light sun = tl_light_default(), lamp = tl_light_default();
    tl_error err;
    sun.type = TL_LIGHT_DIRECTIONAL;
    lamp.position[1] = 1.0f;
    ASSERT_OK(tl_light_set_add(lights, &sun, &err), err);
    ASSERT_OK(tl_light_set_add(lights, &lamp, &err), err);
    for (int i = 0; i < 3; i++) {
        lights->ambient[i] = 0.1f * (float)i;
        lights->sky[i] = 0.3f;
    }
}

static void every_width_agrees(tl_device *device, tl_precision precision, uint32_t present)
{
    static const uint32_t widths[] = {1, 4, 8, 16};
    const tl_arithmetic arithmetic =
        precision == TL_PRECISION_DOUBLE ? TL_TWIN_DOUBLE : TL_TWIN_FLOAT;
    for (int projection = 0; projection < 2; projection++) {
        const tl_camera camera = plain_camera((tl_projection)projection);
        tl_gbuffer *g = random_gbuffer(&camera, present, 1977);
        tl_image *want = image_like(g), *got = image_like(g);
        tl_light_set lights = {0};
        tl_prepared prepared = {0};
        uint32_t seed = 20110901;
        tl_error err;

        for (uint32_t i = 0; i < COUNT_OF(cases); i++)
            place_case(g, &lights, i);
        for (int i = 0; i < RANDOM_LIGHT_COUNT; i++) {
            const tl_light light = random_light(&camera, &seed, 0.5f, 5.0f);
            ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
        }
        add_global_lights(&lights);
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
                       TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE);
}

static void every_width_agrees_on_metal(void **state)
{
    every_width_agrees(*state, TL_PRECISION_FLOAT, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH);
}

static void every_width_agrees_in_double(void **state)
{
    const tl_device_info info = tl_device_describe(*state);
    if (info.has_double)
        every_width_agrees(*state, TL_PRECISION_DOUBLE, TL_GROUP_BASE | TL_GROUP_PHONG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_agrees_in_float),
        cmocka_unit_test(every_width_agrees_on_metal),
        cmocka_unit_test(every_width_agrees_in_double),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
