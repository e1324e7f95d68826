/* Do scattered lights stand off visible surfaces, as many to a pixel as asked for, and are they
 * the same everywhere? */
#include "testing.h"

#include "tilelight/scatter.h"

enum { WIDTH = 40, HEIGHT = 20, FINE_WIDTH = 200, FINE_HEIGHT = 100 };
static const float wall_depth = 5.0f;

/* From tests/tools/oracle_scatter.py: a wall across the view, seed 77, range 2 m. */
static const struct {
    float position[3], color[3];
} expected[] = {
    {{1.875000000e+00f, 6.250000000e-01f, -3.909660302e+00f},
     {0.000000000e+00f, 1.000000000e+00f, 6.539410077e-01f}},
    {{3.625000000e+00f, 1.250000000e-01f, -4.450087253e+00f},
     {0.000000000e+00f, 7.093333935e-02f, 1.000000000e+00f}},
    {{4.625000000e+00f, -1.250000000e-01f, -4.443165030e+00f},
     {0.000000000e+00f, 1.000000000e+00f, 4.048920158e-01f}},
    {{4.375000000e+00f, 1.625000000e+00f, -4.014911095e+00f},
     {0.000000000e+00f, 7.766017238e-02f, 1.000000000e+00f}},
    {{3.875000000e+00f, -1.375000000e+00f, -4.481353918e+00f},
     {1.000000000e+00f, 7.812574280e-01f, 0.000000000e+00f}},
    {{-1.625000000e+00f, 3.750000000e-01f, -4.478022153e+00f},
     {8.601327011e-01f, 1.000000000e+00f, 0.000000000e+00f}},
};

/* A wall at depth 5 that faces a camera in the origin; sky right of column `end`. */
static tl_gbuffer *make_wall(uint32_t width, uint32_t height, uint32_t end)
{
    const tl_camera camera = {.width = width,
                              .height = height,
                              .left = -1.0f,
                              .right = 1.0f,
                              .bottom = -0.5f,
                              .top = 0.5f,
                              .near = 0.1f,
                              .far = INFINITY,
                              .view_from_world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    tl_gbuffer *made = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &made, &err), err);
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < end; x++) {
            tl_gbuffer_plane(made, TL_DEPTH)[y * made->pitch + x] = wall_depth;
            tl_gbuffer_plane(made, TL_NORMAL_Z)[y * made->pitch + x] = 3.0f; /* of any length */
        }
    return made;
}

static void lights_are_those_of_the_definition(void **state)
{
    tl_gbuffer *wall = make_wall(WIDTH, HEIGHT, WIDTH);
    tl_scatter_options options = tl_scatter_options_default();
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    options.count = COUNT_OF(expected);
    options.seed = 77;
    options.range = 2.0f;
    options.intensity = 3.0f;
    ASSERT_OK(tl_scatter(wall, &options, &set, &err), err);
    assert_int_equal(set.count, COUNT_OF(expected));
    for (size_t i = 0; i < set.count; i++) {
        const tl_light *light = &set.lights[i];
        assert_int_equal(light->type, TL_LIGHT_POINT);
        assert_int_equal(light->falloff, TL_FALLOFF_LINEAR);
        assert_true(light->range == 2.0f && light->intensity == 3.0f);
        for (int k = 0; k < 3; k++) {
            /* Some ten roundings in double, one to float; the oracle's is exact. A double that
             * falls the other way at the last rounding is an ulp of 5 off. */
            const float far = fabsf(light->position[k] - expected[i].position[k]);
            if (far > 5.0f * 0x1p-23f ||
                fabsf(light->color[k] - expected[i].color[k]) > 0x1p-23f)
                fail_msg("light %zu, axis %d: %.9g, %.9g", i, k, (double)light->position[k],
                         (double)light->color[k]);
        }
    }
    tl_light_set_clear(&set);
    tl_gbuffer_destroy(wall);
}

/* The mean over all pixels of how many feet are within range, counted apart. */
static double count_overlap(const tl_light_set *set)
{
    const double range = (double)set->lights[0].range;
    size_t pairs = 0;
    for (int y = 0; y < FINE_HEIGHT; y++)
        for (int x = 0; x < FINE_WIDTH; x++)
            for (size_t i = 0; i < set->count; i++) {
                const double dx =
                    ((x + 0.5) / FINE_WIDTH * 2 - 1) * 5 - (double)set->lights[i].position[0];
                const double dy =
                    (0.5 - (y + 0.5) / FINE_HEIGHT) * 5 - (double)set->lights[i].position[1];
                pairs += dx * dx + dy * dy <= range * range;
            }
    return (double)pairs / (FINE_WIDTH * FINE_HEIGHT);
}

static void range_gives_the_overlap(void **state)
{
    static const float overlaps[] = {1.0f, 12.0f, 100.0f, 5000.0f};
    tl_gbuffer *wall = make_wall(FINE_WIDTH, FINE_HEIGHT, FINE_WIDTH);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(overlaps); i++) {
        tl_scatter_options options = tl_scatter_options_default();
        tl_light_set set = {0};
        tl_error err;
        options.overlap = overlaps[i];
        ASSERT_OK(tl_scatter(wall, &options, &set, &err), err);
        const double wanted = fmin((double)overlaps[i], 1024.0), got = count_overlap(&set);
        /* 1000 sampled pixels. Counts vary from pixel to pixel as Poisson's do, and by the frame's
         * edges, which halve them: twice sqrt(wanted) covers both. Five standard errors. */
        const double most = 5 * 2 * sqrt(wanted) / sqrt(1000.0);
        if (!(fabs(got - wanted) <= most))
            fail_msg("overlap %g came out as %g", wanted, got);
        for (size_t k = 0; k < set.count; k++) {
            const double share =
                ((double)set.lights[k].position[2] + 5) / (double)set.lights[k].range;
            assert_true(share >= 0.05 - 1e-5 && share <= 0.6 + 1e-5);
        }
        tl_light_set_clear(&set);
    }
    tl_gbuffer_destroy(wall);
}

/* Not on the sky, on every column of the wall, one side's light like the other's. */
static void lights_stand_on_what_is_visible(void **state)
{
    enum { END = 13 };
    tl_gbuffer *wall = make_wall(WIDTH, HEIGHT, END);
    tl_scatter_options options = tl_scatter_options_default();
    size_t per_column[WIDTH] = {0};
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    options.count = 13 * 400;
    ASSERT_OK(tl_scatter(wall, &options, &set, &err), err);
    for (size_t i = 0; i < set.count; i++) {
        const float column = (set.lights[i].position[0] / wall_depth + 1.0f) * 0.5f * WIDTH;
        assert_true(column > 0.0f && column < (float)END);
        per_column[(int)column]++;
        const float *c = set.lights[i].color;
        assert_true(fmaxf(c[0], fmaxf(c[1], c[2])) == 1.0f);
        assert_true(fminf(c[0], fminf(c[1], c[2])) == 0.0f);
    }
    for (size_t x = 0; x < END; x++) /* 400 expected, standard deviation 19: five of them */
        assert_in_range(per_column[x], 300, 500);
    tl_light_set_clear(&set);
    tl_gbuffer_destroy(wall);
}

static void seeds_differ_and_repeat(void **state)
{
    tl_gbuffer *wall = make_wall(WIDTH, HEIGHT, WIDTH);
    tl_scatter_options options = tl_scatter_options_default();
    tl_light_set first = {0}, again = {0}, other = {0};
    tl_error err;
    (void)state;
    ASSERT_OK(tl_scatter(wall, &options, &first, &err), err);
    ASSERT_OK(tl_scatter(wall, &options, &again, &err), err);
    options.seed = 2;
    ASSERT_OK(tl_scatter(wall, &options, &other, &err), err);
    assert_memory_equal(first.lights, again.lights, first.count * sizeof *first.lights);
    assert_memory_not_equal(first.lights, other.lights, first.count * sizeof *first.lights);
    tl_light_set_clear(&other);
    tl_light_set_clear(&again);
    tl_light_set_clear(&first);
    tl_gbuffer_destroy(wall);
}

static void one_pixel_is_enough(void **state)
{
    tl_gbuffer *wall = make_wall(1, 1, 1);
    tl_scatter_options options = tl_scatter_options_default();
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    for (tl_falloff falloff = 0; falloff < TL_FALLOFF_TABLE; falloff++) {
        options.falloff = falloff;
        ASSERT_OK(tl_scatter(wall, &options, &set, &err), err);
        ASSERT_OK(tl_light_set_check(&set, "scattered", &err), err);
        assert_int_equal(set.lights[set.count - 1].falloff, falloff);
    }
    assert_int_equal(set.count, TL_FALLOFF_TABLE * options.count);
    tl_light_set_clear(&set);
    tl_gbuffer_destroy(wall);
}

static void the_impossible_is_refused(void **state)
{
    static const struct {
        const char *name, *word;
        uint32_t count, wall_end;
        float overlap, range, intensity;
        tl_falloff falloff;
    } cases[] = {
        {"all sky", "sky", 8, 0, 12, 0, 0, 0},
        {"no lights", "scattered", 0, 1, 12, 0, 0, 0},
        {"too many", "1000000", TL_MAX_SCATTERED + 1, 1, 12, 0, 0, 0},
        {"no overlap", "overlap", 8, 1, 0, 0, 0, 0},
        {"overlap NaN", "overlap", 8, 1, NAN, 0, 0, 0},
        {"negative range", "range", 8, 1, 12, -1, 0, 0},
        {"infinite range", "range", 8, 1, 12, INFINITY, 0, 0},
        {"intensity NaN", "intensity", 8, 1, 12, 0, NAN, 0},
        {"a table", "table", 8, 1, 12, 0, 0, TL_FALLOFF_TABLE},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_gbuffer *wall = make_wall(1, 1, cases[i].wall_end);
        const tl_scatter_options options = {.count = cases[i].count,
                                            .overlap = cases[i].overlap,
                                            .range = cases[i].range,
                                            .intensity = cases[i].intensity,
                                            .falloff = cases[i].falloff};
        const tl_light kept = tl_light_default();
        tl_light_set set = {0};
        tl_error err;
        ASSERT_OK(tl_light_set_add(&set, &kept, &err), err);
        if (tl_scatter(wall, &options, &set, &err) != TL_ERR_ARGUMENT ||
            !strstr(err.message, cases[i].word) || set.count != 1)
            fail_msg("%s: %zu lights, \"%s\"", cases[i].name, set.count, err.message);
        tl_light_set_clear(&set);
        tl_gbuffer_destroy(wall);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_are_those_of_the_definition),
        cmocka_unit_test(range_gives_the_overlap),
        cmocka_unit_test(lights_stand_on_what_is_visible),
        cmocka_unit_test(seeds_differ_and_repeat),
        cmocka_unit_test(one_pixel_is_enough),
        cmocka_unit_test(the_impossible_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
