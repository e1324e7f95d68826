/* Is every packed pixel safe to light once tl_gbuffer_repair has been through, whatever its words were,
 * and does no stored position lie farther off its ray than the slack says? */
#include "packed_frames.h"

enum { WIDTH = 37, HEIGHT = 23 };

static tl_gbuffer *random_packed(enum tl_layout_name layout, tl_projection projection)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, projection);
    return packed_gbuffer(&camera, layout, 8); /* with that the faulty pixel is no sky */
}

/* Of what the unpacked frame says; by the table of planes.h. */
static void assert_safe(const tl_gbuffer *g, const char *what)
{
    tl_gbuffer *u = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_unpack(g, &u, &err), err);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const size_t at = (size_t)y * u->pitch + x;
            const float depth = tl_gbuffer_plane(u, TL_DEPTH)[at];
            const int in_front = g->camera.projection == TL_ORTHOGRAPHIC || depth > 0.0f;
            if (isnan(depth) || !in_front || (!isinf(depth) && fabsf(depth) > 1e18f))
                fail_msg("%s: pixel (%u, %u) has depth %g", what, x, y, (double)depth);
            for (int p = TL_NORMAL_X; p < TL_PLANE_COUNT; p++) {
                const float *plane = tl_gbuffer_plane(u, (enum tl_plane)p);
                const float low = p < TL_ALBEDO_R ? -1e18f : 0.0f;
                const float high = p < TL_ALBEDO_R      ? 1e18f
                                   : p == TL_SHININESS  ? 10000.0f
                                   : p >= TL_EMISSIVE_R ? 1e30f
                                                        : 1.0f;
                if (plane && !(plane[at] >= low && plane[at] <= high))
                    fail_msg("%s: pixel (%u, %u), plane %d is %g", what, x, y, p,
                             (double)plane[at]);
            }
        }
    tl_gbuffer_destroy(u);
}

/* What was packed from a good frame is good, and keeps its words. */
static void good_frames_stay(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (int projection = 0; projection < 2; projection++) {
            tl_gbuffer *g =
                random_packed((enum tl_layout_name)layout, (tl_projection)projection);
            unsigned char *before = malloc(gbuffer_bytes(g));
            tl_error err;
            assert_non_null(before);
            memcpy(before, g->planes, gbuffer_bytes(g));
            ASSERT_OK(tl_gbuffer_repair(g, "good", true, NULL, &err), err);
            assert_memory_equal(before, g->planes, gbuffer_bytes(g));
            assert_safe(g, tl_layout_word(g->layout));
            free(before);
            tl_gbuffer_destroy(g);
        }
}

/* Attributes, as messages call them. */
static const struct {
    const char *name;
    size_t offset;
    uint32_t planes;
} attributes[] = {
    {"depth", offsetof(tl_layout, depth), TL_HAS(TL_DEPTH)},
    {"normal", offsetof(tl_layout, normal), TL_HAS(TL_NORMAL_X)},
    {"albedo", offsetof(tl_layout, albedo), TL_HAS(TL_ALBEDO_R)},
    {"specular", offsetof(tl_layout, specular), TL_HAS(TL_SPECULAR_R)},
    {"shininess", offsetof(tl_layout, shininess), TL_HAS(TL_SHININESS)},
    {"metallic", offsetof(tl_layout, metallic), TL_HAS(TL_METALLIC)},
    {"roughness", offsetof(tl_layout, roughness), TL_HAS(TL_ROUGHNESS)},
    {"ao", offsetof(tl_layout, occlusion), TL_HAS(TL_OCCLUSION)},
    {"emissive", offsetof(tl_layout, emissive), TL_HAS(TL_EMISSIVE_R)},
};

/* In the bits of a float without its sign and last 7 bits, of a float, and of a half. */
static const uint32_t not_numbers[] = {
    [TL_NUMBER_FLOAT] = 0x7fc00000u,
    [TL_NUMBER_HALF] = 0x7e00u,
    [TL_NUMBER_FLOAT24] = 0x7fc00000u >> 7,
};
static const uint32_t minus_infinities[] = {
    [TL_NUMBER_FLOAT] = 0xff800000u,
    [TL_NUMBER_HALF] = 0xfc00u,
    [TL_NUMBER_FLOAT24] = 0x7fc00000u >> 7, /* it has no sign */
};

enum { FAULTY_X = 17, FAULTY_Y = 11 };

/* Indices and tangents in floats that layouts of full float have: in neither is a number that is none, and an
 * index is whole. 0 in every pixel is neutral, in an octahedron too. */
static void indices_and_tangents(void **state)
{
    static const struct {
        enum tl_plane plane;
        float value, repaired;
    } cases[] = {{TL_BRDF, 7.0f, 7.0f},        {TL_BRDF, 7.5f, 0.0f},
                 {TL_BRDF, 256.0f, 0.0f},      {TL_BRDF, NAN, 0.0f},
                 {TL_TANGENT_Y, -2.0f, -2.0f}, {TL_TANGENT_Y, NAN, 0.0f}};
    static const enum tl_layout_name layouts[] = {TL_LAYOUT_FLOAT_FORWARD,
                                                  TL_LAYOUT_FLOAT_POSITION,
                                                  TL_LAYOUT_COMPACT_16, TL_LAYOUT_MERLIN};
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    (void)state;
    for (size_t l = 0; l < COUNT_OF(layouts); l++)
        for (size_t i = 0; i < COUNT_OF(cases); i++) {
            const int is_float = l < 2, is_good = same_bits(cases[i].value, cases[i].repaired);
            tl_gbuffer *from = random_gbuffer(&camera, TL_GROUP_BASE, 3), *full = NULL,
                       *g = NULL, *back = NULL;
            tl_repairs repairs;
            tl_error err;
            ASSERT_OK(tl_gbuffer_create(&camera,
                                        TL_GROUP_BASE | TL_GROUP_BRDF | TL_GROUP_TANGENT, &full,
                                        &err),
                      err);
            for (int p = 0; p <= TL_ALBEDO_B; p++)
                memcpy(tl_gbuffer_plane(full, (enum tl_plane)p),
                       tl_gbuffer_plane(from, (enum tl_plane)p),
                       (size_t)full->pitch * full->rows * sizeof(float));
            ASSERT_OK(tl_gbuffer_pack(full, layouts[l], &g, NULL, &err), err);
            const uint32_t both = g->present & (TL_GROUP_BRDF | TL_GROUP_TANGENT);
            assert_int_equal(g->neutral & both, both);
            if (is_float) {
                const uint32_t word =
                    (uint32_t)cases[i].plane + (layouts[l] == TL_LAYOUT_FLOAT_POSITION ? 2 : 0);
                ((float *)tl_gbuffer_words(g, word))[0] = cases[i].value;
                ASSERT_OK(tl_gbuffer_repair(g, "faulty", false, &repairs, &err), err);
                assert_int_equal(repairs.value, !is_good);
                ASSERT_OK(tl_gbuffer_unpack(g, &back, &err), err);
                assert_true(
                    same_bits(tl_gbuffer_plane(back, cases[i].plane)[0], cases[i].repaired));
                assert_int_equal((g->neutral & TL_HAS(TL_BRDF)) == 0,
                                 cases[i].plane == TL_BRDF && is_good);
                assert_int_equal((g->neutral & TL_HAS(TL_TANGENT_X)) == 0,
                                 cases[i].plane != TL_BRDF && is_good);
            }
            tl_gbuffer_destroy(back);
            tl_gbuffer_destroy(g);
            tl_gbuffer_destroy(full);
            tl_gbuffer_destroy(from);
        }
}

static void assert_fault_is_found(tl_gbuffer *g, const char *attribute, const char *what)
{
    char expected[128];
    tl_repairs repairs;
    tl_error err = {.message = ""};
    snprintf(expected, sizeof expected, "%s: pixel (%d, %d), packed %s cannot", what, FAULTY_X,
             FAULTY_Y, attribute);
    const tl_status status = tl_gbuffer_repair(g, what, true, &repairs, &err);
    if (status != TL_ERR_FORMAT || !strstr(err.message, expected))
        fail_msg("expected \"%s\", not \"%s\"", expected, err.message);
    assert_safe(g, what);
}

/* One channel of one pixel is no number, or minus infinity. */
static void a_number_that_is_none_is_found_and_named(void **state)
{
    (void)state;
    for (int layout = 1; layout < TL_LAYOUT_COUNT; layout++)
        for (size_t a = 0; a < COUNT_OF(attributes); a++)
            for (int k = 0; k < 3; k++)
                for (int minus = 0; minus < 2; minus++) {
                    tl_gbuffer *g = random_packed((enum tl_layout_name)layout, TL_PERSPECTIVE);
                    const tl_attribute *attribute =
                        (const void *)((const char *)&tl_layouts[layout] +
                                       attributes[a].offset);
                    const tl_channel c = attribute->channels[k];
                    char what[64];
                    snprintf(what, sizeof what, "%s, channel %d%s", tl_layout_word(g->layout),
                             k, minus ? ", negative" : "");
                    if (attribute->code && c.bits > 0 && c.number <= TL_NUMBER_FLOAT24 &&
                        (g->present & attributes[a].planes)) {
                        set_channel_bits(g, FAULTY_Y * (size_t)g->pitch + FAULTY_X, c,
                                         (minus ? minus_infinities : not_numbers)[c.number]);
                        assert_fault_is_found(g, attributes[a].name, what);
                    }
                    tl_gbuffer_destroy(g);
                }
}

/* Twice, for what was repaired needs no repair; but of normals "none" counts every time. */
static void any_bits_become_safe(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (int projection = 0; projection < 2; projection++) {
            tl_gbuffer *g =
                random_packed((enum tl_layout_name)layout, (tl_projection)projection);
            tl_repairs repairs;
            tl_error err;
            scramble(g, 41);
            assert_safe(g, tl_layout_word(g->layout));
            ASSERT_OK(tl_gbuffer_repair(g, "bits", false, &repairs, &err), err);
            assert_int_equal(repairs.depth, 0);
            assert_int_equal(repairs.value, 0);
            tl_gbuffer_destroy(g);
        }
}

/* Half in a position of m, by the format's definition: sign, 5 bits of exponent, 10 of mantissa. */
static double value_of_bits(const tl_words *words, tl_channel c)
{
    const uint32_t bits = words->of[c.word] >> c.shift;
    if (c.number == TL_NUMBER_FLOAT) {
        float value;
        memcpy(&value, &bits, sizeof value);
        return (double)value;
    }
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const double magnitude =
        exponent == 0 ? ldexp(mantissa, -24) : ldexp(1024 + mantissa, exponent - 25);
    return bits & 0x8000u ? -magnitude : magnitude;
}

/* The largest distances off the rays, in double from the definitions; those of sky are left out. */
static void measure_slack(const tl_gbuffer *g, double most[2])
{
    const tl_word_planes planes = tl_word_planes_of(g);
    const tl_camera *c = &g->camera;
    const int parallel = c->projection == TL_ORTHOGRAPHIC;
    const double step[2] = {((double)c->right - (double)c->left) / c->width,
                            ((double)c->bottom - (double)c->top) / c->height};
    most[0] = most[1] = 0.0;
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++) {
            const tl_words words = tl_words_at(&planes, (size_t)y * g->pitch + x);
            double at[3], view[3];
            for (int k = 0; k < 3; k++)
                at[k] = value_of_bits(&words, planes.layout->depth.channels[k]);
            if (at[0] > 65504.0)
                continue;
            memcpy(view, at, sizeof view);
            if (planes.layout->depth.code == TL_DEPTH_WORLD_POSITION)
                tl_camera_view_point(c, at, view);
            const double unit = parallel ? 1.0 : -view[2];
            const double off_x = fabs(view[0] / unit - ((double)c->left + (x + 0.5) * step[0]));
            const double off_y = fabs(view[1] / unit - ((double)c->top + (y + 0.5) * step[1]));
            most[0] = fmax(most[0], off_x);
            most[1] = fmax(most[1], off_y);
        }
}

/* 1e-5 m or so is what float loses of a point 5 m away, and more than that nobody may be off. */
static void assert_slack_holds(const tl_gbuffer *g)
{
    double most[2];
    measure_slack(g, most);
    for (int axis = 0; axis < 2; axis++) {
        const double slack = (double)(axis ? g->slack_y : g->slack_x);
        if (!(slack >= most[axis] - 1e-5 && slack <= most[axis] + 1e-5))
            fail_msg("%s, axis %d: the slack is %g, positions are %g off",
                     tl_layout_word(g->layout), axis, slack, most[axis]);
    }
}

static void slack_holds_every_position(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (int projection = 0; projection < 2; projection++) {
            tl_gbuffer *g =
                random_packed((enum tl_layout_name)layout, (tl_projection)projection);
            if (!TL_IS_POSITION(tl_layouts[layout].depth.code)) {
                assert_true(same_bits(g->slack_x, 0.0f) && same_bits(g->slack_y, 0.0f));
            } else {
                assert_slack_holds(g);
                move_positions(g, 3);
                assert_slack_holds(g);
                assert_true(g->slack_y > 0.01f);
            }
            tl_gbuffer_destroy(g);
        }
}

/* Before anybody has looked, nothing is known of the positions. */
static void slack_is_infinite_at_first(void **state)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++) {
        tl_gbuffer *g = NULL;
        tl_error err;
        ASSERT_OK(tl_gbuffer_create_packed(&camera, (enum tl_layout_name)layout, TL_GROUP_BASE,
                                           &g, &err),
                  err);
        const float want = TL_IS_POSITION(tl_layouts[layout].depth.code) ? INFINITY : 0.0f;
        assert_true(same_bits(g->slack_x, want) && same_bits(g->slack_y, want));
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_frames_stay),
        cmocka_unit_test(a_number_that_is_none_is_found_and_named),
        cmocka_unit_test(indices_and_tangents),
        cmocka_unit_test(any_bits_become_safe),
        cmocka_unit_test(slack_holds_every_position),
        cmocka_unit_test(slack_is_infinite_at_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
