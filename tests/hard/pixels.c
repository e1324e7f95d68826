/* Pixels that formulas fail on: cases 22 to 25. */
#include "hard_case.h"
#include "hard_frames.h"
#include "hard_pixels.h"

static float value_at(const tl_image *image, unsigned channel, uint32_t x, uint32_t y)
{
    return tl_image_plane(image, channel)[(size_t)y * image->pitch + x];
}

static int is_finite_at(const tl_image *image, uint32_t x, uint32_t y)
{
    return isfinite(value_at(image, 0, x, y)) && isfinite(value_at(image, 1, x, y)) &&
           isfinite(value_at(image, 2, x, y));
}

/* Every pair of a pixel and a light: the pixel's value is finite. Usually l/|l| and 1/|l|^2, and of a falloff
 * that begins where it ends (range - d) / (range - begin). */
static void count_touching(hard_bench *bench,
                           const tl_gbuffer *g,
                           const tl_light_set *lights,
                           const tl_image *image)
{
    tl_prepared prepared = prepared_of(g, lights);
    for (uint32_t i = prepared.frame.global_count; i < prepared.frame.light_count; i++)
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++) {
                const tl_light *light = &lights->lights[prepared.sources[i]];
                const vec3 l =
                    vector_to_light(seen_position(&prepared, g, x, y), prepared.lights[i]);
                const float d2 = dot3(l, l);
                const float quotient =
                    (light->range - sqrtf(d2)) / (light->range - light->begin);
                if (reaches(prepared.lights[i], d2))
                    hard_count(bench, is_finite_at(image, x, y),
                               isfinite(l.x / sqrtf(d2)) && isfinite(1.0f / d2) &&
                                   isfinite(quotient));
            }
    tl_prepared_clear(&prepared);
}

void hard_touching(hard_bench *bench)
{
    for (int projection = 0; projection < 2; projection++) {
        tl_light_set lights = {0};
        tl_gbuffer *g =
            hard_frame((tl_projection)projection, TL_GROUP_BASE | TL_GROUP_PHONG, &lights);
        tl_image *image = hard_picture(g, &lights);
        count_touching(bench, g, &lights, image);
        tl_image_destroy(image);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* Lights whose half vector is along the surface, over it and under it by a float, of every exponent. */
static tl_light_set lights_at_grazing_angles(const tl_gbuffer *g)
{
    tl_light_set lights = {0};
    uint32_t seed = 23;
    tl_error err;
    for (uint32_t i = 0; i < 40; i++) {
        const rim at = random_rim(g, &seed, i);
        const vec3 p = position_at(g, at.x, at.y);
        const double view[3] = {-(double)p.x, -(double)p.y, -(double)p.z};
        const double away = (double)(1 + i % 3), lift = i % 4 < 2 ? 1e-7 : -1e-7;
        const double place[3] = {(double)p.x - away * view[0] / 4.0 + lift * view[1],
                                 (double)p.y - away * view[1] / 4.0 + lift,
                                 (double)p.z - away * view[2] / 4.0};
        double world[3];
        tl_light light = tl_light_default();
        tl_camera_world_point(&g->camera, place, world);
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] = (float)world[axis];
        light.range = 5.0f;
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    }
    return lights;
}

/* Exponents at the ends; the normal across the way to the eye, or turned from it. */
static tl_gbuffer *grazing_surfaces(void)
{
    static const float exponents[] = {0.0f, 1e-40f, 1.0f, 0.5f, 10000.0f};
    const tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = surfaces_between(&camera, 3.0f, 6.0f);
    for (uint32_t y = 0; y < camera.height; y++)
        for (uint32_t x = 0; x < camera.width; x++) {
            if (isinf(depth_at(g, x, y)))
                continue;
            const vec3 p = position_at(g, x, y);
            const double turn = (double)((int)(x % 5) - 2) * 1e-7;
            const double across[3] = {-(double)p.y + turn * (double)p.x,
                                      (double)p.x + turn * (double)p.y, turn * (double)p.z};
            double world[3];
            tl_camera_world_direction(&camera, across, world);
            for (int axis = 0; axis < 3; axis++)
                set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), pixel_at(g, x, y),
                          (float)world[axis]);
            set_pixel(g, TL_SHININESS, pixel_at(g, x, y), exponents[y % COUNT_OF(exponents)]);
        }
    return g;
}

/* powf(n.h, e) as it stands. */
static int is_usual_power_finite(const surface *s, vec3 l)
{
    const float length = sqrtf(dot3(l, l)), eye = sqrtf(dot3(s->position, s->position));
    const vec3 h = {l.x / length - s->position.x / eye, l.y / length - s->position.y / eye,
                    l.z / length - s->position.z / eye};
    const float cosine = dot3(s->normal, h) / sqrtf(dot3(h, h));
    return isfinite(powf(cosine, s->shininess)) && !(cosine <= 0.0f && s->shininess == 0.0f);
}

static void count_powers(hard_bench *bench,
                         const tl_gbuffer *g,
                         const tl_light_set *lights,
                         const tl_image *image)
{
    tl_prepared prepared = prepared_of(g, lights);
    for (uint32_t i = 0; i < prepared.frame.light_count; i++)
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++) {
                const size_t at = pixel_at(g, x, y);
                const vec3 normal = {tl_gbuffer_plane(g, TL_NORMAL_X)[at],
                                     tl_gbuffer_plane(g, TL_NORMAL_Y)[at],
                                     tl_gbuffer_plane(g, TL_NORMAL_Z)[at]};
                const surface s = {.position = seen_position(&prepared, g, x, y),
                                   .normal = view_normal(&prepared.frame, normal),
                                   .shininess = tl_gbuffer_plane(g, TL_SHININESS)[at]};
                if (isfinite(depth_at(g, x, y)))
                    hard_count(bench, is_finite_at(image, x, y),
                               is_usual_power_finite(
                                   &s, vector_to_light(s.position, prepared.lights[i])));
            }
    tl_prepared_clear(&prepared);
}

/* Every model by the twin, which has the kernels' text; the frame's own model in all ways. */
void hard_powers(hard_bench *bench)
{
    tl_gbuffer *g = grazing_surfaces();
    tl_light_set lights = lights_at_grazing_angles(g);
    hard_light(bench, g, &lights);
    for (int model = 0; model < TL_MODEL_COUNT; model++) {
        lights.model = (enum tl_shading_model)model;
        tl_image *image = hard_picture(g, &lights);
        count_powers(bench, g, &lights, image);
        hard_judge(bench, g, &lights, image);
        tl_image_destroy(image);
    }
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

/* Of length 0, and so short or long that squares leave the floats. */
static const float lengths[] = {0.0f, -0.0f, 1e-45f, 1e-30f, 1e-20f, 1e20f, 1e30f, 3e38f};

static tl_light_set lights_over(const tl_gbuffer *g, uint32_t count)
{
    tl_light_set lights = {0};
    uint32_t seed = 24;
    for (uint32_t i = 0; i < count; i++)
        add_light_around(&lights, g, random_rim(g, &seed, i), &seed,
                         uniform(&seed, 0.1f, 3.0f));
    for (int c = 0; c < 3; c++)
        lights.ambient[c] = 0.25f;
    return lights;
}

static float length_at(uint32_t x, uint32_t y)
{
    return lengths[(x / 3 + y) % COUNT_OF(lengths)];
}

/* Of every third pixel; along x or y of the world. */
static tl_gbuffer *frame_without_normals(const tl_camera *camera)
{
    tl_gbuffer *g = surfaces_between(camera, 3.0f, 6.0f);
    tl_error err;
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = y % 3; x < camera->width; x += 3)
            for (int axis = 0; axis < 3 && isfinite(depth_at(g, x, y)); axis++)
                set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), pixel_at(g, x, y),
                          axis == (int)(x % 2) ? length_at(x, y) : 0.0f);
    ASSERT_OK(tl_gbuffer_repair(g, "no normals", false, NULL, &err), err);
    return g;
}

/* Whether the kernels have no normal there, rather than no number. */
static int is_without_normal(const tl_prepared *prepared, const tl_gbuffer *g, size_t at)
{
    const vec3 world = {tl_gbuffer_plane(g, TL_NORMAL_X)[at],
                        tl_gbuffer_plane(g, TL_NORMAL_Y)[at],
                        tl_gbuffer_plane(g, TL_NORMAL_Z)[at]};
    const vec3 n = view_normal(&prepared->frame, world);
    return n.x == 0.0f && n.y == 0.0f && n.z == 0.0f;
}

/* A pixel without a normal has what ambient light gives it, and nothing else. */
void hard_no_normal(hard_bench *bench)
{
    const tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = frame_without_normals(&camera);
    tl_light_set lights = lights_over(g, 40), none = {.ambient = {0.25f, 0.25f, 0.25f}};
    tl_image *image = hard_picture(g, &lights), *ambient = hard_picture(g, &none);
    tl_prepared prepared = prepared_of(g, &lights);
    for (uint32_t y = 0; y < camera.height; y++)
        for (uint32_t x = y % 3; x < camera.width; x += 3) {
            const size_t at = pixel_at(g, x, y);
            const float length = length_at(x, y);
            const int repaired = tl_gbuffer_plane(g, TL_NORMAL_X)[at] == 0.0f &&
                                 tl_gbuffer_plane(g, TL_NORMAL_Y)[at] == 0.0f;
            const int as_ambient =
                is_without_normal(&prepared, g, at) &&
                same_bits(value_at(image, 0, x, y), value_at(ambient, 0, x, y));
            if (isfinite(depth_at(g, x, y)))
                hard_count(bench, is_finite_at(image, x, y) && (!repaired || as_ambient),
                           fabsf(length / sqrtf(length * length)) == 1.0f);
        }
    tl_prepared_clear(&prepared);
    tl_image_destroy(image);
    tl_image_destroy(ambient);
    hard_light(bench, g, &lights);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

static const enum tl_plane spoiled_planes[] = {TL_DEPTH, TL_NORMAL_X, TL_ALBEDO_R,
                                               TL_SPECULAR_G, TL_SHININESS};
static const float no_numbers[] = {NAN, INFINITY, -INFINITY};
enum { SPOILED_COUNT = COUNT_OF(spoiled_planes) * COUNT_OF(no_numbers), STRIDE = 77 };

/* Every STRIDE-th pixel has something else that is no number. */
static int is_spoiled(const tl_gbuffer *g, uint32_t x, uint32_t y)
{
    const uint32_t i = y * g->camera.width + x;
    return i % STRIDE == STRIDE / 2 && i / STRIDE < SPOILED_COUNT;
}

static tl_gbuffer *spoiled_frame(const tl_camera *camera)
{
    tl_gbuffer *g = surfaces_between(camera, 3.0f, 6.0f);
    for (uint32_t i = 0; i < SPOILED_COUNT; i++) {
        const uint32_t which = i * STRIDE + STRIDE / 2;
        const size_t at = pixel_at(g, which % camera->width, which / camera->width);
        set_pixel(g, TL_DEPTH, at, 4.0f);
        set_pixel(g, spoiled_planes[i % COUNT_OF(spoiled_planes)], at,
                  no_numbers[i / COUNT_OF(spoiled_planes)]);
    }
    return g;
}

/* Whether the mean of a plane over a pixel and its neighbours, bloom's first step, is a number. */
static int is_mean_finite(const tl_gbuffer *g, enum tl_plane plane, uint32_t x, uint32_t y)
{
    float sum = 0.0f;
    for (uint32_t row = y - (y > 0); row <= y + 1 && row < g->camera.height; row++)
        for (uint32_t column = x - (x > 0); column <= x + 1 && column < g->camera.width;
             column++)
            sum += tl_gbuffer_plane(g, plane)[pixel_at(g, column, row)];
    return isfinite(sum);
}

/* Every other pixel of the picture, and of that of 2 x 2 samples a pixel, has the bits that it has where all
 * are numbers; and these have a value, too. */
static void count_harmed(hard_bench *bench,
                         const tl_gbuffer *g,
                         const tl_image *got,
                         const tl_image *clean)
{
    tl_image *means = NULL, *clean_means = NULL;
    tl_error err;
    ASSERT_OK(tl_image_resolve(got, 2, &means, &err), err);
    ASSERT_OK(tl_image_resolve(clean, 2, &clean_means, &err), err);
    for (uint32_t y = 0; y < got->height; y++)
        for (uint32_t x = 0; x < got->width; x++)
            hard_count(bench,
                       is_spoiled(g, x, y)
                           ? is_finite_at(got, x, y)
                           : same_bits(value_at(got, 1, x, y), value_at(clean, 1, x, y)),
                       is_mean_finite(g, TL_ALBEDO_R, x, y));
    for (uint32_t y = 0; y < got->height / 2; y++)
        for (uint32_t x = 0; x < got->width / 2; x++)
            if (!is_spoiled(g, 2 * x, 2 * y) && !is_spoiled(g, 2 * x + 1, 2 * y) &&
                !is_spoiled(g, 2 * x, 2 * y + 1) && !is_spoiled(g, 2 * x + 1, 2 * y + 1))
                hard_count(bench,
                           same_bits(value_at(means, 1, x, y), value_at(clean_means, 1, x, y)),
                           1);
    hard_count(bench, isfinite(tl_image_auto_exposure(got)), 1);
    tl_image_destroy(means);
    tl_image_destroy(clean_means);
}

/* Not repaired, as a caller may hand it over who has forgotten to, by both paths; and repaired, in all
 * ways. */
void hard_nan_pixel(hard_bench *bench)
{
    static const tl_path paths[] = {TL_PATH_CPU, TL_PATH_GPU};
    const tl_camera camera = camera_of(FRAME_WIDTH + 1, FRAME_HEIGHT + 1, TL_PERSPECTIVE);
    tl_gbuffer *whole = surfaces_between(&camera, 3.0f, 6.0f), *g = spoiled_frame(&camera);
    tl_light_set lights = lights_over(whole, 40);
    tl_image *clean = hard_picture(whole, &lights), *got = image_like(g);
    tl_error err;
    for (size_t i = 0; i < COUNT_OF(paths) * TL_CULL_COUNT; i++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.path = paths[i % 2];
        options.cull = (tl_cull)(i / 2);
        options.tile_size = 8;
        options.effects = TL_EFFECTS_ALL;
        light_frame(bench->device, &options, g, &lights, got);
        count_harmed(bench, g, got, clean);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "spoiled", false, NULL, &err), err);
    hard_light(bench, g, &lights);
    tl_image *repaired = hard_picture(g, &lights);
    count_harmed(bench, g, repaired, clean);
    tl_image_destroy(repaired);
    tl_image_destroy(clean);
    tl_image_destroy(got);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(whole);
    tl_gbuffer_destroy(g);
}
