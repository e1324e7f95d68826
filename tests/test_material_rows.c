/* Does a surface with an index look as one of a frame that has its row's model and parameters everywhere, to
 * the bit, by every path?
 *
 * Frames of one model say what is wanted; their formulas are other tests'. */
#include "frames.h"

#include "material_rows.h"
#include "tilelight/check.h"
#include "tilelight/layouts.h"

enum { WIDTH = 44, HEIGHT = 20, LIGHTS = 12 };

/* What rows give. Pixels have these indices, in blocks and one by one. */
static const struct {
    uint32_t index;
    tl_material_row row;
} rows[] = {
    {0, {.model = TL_MODEL_PHONG}},
    {1, {.model = TL_MODEL_LAMBERT, .given = TL_TAKES_DIFFUSE, .diffuse = {0.25f, 0.5f, 1.0f}}},
    {2, {.model = TL_MODEL_PHONG, .given = TL_TAKES_EXPONENT, .exponent = 30.0f}},
    {9,
     {.model = TL_MODEL_BLINN_PHONG_NORMALIZED,
      .given = TL_TAKES_SPECULAR | TL_TAKES_EXPONENT,
      .exponent = 7.5f,
      .specular = {1.0f, 0.75f, 0.125f}}},
    {255, {.model = TL_MODEL_BLINN_PHONG_NORMALIZED}},
    {254, {.model = TL_MODEL_PHONG, .given = TL_TAKES_SPECULAR}}, /* black */
};

/* Left of the middle blocks of 8 pixels have one index; right of it each pixel has its own. */
static uint32_t row_at(uint32_t x, uint32_t y)
{
    return x < WIDTH / 2 ? (x / 8 + y / 8) % COUNT_OF(rows) : (x * 7 + y * 3) % COUNT_OF(rows);
}

static tl_gbuffer *frame_of(uint32_t present)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *from = random_gbuffer(&camera, present & (TL_HAS(TL_BRDF) - 1u), 11), *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, present, &g, &err), err);
    for (int p = 0; p < TL_BRDF; p++)
        if (tl_gbuffer_plane(from, (enum tl_plane)p))
            memcpy(tl_gbuffer_plane(g, (enum tl_plane)p),
                   tl_gbuffer_plane(from, (enum tl_plane)p),
                   (size_t)g->pitch * g->rows * sizeof(float));
    tl_gbuffer_destroy(from);
    for (uint32_t i = 0; i < WIDTH * HEIGHT && (present & TL_GROUP_BRDF); i++)
        set_pixel(g, TL_BRDF, (size_t)(i / WIDTH) * g->pitch + i % WIDTH,
                  (float)rows[row_at(i % WIDTH, i / WIDTH)].index);
    ASSERT_OK(tl_gbuffer_repair(g, "frame", false, NULL, &err), err);
    return g;
}

static void add_lights(const tl_camera *camera, tl_light_set *set)
{
    uint32_t seed = 5;
    tl_error err;
    set->ambient[0] = 0.1f;
    for (int i = 0; i < LIGHTS; i++) {
        tl_light light = random_light(camera, &seed, 2.0f, 8.0f);
        if (i == 3)
            light.range = INFINITY, light.falloff = TL_FALLOFF_INVERSE_SQUARE;
        ASSERT_OK(tl_light_set_add(set, &light, &err), err);
    }
}

static void add_rows(tl_light_set *set)
{
    tl_error err;
    for (size_t i = 1; i < COUNT_OF(rows); i++) {
        tl_material_row row = rows[i].row;
        row.index = rows[i].index;
        ASSERT_OK(tl_light_set_add_material(set, &row, &err), err);
    }
}

static void set_plane(tl_gbuffer *g, enum tl_plane plane, float value)
{
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
        set_pixel(g, plane, (size_t)(i / WIDTH) * g->pitch + i % WIDTH, value);
}

/* The picture of a frame in which every surface has what row k gives; full float. */
static tl_image *picture_of_row(size_t k, uint32_t present)
{
    const tl_material_row *row = &rows[k].row;
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *g = frame_of(present & ~(uint32_t)TL_GROUP_BRDF);
    tl_image *image = image_like(g);
    tl_light_set set = {.model = row->model};
    options.precision = TL_PRECISION_TWIN;
    for (int i = 0; i < 3; i++) {
        if (row->given & TL_TAKES_DIFFUSE)
            set_plane(g, (enum tl_plane)(TL_ALBEDO_R + i), row->diffuse[i]);
        if (row->given & TL_TAKES_SPECULAR)
            set_plane(g, (enum tl_plane)(TL_SPECULAR_R + i), row->specular[i]);
    }
    if (row->given & TL_TAKES_EXPONENT)
        set_plane(g, TL_SHININESS, row->exponent);
    g->neutral = 0; /* planes were written: none is known to say nothing */
    add_lights(&g->camera, &set);
    if (row->given & TL_TAKES_DIFFUSE) /* ambient light asks for the pixel's own colour */
        set.ambient[0] = 0.0f;
    light_frame(NULL, &options, g, &set, image);
    tl_light_set_clear(&set);
    tl_gbuffer_destroy(g);
    return image;
}

static void assert_rows_are_seen(const tl_image *got,
                                 const tl_gbuffer *g,
                                 tl_image *const want[],
                                 const char *what)
{
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint32_t x = i % WIDTH, y = i / WIDTH, k = row_at(x, y);
        const size_t at = (size_t)y * got->pitch + x;
        if (isinf(tl_gbuffer_plane(g, TL_DEPTH)[(size_t)y * g->pitch + x]))
            continue;
        for (unsigned c = 0; c < 3; c++) {
            const float a = tl_image_plane(got, c)[at], b = tl_image_plane(want[k], c)[at];
            const int is_ambient = c == 0 && (rows[k].row.given & TL_TAKES_DIFFUSE);
            if (!is_ambient && !same_bits(a, b))
                fail_msg("%s: pixel (%u, %u) of index %u, channel %u is %a, want %a", what, x,
                         y, rows[k].index, c, (double)a, (double)b);
        }
    }
}

static const struct {
    const char *name;
    tl_precision precision;
    tl_path path;
    uint32_t width;
} ways[] = {
    {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0},
    {"vectors", TL_PRECISION_FLOAT, TL_PATH_CPU, 0},
    {"pixels", TL_PRECISION_FLOAT, TL_PATH_GPU, 0},
};

static void every_way_finds_the_row(void **state)
{
    const uint32_t present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_BRDF;
    tl_image *want[COUNT_OF(rows)];
    tl_gbuffer *g = frame_of(present);
    tl_image *got = image_like(g);
    tl_light_set set = {.model = TL_MODEL_PHONG};
    add_lights(&g->camera, &set);
    add_rows(&set);
    for (size_t k = 0; k < COUNT_OF(rows); k++)
        want[k] = picture_of_row(k, present);
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.precision = ways[i].precision;
        options.path = ways[i].path;
        options.vector_width = ways[i].width;
        light_frame(*state, &options, g, &set, got);
        assert_rows_are_seen(got, g, want, ways[i].name);
    }
    for (size_t k = 0; k < COUNT_OF(rows); k++)
        tl_image_destroy(want[k]);
    tl_light_set_clear(&set);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

/* Rows of models that take a width, over metal-rough planes: roughness given is that of the plane, and where
 * it is not, the plane's own counts. */
static const struct {
    uint32_t index;
    enum tl_shading_model model;
    float roughness; /* below 0: not given */
} wide_rows[] = {{0, TL_MODEL_METAL_ROUGH, -1.0f},       {1, TL_MODEL_OREN_NAYAR, 0.5f},
                 {2, TL_MODEL_WARD_ANISOTROPIC, 0.375f}, {3, TL_MODEL_COOK_TORRANCE, -1.0f},
                 {4, TL_MODEL_MINNAERT, 0.25f},          {5, TL_MODEL_WARD, 1.0f}};

/* The frame with tangents everywhere, of which rows know nothing. */
static tl_gbuffer *wide_frame(uint32_t more)
{
    tl_gbuffer *g = frame_of(TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_TANGENT | more);
    tl_error err;
    set_plane(g, TL_TANGENT_X, 0.5f);
    set_plane(g, TL_TANGENT_Z, -2.0f);
    for (uint32_t i = 0; i < WIDTH * HEIGHT && (more & TL_GROUP_BRDF); i++)
        set_pixel(g, TL_BRDF, (size_t)(i / WIDTH) * g->pitch + i % WIDTH,
                  (float)(i % COUNT_OF(wide_rows)));
    ASSERT_OK(tl_gbuffer_repair(g, "frame", false, NULL, &err), err);
    return g;
}

static void widths_and_tangents_reach_rows(void **state)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *g = wide_frame(TL_GROUP_BRDF);
    tl_image *got = image_like(g), *want = image_like(g);
    tl_light_set set = {.model = wide_rows[0].model};
    tl_error err;
    (void)state;
    add_lights(&g->camera, &set);
    options.precision = TL_PRECISION_TWIN;
    for (size_t k = 1; k < COUNT_OF(wide_rows); k++) {
        tl_material_row row = tl_material_row_default();
        row.index = wide_rows[k].index;
        row.model = wide_rows[k].model;
        row.given = wide_rows[k].roughness >= 0.0f ? TL_TAKES_ROUGHNESS : 0;
        row.roughness = wide_rows[k].roughness;
        ASSERT_OK(tl_light_set_add_material(&set, &row, &err), err);
    }
    light_frame(NULL, &options, g, &set, got);
    for (size_t k = 1; k < COUNT_OF(wide_rows); k++) {
        /* A frame's own radiometric model would scale its lights; those of row 0 are. */
        tl_gbuffer *alone = wide_frame(0);
        tl_light_set by_model = {.model = wide_rows[k].model};
        add_lights(&alone->camera, &by_model);
        if (wide_rows[k].roughness >= 0.0f)
            set_plane(alone, TL_ROUGHNESS, wide_rows[k].roughness);
        by_model.ambient[0] = 0.0f;
        light_frame(NULL, &options, alone, &by_model, want);
        for (size_t i = k; i < WIDTH * HEIGHT; i += COUNT_OF(wide_rows)) {
            const size_t at = i / WIDTH * got->pitch + i % WIDTH;
            const float a = tl_image_plane(got, 1)[at], b = tl_image_plane(want, 1)[at];
            /* Lights over pi, rounded to float before the sums or after them: 150 terms at most. */
            if (!(fabsf(a - b / 3.14159274f) <= 2e-5f * b))
                fail_msg("pixel %zu of row %zu is %a, want %a", i, k, (double)a,
                         (double)b / 3.14159265358979323846);
        }
        tl_light_set_clear(&by_model);
        tl_gbuffer_destroy(alone);
    }
    tl_light_set_clear(&set);
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_gbuffer_destroy(g);
}

/* A pixel's tangent stands before its row's direction, and that where it has none before the frame's. */
static void tangents_stand_before_directions(void **state)
{
    static const float along[] = {0.5f, 0.25f, -2.0f};
    tl_lighting_options options = tl_lighting_options_default();
    tl_image *pictures[3];
    (void)state;
    options.precision = TL_PRECISION_TWIN;
    for (int i = 0; i < 3; i++) { /* by the row; by tangents; by neither */
        const uint32_t more = i == 1 ? TL_GROUP_BRDF | TL_GROUP_TANGENT : TL_GROUP_BRDF;
        tl_gbuffer *g = frame_of(TL_GROUP_BASE | TL_GROUP_PHONG | more);
        tl_light_set set = {.model = TL_MODEL_PHONG};
        tl_material_row row = tl_material_row_default();
        tl_error err;
        row.index = 5;
        row.model = TL_MODEL_WARD_ANISOTROPIC;
        row.given = TL_TAKES_ROUGHNESS | TL_TAKES_ACROSS | (i < 2 ? TL_TAKES_DIRECTION : 0);
        row.roughness = 0.4f;
        row.across = 0.8f;
        set_plane(g, TL_BRDF, 5.0f);
        for (int axis = 0; axis < 3; axis++) {
            row.direction[axis] = i == 0 ? along[axis] : axis == 0 ? 1.0f : 0.0f;
            set_plane(g, (enum tl_plane)(TL_TANGENT_X + axis), along[axis]);
        }
        ASSERT_OK(tl_gbuffer_repair(g, "frame", false, NULL, &err), err);
        add_lights(&g->camera, &set);
        ASSERT_OK(tl_light_set_add_material(&set, &row, &err), err);
        pictures[i] = image_like(g);
        light_frame(NULL, &options, g, &set, pictures[i]);
        tl_light_set_clear(&set);
        tl_gbuffer_destroy(g);
    }
    assert_same_image(pictures[1], pictures[0], "a tangent as a direction");
    assert_memory_not_equal(tl_image_plane(pictures[2], 0), tl_image_plane(pictures[0], 0),
                            WIDTH * sizeof(float));
    for (int i = 0; i < 3; i++)
        tl_image_destroy(pictures[i]);
}

/* Of each model a row that gives nothing, and one that gives all that it takes; index 0 has none. */
static void add_rows_of_every_model(tl_light_set *set)
{
    tl_error err;
    for (int model = 0; model < TL_MODEL_COUNT; model++)
        for (int gives = 0; gives < 2; gives++) {
            tl_material_row row = {.model = (enum tl_shading_model)model,
                                   .index = (uint32_t)(1 + 2 * model + gives),
                                   .given =
                                       gives ? tl_model_takes((enum tl_shading_model)model) : 0,
                                   .diffuse = {0.7f, 0.2f, 0.4f},
                                   .specular = {0.3f, 0.6f, 0.05f},
                                   .exponent = 45.0f,
                                   .roughness = 0.4f,
                                   .across = 0.7f,
                                   .direction = {0.3f, 1.0f, -0.2f},
                                   .k = 0.8f};
            ASSERT_OK(tl_light_set_add_material(set, &row, &err), err);
        }
}

/* The twin's picture is within the bounds that are derived for each pixel from its row, and nearer to them
 * than a picture by other rows. */
static void every_value_is_within_its_bounds(void **state)
{
    static const uint32_t materials[] = {TL_GROUP_PHONG, TL_GROUP_METAL_ROUGH};
    (void)state;
    for (size_t m = 0; m < COUNT_OF(materials); m++) {
        tl_lighting_options options = tl_lighting_options_default();
        tl_gbuffer *g = frame_of(TL_GROUP_BASE | materials[m] | TL_GROUP_BRDF);
        tl_image *image = image_like(g);
        tl_light_set set = {.model = TL_MODEL_PHONG};
        tl_check *check = NULL;
        tl_check_report report;
        tl_error err;
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            set_pixel(g, TL_BRDF, (size_t)(i / WIDTH) * g->pitch + i % WIDTH,
                      (float)(i % (1 + 2 * TL_MODEL_COUNT)));
        ASSERT_OK(tl_gbuffer_repair(g, "frame", false, NULL, &err), err);
        add_lights(&g->camera, &set);
        add_rows_of_every_model(&set);
        options.precision = TL_PRECISION_TWIN;
        light_frame(NULL, &options, g, &set, image);
        ASSERT_OK(tl_check_create(g, &set, 0.0f, TL_COSINE_STABLE, &check, &err), err);
        ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
        if (report.failed_count > 0)
            fail_msg(
                "%llu of %llu pixels are not within their bounds, by %g at the most: %g at "
                "(%u, %u), of %g to %g",
                (unsigned long long)report.failed_count, (unsigned long long)report.pixel_count,
                report.worst.ratio, (double)report.worst.got, report.worst.x, report.worst.y,
                report.worst.low, report.worst.high);
        set.materials[1].diffuse[1] *= 1.001f; /* of index 2 */
        light_frame(NULL, &options, g, &set, image);
        ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
        assert_in_range(report.failed_count, 1, report.pixel_count / 2);
        tl_check_destroy(check);
        tl_light_set_clear(&set);
        tl_image_destroy(image);
        tl_gbuffer_destroy(g);
    }
}

/* Where every surface has a row, and all rows one model, frames light by its short code. */
static void rows_of_one_model_are_plain(void **state)
{
    const uint32_t present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_BRDF;
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *g = frame_of(present), *plain = frame_of(present & ~(uint32_t)TL_GROUP_BRDF);
    tl_image *got = image_like(g), *want = image_like(g);
    tl_light_set set = {.model = TL_MODEL_LAMBERT}, by_model;
    tl_material_row row = tl_material_row_default();
    tl_error err;
    row.index = 17;
    row.model = TL_MODEL_BLINN_PHONG_NORMALIZED;
    set_plane(g, TL_BRDF, 17.0f);
    ASSERT_OK(tl_gbuffer_repair(g, "frame", false, NULL, &err), err);
    add_lights(&g->camera, &set);
    by_model = set;
    by_model.model = row.model;
    options.precision = TL_PRECISION_TWIN;
    light_frame(NULL, &options, plain, &by_model, want);
    ASSERT_OK(tl_light_set_add_material(&set, &row, &err), err);
    (void)state;
    light_frame(NULL, &options, g, &set, got);
    assert_same_image(got, want, "one model by rows");
    tl_light_set_clear(&set);
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_gbuffer_destroy(plain);
    tl_gbuffer_destroy(g);
}

/* Indices are of use in a layout that has 8 bits for them, and an exponent, but no specular colour. */
static void merlins_bits_lead_to_rows(void **state)
{
    tl_lighting_options options = tl_lighting_options_default();
    (void)state;
    tl_gbuffer *full = frame_of(TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_BRDF), *g = NULL,
               *back = NULL;
    tl_light_set set = {.model = TL_MODEL_PHONG};
    tl_error err;
    add_lights(&full->camera, &set);
    add_rows(&set);
    ASSERT_OK(tl_gbuffer_pack(full, TL_LAYOUT_MERLIN, &g, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_unpack(g, &back, &err), err);
    assert_memory_equal(g->indices, full->indices, sizeof g->indices);
    tl_image *got = image_like(g), *want = image_like(g);
    options.precision = TL_PRECISION_REFERENCE;
    light_frame(NULL, &options, g, &set, got);
    light_frame(NULL, &options, back, &set, want);
    for (size_t i = 0; i < (size_t)got->pitch * got->rows; i++) {
        const float a = tl_image_plane(got, 1)[i], b = tl_image_plane(want, 1)[i];
        if (!(fabsf(a - b) <= 1e-4f * (0.01f + fabsf(b))))
            fail_msg("pixel %zu is %g by its words, %g unpacked", i, (double)a, (double)b);
    }
    tl_light_set_clear(&set);
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_gbuffer_destroy(back);
    tl_gbuffer_destroy(g);
    tl_gbuffer_destroy(full);
}

/* Without rows, or without an index that has one, indices are not even read. */
static void indices_that_select_nothing_change_nothing(void **state)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *g = frame_of(TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_BRDF),
               *plain = frame_of(TL_GROUP_BASE | TL_GROUP_PHONG);
    tl_image *got = image_like(g), *want = image_like(g);
    tl_light_set set = {.model = TL_MODEL_PHONG};
    (void)state;
    add_lights(&g->camera, &set);
    options.precision = TL_PRECISION_TWIN;
    light_frame(NULL, &options, plain, &set, want);
    light_frame(NULL, &options, g, &set, got);
    assert_same_image(got, want, "indices without rows");
    tl_light_set_clear(&set);
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_gbuffer_destroy(plain);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_finds_the_row),
        cmocka_unit_test(every_value_is_within_its_bounds),
        cmocka_unit_test(widths_and_tangents_reach_rows),
        cmocka_unit_test(tangents_stand_before_directions),
        cmocka_unit_test(rows_of_one_model_are_plain),
        cmocka_unit_test(merlins_bits_lead_to_rows),
        cmocka_unit_test(indices_that_select_nothing_change_nothing),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
