/* Is a capture of the ISPC project's deferred example lit by the model that its README states?
 *
 * The oracle is the README's formulas in long double, on the bytes of the file. */
#include "frames.h"
#include "ispc_captures.h"

#include "capture_read.h"

typedef long double wide;

enum { WIDTH = 48, HEIGHT = 32 };

static wide dot(const wide a[3], const wide b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(wide v[3])
{
    const wide length = sqrtl(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* Lit radiance of a pixel, and in *most what it would be under lights that face it in full, at their
 * peaks: what the errors of a sum are a share of. */
static void light(const ispc_capture *c, int x, int y, wide lit[3], wide most[3])
{
    const ispc_pixel *p = &c->pixels[y * c->width + x];
    const wide vz = (wide)c->proj[3][2] / ((wide)p->z - (wide)c->proj[2][2]);
    const wide sx = 2 * (x + 0.5L) / c->width - 1, sy = -(2 * (y + 0.5L) / c->height - 1);
    const wide at[3] = {sx * vz / (wide)c->proj[0][0], sy * vz / (wide)c->proj[1][1], vz};
    const wide ex = half_value(p->normal[0]), ey = half_value(p->normal[1]);
    const wide f = (ex - ex * ex) + (ey - ey * ey), m = sqrtl(4 * f - 1);
    const wide normal[3] = {m * (4 * ex - 2), m * (4 * ey - 2), 3 - 8 * f};
    const wide power = half_value(p->power), amount = half_value(p->amount);
    wide away[3] = {at[0], at[1], at[2]};
    make_unit(away);
    for (int k = 0; k < 3; k++)
        lit[k] = most[k] = 0;
    for (int i = 0; i < c->light_count; i++) {
        const ispc_light *of = &c->lights[i];
        wide l[3], h[3];
        for (int k = 0; k < 3; k++)
            l[k] = (wide)of->position[k] - at[k];
        const wide d = sqrtl(dot(l, l));
        make_unit(l);
        const wide n_dot_l = dot(normal, l);
        if (d >= (wide)of->end)
            continue;
        for (int k = 0; k < 3; k++)
            h[k] = l[k] - away[k];
        make_unit(h);
        const wide fall = ((wide)of->end - d) / ((wide)of->end - (wide)of->begin);
        const wide att = fall < 1 ? fall : 1;
        const wide n_dot_h = fmaxl(dot(normal, h), 0), peak = amount * (power + 2) / 8;
        for (int k = 0; k < 3; k++) {
            const wide arriving = p->albedo[k] / 255.0L * (wide)of->color[k];
            if (n_dot_l > 0)
                lit[k] += arriving * att * n_dot_l * (1 + peak * powl(n_dot_h, power));
            most[k] += arriving * (1 + peak);
        }
    }
}

/* What the frame hands over is rounded to float: a light is displaced by some 8u of the distances
 * involved, 20 m, so d by 1e-5 m of a falloff that may take 0.1 m, and a direction to a light 0.1 m away by
 * 1e-4, which a power of 200 makes 14 times as much of. All of it is far below. */
static const wide share = 1e-4L;

static void assert_lit(tl_precision precision, int reversed)
{
    static unsigned char bytes[ISPC_MOST];
    const ispc_capture c = ispc_example(WIDTH, HEIGHT, reversed);
    const tl_lighting_options options = {.precision = precision, .tile_size = 16};
    char path[512];
    const tl_capture_request request = {
        .path = scratch_path(path, sizeof path, "capture-to-light.bin")};
    tl_captured read = {0};
    tl_error err;
    wide brightest = 0;
    save_bytes(path, bytes, ispc_bytes(&c, bytes));
    ASSERT_OK(tl_capture_read(&request, &read, &err), err);
    remove(path);
    ASSERT_OK(tl_gbuffer_repair(read.gbuffer, path, true, NULL, &err), err);
    tl_image *got = image_like(read.gbuffer);
    light_frame(NULL, &options, read.gbuffer, &read.lights, got);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        wide lit[3], most[3];
        light(&c, x, y, lit, most);
        for (unsigned k = 0; k < 3; k++) {
            const wide v = (wide)tl_image_plane(got, k)[(size_t)y * got->pitch + (size_t)x];
            brightest = fmaxl(brightest, v);
            if (!(fabsl(v - lit[k]) <= share * most[k] + 1e-12L))
                fail_msg("pixel (%d, %d), channel %u: got %.9Lg, want %.9Lg", x, y, k, v,
                         lit[k]);
        }
    }
    assert_true(brightest > 0.5L);
    tl_image_destroy(got);
    tl_captured_clear(&read);
}

static void by_the_reference(void **state)
{
    (void)state;
    assert_lit(TL_PRECISION_REFERENCE, 0);
    assert_lit(TL_PRECISION_REFERENCE, 1);
}

/* The twin's bits are the kernels' bits: tests/test_same_bits.c. */
static void in_float(void **state)
{
    (void)state;
    assert_lit(TL_PRECISION_TWIN, 0);
    assert_lit(TL_PRECISION_TWIN, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_the_reference),
                                       cmocka_unit_test(in_float)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
