/* Does tl_sphere_bounds keep every pixel whose ray meets the sphere, and at most one more per side?
 *
 * tests/oracle/sphere.h says what is met. */
#include "testing.h"

#include "oracle/sphere.h"
#include "tilelight/bounds.h"

static tl_span oracle(const tl_camera *camera, float center, float center_z, float radius)
{
    return tl_oracle_sphere_span(center, -(wide)center_z, radius, camera->near, camera->far,
                                 camera->projection == TL_ORTHOGRAPHIC);
}

typedef struct counts {
    uint64_t lost, extra, falsely_empty, falsely_kept;
} counts;

/* Pixels [first, end) of one axis against the oracle's span, in units of pixels. */
static void judge(counts *n,
                  tl_span s,
                  wide at_0,
                  wide at_count,
                  uint32_t count,
                  uint32_t first,
                  uint32_t end)
{
    const wide scale = count / (at_count - at_0);
    const wide a = (s.low - at_0) * scale, b = (s.high - at_0) * scale;
    const wide from = a < b ? a : b, to = a < b ? b : a;
    const wide slack = 1e-6Q; /* of a pixel: what the test grants the doubles */
    if (s.empty || to < -slack || from > count + slack) {
        n->falsely_kept += end > first;
        return;
    }
    if (to < slack || from > count - slack)
        return; /* touches the image's edge within the slack: both answers are right */
    if (end <= first) {
        n->falsely_empty++;
        return;
    }
    /* The first and the last pixel whose centre is inside, beyond doubt. */
    const wide first_inside = ceilq(from - 0.5Q + slack),
               last_inside = floorq(to - 0.5Q - slack);
    if (first_inside <= last_inside) {
        const wide low = first_inside < 0 ? 0 : first_inside;
        const wide high = last_inside > count - 1 ? count - 1 : last_inside;
        n->lost += low <= high && ((wide)first > low || (wide)end - 1 < high);
    }
    n->extra += (wide)first + 1 < floorq(from - slack) + 1 && first > 0;
    n->extra += (wide)end - 1 > floorq(to + slack) + 0 && end < count;
}

static void check(counts *n, const tl_camera *camera, const float center[3], float radius)
{
    tl_pixel_rect rect;
    const tl_span x = oracle(camera, center[0], center[2], radius);
    const tl_span y = oracle(camera, center[1], center[2], radius);
    tl_sphere_bounds(camera, center, radius, &rect);
    if (rect.x1 == 0) { /* empty: one axis has to be the reason */
        counts nx = {0}, ny = {0};
        judge(&nx, x, camera->left, camera->right, camera->width, 0, 0);
        judge(&ny, y, camera->top, camera->bottom, camera->height, 0, 0);
        n->falsely_empty += nx.falsely_empty && ny.falsely_empty;
        return;
    }
    judge(n, x, camera->left, camera->right, camera->width, rect.x0, rect.x1);
    judge(n, y, camera->top, camera->bottom, camera->height, rect.y0, rect.y1);
}

static tl_camera camera_of(double fov, double offset, uint32_t width, uint32_t height)
{
    const double tangent = tan(0.5 * fov * 3.141592653589793 / 180.0);
    return (tl_camera){.projection = TL_PERSPECTIVE,
                       .width = width,
                       .height = height,
                       .left = (float)(tangent * (offset - 1.0)),
                       .right = (float)(tangent * (offset + 1.0)),
                       .bottom = (float)-tangent,
                       .top = (float)tangent,
                       .near = 0.1f,
                       .far = 100.0f,
                       .view_from_world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

/* Centre in view space, radius, in m. */
static const struct {
    const char *name;
    float center[3], radius;
} named[] = {
    {"in front", {1, 2, -10}, 1},
    {"camera inside", {0.5f, 0, -0.5f}, 3},
    {"camera on the surface", {0, 0, -2}, 2},
    {"camera one ulp outside", {0, 0, -2}, 0x1.fffffep0f},
    {"camera one ulp outside, beside", {2, 0, 0}, 0x1.fffffep0f},
    {"centre behind the camera", {1, 1, 2}, 5},
    {"centre beside the camera", {3, 0, 0}, 2},
    {"depth equal to the radius", {3, 1, -2}, 2},
    {"minus depth equal to the radius", {3, 1, 2}, 2},
    {"tangent to near from behind", {0, 0, 0.9f}, 1},
    {"barely through near", {0.01f, 0, 0.9f}, 0x1.000002p0f},
    {"tangent to far", {0, 0, -101}, 1},
    {"across far", {30, 0, -100}, 5},
    {"radius 0", {0.3f, 0.2f, -5}, 0},
    {"denormal radius", {0.3f, 0.2f, -5}, 1e-42f},
    {"tiny and far", {0.3f, 0.2f, -90}, 1e-5f},
    {"everything tiny", {1e-30f, 0, -1e-30f}, 1e-30f},
    {"everything huge", {1e30f, 0, -1e30f}, 1e30f},
    {"the eye its centre", {0, 0, 0}, 1},
    {"the eye its centre, radius below near", {0, 0, 0}, 0.05f},
};

static void assert_clean(const counts *n, const char *what)
{
    if (n->lost || n->extra || n->falsely_empty || n->falsely_kept)
        fail_msg("%s: %llu lost, %llu kept beyond one, %llu empty that are not, %llu not empty "
                 "that are",
                 what, (unsigned long long)n->lost, (unsigned long long)n->extra,
                 (unsigned long long)n->falsely_empty, (unsigned long long)n->falsely_kept);
}

static void named_cases_are_bounded(void **state)
{
    static const double fovs[] = {0.01, 1, 60, 120, 179.9}, offsets[] = {0, 0.3, -2};
    static const uint32_t extents[] = {1, 3, 1920, 16384};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(named); i++)
        for (size_t f = 0; f < COUNT_OF(fovs); f++)
            for (size_t o = 0; o < COUNT_OF(offsets); o++)
                for (size_t e = 0; e < COUNT_OF(extents); e++)
                    for (int projection = 0; projection < 2; projection++) {
                        counts n = {0};
                        tl_camera camera =
                            camera_of(fovs[f], offsets[o], extents[e], extents[e] / 2 + 1);
                        camera.projection = (tl_projection)projection;
                        check(&n, &camera, named[i].center, named[i].radius);
                        assert_clean(&n, named[i].name);
                    }
}

static uint64_t random_state;
static double uniform(double low, double high) /* splitmix64 */
{
    uint64_t z = random_state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return low + (high - low) * (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static float signed_magnitude(double low, double high)
{
    const double m = exp2(uniform(low, high));
    return (float)(uniform(-1.0, 1.0) < 0.0 ? -m : m);
}

/* A sphere that is tangent, to an ulp or so, to a plane through the eye or to near or far. */
static float tangent_radius(const tl_camera *camera, const float center[3])
{
    const double depth = -(double)center[2], c = (double)center[0];
    const double slope = (double)(uniform(0.0, 1.0) < 0.5 ? camera->left : camera->right);
    const double radii[] = {
        fabs(c - slope * depth) / sqrt(1.0 + slope * slope), fabs(depth - (double)camera->near),
        fabs(depth - (double)camera->far), sqrt(c * c + depth * depth), fabs(depth)};
    const float r = (float)radii[(int)uniform(0.0, 5.0)];
    return uniform(0.0, 1.0) < 0.3   ? nextafterf(r, 0.0f)
           : uniform(0.0, 1.0) < 0.5 ? nextafterf(r, INFINITY)
                                     : r;
}

static void random_cases_are_bounded(void **state)
{
    enum { CASE_COUNT = 300000 };
    counts n = {0};
    (void)state;
    random_state = 20261124;
    for (int i = 0; i < CASE_COUNT; i++) {
        const double spread = i % 3 == 0 ? 40.0 : 6.0;
        tl_camera camera =
            camera_of(exp2(uniform(-6.6, 7.49)), uniform(-1.5, 1.5),
                      (uint32_t)exp2(uniform(0.0, 14.0)), (uint32_t)exp2(uniform(0.0, 14.0)));
        const float center[3] = {signed_magnitude(-spread, spread),
                                 signed_magnitude(-spread, spread),
                                 signed_magnitude(-spread, spread)};
        camera.projection = i % 7 == 0 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
        camera.far = i % 5 == 0 ? INFINITY : 100.0f;
        check(&n, &camera, center,
              i % 2 && isfinite(camera.far) ? tangent_radius(&camera, center)
                                            : fabsf(signed_magnitude(-spread, spread)));
    }
    print_message("%d cases: %llu lost, %llu beyond one extra\n", CASE_COUNT,
                  (unsigned long long)n.lost, (unsigned long long)n.extra);
    assert_clean(&n, "random cases");
}

/* The Tutorial's way for one side: focal length written in, no near plane, truncation. It has to
 * lose pixels on the named cases, else the cases prove nothing. */
static int textbook_loses(const tl_camera *camera, const float center[3], float r)
{
    const double lx = (double)center[0], lz = (double)center[2], radius = (double)r;
    const double e = 1.0 / (double)camera->right, l2 = lx * lx + lz * lz;
    const double d = radius * radius * lx * lx - l2 * (radius * radius - lz * lz);
    if (d < 0.0)
        return 0;
    double low = -1.0, high = 1.0;
    for (int side = -1; side <= 1; side += 2) {
        const double nx = (radius * lx + side * sqrt(d)) / l2;
        const double nz = (radius - nx * lx) / lz;
        const double pz = (l2 - radius * radius) / (lz - nz / nx * lx);
        if (pz < 0.0) {
            const double edge = nz * e / nx, px = -pz * nz / nx;
            if (px < lx)
                low = edge > low ? edge : low;
            else
                high = edge < high ? edge : high;
        }
    }
    const int x0 = (int)((low + 1.0) * camera->width / 2),
              x1 = (int)((high + 1.0) * camera->width / 2);
    counts n = {0};
    judge(&n, oracle(camera, center[0], center[2], r), camera->left, camera->right,
          camera->width, (uint32_t)(x0 > 0 ? x0 : 0), (uint32_t)(x1 > 0 ? x1 : 0));
    return n.lost > 0 || n.falsely_empty > 0;
}

static void textbook_form_fails(void **state)
{
    int failures = 0;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(named); i++) {
        const tl_camera camera = camera_of(60, 0, 1920, 1080);
        failures += textbook_loses(&camera, named[i].center, named[i].radius);
    }
    print_message("the textbook's rectangle fails %d of %zu named cases\n", failures,
                  COUNT_OF(named));
    assert_in_range(failures, 3, COUNT_OF(named));
}

static void not_finite_is_the_whole_image(void **state)
{
    const tl_camera camera = camera_of(60, 0, 64, 48);
    const float bad[][4] = {
        {NAN, 0, -1, 1}, {0, INFINITY, -1, 1}, {0, 0, -1, NAN}, {0, 0, -1, -1}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        tl_pixel_rect rect;
        tl_sphere_bounds(&camera, bad[i], bad[i][3], &rect);
        assert_int_equal(rect.x1 * 1000 + rect.y1, 64048);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(named_cases_are_bounded),
        cmocka_unit_test(random_cases_are_bounded),
        cmocka_unit_test(textbook_form_fails),
        cmocka_unit_test(not_finite_is_the_whole_image),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
