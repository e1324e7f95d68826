/* Does no value of a pixel, however odd, make a picture that is not finite, whatever lights shine on it, in
 * any layout, model and arithmetic; and becomes each what docs/input.md says? */
#include "packed_frames.h"

#include "material_rows.h"
#include "tilelight/check.h"

#include <float.h>

/* Each is tried with both signs, alone and together with the others. */
static const float values[] = {
    0.0f,  1e-45f, 1e-40f,        FLT_MIN, 1e-30f,  0x1.272fp-60f,   1e-18f,    1e-6f,    0.5f,
    1.0f,  2.5f,   0x1.000002p0f, 255.0f,  256.0f,  10000.0f,        10001.f,   65504.0f, 1e9f,
    1e18f, 1e20f,  1e30f,         2e30f,   FLT_MAX, (float)INFINITY, (float)NAN};
enum { VALUE_COUNT = 2 * COUNT_OF(values) };

static float value_of(uint32_t i)
{
    const float v = values[i / 2];
    return i % 2 ? -v : v;
}

/* What planes take, as docs/input.md has it, and what becomes of the rest. */
enum fate { CUT, NOTHING, SKY, NO_NORMAL };
static const struct {
    enum tl_plane first, last;
    float least, most;
    enum fate above; /* below and NaN: 0, of CUT too; but see the others */
} ranges[] = {
    {TL_DEPTH, TL_DEPTH, 1e-45f, 1e18f, SKY},
    {TL_NORMAL_X, TL_NORMAL_Z, -1e18f, 1e18f, NO_NORMAL},
    {TL_ALBEDO_R, TL_SPECULAR_B, 0.0f, 1.0f, CUT},
    {TL_SHININESS, TL_SHININESS, 0.0f, 10000.0f, CUT},
    {TL_METALLIC, TL_OCCLUSION, 0.0f, 1.0f, CUT},
    {TL_EMISSIVE_R, TL_EMISSIVE_B, 0.0f, 1e30f, CUT},
    {TL_BRDF, TL_BRDF, 0.0f, 255.0f, NOTHING},
    {TL_TANGENT_X, TL_TANGENT_Z, -1e18f, 1e18f, NOTHING},
};

enum { WIDTH = 24, HEIGHT = 13 };
static const float identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

static tl_camera camera_with(tl_projection projection, float edge, float near, float far)
{
    tl_camera camera = {.projection = projection,
                        .width = WIDTH,
                        .height = HEIGHT,
                        .left = -edge,
                        .right = edge,
                        .bottom = -edge,
                        .top = edge,
                        .near = near,
                        .far = far};
    memcpy(camera.view_from_world, identity, sizeof identity);
    return camera;
}

static const uint32_t phong = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION |
                              TL_GROUP_EMISSIVE | TL_GROUP_BRDF | TL_GROUP_TANGENT;

/* Pixel i, row by row, in a plane. */
static size_t place_of(const tl_gbuffer *g, uint32_t i)
{
    return i / WIDTH * (size_t)g->pitch + i % WIDTH;
}

/* A surface 1 m before the eye in every pixel, of values that are taken as they are. */
static tl_gbuffer *plain_frame(const tl_camera *camera, uint32_t present)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(camera, present, &g, &err), err);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
        for (int p = 0; p < TL_PLANE_COUNT; p++)
            set_pixel(g, (enum tl_plane)p, place_of(g, i),
                      p == TL_DEPTH  ? 1.0f
                      : p == TL_BRDF ? 0.0f
                                     : 0.5f);
    return g;
}

static float wanted(size_t range, float value)
{
    const float least = ranges[range].least, most = ranges[range].most;
    if (ranges[range].above == SKY && value == INFINITY)
        return value;
    if (value >= least && value <= most &&
        (ranges[range].first != TL_BRDF || value == floorf(value)))
        return value;
    if (ranges[range].above == SKY)
        return INFINITY;
    if (ranges[range].above == CUT && value > most && isfinite(value))
        return most;
    return 0.0f;
}

static void each_value_becomes_what_the_page_says(void **state)
{
    const tl_camera camera = camera_with(TL_PERSPECTIVE, 1.0f, 0.1f, 100.0f);
    (void)state;
    for (size_t r = 0; r < COUNT_OF(ranges); r++)
        for (int p = ranges[r].first; p <= (int)ranges[r].last; p++) {
            const int is_metal = p == TL_METALLIC || p == TL_ROUGHNESS;
            tl_gbuffer *g =
                plain_frame(&camera, is_metal ? TL_GROUP_BASE | TL_GROUP_METAL_ROUGH : phong);
            uint64_t faults = 0;
            tl_repairs found;
            tl_error err;
            for (uint32_t i = 0; i < VALUE_COUNT; i++) {
                const float want = wanted(r, value_of(i));
                set_pixel(g, (enum tl_plane)p, place_of(g, i), value_of(i));
                faults += !(value_of(i) == want);
            }
            ASSERT_OK(tl_gbuffer_repair(g, "special", false, &found, &err), err);
            for (uint32_t i = 0; i < VALUE_COUNT; i++) {
                const float got = tl_gbuffer_plane(g, (enum tl_plane)p)[place_of(g, i)];
                if (got != wanted(r, value_of(i)))
                    fail_msg("plane %d: %g became %g, want %g", p, (double)value_of(i),
                             (double)got, (double)wanted(r, value_of(i)));
            }
            assert_int_equal(ranges[r].above == SKY         ? found.depth
                             : ranges[r].above == NO_NORMAL ? found.normal
                                                            : found.value,
                             faults);
            assert_int_equal(found.depth + found.normal + found.value, faults);
            tl_gbuffer_destroy(g);
        }
}

static void a_normal_without_length_is_none(void **state)
{
    const tl_camera camera = camera_with(TL_PERSPECTIVE, 1.0f, 0.1f, 100.0f);
    tl_gbuffer *g = plain_frame(&camera, TL_GROUP_BASE);
    tl_repairs found;
    tl_error err;
    (void)state;
    for (int p = TL_NORMAL_X; p <= TL_NORMAL_Z; p++) {
        set_pixel(g, (enum tl_plane)p, 0, 0x1.272fp-60f); /* 1e-18 */
        set_pixel(g, (enum tl_plane)p, 1, 0.9e-18f);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "short", false, &found, &err), err);
    assert_int_equal(found.normal, 1);
    assert_true(tl_gbuffer_plane(g, TL_NORMAL_X)[0] > 0.0f);
    assert_true(same_bits(tl_gbuffer_plane(g, TL_NORMAL_X)[1], 0.0f));
    tl_gbuffer_destroy(g);
}

/* A wide view sees deep surfaces far to the side: as full float has depth, and a word. */
static void no_coordinate_is_beyond_the_farthest(void **state)
{
    static const float depths[] = {1.0f, 1e14f, 1.2e15f, 1e18f};
    const tl_camera camera = camera_with(TL_PERSPECTIVE, 1e3f, 0.1f, 1e30f);
    const tl_channel word = tl_layouts[TL_LAYOUT_COMPACT_16].depth.channels[0];
    tl_gbuffer *g = plain_frame(&camera, TL_GROUP_BASE), *packed = NULL;
    tl_repairs found;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_gbuffer_pack(g, TL_LAYOUT_COMPACT_16, &packed, NULL, &err), err);
    for (size_t i = 0; i < COUNT_OF(depths); i++) {
        uint32_t bits;
        memcpy(&bits, &depths[i], sizeof bits);
        set_pixel(g, TL_DEPTH, i, depths[i]);
        set_channel_bits(packed, i, word, bits);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "wide", false, &found, &err), err);
    assert_int_equal(found.depth, 2);
    ASSERT_OK(tl_gbuffer_repair(packed, "wide", false, &found, &err), err);
    assert_int_equal(found.depth, 2);
    tl_gbuffer_destroy(g);
    tl_gbuffer_destroy(packed);
}

/* All that a light may say, at its ends. */
static const float intensities[] = {1e-45f, 1.0f, 1e30f};
static const float ranges_m[] = {1e-45f, 1e-12f, 1.0f, 1e18f, FLT_MAX, INFINITY};
static const float places[][3] = {{0, 0, 0},
                                  {0, 0, -1},
                                  {0, 0, -0.99f},
                                  {0.02f, 0.02f, -1.0f},
                                  {1e18f, 1e18f, 1e18f},
                                  {-1e18f, 1e18f, -1e18f},
                                  {0, 0, 1e-40f},
                                  {1e-6f, 1e-6f, -1e-6f}};
static const float cones[][2] = {
    {0, 0}, {0, 1e-3f}, {1.5f, 1.5f}, {3.14159274f, 3.14159274f}, {0, 3.14159274f}};

#define ANY_OF(array, seed) ((array)[(int)uniform(seed, 0.0f, (float)COUNT_OF(array))])

static tl_light extreme_light(uint32_t *seed, uint32_t image, uint32_t table)
{
    tl_light light = tl_light_default();
    light.type = (tl_light_type)uniform(seed, 0.0f, TL_LIGHT_TYPE_COUNT);
    light.intensity = ANY_OF(intensities, seed);
    light.diffuse = ANY_OF(intensities, seed);
    light.specular = ANY_OF(intensities, seed);
    light.ambient = ANY_OF(intensities, seed);
    for (int c = 0; c < 3; c++)
        light.color[c] = uniform(seed, 0.0f, 1.0f) < 0.2f ? 0.0f : ANY_OF(intensities, seed);
    if (light.type == TL_LIGHT_DIRECTIONAL)
        return light;
    memcpy(light.position, ANY_OF(places, seed), sizeof light.position);
    light.range = ANY_OF(ranges_m, seed);
    light.falloff = isinf(light.range) ? TL_FALLOFF_INVERSE_SQUARE
                                       : (tl_falloff)uniform(seed, 0.0f, TL_FALLOFF_COUNT);
    light.table = light.falloff == TL_FALLOFF_TABLE ? table : 0;
    if (light.falloff == TL_FALLOFF_LINEAR)
        light.begin = (float[]){0.0f, light.range, nextafterf(light.range, 0.0f)}[*seed % 3];
    if (light.type == TL_LIGHT_SPOT) {
        const float *cone = ANY_OF(cones, seed);
        light.inner_cone = cone[0];
        light.outer_cone = cone[1];
    }
    if (light.type == TL_LIGHT_POINT || light.outer_cone < 1.57f)
        light.texture = uniform(seed, 0.0f, 1.0f) < 0.3f ? image : 0;
    return light;
}

/* count of them, with a sky and ambient light alike. */
static void add_extreme_lights(tl_light_set *set, int count, uint32_t seed)
{
    static const float shown[12] = {1e30f, 0,     1,     0, 1e30f, 1e-40f,
                                    1e30f, 1e30f, 1e30f, 0, 0,     0};
    static const float falloff[] = {1e4f, 0.0f, 1e-45f, 1e4f};
    float *pixels = malloc(sizeof shown);
    uint32_t table = 0, image = 0;
    tl_error err;
    assert_non_null(pixels);
    memcpy(pixels, shown, sizeof shown);
    ASSERT_OK(tl_light_set_add_image(set, "bright", 2, 2, pixels, &image, &err), err);
    ASSERT_OK(tl_light_set_add_table(set, falloff, COUNT_OF(falloff), &table, &err), err);
    for (int i = 0; i < count; i++) {
        const tl_light light = extreme_light(&seed, image, table);
        ASSERT_OK(tl_light_set_add(set, &light, &err), err);
    }
    for (int c = 0; c < 3; c++)
        set->ambient[c] = 1e30f;
    set->sky_type = TL_SKY_IMAGE;
    set->sky_image = image;
    set->sky_intensity = 1e30f;
    ASSERT_OK(tl_light_set_check(set, "extreme", &err), err);
}

/* A row of materials for each model, some with parameters at their ends. */
static void add_rows(tl_light_set *set)
{
    tl_error err;
    for (uint32_t i = 1; i <= TL_MAX_MATERIALS; i++) {
        tl_material_row row = tl_material_row_default();
        row.index = i;
        row.model = (enum tl_shading_model)(i % TL_MODEL_COUNT);
        row.given = i < 128 ? 0 : tl_model_takes(row.model);
        row.roughness = i % 3 == 0 ? 1e-45f : 1.0f;
        row.across = i % 5 == 0 ? 0.0f : 1.0f;
        row.exponent = i % 2 ? 10000.0f : 0.0f;
        row.k = i % 2 ? 100.0f : 0.0f;
        memcpy(row.diffuse, (float[]){1, 0, 1e-45f}, sizeof row.diffuse);
        memcpy(row.specular, (float[]){0, 1, 1e-45f}, sizeof row.specular);
        memcpy(row.direction, (float[]){1e18f, -1e18f, 1e-18f}, sizeof row.direction);
        ASSERT_OK(tl_light_set_add_material(set, &row, &err), err);
    }
    ASSERT_OK(tl_light_set_check(set, "rows", &err), err);
}

/* Random values of the table in every plane, or of a packed frame random bits. Repaired. */
static tl_gbuffer *special_frame(const tl_camera *camera,
                                 enum tl_layout_name layout,
                                 uint32_t present,
                                 uint32_t seed)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    if (layout != TL_LAYOUT_FLOAT) {
        if (tl_gbuffer_create_packed(camera, layout, present, &g, &err) != TL_OK)
            return NULL;
        scramble(g, seed);
        return g;
    }
    g = plain_frame(camera, present);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
        for (int p = 0; p < TL_PLANE_COUNT; p++)
            if (uniform(&seed, 0.0f, 1.0f) < (p < TL_ALBEDO_R ? 0.2f : 0.5f))
                set_pixel(g, (enum tl_plane)p, place_of(g, i),
                          value_of((uint32_t)uniform(&seed, 0.0f, VALUE_COUNT)));
    ASSERT_OK(tl_gbuffer_repair(g, "special", false, NULL, &err), err);
    return g;
}

static void assert_finite(const tl_image *image, const char *what)
{
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < image->height; y++)
            for (uint32_t x = 0; x < image->width; x++) {
                const float v = tl_image_plane(image, c)[(size_t)y * image->pitch + x];
                if (!(v >= 0.0f && v <= FLT_MAX))
                    fail_msg("%s: pixel (%u, %u), channel %u is %g", what, x, y, c, (double)v);
            }
}

/* Lights by the twin and in double; the twin's is within what check allows, however large. */
static void light_both(const tl_gbuffer *g, const tl_light_set *lights, const char *what)
{
    static const tl_precision precisions[] = {TL_PRECISION_REFERENCE, TL_PRECISION_TWIN};
    tl_image *image = image_like(g);
    for (size_t i = 0; i < COUNT_OF(precisions); i++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.precision = precisions[i];
        light_frame(NULL, &options, g, lights, image);
        assert_finite(image, what);
    }
    if (g->layout == TL_LAYOUT_FLOAT) {
        tl_check *check = NULL;
        tl_check_report report;
        tl_error err;
        ASSERT_OK(tl_check_create(g, lights, 0.0f, TL_COSINE_STABLE, &check, &err), err);
        ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
        if (report.failed_count > 0)
            fail_msg("%s: pixel (%u, %u), channel %u is %g, of %g to %g", what, report.worst.x,
                     report.worst.y, report.worst.channel, (double)report.worst.got,
                     report.worst.low, report.worst.high);
        tl_check_destroy(check);
    }
    tl_image_destroy(image);
}

static void nothing_that_is_not_finite_leaves(void **state)
{
    const tl_camera cameras[] = {
        camera_with(TL_PERSPECTIVE, 1.0f, 0.1f, 100.0f),
        camera_with(TL_ORTHOGRAPHIC, 1.0f, -1e18f, 1e18f),
        camera_with(TL_PERSPECTIVE, 1e18f, 1e-38f, 3e38f),
        camera_with(TL_PERSPECTIVE, 1e-45f, 1e-45f, 1e-44f),
    };
    static const uint32_t materials[] = {TL_GROUP_PHONG, TL_GROUP_METAL_ROUGH};
    uint32_t seed = 2011;
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (size_t i = 0; i < COUNT_OF(cameras) * COUNT_OF(materials); i++) {
            const uint32_t present =
                tl_layout_planes((enum tl_layout_name)layout) &
                ((phong & ~TL_GROUP_PHONG) | materials[i % COUNT_OF(materials)]);
            tl_gbuffer *g =
                special_frame(&cameras[i / 2], (enum tl_layout_name)layout, present, seed++);
            tl_light_set lights = {0};
            char what[64];
            if (!g)
                continue;
            snprintf(what, sizeof what, "%s, camera %zu, material %zu",
                     tl_layout_word(g->layout), i / 2, i % 2);
            add_extreme_lights(&lights, layout == TL_LAYOUT_FLOAT ? 64 : 16, seed++);
            lights.model = (enum tl_shading_model)(seed % TL_MODEL_COUNT);
            if (present & TL_GROUP_BRDF)
                add_rows(&lights);
            light_both(g, &lights, what);
            tl_light_set_clear(&lights);
            tl_gbuffer_destroy(g);
        }
}

/* 1 cm before the surface of the pixel in the middle, which it lights with 1e34. */
static void add_bright_lights(tl_light_set *lights, int count, float ambient)
{
    tl_light light = tl_light_default();
    tl_error err;
    light.position[2] = -0.99f;
    light.intensity = 1e30f;
    light.ambient = ambient;
    for (int i = 0; i < count; i++)
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
}

static void remember(void *context, const char *text)
{
    snprintf(context, 256, "%s", text);
}

/* Every third surface faces eye and lights. */
static tl_gbuffer *peaks_frame(const tl_camera *camera, float exponent)
{
    tl_gbuffer *g = special_frame(camera, TL_LAYOUT_FLOAT,
                                  TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION, 1968);
    tl_error err;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i += 3) {
        const size_t at = place_of(g, i);
        set_pixel(g, TL_DEPTH, at, 1.0f);
        for (int p = TL_NORMAL_X; p <= TL_SPECULAR_B; p++)
            set_pixel(g, (enum tl_plane)p, at, p < TL_NORMAL_Z ? 0.0f : 1.0f);
        set_pixel(g, TL_SHININESS, at, exponent);
        set_pixel(g, TL_OCCLUSION, at, 1.0f);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "peaks", false, NULL, &err), err);
    return g;
}

/* Both paths, in float: the twin's bits. The builds are those of shapes in test_same_bits. */
static void the_device_agrees(void **state)
{
    static const tl_path paths[] = {TL_PATH_CPU, TL_PATH_GPU};
    const tl_camera camera = camera_with(TL_PERSPECTIVE, 0.01f, 0.1f, 100.0f);
    tl_gbuffer *g = peaks_frame(&camera, 0.0f);
    tl_image *want = image_like(g), *got = image_like(g);
    tl_lighting_options options = tl_lighting_options_default();
    tl_light_set lights = {0};
    add_extreme_lights(&lights, 64, 7);
    add_bright_lights(&lights, 12000, 1.0f); /* 3e34 each: diffuse, highlight, ambient */
    lights.sky_type = TL_SKY_GRADIENT;
    lights.zenith[0] = lights.sky[1] = lights.ground[2] = 1e30f;
    options.precision = TL_PRECISION_TWIN;
    const tl_lighting_counts in_c = light_frame(NULL, &options, g, &lights, want);
    options.precision = TL_PRECISION_FLOAT;
    assert_in_range(in_c.cut_count, 1, WIDTH * HEIGHT - 1);
    for (size_t i = 0; i < COUNT_OF(paths); i++) {
        options.path = paths[i];
        options.vector_width = paths[i] == TL_PATH_CPU ? 8 : 0;
        const tl_lighting_counts counts = light_frame(*state, &options, g, &lights, got);
        assert_same_image(got, want, i == 0 ? "by tiles" : "by pixels");
        assert_int_equal(counts.cut_count, in_c.cut_count);
    }
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

/* Together, in the peak of a narrow lobe: the light that comes is infinite, and the pixel has the largest
 * float, but not where it reflects nothing; and it is counted, and told of. */
static void what_is_beyond_floats_is_cut_and_counted(void **state)
{
    static const tl_precision precisions[] = {TL_PRECISION_REFERENCE, TL_PRECISION_TWIN};
    const tl_camera camera = camera_with(TL_PERSPECTIVE, 1e-4f, 0.1f, 100.0f);
    tl_gbuffer *g = peaks_frame(&camera, 10000.0f);
    tl_image *image = image_like(g);
    char told[256] = "";
    const tl_notices notices = {remember, told};
    const size_t green = place_of(g, 150);
    tl_error err;
    (void)state;
    set_pixel(g, TL_ALBEDO_G, green, 0.0f);
    set_pixel(g, TL_SPECULAR_G, green, 0.0f);
    set_pixel(g, TL_SPECULAR_R, green, 0.5f);
    for (int count = 20; count <= 40; count += 20) {
        tl_light_set lights = {.model = TL_MODEL_WARD};
        add_bright_lights(&lights, count, 0.0f);
        for (size_t i = 0; i < COUNT_OF(precisions); i++) {
            tl_lighting_options options = tl_lighting_options_default();
            tl_lighting *lighting = NULL;
            tl_lighting_counts counts;
            options.precision = precisions[i];
            ASSERT_OK(tl_lighting_create(NULL, &options, &lighting, &err), err);
            ASSERT_OK(
                tl_lighting_run(lighting, g, &lights, image, NULL, &notices, &counts, &err),
                err);
            tl_lighting_destroy(lighting);
            const float red = tl_image_plane(image, 0)[green];
            assert_true(same_bits(tl_image_plane(image, 1)[green], 0.0f));
            assert_true(count == 20 ? red > 1e38f && red < FLT_MAX : same_bits(red, FLT_MAX));
            assert_int_equal(counts.cut_count > 0, count > 20);
            assert_int_equal(strstr(told, " pixels are brighter than a float can say") != NULL,
                             count > 20);
        }
        tl_light_set_clear(&lights);
    }
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_value_becomes_what_the_page_says),
        cmocka_unit_test(a_normal_without_length_is_none),
        cmocka_unit_test(no_coordinate_is_beyond_the_farthest),
        cmocka_unit_test(nothing_that_is_not_finite_leaves),
        cmocka_unit_test(what_is_beyond_floats_is_cut_and_counted),
        cmocka_unit_test(the_device_agrees),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
