#include "ray_cast.h"

#include "parallel.h"
#include "tilelight/bounds.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

static const double eye_height = 1.7; /* m */
/* Edges of the view as tangents: 60 degrees high, off-centre, so that less of it is sky. */
static const double view_top = 0.35, view_bottom = -0.80;

typedef struct sphere {
    double center[3], radius; /* view space, m */
    tl_pixel_rect rect;
} sphere;

typedef struct cast {
    const tl_bench_scene *scene;
    tl_gbuffer *gbuffer;
    float *planes[TL_PLANE_COUNT]; /* NULL where absent */
    sphere *spheres;               /* [scene->sphere_count] */
} cast;

/* A number in [0, 1): the fractions of multiples of an irrational, which fill an interval evenly
 * (Weyl 1916). Roots of primes for axes that are to be independent. */
static double spread(uint32_t index, double irrational)
{
    const double x = ((double)index + 1.0) * irrational;
    return x - floor(x);
}

static double between(double low, double high, double share)
{
    return low + (high - low) * share;
}

static void put(const cast *c, int plane, size_t at, double value)
{
    if (c->planes[plane])
        c->planes[plane][at] = (float)value;
}

/* What the surface with this number is made of. A quarter is metal, an eighth shines by itself. */
static void write_material(const cast *c, size_t at, uint32_t number)
{
    const double glow = number % 8 == 7 ? 0.3 : 0.0;
    for (int i = 0; i < 3; i++) {
        const uint32_t k = 3 * number + (uint32_t)i;
        put(c, TL_ALBEDO_R + i, at, between(0.15, 0.9, spread(k, 0.7320508075688772)));
        put(c, TL_SPECULAR_R + i, at, between(0.04, 0.5, spread(number, 0.2360679774997898)));
        put(c, TL_EMISSIVE_R + i, at, glow * spread(k, 0.7320508075688772));
    }
    put(c, TL_SHININESS, at, 8.0 * exp2(5.0 * spread(number, 0.6457513110645906))); /* to 256 */
    put(c, TL_METALLIC, at, number % 4 == 3 ? 1.0 : 0.0);
    put(c, TL_ROUGHNESS, at, between(0.3, 0.9, spread(number, 0.6457513110645906)));
    put(c, TL_OCCLUSION, at, between(0.5, 1.0, spread(number, 0.2360679774997898)));
}

/* The point x, y, z (view space) of a surface with unit normal n (the same in world space: the camera
 * is not turned), which the bumps lean. */
static void write_surface(
    const cast *c, size_t at, const double p[3], const double n[3], uint32_t number)
{
    double leaning[3], length2 = 0.0;
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        leaning[i] = n[i] + c->scene->bump * 0.57 * sin(9.0 * p[next] + (double)i);
        length2 += leaning[i] * leaning[i];
    }
    for (int i = 0; i < 3; i++)
        c->planes[TL_NORMAL_X + i][at] = (float)(leaning[i] / sqrt(length2));
    c->planes[TL_DEPTH][at] = (float)-p[2];
    write_material(c, at, number);
}

/* Along the pixel's ray, depth 1. */
static void ray_of(const cast *c, uint32_t column, uint32_t row, double ray[3])
{
    const tl_camera *camera = &c->gbuffer->camera;
    ray[0] = between((double)camera->left, (double)camera->right,
                     ((double)column + 0.5) / camera->width);
    ray[1] = between((double)camera->top, (double)camera->bottom,
                     ((double)row + 0.5) / camera->height);
    ray[2] = -1.0;
}

static void cast_planes(const cast *c, uint32_t row)
{
    static const double up[3] = {0, 1, 0}, towards[3] = {0, 0, 1};
    const tl_bench_scene *scene = c->scene;
    for (uint32_t column = 0; column < c->gbuffer->camera.width; column++) {
        double ray[3];
        ray_of(c, column, row, ray);
        const double floor_depth = ray[1] < 0.0 ? -eye_height / ray[1] : HUGE_VAL;
        const int on_floor = floor_depth < scene->floor_end;
        const int on_wall = scene->wall > 0.0 && !(on_floor && floor_depth < scene->wall);
        const double depth = on_wall ? scene->wall : floor_depth;
        const double p[3] = {ray[0] * depth, ray[1] * depth, -depth};
        if (on_wall || on_floor)
            write_surface(c, (size_t)row * c->gbuffer->pitch + column, p,
                          on_wall ? towards : up, on_wall ? 1 : 0);
    }
}

/* The nearer of the two points where the ray meets the sphere, by Vieta: the depth d of
 * |d ray - center| = radius. */
static void cast_sphere(const cast *c, uint32_t number, uint32_t column, uint32_t row)
{
    const sphere *s = &c->spheres[number];
    const size_t at = (size_t)row * c->gbuffer->pitch + column;
    double ray[3], a = 0.0, half_b = 0.0, power = -s->radius * s->radius;
    ray_of(c, column, row, ray);
    for (int i = 0; i < 3; i++) {
        a += ray[i] * ray[i];
        half_b += ray[i] * s->center[i];
        power += s->center[i] * s->center[i];
    }
    const double discriminant = half_b * half_b - a * power;
    if (discriminant < 0.0 || half_b <= 0.0 || power <= 0.0)
        return;
    const double depth = power / (half_b + sqrt(discriminant));
    if (depth >= (double)c->planes[TL_DEPTH][at])
        return;
    double p[3], n[3];
    for (int i = 0; i < 3; i++) {
        p[i] = ray[i] * depth;
        n[i] = (p[i] - s->center[i]) / s->radius;
    }
    write_surface(c, at, p, n, number + 2);
}

static void cast_rows(void *context, size_t begin, size_t end)
{
    const cast *c = context;
    for (size_t row = begin; row < end; row++)
        cast_planes(c, (uint32_t)row);
    for (uint32_t number = 0; number < c->scene->sphere_count; number++) {
        const tl_pixel_rect rect = c->spheres[number].rect;
        const size_t first = rect.y0 > begin ? rect.y0 : begin;
        for (size_t row = first; row < end && row < rect.y1; row++)
            for (uint32_t column = rect.x0; column < rect.x1; column++)
                cast_sphere(c, number, column, (uint32_t)row);
    }
}

static void place_spheres(const cast *c)
{
    static const double irrationals[3] = {0.8191725133961645, 0.6710436067037893,
                                          0.5497004779019703}; /* Roberts 2018, three axes */
    const tl_bench_scene *scene = c->scene;
    for (uint32_t i = 0; i < scene->sphere_count; i++) {
        sphere *s = &c->spheres[i];
        float center[3];
        for (int axis = 0; axis < 3; axis++) {
            s->center[axis] =
                between(scene->low[axis], scene->high[axis], spread(i, irrationals[axis])) -
                (axis == 1 ? eye_height : 0.0);
            center[axis] = (float)s->center[axis];
        }
        s->radius =
            between(scene->least_radius, scene->most_radius, spread(i, 0.3166247903554));
        tl_sphere_bounds(&c->gbuffer->camera, center, (float)(s->radius * (1.0 + 1e-5)),
                         &s->rect);
    }
}

static tl_camera camera_of(uint32_t width, uint32_t height)
{
    const double wide =
        height > 0 ? 0.5 * (view_top - view_bottom) * (double)width / (double)height : 1.0;
    return (tl_camera){
        .projection = TL_PERSPECTIVE,
        .width = width,
        .height = height,
        .left = (float)-wide,
        .right = (float)wide,
        .bottom = (float)view_bottom,
        .top = (float)view_top,
        .near = 0.1f,
        .far = 1000.0f, /* beyond all surfaces; finite for layouts that store shares of it */
        .view_from_world = {{1, 0, 0, 0}, {0, 1, 0, (float)-eye_height}, {0, 0, 1, 0}}};
}

tl_status tl_ray_cast(const tl_bench_scene *scene,
                      uint32_t present,
                      uint32_t width,
                      uint32_t height,
                      tl_gbuffer **out,
                      tl_error *err)
{
    tl_status status = TL_OK;
    const tl_camera camera = camera_of(width, height);
    cast c = {.scene = scene};
    TRY(tl_gbuffer_create(&camera, present, &c.gbuffer, err));
    for (int plane = 0; plane < TL_PLANE_COUNT; plane++)
        c.planes[plane] = tl_gbuffer_plane(c.gbuffer, (enum tl_plane)plane);
    c.spheres = calloc(scene->sphere_count + 1u, sizeof *c.spheres);
    if (!c.spheres)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a bench scene"));
    place_spheres(&c);
    tl_parallel(height, 1, cast_rows, &c);
    *out = c.gbuffer;
    c.gbuffer = NULL;
done:
    free(c.spheres);
    tl_gbuffer_destroy(c.gbuffer);
    return status;
}
