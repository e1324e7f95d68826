/* What a sphere reaches on the screen: cases 1, 2, 3, 5 and 6.
 *
 * Which pixels a light reaches is decided from the definition, in extended precision, pixel by pixel: the
 * point at a pixel's depth on the ray through its centre is nearer than the range. */
#include "hard_case.h"
#include "hard_frames.h"
#include "sphere_pixels.h"

#include "sphere_bounds.h"
#include "tilelight/bounds.h"

typedef struct ray {
    long double x, y; /* x/depth, y/depth; m of an orthographic camera */
} ray;

static ray ray_of(const tl_camera *c, uint32_t x, uint32_t y)
{
    const long double left = c->left, right = c->right, top = c->top, bottom = c->bottom;
    const ray r = {left + ((long double)x + 0.5L) * (right - left) / c->width,
                   top - ((long double)y + 0.5L) * (top - bottom) / c->height};
    return r;
}

static int is_within(
    const tl_gbuffer *g, uint32_t x, uint32_t y, const float centre[3], float radius)
{
    const long double depth = depth_at(g, x, y);
    const long double scale = g->camera.projection == TL_ORTHOGRAPHIC ? 1.0L : depth;
    const ray r = ray_of(&g->camera, x, y);
    const long double away[3] = {r.x * scale - centre[0], r.y * scale - centre[1],
                                 -depth - centre[2]};
    return isfinite(depth_at(g, x, y)) &&
           away[0] * away[0] + away[1] * away[1] + away[2] * away[2] <
               (long double)radius * radius;
}

static void count_pixels(hard_bench *bench,
                         const tl_gbuffer *g,
                         const tl_light_set *lights,
                         hard_keeps *usually)
{
    const tl_camera *camera = &g->camera;
    for (size_t i = 0; i < lights->count; i++) {
        const tl_view_light light = seen_light(g, &lights->lights[i]);
        const float radius = lights->lights[i].range;
        tl_pixel_rect rect;
        tl_sphere_bounds(camera, light.position, radius, &rect);
        for (uint32_t y = 0; y < camera->height; y++)
            for (uint32_t x = 0; x < camera->width; x++)
                if (is_within(g, x, y, light.position, radius))
                    hard_count(bench,
                               x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1,
                               usually(camera, light.position, radius, x, y));
    }
}

void hard_try_spheres(hard_bench *bench,
                      tl_gbuffer *g,
                      tl_light_set *lights,
                      hard_keeps *usually)
{
    count_pixels(bench, g, lights, usually);
    hard_light(bench, g, lights);
    tl_light_set_clear(lights);
    tl_gbuffer_destroy(g);
}

int hard_around_centre(
    const tl_camera *camera, const float centre[3], float radius, uint32_t x, uint32_t y)
{
    const long double depth = -(long double)centre[2];
    const ray r = ray_of(camera, x, y);
    return depth > 0.0L && fabsl(r.x - centre[0] / depth) <= radius / depth &&
           fabsl(r.y - centre[1] / depth) <= radius / depth;
}

static void add_spheres_through_the_eye(tl_light_set *lights,
                                        const tl_camera *camera,
                                        int count)
{
    uint32_t seed = 7;
    tl_error err;
    for (int i = 0; i < count; i++) {
        tl_light light = tl_light_default();
        const double view[3] = {(double)uniform(&seed, -1.0f, 1.0f),
                                (double)uniform(&seed, -1.0f, 1.0f),
                                (double)uniform(&seed, -1.0f, 1.0f)};
        const float radius =
            (float)sqrt(view[0] * view[0] + view[1] * view[1] + view[2] * view[2]);
        double world[3];
        tl_camera_world_point(camera, view, world);
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] = (float)world[axis];
        light.range = floats_beyond(radius, i % 3 - 1);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

void hard_camera_inside(hard_bench *bench)
{
    for (int view = 0; view < VIEW_COUNT; view++) {
        const tl_camera camera = view_of(view);
        tl_gbuffer *g = surfaces_between(&camera, camera.near, 3.0f);
        tl_light_set lights = {0};
        uint32_t seed = 1;
        for (uint32_t i = 0; i < 36; i++) {
            const float place[3] = {uniform(&seed, -1.0f, 1.0f), uniform(&seed, -1.0f, 1.0f),
                                    uniform(&seed, -0.2f, 1.0f)};
            add_light_at(&lights, g, random_rim(g, &seed, i), place);
        }
        add_spheres_through_the_eye(&lights, &camera, 24);
        hard_try_spheres(bench, g, &lights, hard_around_centre);
    }
}

void hard_small_rectangle(hard_bench *bench)
{
    for (int view = 0; view < VIEW_COUNT; view++) {
        const tl_camera camera = view_of(view);
        tl_gbuffer *g = surfaces_between(&camera, 1.0f, 9.0f);
        tl_light_set lights = {0};
        uint32_t seed = 2;
        for (uint32_t i = 0; i < 60; i++)
            add_light_around(&lights, g, random_rim(g, &seed, i), &seed,
                             uniform(&seed, 0.1f, 9.0f));
        hard_try_spheres(bench, g, &lights, hard_around_centre);
    }
}

/* [(int)low, (int)high): the pixel that `high` is in is lost. */
static int truncated(
    const tl_camera *camera, const float centre[3], float radius, uint32_t x, uint32_t y)
{
    const tl_interval seen = sphere_interval(
        (double)centre[0], -(double)centre[2], (double)radius, (double)camera->near,
        (double)camera->far, camera->projection == TL_ORTHOGRAPHIC);
    const double step = ((double)camera->right - (double)camera->left) / camera->width;
    (void)y;
    return (int)((seen.low - (double)camera->left) / step) <= (int)x &&
           (int)x < (int)((seen.high - (double)camera->left) / step);
}

/* Beside the pixel, at its depth, some pixels away: the sphere ends at the pixel's centre. */
static void add_light_beside(tl_light_set *lights, const tl_gbuffer *g, rim at, int pixels)
{
    const tl_camera *c = &g->camera;
    const vec3 p = position_at(g, at.x, at.y);
    const float step = (c->right - c->left) / (float)c->width;
    const float scale = c->projection == TL_ORTHOGRAPHIC ? 1.0f : -p.z;
    const float offset[3] = {(float)pixels * step * scale, 0.0f, 0.0f};
    const tl_light light = rim_light(g, at, offset);
    tl_error err;
    ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
}

void hard_scissor(hard_bench *bench)
{
    for (int view = 0; view <= VIEW_COUNT; view++) {
        const tl_camera camera = view < VIEW_COUNT
                                     ? view_of(view)
                                     : camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_ORTHOGRAPHIC);
        tl_gbuffer *g = surfaces_between(&camera, 4.0f, 4.0f);
        tl_light_set lights = {0};
        uint32_t seed = 3;
        for (uint32_t i = 0; i < 48; i++) {
            const int pixels = 1 + (int)(i % 9);
            add_light_beside(&lights, g, random_rim(g, &seed, i), i % 2 ? pixels : -pixels);
        }
        hard_try_spheres(bench, g, &lights, truncated);
    }
}

static int before_far(
    const tl_camera *camera, const float centre[3], float radius, uint32_t x, uint32_t y)
{
    (void)radius, (void)x, (void)y;
    return -centre[2] <= camera->far;
}

/* Depths and normals alone, which every layout holds. */
static tl_gbuffer *bare_copy(const tl_gbuffer *g)
{
    tl_gbuffer *bare = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&g->camera, TL_GROUP_BASE, &bare, &err), err);
    for (int p = TL_DEPTH; p <= TL_NORMAL_Z; p++)
        memcpy(tl_gbuffer_plane(bare, (enum tl_plane)p), tl_gbuffer_plane(g, (enum tl_plane)p),
               (size_t)g->pitch * g->rows * sizeof(float));
    return bare;
}

/* A surface on the far plane is one after packing, too. */
static void far_plane_is_no_sky(hard_bench *bench, const tl_gbuffer *g)
{
    tl_gbuffer *bare = bare_copy(g);
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++) {
        tl_gbuffer *packed = NULL, *again = NULL;
        tl_error err;
        ASSERT_OK(tl_gbuffer_pack(bare, (enum tl_layout_name)layout, &packed, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_unpack(packed, &again, &err), err);
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++)
                hard_count(bench,
                           isfinite(depth_at(again, x, y)) == isfinite(depth_at(g, x, y)), 1);
        tl_gbuffer_destroy(packed);
        tl_gbuffer_destroy(again);
    }
    tl_gbuffer_destroy(bare);
}

/* On the plane, or just before it, or farther before it. */
static tl_gbuffer *surfaces_at_far(const tl_camera *camera, float deepest)
{
    tl_gbuffer *g = surfaces_between(camera, 0.9f * deepest, 2.0f * deepest);
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++)
            if (depth_at(g, x, y) >= deepest && isfinite(depth_at(g, x, y)))
                set_pixel(g, TL_DEPTH, pixel_at(g, x, y),
                          floats_beyond(deepest, -(x % 2 == 1)));
    return g;
}

void hard_far_plane(hard_bench *bench)
{
    static const float fars[] = {20.0f, INFINITY, 1e4f};
    for (int i = 0; i < VIEW_COUNT; i++) {
        tl_camera camera = view_of(i);
        tl_light_set lights = {0};
        uint32_t seed = 5;
        camera.far = fars[i];
        const float deepest = isinf(camera.far) ? 1e6f : camera.far;
        tl_gbuffer *g = surfaces_at_far(&camera, deepest);
        for (uint32_t k = 0; k < 40; k++) {
            const float place[3] = {uniform(&seed, -0.5f, 0.5f) * deepest,
                                    uniform(&seed, -0.5f, 0.5f) * deepest,
                                    uniform(&seed, -1.3f, -0.7f) * deepest};
            add_light_at(&lights, g, random_rim(g, &seed, k), place);
        }
        if (isfinite(camera.far))
            far_plane_is_no_sky(bench, g);
        hard_try_spheres(bench, g, &lights, before_far);
    }
}

static int behind_near(
    const tl_camera *camera, const float centre[3], float radius, uint32_t x, uint32_t y)
{
    (void)radius, (void)x, (void)y;
    return -centre[2] >= camera->near;
}

/* On the plane, just behind it, or farther behind it. */
static tl_gbuffer *surfaces_at_near(const tl_camera *camera)
{
    tl_gbuffer *g = surfaces_between(camera, camera->near, 1.01f * camera->near);
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++)
            if (isfinite(depth_at(g, x, y)) && x % 3 < 2)
                set_pixel(g, TL_DEPTH, pixel_at(g, x, y),
                          floats_beyond(camera->near, (int)(x % 3)));
    return g;
}

void hard_near_gap(hard_bench *bench)
{
    for (int view = 0; view < VIEW_COUNT; view++) {
        const tl_camera camera = view_of(view);
        tl_gbuffer *g = surfaces_at_near(&camera);
        tl_light_set lights = {0};
        uint32_t seed = 6;
        for (uint32_t i = 0; i < 60; i++) {
            const float place[3] = {uniform(&seed, -0.1f, 0.1f), uniform(&seed, -0.1f, 0.1f),
                                    uniform(&seed, -1.1f, 0.1f) * camera.near};
            add_light_at(&lights, g, random_rim(g, &seed, i), place);
        }
        hard_try_spheres(bench, g, &lights, behind_near);
    }
}
