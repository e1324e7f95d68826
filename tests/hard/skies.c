/* Skies that light: one pixel that is a million times brighter than the rest, and directions where maps
 * end. */
#include "hard_case.h"

#include "prepared.h"
#include "sky_light.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { WIDTH = 64, HEIGHT = 32 };

static tl_light_set sky_of(double (*shape)(const double d[3]))
{
    tl_light_set set = {.sky_type = TL_SKY_IMAGE, .sky_intensity = 1.0f, .sky_light = 1.0f};
    float *pixels = malloc(3 * sizeof(float) * WIDTH * HEIGHT);
    tl_error err;
    assert_non_null(pixels);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double turn = 2.0 * pi * ((i % WIDTH + 0.5) / WIDTH - 0.5);
        const double fall = pi * (i / WIDTH + 0.5) / HEIGHT;
        const double d[3] = {sin(fall) * sin(turn), cos(fall), sin(fall) * cos(turn)};
        for (int c = 0; c < 3; c++)
            pixels[3 * i + c] = (float)shape(d);
    }
    ASSERT_OK(tl_light_set_add_image(&set, "sky", WIDTH, HEIGHT, pixels, &set.sky_image, &err),
              err);
    return set;
}

/* A frame of surfaces of the set's model. */
static tl_prepared prepared_under(const tl_light_set *set)
{
    const tl_camera camera = camera_of(8, 8, TL_PERSPECTIVE);
    const uint32_t material = set->model == TL_MODEL_METAL_ROUGH ? TL_GROUP_METAL_ROUGH : 0;
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | material, 3);
    tl_prepared p = {.memory_size = 0};
    tl_error err;
    ASSERT_OK(tl_prepare(g, set, &(tl_prepare_options){.tile_size = 16}, NULL, &p, &err), err);
    tl_gbuffer_destroy(g);
    return p;
}

/* A pixel's middle; its light is 1e6 times its solid angle, of 2 pi^2/2048 sr times a sine. */
static const double sun_turn = 2.0 * pi * (40.5 / WIDTH - 0.5), sun_fall = pi * 9.5 / HEIGHT;

static double sun(const double d[3])
{
    const double at[3] = {sin(sun_fall) * sin(sun_turn), cos(sun_fall),
                          sin(sun_fall) * cos(sun_turn)};
    return d[0] * at[0] + d[1] * at[1] + d[2] * at[2] > 0.9999 ? 1e6 : 0.0;
}

/* Without the cut at 0. */
static double as_it_stands(const float c[12], vec3 n)
{
    const double x = (double)n.x, y = (double)n.y, z = (double)n.z;
    return (double)c[0] + (double)c[1] * x + (double)c[2] * y + (double)c[3] * z +
           (double)c[4] * x * x + (double)c[5] * y * y + (double)c[6] * z * z +
           (double)c[7] * x * y + (double)c[8] * y * z + (double)c[9] * z * x;
}

/* Normals all around: none has less than no light, each that of the pixel to within 3/32 of its light over
 * pi, and on average all of them have a fourth of it, and no more than 3.1 % beyond. */
void hard_sun_pixel(hard_bench *bench)
{
    tl_light_set set = sky_of(sun);
    tl_prepared p = prepared_under(&set);
    const tl_numbers numbers = (tl_numbers)p.lights;
    const tl_view_sky_light *sky = sky_light_behind(&p.frame, numbers);
    const double light =
        1e6 * 2.0 * pi / WIDTH * (cos(pi * 9.0 / HEIGHT) - cos(pi * 10.0 / HEIGHT));
    const double axes[3] = {sin(sun_fall) * sin(sun_turn), cos(sun_fall),
                            sin(sun_fall) * cos(sun_turn)};
    double toward[3], sum = 0.0;
    uint32_t seed = 37;
    for (int i = 0; i < 3; i++)
        toward[i] = axes[0] * (double)sky->right[i] + axes[1] * (double)sky->up[i] +
                    axes[2] * (double)sky->ahead[i];
    enum { NORMALS = 20000 };
    for (int i = 0; i < NORMALS; i++) {
        double d[3];
        random_direction(&seed, d);
        const vec3 n = {(float)d[0], (float)d[1], (float)d[2]};
        const double got = (double)irradiance_of(sky->irradiance[0], n);
        const double cosine = toward[0] * d[0] + toward[1] * d[1] + toward[2] * d[2];
        const double want = light * fmax(0.0, cosine) / pi;
        hard_count(bench, got >= 0.0 && fabs(got - want) <= (3.0 / 32.0 + 1e-3) * light / pi,
                   as_it_stands(sky->irradiance[0], n) >= 0.0);
        sum += got / NORMALS;
    }
    /* Of so many normals the mean is off by a hundredth, three times what it varies by. */
    const double mean = sum / (light / (4.0 * pi));
    hard_count(bench, mean > 0.98 && mean < 1.05, 1);
    tl_prepared_clear(&p);
    tl_light_set_clear(&set);
}

static double smooth_sky(const double d[3])
{
    return 2.0 + d[0] + 0.5 * d[1] * d[2] + 0.25 * d[2];
}

/* The same level, whose outermost texels go on at the edges of its square. */
static double without_border(tl_numbers numbers,
                             const tl_view_sky_light *sky,
                             int level,
                             vec2 e)
{
    const float *levels = numbers + (size_t)sky->levels_at * 4;
    const double size = (double)levels[2 * level + 1];
    const double most = 1.0 - 1.0 / size;
    const vec2 inside = {(float)fmax(-most, fmin(most, (double)e.x)),
                         (float)fmax(-most, fmin(most, (double)e.y))};
    return (double)level_mix(numbers, sky, level, inside).x;
}

static vec2 place_of(const double d[3])
{
    return octahedron_of((vec3){(float)d[0], (float)d[2], (float)d[1]});
}

/* Directions on both sides of where an octahedral map has its edges, and of the seam and the poles of a map
 * of latitude and longitude: what they mirror is the same, to within what the sky changes by. */
static void count_across(hard_bench *bench,
                         tl_numbers numbers,
                         const tl_view_sky_light *sky,
                         const double at[3],
                         const double across[3])
{
    static const double apart = 1e-4;
    for (int level = 0; level < TL_SKY_LEVELS; level += 4) {
        double side[2][3], got[2], usual[2];
        for (int s = 0; s < 2; s++) {
            double length = 0.0;
            for (int i = 0; i < 3; i++) {
                side[s][i] = at[i] + (s ? apart : -apart) * across[i];
                length += side[s][i] * side[s][i];
            }
            for (int i = 0; i < 3; i++)
                side[s][i] /= sqrt(length);
            const vec2 e = place_of(side[s]);
            got[s] = (double)level_mix(numbers, sky, level, e).x;
            usual[s] = without_border(numbers, sky, level, e);
        }
        hard_count(bench, fabs(got[1] - got[0]) < 2e-3, fabs(usual[1] - usual[0]) < 2e-3);
    }
}

void hard_sky_seam(hard_bench *bench)
{
    tl_light_set set = sky_of(smooth_sky);
    set.model = TL_MODEL_METAL_ROUGH; /* which mirrors it */
    tl_prepared p = prepared_under(&set);
    const tl_numbers numbers = (tl_numbers)p.lights;
    const tl_view_sky_light *sky = sky_light_behind(&p.frame, numbers);
    for (int i = 0; i <= 200; i++) {
        const double angle = pi * i / 200.0, c = cos(angle), s = sin(angle);
        const double seam[3] = {0.0, c, -s}, right[3] = {1.0, 0.0, 0.0};
        const double front[3] = {0.0, -s, c}, side[3] = {c, -s, 0.0},
                     ahead[3] = {0.0, 0.0, 1.0};
        count_across(bench, numbers, sky, seam, right);
        count_across(bench, numbers, sky, front, right);
        count_across(bench, numbers, sky, side, ahead);
    }
    tl_prepared_clear(&p);
    tl_light_set_clear(&set);
}
