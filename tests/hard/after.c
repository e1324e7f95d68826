/* What is done to a lit picture: cases 31 to 34. */
#include "hard_case.h"

#include "post_frames.h"

enum { WIDTH = 96, HEIGHT = 64 };

static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};

/* Run through by the twin; on the device every pixel has to have the same bits. The caller destroys it. */
static tl_image *run_through(hard_bench *bench,
                             const tl_gbuffer *g,
                             const tl_post_options *options,
                             const tl_image *from)
{
    tl_image *want = post_image(NULL, &twin, options, g, from, 0, NULL);
    tl_image *got = post_image(bench->device, &post_ways[0], options, g, from, 0, NULL);
    bench->result.pixels += WIDTH * HEIGHT;
    bench->result.lost += hard_different_pixels(got, want);
    tl_image_destroy(got);
    return want;
}

static int is_changed(const tl_image *a, const tl_image *b, int64_t x, int64_t y)
{
    for (unsigned c = 0; c < 3; c++)
        if (!same_bits(color_at(a, c, x, y), color_at(b, c, x, y)))
            return 1;
    return 0;
}

/* Two normals in blots of a few pixels, or one with a step; depth of a floor that is seen aslant. */
static tl_gbuffer *floor_of(int has_blots)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = NULL;
    tl_error err;
    uint32_t seed = 31;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            const int is_blot = has_blots && uniform(&seed, 0.0f, 1.0f) < 0.02f;
            const double down = (y + 0.5) / HEIGHT;
            set_pixel(g, TL_DEPTH, at, (float)(2.0 / (0.05 + down)));
            set_pixel(g, is_blot ? TL_NORMAL_X : TL_NORMAL_Y, at, 1.0f);
        }
    ASSERT_OK(tl_gbuffer_repair(g, "floor", false, NULL, &err), err);
    return g;
}

static int is_blot(const tl_gbuffer *g, int64_t x, int64_t y)
{
    const int is_there = x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT;
    return is_there &&
           tl_gbuffer_plane(g, TL_NORMAL_X)[(size_t)y * g->pitch + (size_t)x] > 0.5f;
}

/* The first four of eight offsets, of which one is there twice and its opposite across the corner is not. */
static int is_edge_by_listing(const tl_gbuffer *g, int64_t x, int64_t y)
{
    static const int offsets[8][2] = {{-1, 1}, {1, -1}, {-1, 1}, {1, 1},
                                      {-1, 0}, {1, 0},  {0, -1}, {0, 1}};
    double factor = 0.0;
    for (int i = 0; i < 4; i++)
        if (is_blot(g, x + offsets[i][0], y + offsets[i][1]) != is_blot(g, x, y))
            factor += 2.0; /* of normals at right angles */
    return factor > 0.0;
}

static int is_beside_edge(const tl_gbuffer *g, int64_t x, int64_t y)
{
    for (int64_t j = y - 1; j <= y + 1; j++)
        for (int64_t i = x - 1; i <= x + 1; i++)
            if (is_blot(g, i, j) != is_blot(g, x, y))
                return 1;
    return 0;
}

void hard_edge_neighbours(hard_bench *bench)
{
    const tl_post_options options = {.edges = {.normals = 1}};
    tl_gbuffer *g = floor_of(1);
    tl_image *from = random_picture(WIDTH, HEIGHT, 31),
             *got = run_through(bench, g, &options, from);
    for (int64_t y = 1; y < HEIGHT - 1; y++)
        for (int64_t x = 1; x < WIDTH - 1; x++)
            if (is_beside_edge(g, x, y))
                hard_count(bench, is_changed(got, from, x, y), is_edge_by_listing(g, x, y));
    tl_image_destroy(got);
    tl_image_destroy(from);
    tl_gbuffer_destroy(g);
}

/* Equation 7 of depths, as shares of the pixel's own: against what a straight step of the default threshold
 * comes to. */
static int is_edge_by_differences(const tl_gbuffer *g, int64_t x, int64_t y)
{
    const float *depth = tl_gbuffer_plane(g, TL_DEPTH);
    const double own = (double)depth[(size_t)y * g->pitch + (size_t)x];
    const double step = (double)TL_DEFAULT_EDGE_STEP;
    double sum = 0.0;
    for (int64_t j = y - 1; j <= y + 1; j++)
        for (int64_t i = x - 1; i <= x + 1; i++) {
            const double d = (double)depth[(size_t)j * g->pitch + (size_t)i] / own - 1.0;
            sum += d * d;
        }
    return sum > 3.0 * step * step;
}

void hard_edge_plane(hard_bench *bench)
{
    const tl_post_options options = {.edges = {.normals = 1, .depth = 1}};
    tl_gbuffer *g = floor_of(0);
    tl_image *from = random_picture(WIDTH, HEIGHT, 32),
             *got = run_through(bench, g, &options, from);
    for (int64_t y = 1; y < HEIGHT - 1; y++)
        for (int64_t x = 1; x < WIDTH - 1; x++)
            hard_count(bench, !is_changed(got, from, x, y), !is_edge_by_differences(g, x, y));
    tl_image_destroy(got);
    tl_image_destroy(from);
    tl_gbuffer_destroy(g);
}

/* One light of one colour on black. */
static tl_image *colored_light(const float color[3])
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(WIDTH, HEIGHT, &image, &err), err);
    for (uint32_t i = 0; i < 16; i++)
        fill_color(image, 44 + i % 4, 28 + i / 4, color);
    return image;
}

/* Whether b has the hue of a: products of each with the other's numbers differ by roundings alone. */
static int has_hue(const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(a[i] * b[(i + 1) % 3] - a[(i + 1) % 3] * b[i]) <=
              1e-5 * fabs(a[i] * b[(i + 1) % 3])))
            return 0;
    return 1;
}

/* A seventh of the sum of seven t.t across, of what that gives down: one number for all three. */
static double grey_glow(const tl_image *from, int64_t x, int64_t y)
{
    double down = 0.0;
    for (int64_t j = y - 3; j <= y + 3; j++) {
        double across = 0.0;
        for (int64_t i = x - 3; i <= x + 3; i++)
            for (unsigned c = 0; c < 3 && i >= 0 && i < WIDTH && j >= 0 && j < HEIGHT; c++)
                across +=
                    (double)color_at(from, c, i, j) * (double)color_at(from, c, i, j) / 7.0;
        down += 3.0 * across * across / 7.0;
    }
    return down;
}

void hard_grey_bloom(hard_bench *bench)
{
    static const float color[3] = {8.0f, 2.0f, 0.5f};
    static const double hue[3] = {8.0, 2.0, 0.5};
    const tl_post_options options = {.bloom = {0.5f, 1.0f, 0.5f, 3.0f, 4}};
    tl_gbuffer *g = floor_of(0);
    tl_image *from = colored_light(color), *got = run_through(bench, g, &options, from);
    for (int64_t y = 0; y < HEIGHT; y++)
        for (int64_t x = 0; x < WIDTH; x++) {
            const double grey = grey_glow(from, x, y), usual[3] = {grey, grey, grey};
            const double added[3] = {(double)color_at(got, 0, x, y),
                                     (double)color_at(got, 1, x, y),
                                     (double)color_at(got, 2, x, y)};
            if (added[0] > 1e-30)
                hard_count(bench, has_hue(hue, added), !(grey > 0.0) || has_hue(hue, usual));
        }
    tl_image_destroy(got);
    tl_image_destroy(from);
    tl_gbuffer_destroy(g);
}

/* Whether seven taps across and seven down would reach a pixel that is no number. */
static int is_spoiled(const tl_image *from, int64_t x, int64_t y)
{
    for (int64_t j = y - 3; j <= y + 3; j++)
        for (int64_t i = x - 3; i <= x + 3; i++)
            if (i >= 0 && i < WIDTH && j >= 0 && j < HEIGHT &&
                !isfinite(color_at(from, 0, i, j)))
                return 1;
    return 0;
}

void hard_nan_bloom(hard_bench *bench)
{
    static const float no_colors[][3] = {
        {NAN, 1.0f, 1.0f}, {INFINITY, 1.0f, 1.0f}, {-INFINITY, 0.0f, 0.0f}, {NAN, NAN, NAN}};
    const tl_post_options options = {
        .mend = 1, .edges = {.normals = 1, .depth = 1}, .bloom = {0.5f, 1.0f, 0.5f, 6.0f, 4}};
    tl_gbuffer *g = floor_of(1);
    tl_image *from = random_picture(WIDTH, HEIGHT, 34);
    for (uint32_t i = 0; i < COUNT_OF(no_colors); i++)
        fill_color(from, 10 + 22 * i, 8 + 14 * i, no_colors[i]);
    tl_image *got = run_through(bench, g, &options, from);
    for (int64_t y = 0; y < HEIGHT; y++)
        for (int64_t x = 0; x < WIDTH; x++)
            hard_count(bench,
                       isfinite(color_at(got, 0, x, y)) && isfinite(color_at(got, 1, x, y)) &&
                           isfinite(color_at(got, 2, x, y)),
                       !is_spoiled(from, x, y));
    tl_image_destroy(got);
    tl_image_destroy(from);
    tl_gbuffer_destroy(g);
}
