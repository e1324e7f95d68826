/* Is what a layout cannot say cut to the nearest that it can, counted, and never sky?
 *
 * Frames of one pixel. What is expected is known from the formats: 65504 is the largest half, 511/512 2^16
 * the largest RGB9E5, a depth buffer ends at its planes. */
#include "frames.h"

#include "tilelight/error_bounds.h"
#include "tilelight/layouts.h"

static const struct cut_case {
    const char *name;
    enum tl_layout_name layout;
    tl_projection projection;
    float near, far;
    enum tl_plane plane;
    float value, want; /* want: within tolerance, relative */
    double tolerance;
    uint64_t cut;
} cases[] = {
    /* With far = 1e7 near, all that is beyond far is 1e-7 of the depth buffer's numbers. */
    {"twice the far plane", TL_LAYOUT_FLOAT_FORWARD, TL_PERSPECTIVE, 1e-2f, 1e5f, TL_DEPTH,
     2e5f, 1e5f, 0.4, 1},
    {"twice the far plane", TL_LAYOUT_FLOAT_REVERSED, TL_PERSPECTIVE, 1e-2f, 1e5f, TL_DEPTH,
     2e5f, 1e5f, 1e-6, 1},
    {"twice the far plane", TL_LAYOUT_MERLIN, TL_PERSPECTIVE, 0.1f, 1e3f, TL_DEPTH, 2e3f, 1e3f,
     1e-3, 1},
    {"as deep as surfaces are", TL_LAYOUT_TUTORIAL_3X8, TL_PERSPECTIVE, 0.1f, 1e3f, TL_DEPTH,
     1e18f, 1e3f, 1e-3, 1},
    {"half of near", TL_LAYOUT_FLOAT_NDC, TL_PERSPECTIVE, 0.1f, 1e3f, TL_DEPTH, 0.05f, 0.1f,
     1e-6, 1},
    {"far, rounded up", TL_LAYOUT_FLOAT_REVERSED, TL_PERSPECTIVE, 0.1f, 1e3f, TL_DEPTH,
     0x1.f40002p9f, 1e3f, 1e-6, 0},
    {"near, rounded down", TL_LAYOUT_FLOAT_REVERSED, TL_PERSPECTIVE, 0.1f, 1e3f, TL_DEPTH,
     0x1.999998p-4f, 0.1f, 1e-6, 0},
    {"before near, parallel", TL_LAYOUT_FLOAT_FORWARD, TL_ORTHOGRAPHIC, 0.0f, 10.0f, TL_DEPTH,
     -1.0f, 0.0f, 1e-6, 1},
    {"0, parallel", TL_LAYOUT_FLOAT_FORWARD, TL_ORTHOGRAPHIC, 0.0f, 10.0f, TL_DEPTH, -1e-6f,
     0.0f, 1e-6, 0},
    {"beyond far, as a fraction", TL_LAYOUT_FLOAT_FRACTION, TL_PERSPECTIVE, 0.1f, 1e3f,
     TL_DEPTH, 2e3f, 2e3f, 1e-6, 0},
    {"a fraction beyond float", TL_LAYOUT_FLOAT_FRACTION, TL_PERSPECTIVE, 1e-30f, 2e-30f,
     TL_DEPTH, 1e18f, 3.4e8f, 0.1, 1},
    {"behind the eye, no sign", TL_LAYOUT_COMPACT_12, TL_ORTHOGRAPHIC, -5.0f, 10.0f, TL_DEPTH,
     -1.0f, 0.0f, 0.0, 1},
    {"a half beyond 65504", TL_LAYOUT_MERLIN_POSITION, TL_PERSPECTIVE, 0.1f, 1e6f, TL_DEPTH,
     7e4f, 65504.0f, 0.0, 1},
    {"the largest half", TL_LAYOUT_MERLIN_POSITION, TL_PERSPECTIVE, 0.1f, 1e6f, TL_DEPTH,
     65504.0f, 65504.0f, 0.0, 0},
    {"as deep as surfaces are", TL_LAYOUT_COMPACT_12, TL_PERSPECTIVE, 0.1f, 1e3f, TL_DEPTH,
     9e17f, 9e17f, 1e-5, 0},
    {"emission in a half", TL_LAYOUT_DXR, TL_PERSPECTIVE, 0.1f, 1e3f, TL_EMISSIVE_R, 1e30f,
     65504.0f, 0.0, 1},
    {"emission in a byte", TL_LAYOUT_DXR, TL_PERSPECTIVE, 0.1f, 1e3f, TL_EMISSIVE_B, 2.0f, 1.0f,
     0.0, 1},
    {"emission of 1 in a byte", TL_LAYOUT_DXR, TL_PERSPECTIVE, 0.1f, 1e3f, TL_EMISSIVE_B, 1.0f,
     1.0f, 0.0, 0},
    {"shared exponent", TL_LAYOUT_COMPACT_16, TL_PERSPECTIVE, 0.1f, 1e3f, TL_EMISSIVE_G, 1e30f,
     65408.0f, 0.0, 1},
    {"largest shared exponent", TL_LAYOUT_COMPACT_12, TL_PERSPECTIVE, 0.1f, 1e3f, TL_EMISSIVE_G,
     65408.0f, 65408.0f, 0.0, 0},
    {"emission in floats", TL_LAYOUT_FLOAT_NDC, TL_PERSPECTIVE, 0.1f, 1e3f, TL_EMISSIVE_G,
     1e30f, 1e30f, 0.0, 0},
    {"largest exponent", TL_LAYOUT_ISPC, TL_PERSPECTIVE, 0.1f, 1e3f, TL_SHININESS, 10000.0f,
     10000.0f, 0.0, 0},
    {"largest exponent's logarithm", TL_LAYOUT_MERLIN, TL_PERSPECTIVE, 0.1f, 1e3f, TL_SHININESS,
     10000.0f, 10000.0f, 0.0, 0},
};

static tl_gbuffer *one_pixel(const struct cut_case *c)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 1, 1, 0.1, 1.0);
    const uint32_t material = tl_layout_planes(c->layout) & TL_GROUP_PHONG ? TL_GROUP_PHONG : 0;
    const uint32_t emissive = tl_layout_planes(c->layout) & TL_GROUP_EMISSIVE;
    tl_gbuffer *g = NULL;
    tl_error err;
    camera.projection = c->projection;
    camera.near = c->near;
    camera.far = c->far;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE | material | emissive, &g, &err), err);
    set_pixel(g, TL_DEPTH, 0, isinf(c->far) ? c->near : 0.5f * (c->near + c->far));
    set_pixel(g, TL_NORMAL_Z, 0, 1.0f);
    set_pixel(g, c->plane, 0, c->value);
    return g;
}

/* Of the plane of the case alone: no other has anything that could be cut. */
static void assert_counts(const struct cut_case *c, const tl_packing_report *report)
{
    for (int p = 0; p < TL_PLANE_COUNT; p++) {
        const uint64_t want = p == (int)c->plane ? c->cut : 0;
        if (report->cut[p] != want)
            fail_msg("%s, %s: %llu values of plane %d were cut, want %llu", c->name,
                     tl_layout_word(c->layout), (unsigned long long)report->cut[p], p,
                     (unsigned long long)want);
    }
}

static void values_are_cut_and_counted(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const struct cut_case *c = &cases[i];
        tl_gbuffer *from = one_pixel(c), *packed = NULL, *read = NULL;
        tl_packing_report report;
        tl_error err;
        ASSERT_OK(tl_gbuffer_pack(from, c->layout, &packed, &report, &err), err);
        ASSERT_OK(tl_gbuffer_unpack(packed, &read, &err), err);
        const double got = (double)tl_gbuffer_plane(read, c->plane)[0], want = (double)c->want;
        assert_counts(c, &report);
        if (!(fabs(got - want) <= c->tolerance * fmax(fabs(want), 1.0)))
            fail_msg("%s, %s: %.9g becomes %.9g, want %.9g", c->name, tl_layout_word(c->layout),
                     (double)c->value, got, want);
        tl_gbuffer_destroy(read);
        tl_gbuffer_destroy(packed);
        tl_gbuffer_destroy(from);
    }
}

/* tl_layout_range says where the cases begin. */
static void ranges_are_told(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const struct cut_case *c = &cases[i];
        tl_gbuffer *from = one_pixel(c);
        double low, high;
        tl_layout_range(&from->camera, c->layout, c->plane, &low, &high);
        const double value = (double)c->value, slack = 2e-6 * (fabs(value) + 1.0);
        const int beyond = value < low - slack || value > high + slack;
        if (beyond != (int)c->cut && c->layout != TL_LAYOUT_FLOAT_FRACTION)
            fail_msg("%s, %s: %.9g, of a range from %.9g to %.9g", c->name,
                     tl_layout_word(c->layout), value, low, high);
        tl_gbuffer_destroy(from);
    }
}

/* Cameras whose depth cannot be told from the numbers of a depth buffer. */
static void depths_without_numbers_are_refused(void **state)
{
    static const struct {
        enum tl_layout_name layout;
        tl_projection projection;
        float near, far;
        const char *message;
    } refused[] = {
        {TL_LAYOUT_FLOAT_FRACTION, TL_PERSPECTIVE, 0.1f, INFINITY,
         "this camera's is infinitely far"},
        {TL_LAYOUT_MERLIN, TL_ORTHOGRAPHIC, 0.1f, INFINITY,
         "orthographic camera's is infinitely far"},
        {TL_LAYOUT_FLOAT_REVERSED, TL_PERSPECTIVE, 1e-39f, 1.0f, "cannot be told from numbers"},
        {TL_LAYOUT_TUTORIAL, TL_ORTHOGRAPHIC, -3e38f, 3e38f, "cannot be told from numbers"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(refused); i++) {
        const struct cut_case c = {.layout = refused[i].layout,
                                   .projection = refused[i].projection,
                                   .near = refused[i].near,
                                   .far = refused[i].far,
                                   .value = 1.0f};
        tl_gbuffer *from = one_pixel(&c), *packed = NULL;
        tl_error err;
        assert_int_equal(tl_gbuffer_pack(from, c.layout, &packed, NULL, &err),
                         TL_ERR_UNSUPPORTED);
        assert_null(packed);
        if (!strstr(err.message, refused[i].message))
            fail_msg("case %zu: %s", i, err.message);
        tl_gbuffer_destroy(from);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_cut_and_counted),
        cmocka_unit_test(ranges_are_told),
        cmocka_unit_test(depths_without_numbers_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
