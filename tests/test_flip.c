/* Is FLIP what its papers define?
 *
 * The oracle convolves in two dimensions, in double, pixel by pixel, with weights as equations have
 * them; the program does it along rows and columns, in float, strip by strip. */
#define _POSIX_C_SOURCE 200809L
#include "testing.h"

#include "tilelight/flip.h"

typedef struct color {
    double of[3];
} color;

enum { MOST_RADIUS = 24, SIDE = 2 * MOST_RADIUS + 1 };

typedef struct kernel {
    int radius;
    double weights[SIDE][SIDE];
} kernel;

static const double pi = 3.14159265358979323846;

/* a sqrt(pi/b) exp(-pi^2 d^2/b) of up to two terms, d in degrees: 2020, equations 4 and 5. */
static kernel eye_kernel(double per_degree, const double a[2], const double b[2])
{
    kernel k = {.radius = (int)ceil(3.0 * sqrt(0.04 / (2.0 * pi * pi)) * per_degree)};
    double sum = 0.0;
    for (int y = -k.radius; y <= k.radius; y++)
        for (int x = -k.radius; x <= k.radius; x++) {
            const double d2 = (x * x + y * y) / (per_degree * per_degree);
            double w = 0.0;
            for (int i = 0; i < 2; i++)
                if (a[i] > 0.0)
                    w += a[i] * sqrt(pi / b[i]) * exp(-pi * pi * d2 / b[i]);
            sum += k.weights[y + k.radius][x + k.radius] = w;
        }
    for (int y = 0; y <= 2 * k.radius; y++)
        for (int x = 0; x <= 2 * k.radius; x++)
            k.weights[y][x] /= sum;
    return k;
}

/* Edges (order 1) or points (order 2) along x, or transposed along y: 2020, section 4.2.1. */
static kernel feature_kernel(double per_degree, int order, int transposed)
{
    const double deviation = 0.5 * 0.082 * per_degree, s2 = deviation * deviation;
    kernel k = {.radius = (int)ceil(3.0 * deviation)};
    double above = 0.0, below = 0.0;
    for (int y = -k.radius; y <= k.radius; y++)
        for (int x = -k.radius; x <= k.radius; x++) {
            const int along = transposed ? y : x;
            const double g = exp(-(x * x + y * y) / (2.0 * s2));
            const double w = order == 1 ? -along * g : (along * along / s2 - 1.0) * g;
            *(w > 0.0 ? &above : &below) += w;
            k.weights[y + k.radius][x + k.radius] = w;
        }
    for (int y = 0; y <= 2 * k.radius; y++)
        for (int x = 0; x <= 2 * k.radius; x++)
            k.weights[y][x] /= k.weights[y][x] > 0.0 ? above : -below;
    return k;
}

typedef struct picture {
    int width, height;
    color *opponent;
} picture;

static double decode(double v)
{
    v = v > 0.0 ? v < 1.0 ? v : 1.0 : 0.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double shown(double radiance, double exposure)
{
    const double x = radiance > 0.0 ? 0.6 * exp2(exposure) * radiance : 0.0;
    const double y = (2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14);
    return x > 1e100 || y > 1.0 ? 1.0 : y;
}

static const double white[3] = {0.950428545, 1.0, 1.088900371};
static const double xyz_of_rgb[3][3] = {
    {10135552 / 24577794.0, 8788810 / 24577794.0, 4435075 / 24577794.0},
    {2613072 / 12288897.0, 8788810 / 12288897.0, 887015 / 12288897.0},
    {1425312 / 73733382.0, 8788810 / 73733382.0, 70074185 / 73733382.0}};

static color multiply(const double m[3][3], color v)
{
    color out = {{0}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out.of[i] += m[i][k] * v.of[k];
    return out;
}

static color opponent_of(color rgb)
{
    color xyz = multiply(xyz_of_rgb, rgb);
    for (int i = 0; i < 3; i++)
        xyz.of[i] /= white[i];
    return (color){{116.0 * xyz.of[1] - 16.0, 500.0 * (xyz.of[0] - xyz.of[1]),
                    200.0 * (xyz.of[1] - xyz.of[2])}};
}

/* Solved by Cramer's rule, not by an inverse that somebody wrote down. */
static color rgb_of_xyz(color xyz)
{
    const double(*m)[3] = xyz_of_rgb;
    double determinant[4];
    for (int column = 0; column < 4; column++) {
        double c[3][3];
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                c[i][k] = k == column ? xyz.of[i] : m[i][k];
        determinant[column] = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) -
                              c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
                              c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
    }
    return (color){{determinant[0] / determinant[3], determinant[1] / determinant[3],
                    determinant[2] / determinant[3]}};
}

static color hunt_lab(color rgb)
{
    const color xyz = multiply(xyz_of_rgb, rgb);
    double f[3];
    for (int i = 0; i < 3; i++) {
        const double t = xyz.of[i] / white[i], delta = 6.0 / 29.0;
        f[i] = t > delta * delta * delta ? cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    }
    const double l = 116.0 * f[1] - 16.0;
    return (color){{l, 0.01 * l * 500.0 * (f[0] - f[1]), 0.01 * l * 200.0 * (f[1] - f[2])}};
}

static double hyab(color a, color b)
{
    return fabs(a.of[0] - b.of[0]) + hypot(a.of[1] - b.of[1], a.of[2] - b.of[2]);
}

static double convolve(const picture *p, const kernel *k, int channel, int x, int y)
{
    double sum = 0.0;
    for (int j = -k->radius; j <= k->radius; j++)
        for (int i = -k->radius; i <= k->radius; i++) {
            const int u = x + i < 0 ? 0 : x + i >= p->width ? p->width - 1 : x + i;
            const int v = y + j < 0 ? 0 : y + j >= p->height ? p->height - 1 : y + j;
            sum += k->weights[j + k->radius][i + k->radius] *
                   p->opponent[v * p->width + u].of[channel];
        }
    return sum;
}

typedef struct oracle {
    kernel eye[3], features[2][2];
    double most;
} oracle;

static oracle make_oracle(double per_degree)
{
    static const double a[3][2] = {{1, 0}, {1, 0}, {34.1, 13.5}};
    static const double b[3][2] = {{0.0047, 1}, {0.0053, 1}, {0.04, 0.025}};
    oracle o;
    for (int i = 0; i < 3; i++)
        o.eye[i] = eye_kernel(per_degree, a[i], b[i]);
    for (int order = 0; order < 2; order++)
        for (int axis = 0; axis < 2; axis++)
            o.features[order][axis] = feature_kernel(per_degree, order + 1, axis);
    o.most = pow(hyab(hunt_lab((color){{0, 1, 0}}), hunt_lab((color){{0, 0, 1}})), 0.7);
    return o;
}

static color seen_by(const oracle *o, const picture *p, int x, int y)
{
    color c, xyz;
    for (int i = 0; i < 3; i++)
        c.of[i] = convolve(p, &o->eye[i], i, x, y);
    const double luminance = (c.of[0] + 16.0) / 116.0;
    xyz = (color){{(luminance + c.of[1] / 500.0) * white[0], luminance,
                   (luminance - c.of[2] / 200.0) * white[2]}};
    color rgb = rgb_of_xyz(xyz);
    for (int i = 0; i < 3; i++)
        rgb.of[i] = fmin(fmax(rgb.of[i], 0.0), 1.0);
    return hunt_lab(rgb);
}

static double flip_at(const oracle *o, const picture pictures[2], int x, int y)
{
    const double power =
        pow(hyab(seen_by(o, &pictures[0], x, y), seen_by(o, &pictures[1], x, y)), 0.7);
    const double knee = 0.4 * o->most;
    const double color_part =
        power < knee ? 0.95 / knee * power : 0.95 + 0.05 * (power - knee) / (o->most - knee);
    double feature_part = 0.0;
    for (int order = 0; order < 2; order++) {
        double strengths[2];
        for (int i = 0; i < 2; i++)
            strengths[i] = hypot(convolve(&pictures[i], &o->features[order][0], 0, x, y),
                                 convolve(&pictures[i], &o->features[order][1], 0, x, y)) /
                           116.0;
        feature_part = fmax(feature_part, fabs(strengths[0] - strengths[1]));
    }
    return pow(color_part, 1.0 - sqrt(feature_part / sqrt(2.0)));
}

static picture picture_of(const tl_image *image, int radiance, double exposure)
{
    picture p = {(int)image->width, (int)image->height, NULL};
    p.opponent = malloc((size_t)p.width * (size_t)p.height * sizeof *p.opponent);
    assert_non_null(p.opponent);
    for (size_t y = 0; y < image->height; y++)
        for (size_t x = 0; x < image->width; x++) {
            color rgb;
            for (unsigned i = 0; i < 3; i++) {
                const double v = (double)tl_image_plane(image, i)[y * image->pitch + x];
                rgb.of[i] = radiance ? shown(v, exposure) : decode(v);
            }
            p.opponent[y * image->width + x] = opponent_of(rgb);
        }
    return p;
}

static uint32_t random_state = 1;

static double random_unit(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) * 0x1p-24;
}

/* Edges, points and gradients with noise; values far above 1, below 0, NaN and infinity in radiance. */
static tl_image *draw(uint32_t width, uint32_t height, int radiance, double noise)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    for (unsigned i = 0; i < 3; i++)
        for (size_t y = 0; y < height; y++)
            for (size_t x = 0; x < width; x++) {
                double v = 0.5 + 0.4 * sin(0.3 * (double)x + i) * cos(0.2 * (double)y);
                v = (x / 7 + y / 5) % 3 == i ? v : 0.2 * v;
                v += x % 11 == 3 && y % 13 == 4 ? 0.5 : 0.0;
                v += noise * (random_unit() - 0.5);
                if (radiance)
                    v = x < 2 && y == 0 ? 300.0 : x == 2 && y == 0 ? -1.0 : v * v * v;
                tl_image_plane(image, i)[y * image->pitch + x] = (float)v;
            }
    return image;
}

static const struct {
    const char *name;
    uint32_t width, height;
    double per_degree;
    int radiance;
    double noise;
} cases[] = {
    {"screen", 61, 70, TL_FLIP_PIXELS_PER_DEGREE, 0, 0.3},
    {"small differences", 40, 40, TL_FLIP_PIXELS_PER_DEGREE, 0, 1e-3},
    {"one pixel", 1, 1, TL_FLIP_PIXELS_PER_DEGREE, 0, 0.5},
    {"one column, two strips", 1, 67, 30.0, 0, 0.5},
    {"few pixels a degree", 50, 20, 1.0, 0, 0.5},
    {"radiance", 37, 33, TL_FLIP_PIXELS_PER_DEGREE, 1, 0.3},
};

/* The exposures as the 2021 paper defines them; none is checked against the program's. */
static void expect_exposures(const tl_image *reference, const tl_flip *got)
{
    const double a = 0.36 * (2.51 - 0.85 * 2.43), b = 0.6 * (0.03 - 0.85 * 0.59),
                 c = -0.85 * 0.14;
    const double root = (-b + sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    assert_true(fabs(shown(root, 0.0) - 0.85) < 1e-12);
    const double brightest = 300.0;
    assert_true(fabs(got->first_exposure - log2(root / brightest)) < 1e-5);
    assert_true(got->last_exposure > got->first_exposure);
    assert_int_equal(got->exposure_count,
                     (uint32_t)ceil(got->last_exposure - got->first_exposure));
    size_t above = 0, count = 0;
    const double median = root / exp2(got->last_exposure);
    for (size_t y = 0; y < reference->height; y++)
        for (size_t x = 0; x < reference->width; x++) {
            static const double weights[3] = {0.2126, 0.7152, 0.0722};
            double luminance = 0.0;
            for (unsigned i = 0; i < 3; i++)
                luminance +=
                    weights[i] *
                    fmax(0.0, (double)tl_image_plane(reference, i)[y * reference->pitch + x]);
            count += luminance > 0.0;
            above += luminance > median * (1.0 + 1e-5);
        }
    assert_true(above <= count / 2 && above + 1 >= count / 2);
}

/* Where the oracle sees more than `want` has, at this exposure, that becomes what it sees. */
static void see_more(
    const oracle *o, tl_image *const images[2], int radiance, double exposure, double *want)
{
    const picture pictures[2] = {picture_of(images[0], radiance, exposure),
                                 picture_of(images[1], radiance, exposure)};
    for (int y = 0; y < pictures[0].height; y++)
        for (int x = 0; x < pictures[0].width; x++) {
            double *w = &want[(size_t)y * (size_t)pictures[0].width + (size_t)x];
            *w = fmax(*w, flip_at(o, pictures, x, y));
        }
    free(pictures[0].opponent);
    free(pictures[1].opponent);
}

static void compare_with_oracle(size_t which)
{
    const int radiance = cases[which].radiance;
    const uint32_t width = cases[which].width, height = cases[which].height;
    random_state = (uint32_t)which + 1;
    tl_image *images[2] = {draw(width, height, radiance, cases[which].noise),
                           draw(width, height, radiance, 0.0)};
    float *map = malloc(sizeof *map * width * height);
    double *want = calloc((size_t)width * height, sizeof *want);
    const oracle o = make_oracle(cases[which].per_degree);
    tl_flip got;
    tl_error err;
    ASSERT_OK(tl_flip_compare(images[0], images[1],
                              radiance ? TL_FLIP_RADIANCE : TL_FLIP_SCREEN,
                              cases[which].per_degree, map, &got, &err),
              err);
    if (radiance)
        expect_exposures(images[1], &got);
    const uint32_t exposures = radiance ? got.exposure_count : 1;
    for (uint32_t e = 0; e < exposures; e++) {
        const double exposure =
            exposures > 1 ? got.first_exposure +
                                e * (got.last_exposure - got.first_exposure) / (exposures - 1)
                          : 0.0;
        see_more(&o, images, radiance, exposure, want);
    }
    double worst = 0.0, mean = 0.0, largest = 0.0;
    for (size_t i = 0; i < (size_t)width * height; i++) {
        worst = fmax(worst, fabs((double)map[i] - want[i]));
        mean += want[i] / ((double)width * height);
        largest = fmax(largest, (double)map[i]);
    }
    printf("%-24s mean %.6f, off by %.1e at most\n", cases[which].name, mean, worst);
    /* Filters sum some 40 floats of up to 100 or so on each axis: 42 roundings of 2^-24 leave colours
     * off by 2.5e-4 at most. Where nothing differs that is the difference, and 0.95/16.5 times its
     * power 0.7 the error, 1.7e-4; elsewhere the slope is less. */
    assert_true(worst < 2e-4);
    assert_true(fabs(got.mean - mean) < 1e-4);
    assert_true(got.max == largest);
    assert_true((double)map[(size_t)got.worst_y * width + got.worst_x] == largest);
    free(want);
    free(map);
    tl_image_destroy(images[1]);
    tl_image_destroy(images[0]);
}

static void maps_are_those_of_the_oracle(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        compare_with_oracle(i);
}

static tl_image *fill(uint32_t side, const float rgb[3])
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(side, side, &image, &err), err);
    for (unsigned i = 0; i < 3; i++)
        for (size_t at = 0; at < (size_t)image->pitch * side; at++)
            tl_image_plane(image, i)[at] = rgb[i];
    return image;
}

/* Even pictures have no features, and filters leave them as they are: what is left is the paper's
 * scale. Green and blue are its end; black and white are 100 apart, (100^0.7 - k)/(m - k) of the last
 * twentieth with m = 203.37^0.7 and k = 0.4 m. */
static void even_pictures_are_on_the_scale(void **state)
{
    static const struct {
        float a[3], b[3];
        double want;
    } pairs[] = {
        {{0, 1, 0}, {0, 0, 1}, 1.0},
        {{0, 0, 0}, {1, 1, 1}, 0.967374},
        {{0.25f, 0.5f, 0.75f}, {0.25f, 0.5f, 0.75f}, 0.0},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(pairs); i++) {
        tl_image *a = fill(9, pairs[i].a), *b = fill(9, pairs[i].b);
        tl_flip got;
        tl_error err;
        ASSERT_OK(
            tl_flip_compare(a, b, TL_FLIP_SCREEN, TL_FLIP_PIXELS_PER_DEGREE, NULL, &got, &err),
            err);
        if (fabs(got.mean - pairs[i].want) > 2e-5)
            fail_msg("pair %zu: %.9g, not %.9g", i, got.mean, pairs[i].want);
        tl_image_destroy(b);
        tl_image_destroy(a);
    }
}

static void threads_change_nothing(void **state)
{
    tl_image *a = draw(30, 200, 1, 0.2), *b = draw(30, 200, 1, 0.0);
    tl_flip one, many;
    tl_error err;
    (void)state;
    memset(&one, 0, sizeof one);
    memset(&many, 0, sizeof many);
    setenv("TILELIGHT_THREADS", "1", 1);
    ASSERT_OK(tl_flip_compare(a, b, TL_FLIP_RADIANCE, 20.0, NULL, &one, &err), err);
    setenv("TILELIGHT_THREADS", "3", 1);
    ASSERT_OK(tl_flip_compare(a, b, TL_FLIP_RADIANCE, 20.0, NULL, &many, &err), err);
    unsetenv("TILELIGHT_THREADS");
    assert_memory_equal(&one, &many, sizeof one);
    assert_true(one.mean > 0.0);
    tl_image_destroy(b);
    tl_image_destroy(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_are_those_of_the_oracle),
        cmocka_unit_test(even_pictures_are_on_the_scale),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
