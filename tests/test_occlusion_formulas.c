/* Is ambient occlusion 1 where nothing stands around, what the closed forms are where they are known, near
 * what rays find, and right at borders, edges and in what is no surface? */
#include "occlusion_scenes.h"

#include "tilelight/layouts.h"
#include "tilelight/occlusion.h"

enum { SIDE = FRAME_SIDE };

static size_t count_surfaces(const tl_gbuffer *g)
{
    size_t count = 0;
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        count += tl_gbuffer_plane(g, TL_DEPTH)[i] < INFINITY;
    return count;
}

static void assert_open(const tl_gbuffer *g, float radius, float least, const char *name)
{
    surrounded s = surround(g, radius, 0, TL_TWIN_FLOAT);
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++)
            if (!(s.share[(size_t)y * g->pitch + x] >= least))
                fail_msg("%s, radius %g: pixel (%u, %u) gets %.9g", name, (double)radius, x, y,
                         (double)s.share[(size_t)y * g->pitch + x]);
    tl_prepared_clear(&s.prepared);
}

static const float radii[] = {1e-3f, 0.3f, 4.0f, 1e9f};

/* To the last bit, with sky beyond its end, whatever the angle and the projection. */
static void a_plane_is_open(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(plane_slopes); i++)
        for (int turn = 0; turn < 2; turn++)
            for (int parallel = 0; parallel < 2; parallel++) {
                char name[64];
                tl_gbuffer *g = plane_frame(plane_slopes[i], turn, parallel);
                assert_true(count_surfaces(g) > SIDE * SIDE / 3);
                snprintf(name, sizeof name, "slope %g, turn %d, parallel %d", plane_slopes[i],
                         turn, parallel);
                for (size_t r = 0; r < COUNT_OF(radii); r++)
                    assert_open(g, radii[r], 1.0f, name);
                tl_gbuffer_destroy(g);
            }
}

/* Where normals are off by an angle, what a plane loses is half the square of its sine to either side: less
 * than 2^-6 of rgb8's three degrees and a half. Depths are off by what is allowed for, and bring nothing. */
static void a_packed_plane_is_open(void **state)
{
    static const struct {
        enum tl_layout_name layout;
        float least;
    } packed[] = {{TL_LAYOUT_COMPACT_16, 1.0f - 0x1p-20f}, {TL_LAYOUT_MERLIN, 1.0f - 0x1p-6f}};
    const double slope = 1.1;
    const shape plane = {SHAPE_PLANE, {0.0, 0.0, -5.0}, {sin(slope), 0.0, cos(slope)}};
    const tl_camera camera = camera_at(0.0, 0.0, 0.0, 0.0, 0.0, -1.0);
    tl_gbuffer *g = cast_frame(&camera, (shapes){&plane, 1}, 0);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(packed); i++) {
        tl_gbuffer *p = NULL;
        tl_error err;
        ASSERT_OK(tl_gbuffer_pack(g, packed[i].layout, &p, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_repair(p, "packed", false, NULL, &err), err);
        assert_open(p, 1.0f, packed[i].least, tl_layout_word(packed[i].layout));
        tl_gbuffer_destroy(p);
    }
    tl_gbuffer_destroy(g);
}

/* A wall of height H, long, at distance d: half of what is below its upper edge is gone,
 * (1 + d/sqrt(d^2 + H^2))/2 is left. */
static void a_corner_has_its_closed_form(void **state)
{
    static const double height = 0.5;
    const shape of[] = {{SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                        {SHAPE_BOX, {1.0, height - 2.0, 0.0}, {1.0, 2.0, 50.0}}};
    const tl_camera camera = camera_at(-4.0, 4.0, 0.0, -0.3, 0.0, 0.0);
    tl_gbuffer *g = cast_frame(&camera, (shapes){of, 2}, 0);
    static const struct {
        uint32_t samples;
        double most, mean;
    } rows[] = {{256, 0.02, 0.006}, {TL_DEFAULT_OCCLUSION_SAMPLES, 0.04, 0.025}};
    (void)state;
    for (size_t r = 0; r < COUNT_OF(rows); r++) {
        surrounded s = surround(g, 5.0f, rows[r].samples, TL_TWIN_FLOAT);
        double most = 0.0, sum = 0.0;
        size_t count = 0;
        for (uint32_t y = SIDE / 4; y < 3 * SIDE / 4; y++)
            for (uint32_t x = SIDE / 4; x < 3 * SIDE / 4; x++) {
                double origin[3], way[3], normal[3];
                pixel_ray(&camera, x, y, origin, way);
                const double t = nearest_hit((shapes){of, 2}, origin, way, normal);
                const double d = -(origin[0] + t * way[0]);
                if (normal[1] < 0.5 || d < 0.1 || d > 0.8)
                    continue;
                const double want = 0.5 + 0.5 * d / hypot(d, height);
                const double off = fabs((double)s.share[(size_t)y * g->pitch + x] - want);
                most = fmax(most, off);
                sum += off;
                count++;
            }
        assert_true(count > 500);
        print_message("corner, %u samples: off by %.4f at most, %.4f on average\n",
                      rows[r].samples, most, sum / (double)count);
        assert_true(most < rows[r].most);
        assert_true(sum / (double)count < rows[r].mean);
        tl_prepared_clear(&s.prepared);
    }
    tl_gbuffer_destroy(g);
}

/* What is lost of a slice, as the integral that it stands for. */
static void horizons_are_their_integral(void **state)
{
    enum { STEPS = 4000 };
    (void)state;
    for (double g = -1.5; g <= 1.5; g += 0.25)
        for (double b = 0.0; b <= 0.5 * acos(-1.0) + g; b += 0.1) {
            const double from = 0.5 * acos(-1.0) - b, width = b / STEPS;
            double want = 0.0;
            for (int i = 0; i < STEPS; i++) {
                const double a = from + (i + 0.5) * width;
                want += cos(a) * fabs(sin(a + g)) * width;
            }
            const double got =
                0.5 * (double)lost_on_side((float)(1.0 - cos(b)), (float)cos(g), (float)sin(g));
            if (!(fabs(got - want) < 4e-6))
                fail_msg("angle %g, horizon %g: %.8f, want %.8f", g, b, got, want);
        }
}

/* A ball and a box on a floor. What this method takes for solid behind what is seen makes it darker than
 * rays find, what its looks miss lighter; both are printed, and how near the two are is held. */
static void rays_find_much_the_same(void **state)
{
    enum { EVERY = 3 };
    const shape of[] = {{SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                        {SHAPE_SPHERE, {-0.6, 0.5, 0.0}, {0.5, 0.0, 0.0}},
                        {SHAPE_BOX, {0.7, 0.4, 0.2}, {0.4, 0.4, 0.4}}};
    const shapes in = {of, COUNT_OF(of)};
    const tl_camera camera = camera_at(0.4, 2.0, 3.5, 0.0, 0.3, 0.0);
    tl_gbuffer *g = cast_frame(&camera, in, 0);
    surrounded s = surround(g, 1.0f, 0, TL_TWIN_FLOAT);
    double sum = 0.0, bias = 0.0;
    size_t count = 0;
    (void)state;
    for (uint32_t y = 8; y < SIDE - 8; y += EVERY)
        for (uint32_t x = 8; x < SIDE - 8; x += EVERY) {
            double origin[3], way[3], normal[3], at[3];
            pixel_ray(&camera, x, y, origin, way);
            const double t = nearest_hit(in, origin, way, normal);
            if (isinf(t))
                continue;
            for (int i = 0; i < 3; i++)
                at[i] = origin[i] + t * way[i];
            const double off =
                (double)s.share[(size_t)y * g->pitch + x] - cast_share(in, at, normal, 1.0);
            sum += fabs(off);
            bias += off;
            count++;
        }
    print_message("against rays: off by %.4f on average, of which %+.4f one way\n",
                  sum / (double)count, bias / (double)count);
    assert_true(count > 1000);
    assert_true(sum / (double)count < 0.03);
    tl_prepared_clear(&s.prepared);
    tl_gbuffer_destroy(g);
}

/* m that a pixel spans at this depth. */
static float pixel_at_depth(const tl_camera *camera, float depth)
{
    return (camera->right - camera->left) / (float)camera->width * depth;
}

/* Below a pixel a radius finds nothing; it begins to without a step. */
static void a_small_radius_fades(void **state)
{
    const shape of[] = {{SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                        {SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
    const tl_camera camera = camera_at(0.0, 2.0, 2.0, 0.0, 0.0, 0.0);
    tl_gbuffer *g = cast_frame(&camera, (shapes){of, 2}, 0);
    const float step = pixel_at_depth(&camera, 2.83f);
    double before = 1.0, greatest = 0.0;
    (void)state;
    assert_open(g, 0.7f * step, 1.0f, "less than a pixel");
    for (int i = 0; i < 40; i++) {
        surrounded s = surround(g, step * (0.8f + 0.04f * (float)i), 0, TL_TWIN_FLOAT);
        const double share = (double)s.share[(size_t)(SIDE / 2) * g->pitch + SIDE / 2];
        greatest = fmax(greatest, fabs(share - before));
        before = share;
        tl_prepared_clear(&s.prepared);
    }
    print_message("the corner's middle, by steps of 1/25 pixel: %.4f at most, down to %.3f\n",
                  greatest, before);
    assert_true(before < 0.95);
    assert_true(greatest < 0.05);
    tl_gbuffer_destroy(g);
}

/* The edge of something near takes nothing from what is dark behind it, and gives it nothing. */
static void edges_do_not_bleed(void **state)
{
    const shape of[] = {{SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                        {SHAPE_PLANE, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                        {SHAPE_BOX, {0.02, 4.0, 4.0}, {0.25, 0.7, 0.01}}};
    const tl_camera camera = camera_at(0.0, 6.0, 6.0, 0.0, 0.0, 0.0);
    tl_gbuffer *with = cast_frame(&camera, (shapes){of, 3}, 0);
    tl_gbuffer *without = cast_frame(&camera, (shapes){of, 2}, 0);
    surrounded s = surround(with, 0.5f, 0, TL_TWIN_FLOAT);
    surrounded plain = surround(without, 0.5f, 0, TL_TWIN_FLOAT);
    const float *depth = tl_gbuffer_plane(with, TL_DEPTH);
    size_t front = 0, dark = 0;
    (void)state;
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            const size_t at = (size_t)y * with->pitch + x;
            if (depth[at] < 5.0f) {
                front++;
                dark += plain.share[at] < 0.8f;
                if (!same_bits(s.share[at], 1.0f))
                    fail_msg("before the edge (%u, %u): %.9g", x, y, (double)s.share[at]);
            } else if (fabsf(s.share[at] - plain.share[at]) > 0.12f) {
                fail_msg("behind the edge (%u, %u): %g, without it %g", x, y,
                         (double)s.share[at], (double)plain.share[at]);
            }
        }
    assert_true(front > 100);
    assert_true(dark > 10);
    tl_prepared_clear(&plain.prepared);
    tl_prepared_clear(&s.prepared);
    tl_gbuffer_destroy(without);
    tl_gbuffer_destroy(with);
}

/* Wires of one pixel, depths at random, normals of no length, turned away and along the ray. */
static void anything_is_a_share(void **state)
{
    tl_camera camera = camera_of(70, 41, TL_PERSPECTIVE);
    uint32_t seed = 77;
    (void)state;
    for (int parallel = 0; parallel < 2; parallel++) {
        camera.projection = parallel ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
        tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 5);
        for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++) {
            const float way = uniform(&seed, 0.0f, 1.0f);
            if (tl_gbuffer_plane(g, TL_DEPTH)[i] < INFINITY) {
                set_pixel(g, TL_DEPTH, i,
                          way < 0.1f   ? 1e-20f
                          : way < 0.2f ? 1e20f
                                       : 4.0f + way);
                for (int axis = 0; axis < 3 && way > 0.5f; axis++)
                    set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), i,
                              way < 0.6f ? 0.0f : uniform(&seed, -1.0f, 1.0f));
            }
        }
        for (size_t r = 0; r < COUNT_OF(radii); r++) {
            surrounded s = surround(g, radii[r], 0, TL_TWIN_FLOAT);
            for (uint32_t y = 0; y < camera.height; y++)
                for (uint32_t x = 0; x < camera.width; x++) {
                    const float share = s.share[(size_t)y * g->pitch + x];
                    assert_true(share >= 0.0f && share <= 1.0f);
                }
            tl_prepared_clear(&s.prepared);
        }
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(horizons_are_their_integral),
        cmocka_unit_test(a_plane_is_open),
        cmocka_unit_test(a_packed_plane_is_open),
        cmocka_unit_test(a_corner_has_its_closed_form),
        cmocka_unit_test(rays_find_much_the_same),
        cmocka_unit_test(a_small_radius_fades),
        cmocka_unit_test(edges_do_not_bleed),
        cmocka_unit_test(anything_is_a_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
