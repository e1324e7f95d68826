/* Are edges of surfaces found in normals and in depth, in every layout and projection, and planes left as
 * they are, bit for bit, however aslant? Is what becomes of an edge the mean of ten lookups of equation 7's
 * factor, with the same bits by every path and width, in bands, and by the twin, and float within what is
 * derived?
 *
 * The oracle looks up bilinearly, in double, by the definition. */
#define _GNU_SOURCE
#include "packed_frames.h"
#include "post_frames.h"

enum { WIDTH = 83, HEIGHT = 41 };
static const double unit = 0x1p-24;
static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};
static const post_way reference = {"reference", TL_PRECISION_REFERENCE, TL_PATH_AUTO, 0, 0, 0};

static tl_post_options edges_of(int normals, int depth, float angle, float step)
{
    return (tl_post_options){
        .edges = {.normals = normals, .depth = depth, .angle = angle, .step = step}};
}

/* A plane, in view space, 5 m and under parallel rays 20 m away in the middle. step: what is added to the
 * depth of the right half, as a share. */
static tl_gbuffer *tilted(tl_projection projection, double right, double down, double step)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, projection);
    const double view[3] = {-right, -down, 1.0};
    const double length = sqrt(right * right + down * down + 1.0);
    double unit_view[3], world[3];
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    for (int i = 0; i < 3; i++)
        unit_view[i] = view[i] / length;
    tl_camera_world_direction(&camera, unit_view, world);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            const double sx = (double)camera.left +
                              ((double)camera.right - (double)camera.left) * (x + 0.5) / WIDTH;
            const double sy = (double)camera.top +
                              ((double)camera.bottom - (double)camera.top) * (y + 0.5) / HEIGHT;
            const double rise = right * sx + down * sy;
            const double depth =
                projection == TL_PERSPECTIVE ? 5.0 / (1.0 + rise) : 20.0 - rise;
            set_pixel(g, TL_DEPTH, at, (float)(depth * (x >= WIDTH / 2 ? 1.0 + step : 1.0)));
            for (int axis = 0; axis < 3; axis++)
                set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), at, (float)world[axis]);
        }
    ASSERT_OK(tl_gbuffer_repair(g, "tilted", false, NULL, &err), err);
    return g;
}

static uint32_t changed_pixels(const tl_image *a, const tl_image *b)
{
    uint32_t count = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            count += !same_bits(color_at(a, 0, x, y), color_at(b, 0, x, y)) ||
                     !same_bits(color_at(a, 1, x, y), color_at(b, 1, x, y)) ||
                     !same_bits(color_at(a, 2, x, y), color_at(b, 2, x, y));
    return count;
}

/* How many pixels of a random picture the twin changes. */
static uint32_t smoothed_count(const tl_gbuffer *g, const tl_post_options *options)
{
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    tl_image *got = post_image(NULL, &twin, options, g, from, 0, NULL);
    const uint32_t count = changed_pixels(got, from);
    tl_image_destroy(got);
    tl_image_destroy(from);
    return count;
}

static const struct {
    double right, down;
} tilts[] = {{0.0, 0.0}, {0.6, 0.0}, {0.0, -1.2}, {0.4, 0.5}, {-0.3, 0.7}};

/* By depth even a threshold a millionth of it: the second difference is what rounding of the layout may make,
 * which is taken away. */
static void planes_stay_in_every_layout(void **state)
{
    const tl_post_options by_depth = edges_of(0, 1, 0.0f, 1e-6f),
                          by_both = edges_of(1, 1, 0.0f, 0.0f);
    uint32_t tried = 0;
    (void)state;
    for (int projection = 0; projection < 2; projection++)
        for (size_t i = 0; i < COUNT_OF(tilts); i++) {
            tl_gbuffer *from =
                tilted((tl_projection)projection, tilts[i].right, tilts[i].down, 0.0);
            for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++) {
                tl_gbuffer *g = NULL;
                if (tl_gbuffer_pack(from, (enum tl_layout_name)layout, &g, NULL, NULL) != TL_OK)
                    continue;
                const uint32_t moved = smoothed_count(g, &by_depth);
                if (moved != 0 || smoothed_count(g, &by_both) != 0)
                    fail_msg("projection %d, tilt %zu, layout %d: %u pixels are smoothed",
                             projection, i, layout, moved);
                tl_gbuffer_destroy(g);
                tried++;
            }
            tl_gbuffer_destroy(from);
        }
    print_message("%u planes\n", tried);
    assert_true(tried > 100);
}

/* Two columns beside a step of half as much again: where world positions are halves, a plane may have steps
 * of 0.15 near the eye. */
static void steps_are_found_in_every_layout(void **state)
{
    const tl_post_options by_depth = edges_of(0, 1, 0.0f, 0.0f);
    (void)state;
    for (int projection = 0; projection < 2; projection++) {
        tl_gbuffer *from = tilted((tl_projection)projection, 0.1, 0.2, 0.5);
        for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++) {
            tl_gbuffer *g = NULL;
            if (tl_gbuffer_pack(from, (enum tl_layout_name)layout, &g, NULL, NULL) != TL_OK)
                continue;
            const uint32_t moved = smoothed_count(g, &by_depth);
            if (moved != 2 * HEIGHT)
                fail_msg("projection %d, layout %d: %u pixels are smoothed, not %d", projection,
                         layout, moved, 2 * HEIGHT);
            tl_gbuffer_destroy(g);
        }
        tl_gbuffer_destroy(from);
    }
}

/* A crease of `angle` through flat depth, and a horizon. */
static void normals_and_sky_make_edges(void **state)
{
    const float angle = 0.5f;
    const tl_post_options by_normals = edges_of(1, 0, angle, 0.0f),
                          by_depth = edges_of(0, 1, 0.0f, 0.0f);
    static const double turns[] = {0.49, 0.51, 1.2};
    static const uint32_t want[] = {0, 2 * HEIGHT, 2 * HEIGHT};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(turns); i++) {
        tl_gbuffer *g = tilted(TL_PERSPECTIVE, 0.0, 0.0, 0.0);
        const double view[3] = {sin(turns[i]), 0.0, cos(turns[i])};
        double world[3];
        tl_camera_world_direction(&g->camera, view, world);
        for (uint32_t at = 0; at < g->pitch * HEIGHT; at++)
            for (int axis = 0; axis < 3 && at % g->pitch >= WIDTH / 2; axis++)
                set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), at, (float)world[axis]);
        assert_int_equal(smoothed_count(g, &by_normals), want[i]);
        assert_int_equal(smoothed_count(g, &by_depth), 0);
        tl_gbuffer_destroy(g);
    }
    for (int projection = 0; projection < 2; projection++) {
        tl_error err;
        tl_gbuffer *g = tilted((tl_projection)projection, 0.3, 0.1, 0.0);
        for (uint32_t at = 0; at < g->pitch * (HEIGHT / 2); at++) {
            set_pixel(g, TL_DEPTH, at, INFINITY);
            for (int axis = 0; axis < 3; axis++)
                set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), at, 0.0f);
        }
        ASSERT_OK(tl_gbuffer_repair(g, "horizon", false, NULL, &err), err);
        assert_int_equal(smoothed_count(g, &by_normals), 2 * WIDTH);
        assert_int_equal(smoothed_count(g, &by_depth), 2 * WIDTH);
        tl_gbuffer_destroy(g);
    }
}

static int64_t clamped(int64_t v, int64_t count)
{
    return v < 0 ? 0 : v >= count ? count - 1 : v;
}

static double place_of(const tl_gbuffer *g, int64_t x, int64_t y)
{
    const size_t at = (size_t)clamped(y, HEIGHT) * g->pitch + (size_t)clamped(x, WIDTH);
    return (double)(float)(1.0 / (double)tl_gbuffer_plane(g, TL_DEPTH)[at]);
}

static double turned2(const tl_gbuffer *g, int64_t x, int64_t y, int64_t i, int64_t j)
{
    const size_t a = (size_t)y * g->pitch + (size_t)x,
                 b = (size_t)clamped(j, HEIGHT) * g->pitch + (size_t)clamped(i, WIDTH);
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const float *n = tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + axis));
        sum += ((double)n[a] - (double)n[b]) * ((double)n[a] - (double)n[b]);
    }
    return sum;
}

static double stepped2(const tl_gbuffer *g, int64_t x, int64_t y, int64_t right, int64_t down)
{
    if ((right && (x == 0 || x == WIDTH - 1)) || (down && (y == 0 || y == HEIGHT - 1)))
        return 0.0;
    const double own = place_of(g, x, y), one = place_of(g, x + right, y + down),
                 other = place_of(g, x - right, y - down);
    if (own == 0.0 || one == 0.0 || other == 0.0)
        return own == 0.0 && one == 0.0 && other == 0.0 ? 0.0 : 1.0;
    const double share = fabs(one + other - 2.0 * own) / own;
    return fmin(share, 1.0) * fmin(share, 1.0);
}

static double factor_of(const tl_gbuffer *g, int64_t x, int64_t y, const tl_edge_options *o)
{
    const double chord = 2.0 * sin(0.5 * (double)o->angle), step = (double)o->step;
    double normals = 0.0, depths = 0.0;
    for (int64_t down = -1; down <= 1; down++)
        for (int64_t right = -1; right <= 1; right++) {
            normals += turned2(g, x, y, x + right, y + down);
            depths += right || down ? stepped2(g, x, y, right, down) : 0.0;
        }
    const double sum = (o->normals ? normals / (3.0 * chord * chord) : 0.0) +
                       (o->depth ? depths / (6.0 * step * step) : 0.0);
    return fmin(fmax(sum - 1.0, 0.0), 1.0);
}

static double looked_up(const tl_image *from, unsigned channel, double x, double y)
{
    const double left = floor(x), top = floor(y), fx = x - left, fy = y - top;
    double v[2][2];
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++)
            v[j][i] = (double)color_at(from, channel, clamped((int64_t)left + i, WIDTH),
                                       clamped((int64_t)top + j, HEIGHT));
    return (1.0 - fy) * ((1.0 - fx) * v[0][0] + fx * v[0][1]) +
           fy * ((1.0 - fx) * v[1][0] + fx * v[1][1]);
}

static double mean_of_ten(
    const tl_image *from, unsigned channel, int64_t x, int64_t y, double factor)
{
    double sum = (double)color_at(from, channel, x, y); /* with the one below, twice */
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++)
            sum +=
                looked_up(from, channel, (double)x + factor * right, (double)y + factor * down);
    return sum / 10.0;
}

/* How far a factor may be off. Normals: each of 24 differences, 2 at most, by 4 units of the turned normal's
 * and one more, twice in its square, and 30 roundings of the sum. Places: each share, below sqrt(2 step^2 6)
 * where the factor is not yet 1, by 8 units of places and differences, what is taken for rounding of places,
 * 80 units, and as many roundings. */
static double factor_error(const tl_edge_options *o)
{
    const double chord = 2.0 * sin(0.5 * (double)o->angle), step = (double)o->step;
    const double normals = 24.0 * 2.0 * 2.0 * 5.0 * unit / (3.0 * chord * chord) + 60.0 * unit;
    const double depths =
        16.0 * sqrt(12.0) * step * 200.0 * unit / (6.0 * step * step) + 60.0 * unit;
    return (o->normals ? normals : 0.0) + (o->depth ? depths : 0.0);
}

static void edges_become_what_is_defined(void **state)
{
    static const int which[][2] = {{1, 0}, {0, 1}, {1, 1}};
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 3);
    uint32_t between = 0;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(which); i++) {
        const tl_post_options options = edges_of(which[i][0], which[i][1], 1.0f, 0.4f);
        tl_image *in_float = post_image(NULL, &twin, &options, g, from, 0, NULL),
                 *in_double = post_image(NULL, &reference, &options, g, from, 0, NULL);
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const double factor = factor_of(g, x, y, &options.edges);
                between += factor > 0.0 && factor < 1.0;
                for (unsigned c = 0; c < 3; c++) {
                    const double want = mean_of_ten(from, c, x, y, factor);
                    /* weights change by 2 at most with the factor; 20 roundings of colours up to 40 */
                    const double allowed =
                        40.0 * (2.0 * factor_error(&options.edges) + 20.0 * unit);
                    const double off = fabs((double)color_at(in_float, c, x, y) - want),
                                 other = fabs((double)color_at(in_double, c, x, y) - want);
                    if (!(off <= allowed && other <= allowed))
                        fail_msg("(%u, %u) channel %u, %d %d: %.9g and %.9g, not %.9g", x, y, c,
                                 which[i][0], which[i][1], (double)color_at(in_float, c, x, y),
                                 (double)color_at(in_double, c, x, y), want);
                }
            }
        tl_image_destroy(in_float);
        tl_image_destroy(in_double);
    }
    assert_true(between > 1000);
    tl_gbuffer_destroy(g);
    tl_image_destroy(from);
}

static void same_bits_of(tl_device *device,
                         const tl_gbuffer *g,
                         const tl_post_options *options,
                         size_t ways)
{
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    tl_image *want = post_image(NULL, &twin, options, g, from, 0, NULL);
    const uint64_t row = (24 + 16 + tl_gbuffer_pixel_size(g)) * from->pitch;
    assert_true(changed_pixels(want, from) > 1000);
    for (size_t i = 0; i < ways; i++) {
        tl_post_counts counts;
        tl_image *got =
            post_image(device, &post_ways[i], options, g, from, (2 + 16 + 10) * row, &counts);
        assert_same_pixels(got, want, post_ways[i].name);
        assert_int_equal(counts.band_count, post_ways[i].memory ? 6 : 1);
        tl_image_destroy(got);
    }
    tl_image_destroy(want);
    tl_image_destroy(from);
}

static void every_way_has_the_same_bits(void **state)
{
    const tl_post_options options = edges_of(1, 1, 1.0f, 0.4f),
                          depth = edges_of(0, 1, 0.0f, 0.3f);
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE),
                    parallel = camera_of(WIDTH, HEIGHT, TL_ORTHOGRAPHIC);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 3);
    same_bits_of(*state, g, &options, COUNT_OF(post_ways));
    same_bits_of(*state, g, &depth, 3);
    tl_gbuffer_destroy(g);
    g = packed_gbuffer(&parallel, TL_LAYOUT_MERLIN, 3);
    same_bits_of(*state, g, &options, 1);
    tl_gbuffer_destroy(g);
}

static void thresholds_outside_their_ranges_are_refused(void **state)
{
    static const tl_edge_options wrong[] = {
        {1, 0, -1.0f, 0.0f}, {1, 0, 4.0f, 0.0f}, {1, 0, NAN, 0.0f}, {0, 1, 0.0f, 1.5f}};
    tl_lighting_options lighting = tl_lighting_options_default();
    (void)state;
    lighting.precision = TL_PRECISION_TWIN;
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        const tl_post_options options = {.edges = wrong[i]};
        tl_post *post = NULL;
        tl_error err;
        assert_int_equal(tl_post_create(NULL, &lighting, &options, &post, &err),
                         TL_ERR_ARGUMENT);
        assert_non_null(strstr(err.message, i < 3 ? "pi at most" : "1 at most"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_stay_in_every_layout),
        cmocka_unit_test(steps_are_found_in_every_layout),
        cmocka_unit_test(normals_and_sky_make_edges),
        cmocka_unit_test(edges_become_what_is_defined),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(thresholds_outside_their_ranges_are_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
