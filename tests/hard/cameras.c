/* Cameras that are not the common one: cases 13, 14 and 20. */
#include "hard_case.h"
#include "hard_frames.h"
#include "sphere_pixels.h"

/* Lights around random pixels, so far away in parts of the view's height. */
static tl_light_set lights_around(const tl_gbuffer *g,
                                  uint32_t count,
                                  float nearest,
                                  float farthest)
{
    tl_light_set lights = {0};
    uint32_t seed = 13;
    for (uint32_t i = 0; i < count; i++)
        add_light_around(&lights, g, random_rim(g, &seed, i), &seed,
                         uniform(&seed, nearest, farthest));
    return lights;
}

void hard_orthographic(hard_bench *bench)
{
    tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_ORTHOGRAPHIC);
    camera.near = -6.0f; /* surfaces beside and behind the eye point, too */
    camera.far = 6.0f;
    tl_gbuffer *g = surfaces_between(&camera, camera.near, camera.far);
    set_pixel(g, TL_DEPTH, pixel_at(g, 0, 0), 0.0f);
    tl_light_set lights = lights_around(g, 60, 0.01f, 3.0f);
    hard_try_spheres(bench, g, &lights, hard_around_centre);
}

/* As if the frustum were symmetric: the right edge alone says how wide it is. */
static int by_right_edge(
    const tl_camera *camera, const float centre[3], float radius, uint32_t x, uint32_t y)
{
    tl_camera symmetric = *camera;
    symmetric.left = -camera->right;
    symmetric.bottom = -camera->top;
    return hard_around_centre(&symmetric, centre, radius, x, y);
}

void hard_frustum(hard_bench *bench)
{
    static const double eye[3] = {3, -2, 5}, target[3] = {2.5, -2.2, 1}, up[3] = {0.1, 1, 0.2};
    static const struct {
        double field_of_view;
        float shift; /* of the image, in its halves */
    } views[] = {{3.13, 0.0f}, {1.0, 2.5f}, {1e-4, 0.0f}, {1e-4, -40.0f}};
    for (size_t i = 0; i < COUNT_OF(views); i++) {
        tl_camera camera = tl_camera_look_at(eye, target, up, views[i].field_of_view,
                                             FRAME_WIDTH, FRAME_HEIGHT, 0.1, 100.0);
        const float extent = camera.top, across = views[i].shift * camera.right;
        camera.left += across;
        camera.right += across;
        tl_gbuffer *g = surfaces_between(&camera, 2.0f, 5.0f);
        tl_light_set lights =
            lights_around(g, 30, 0.1f * fminf(extent, 1.0f), fminf(3.0f * extent, 9.0f));
        hard_try_spheres(bench, g, &lights, by_right_edge);
    }
}

/* Where the pixel is in world space, from the kernels' view of it. */
static void world_point(const tl_gbuffer *g, vec3 p, double world[3])
{
    const double view[3] = {(double)p.x, (double)p.y, (double)p.z};
    tl_camera_world_point(&g->camera, view, world);
}

static long double length_of(const double v[3])
{
    return sqrtl((long double)v[0] * v[0] + (long double)v[1] * v[1] +
                 (long double)v[2] * v[2]);
}

/* What the kernels decide in view space against distances in world space; and against a view that is scaled
 * while the range is not. Of pairs that are closer to the rim than floats of their coordinates tell: 8u of
 * them, for position and light, three axes each. */
static void count_scaled(hard_bench *bench,
                         const tl_gbuffer *g,
                         const tl_light_set *lights,
                         float scale)
{
    tl_prepared prepared = prepared_of(g, lights);
    for (uint32_t i = 0; i < prepared.frame.light_count; i++)
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++) {
                const tl_light *light = &lights->lights[prepared.sources[i]];
                const vec3 p = seen_position(&prepared, g, x, y);
                const vec3 l = vector_to_light(p, prepared.lights[i]);
                double world[3], away[3], from_eye[3] = {(double)p.x, (double)p.y, (double)p.z};
                if (isinf(p.z))
                    continue;
                world_point(g, p, world);
                for (int axis = 0; axis < 3; axis++)
                    away[axis] = (double)light->position[axis] - world[axis];
                const long double distance = length_of(away), range = light->range;
                const float distance2 = dot3(l, l);
                if (fabsl(distance - range) <=
                    0x1p-21L * (length_of(from_eye) + distance + 10.0L))
                    continue;
                hard_count(bench, reaches(prepared.lights[i], distance2) == (distance < range),
                           reaches(prepared.lights[i], distance2 * (scale * scale)) ==
                               (distance < range));
            }
    tl_prepared_clear(&prepared);
}

/* A view that scales is refused; of what is left of it by rounding, a thousandth at most, all agree. */
void hard_scaled_view(hard_bench *bench)
{
    static const float scales[] = {0.5f, 2.0f, 1.01f, 0.99f, 0.9995f, 1.0004f};
    for (size_t i = 0; i < COUNT_OF(scales); i++) {
        tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_PERSPECTIVE);
        tl_gbuffer *g = surfaces_between(&camera, 2.0f, 5.0f);
        tl_light_set lights = lights_around(g, 30, 0.1f, 2.0f);
        tl_error err;
        count_scaled(bench, g, &lights, scales[i]);
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                g->camera.view_from_world[row][column] *= scales[i];
        const int is_refused = tl_camera_check(&g->camera, &err) == TL_ERR_ARGUMENT;
        hard_count(bench, is_refused == (fabsf(scales[i] - 1.0f) > 1e-3f), 1);
        if (!is_refused)
            hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}
