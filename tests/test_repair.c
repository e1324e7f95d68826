/* Does tl_gbuffer_repair make every pixel one that can be lit, and count what it did? */
#include "testing.h"

#include "tilelight/gbuffer.h"

static const struct {
    const char *name;
    enum tl_plane plane;
    float value, want;
    uint64_t depth, normal, values;
} cases[] = {
    {"NaN depth is sky", TL_DEPTH, NAN, INFINITY, 1, 0, 0},
    {"negative depth is sky", TL_DEPTH, -1.0f, INFINITY, 1, 0, 0},
    {"depth 0 is sky", TL_DEPTH, 0.0f, INFINITY, 1, 0, 0},
    {"minus infinity is sky", TL_DEPTH, -INFINITY, INFINITY, 1, 0, 0},
    {"a depth whose square overflows is sky", TL_DEPTH, 1e30f, INFINITY, 1, 0, 0},
    {"infinite depth is sky as it is", TL_DEPTH, INFINITY, INFINITY, 0, 0, 0},
    {"denormal depth stays", TL_DEPTH, 1e-40f, 1e-40f, 0, 0, 0},
    {"NaN normal is none", TL_NORMAL_X, NAN, 0.0f, 0, 1, 0},
    {"infinite normal is none", TL_NORMAL_X, INFINITY, 0.0f, 0, 1, 0},
    {"a normal of any length stays", TL_NORMAL_Z, 17.0f, 17.0f, 0, 0, 0},
    {"NaN albedo is black", TL_ALBEDO_G, NAN, 0.0f, 0, 0, 1},
    {"negative albedo is black", TL_ALBEDO_G, -0.5f, 0.0f, 0, 0, 1},
    {"albedo above 1 is 1", TL_ALBEDO_G, 1.5f, 1.0f, 0, 0, 1},
    {"infinite albedo is black", TL_ALBEDO_G, INFINITY, 0.0f, 0, 0, 1},
    {"a shininess that is too high is cut", TL_SHININESS, 1e9f, 10000.0f, 0, 0, 1},
    {"emission has no limit to speak of", TL_EMISSIVE_R, 1e20f, 1e20f, 0, 0, 0},
    {"NaN emission is none", TL_EMISSIVE_B, NAN, 0.0f, 0, 0, 1},
    {"occlusion above 1 is 1", TL_OCCLUSION, 2.0f, 1.0f, 0, 0, 1},
    {"the last index stays", TL_BRDF, 255.0f, 255.0f, 0, 0, 0},
    {"an index above it is none", TL_BRDF, 256.0f, 0.0f, 0, 0, 1},
    {"half an index is none", TL_BRDF, 2.5f, 0.0f, 0, 0, 1},
    {"NaN is no index", TL_BRDF, NAN, 0.0f, 0, 0, 1},
    {"a tangent points anywhere", TL_TANGENT_Y, -17.0f, -17.0f, 0, 0, 0},
    {"NaN is no tangent", TL_TANGENT_Y, NAN, 0.0f, 0, 0, 1},
    {"minus infinity is no tangent", TL_TANGENT_Z, -INFINITY, 0.0f, 0, 0, 1},
};

enum { WIDTH = 5, HEIGHT = 4, X = 3, Y = 2 };

static tl_gbuffer *good_gbuffer(tl_projection projection)
{
    const tl_camera camera = {.projection = projection,
                              .width = WIDTH,
                              .height = HEIGHT,
                              .left = -1,
                              .right = 1,
                              .bottom = -1,
                              .top = 1,
                              .near = 0.1f,
                              .far = 10,
                              .view_from_world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    const uint32_t present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION |
                             TL_GROUP_EMISSIVE | TL_GROUP_BRDF | TL_GROUP_TANGENT;
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, present, &g, &err), err);
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        for (uint32_t i = 0; tl_gbuffer_plane(g, (enum tl_plane)p) && i < WIDTH * HEIGHT; i++)
            tl_gbuffer_plane(g, (enum tl_plane)p)[i / WIDTH * g->pitch + i % WIDTH] =
                p == TL_BRDF ? 3.0f : 0.5f;
    return g;
}

static void each_fault_is_repaired_and_counted(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_gbuffer *g = good_gbuffer(TL_PERSPECTIVE);
        const size_t at = Y * (size_t)g->pitch + X;
        float *plane = tl_gbuffer_plane(g, cases[i].plane);
        tl_repairs repairs;
        tl_error err;
        plane[at] = cases[i].value;
        ASSERT_OK(tl_gbuffer_repair(g, "test", false, &repairs, &err), err);
        if (!same_bits(plane[at], cases[i].want) || repairs.depth != cases[i].depth ||
            repairs.normal != cases[i].normal || repairs.value != cases[i].values)
            fail_msg("%s: became %g; %d, %d, %d repaired", cases[i].name, (double)plane[at],
                     (int)repairs.depth, (int)repairs.normal, (int)repairs.value);
        if (isinf(tl_gbuffer_plane(g, TL_DEPTH)[at]))
            assert_true(same_bits(tl_gbuffer_plane(g, TL_ALBEDO_R)[at], 0.0f) &&
                        same_bits(tl_gbuffer_plane(g, TL_OCCLUSION)[at], 1.0f));
        tl_gbuffer_destroy(g);
    }
}

static void strict_refuses_and_names_the_first(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_gbuffer *g = good_gbuffer(TL_PERSPECTIVE);
        const int faulty = cases[i].depth + cases[i].normal + cases[i].values > 0;
        tl_error err = {.message = ""};
        tl_gbuffer_plane(g, cases[i].plane)[Y * (size_t)g->pitch + X] = cases[i].value;
        const tl_status status = tl_gbuffer_repair(g, "frame.exr", true, NULL, &err);
        assert_int_equal(status, faulty ? TL_ERR_FORMAT : TL_OK);
        if (faulty)
            assert_non_null(strstr(err.message, "frame.exr: pixel (3, 2)"));
        tl_gbuffer_destroy(g);
    }
}

static void parallel_rays_allow_any_depth(void **state)
{
    tl_gbuffer *g = good_gbuffer(TL_ORTHOGRAPHIC);
    tl_repairs repairs;
    tl_error err;
    (void)state;
    tl_gbuffer_plane(g, TL_DEPTH)[0] = -3.0f;
    ASSERT_OK(tl_gbuffer_repair(g, "test", true, &repairs, &err), err);
    assert_true(same_bits(tl_gbuffer_plane(g, TL_DEPTH)[0], -3.0f));
    tl_gbuffer_destroy(g);
}

static void incomplete_groups_are_refused(void **state)
{
    static const uint32_t sets[] = {
        0,
        TL_GROUP_BASE & ~TL_HAS(TL_NORMAL_Y),
        TL_GROUP_BASE | TL_HAS(TL_SHININESS),
        TL_GROUP_BASE | TL_HAS(TL_METALLIC),
        TL_GROUP_BASE | TL_HAS(TL_EMISSIVE_G),
        TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH,
        TL_GROUP_BASE | 1u << TL_PLANE_COUNT,
    };
    tl_gbuffer *good = good_gbuffer(TL_PERSPECTIVE), *g = NULL;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(sets); i++)
        assert_int_equal(tl_gbuffer_create(&good->camera, sets[i], &g, NULL), TL_ERR_ARGUMENT);
    tl_gbuffer_destroy(good);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_fault_is_repaired_and_counted),
        cmocka_unit_test(strict_refuses_and_names_the_first),
        cmocka_unit_test(parallel_rays_allow_any_depth),
        cmocka_unit_test(incomplete_groups_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
