/* The panes of data/panes.gltf, captured, and what rays through them say in double.
 *
 * Rays tell nothing of pixels whose centre is so near to a pane's edge that the rasteriser's grid of 1/256 px
 * decides, nor where two panes cross within the rounding of a depth. */
#ifndef TL_PANE_SCENES_H
#define TL_PANE_SCENES_H

#include "edited_gltf.h"
#include "frames.h"

#include "tilelight/capture.h"

enum { PANES_WIDTH = 320, PANES_HEIGHT = 180, MOST_SHEETS = 32 };

static const double near_edge = 1.0 / 64; /* px */
static const double near_depth = 2e-6; /* of a depth: a few roundings of it and of its plane */
static const double pane_tolerance = 1e-5; /* of radiance, up to 1 */
static const float sky[3] = {0.2f, 0.35f, 0.6f};

/* A parallelogram of the scene: a unit square, placed. */
typedef struct sheet {
    double axes[3][3]; /* right, up, towards its front; of unit length */
    double center[3], size[2];
    double color[3], alpha;
    int blends;
} sheet;

typedef struct scene {
    sheet of[MOST_SHEETS];
    size_t count;
} scene;

/* What a ray meets. */
typedef struct hit {
    double depth;
    const sheet *at;
} hit;

static inline void numbers(const json_t *array, size_t count, double *out)
{
    for (size_t i = 0; i < count; i++)
        out[i] = json_number_value(json_array_get(array, i));
}

static inline void turn(const double q[4], double axes[3][3])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double n = 2.0 / (x * x + y * y + z * z + w * w);
    const double m[3][3] = {
        {1 - n * (y * y + z * z), n * (x * y + w * z), n * (x * z - w * y)},
        {n * (x * y - w * z), 1 - n * (x * x + z * z), n * (y * z + w * x)},
        {n * (x * z + w * y), n * (y * z - w * x), 1 - n * (x * x + y * y)}};
    memcpy(axes, m, sizeof m);
}

static inline scene scene_of(const edited_gltf *of)
{
    scene s = {.count = 0};
    size_t i;
    json_t *node;
    json_array_foreach(json_object_get(of->json, "nodes"), i, node)
    {
        const json_t *material = gltf_material_of(of, node);
        double rotation[4], color[4];
        if (!material)
            continue;
        sheet *to = &s.of[s.count++];
        assert_true(s.count <= MOST_SHEETS);
        numbers(json_object_get(node, "translation"), 3, to->center);
        numbers(json_object_get(node, "scale"), 2, to->size);
        numbers(json_object_get(node, "rotation"), 4, rotation);
        turn(rotation, to->axes);
        numbers(json_object_get(json_object_get(material, "pbrMetallicRoughness"),
                                "baseColorFactor"),
                4, color);
        memcpy(to->color, color, sizeof to->color);
        to->alpha = color[3];
        to->blends = gltf_blends(material);
    }
    return s;
}

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ray: at depth 1. 0: it passes by. */
static inline int meets(const sheet *s, const double ray[3], double *depth)
{
    double from_center[3];
    *depth = dot(s->axes[2], s->center) / dot(s->axes[2], ray);
    for (int i = 0; i < 3; i++)
        from_center[i] = *depth * ray[i] - s->center[i];
    return fabs(dot(s->axes[0], from_center)) < 0.5 * s->size[0] &&
           fabs(dot(s->axes[1], from_center)) < 0.5 * s->size[1];
}

static inline void ray_of(const tl_camera *c, double x, double y, double out[3])
{
    const double left = (double)c->left, top = (double)c->top;
    out[0] = left + x / c->width * ((double)c->right - left);
    out[1] = top + y / c->height * ((double)c->bottom - top);
    out[2] = -1.0;
}

static inline int nearer(const void *a, const void *b)
{
    const double x = ((const hit *)a)->depth, y = ((const hit *)b)->depth;
    return (x > y) - (x < y);
}

/* Whether the ray around pixel (x, y) tells what is seen there: *count of *hits, nearest first, up to what
 * hides all behind it. */
static inline int look(
    const scene *s, const tl_camera *c, uint32_t x, uint32_t y, hit *hits, size_t *count)
{
    static const double around[5][2] = {{0, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    int is_clear = 1;
    *count = 0;
    for (size_t i = 0; i < s->count; i++) {
        int met[5];
        double depth[5], ray[3];
        for (int k = 0; k < 5; k++) {
            ray_of(c, x + 0.5 + near_edge * around[k][0], y + 0.5 + near_edge * around[k][1],
                   ray);
            met[k] = meets(&s->of[i], ray, &depth[k]);
            is_clear &= met[k] == met[0];
        }
        if (met[0])
            hits[(*count)++] = (hit){depth[0], &s->of[i]};
    }
    qsort(hits, *count, sizeof *hits, nearer);
    for (size_t i = 0; i + 1 < *count; i++)
        is_clear &= hits[i + 1].depth - hits[i].depth > near_depth * hits[i].depth;
    for (size_t i = 0; i < *count; i++)
        if (!hits[i].at->blends)
            *count = i + 1;
    return is_clear;
}

static inline void blend(const hit *hits, size_t count, double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = (double)sky[c];
    for (size_t i = count; i-- > 0;) {
        const double alpha = hits[i].at->blends ? hits[i].at->alpha : 1.0;
        for (int c = 0; c < 3; c++)
            out[c] = alpha * hits[i].at->color[c] + (1.0 - alpha) * out[c];
    }
}

static inline char *panes_path(void)
{
    const char *source = getenv("TILELIGHT_SOURCE");
    char *path = NULL;
    assert_true(asprintf(&path, "%s/data/panes.gltf", source ? source : ".") > 0);
    return path;
}

static inline tl_gbuffer *captured(const char *path, uint32_t layers)
{
    const tl_capture_options options = {
        .width = PANES_WIDTH, .height = PANES_HEIGHT, .layers = layers};
    tl_gbuffer *made = NULL;
    tl_light_set lights = {0};
    tl_error err;
    ASSERT_OK(tl_capture(path, &options, &made, &lights, NULL, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(made, path, true, NULL, &err), err);
    tl_light_set_clear(&lights);
    return made;
}

static inline tl_image *lit(const tl_gbuffer *gbuffer)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_light_set lights = {0};
    tl_image *image = image_like(gbuffer);
    options.precision = TL_PRECISION_TWIN;
    memcpy(lights.sky, sky, sizeof lights.sky);
    light_frame(NULL, &options, gbuffer, &lights, image);
    return image;
}

#endif
