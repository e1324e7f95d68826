#include "ray_scene.h"

#include "model.h"
#include "try.h"

#include <embree3/rtcore.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What an alpha test needs of a draw. */
typedef struct masked {
    const tl_model *model;
    const tl_part *part;
    const tl_material *material;
    const tl_texels *texels; /* NULL: its base colour has no texture */
    uint32_t width, height;  /* of them, px */
    int wraps[2];            /* GL's words */
} masked;

struct ray_scene {
    tl_model *model;
    RTCDevice device;
    RTCScene scene;
    masked *draws;     /* [model->draw_count] */
    tl_texels *texels; /* [model->pixels_count]; decoded where a mask needs them */
};

/* --- holes ----------------------------------------------------------------------------------------- */

enum { CLAMPED = 33071, MIRRORED = 33648 };

static double wrapped(double t, int wrap)
{
    if (wrap == CLAMPED)
        return fmin(fmax(t, 0.0), 1.0);
    if (wrap == MIRRORED) {
        const double twice = t - 2.0 * floor(0.5 * t);
        return twice > 1.0 ? 2.0 - twice : twice;
    }
    return t - floor(t);
}

static double alpha_texel(const masked *m, long x, long y)
{
    const long width = (long)m->width, height = (long)m->height;
    const long column = m->wraps[0] == CLAMPED ? (x < 0        ? 0
                                                  : x >= width ? width - 1
                                                               : x)
                                               : ((x % width) + width) % width;
    const long row = m->wraps[1] == CLAMPED ? (y < 0         ? 0
                                               : y >= height ? height - 1
                                                             : y)
                                            : ((y % height) + height) % height;
    return m->texels->rgba[4 * (row * width + column) + 3] / 65535.0;
}

/* Bilinear, without mipmaps: capture may look at coarser ones, near the rims of holes. */
static double alpha_at(const masked *m, const double uv[2])
{
    const double x = wrapped(uv[0], m->wraps[0]) * m->width - 0.5;
    const double y = wrapped(uv[1], m->wraps[1]) * m->height - 0.5;
    const long column = (long)floor(x), row = (long)floor(y);
    const double fx = x - (double)column, fy = y - (double)row;
    return (alpha_texel(m, column, row) * (1.0 - fx) + alpha_texel(m, column + 1, row) * fx) *
               (1.0 - fy) +
           (alpha_texel(m, column, row + 1) * (1.0 - fx) +
            alpha_texel(m, column + 1, row + 1) * fx) *
               fy;
}

static const float *attribute_of(const masked *m,
                                 unsigned attribute,
                                 uint32_t vertex,
                                 size_t width)
{
    const float *values = m->model->vertices[m->part->vertices].attributes[attribute];
    return values ? values + vertex * width : NULL;
}

/* Where in the base colour's texture a triangle is hit. */
static void look_up_place(const masked *m,
                          const uint32_t corners[3],
                          const double at[3],
                          double uv[2])
{
    const tl_texture_slot *slot = &m->material->slots[TL_GLTF_BASE_COLOR];
    double st[2] = {0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        const float *of =
            attribute_of(m, TL_GLTF_TEXCOORD_0 + (unsigned)slot->coordinates, corners[k], 2);
        for (int i = 0; i < 2 && of; i++)
            st[i] += at[k] * (double)of[i];
    }
    for (int i = 0; i < 2; i++)
        uv[i] = (double)slot->uv_from_coordinates[i][0] * st[0] +
                (double)slot->uv_from_coordinates[i][1] * st[1] +
                (double)slot->uv_from_coordinates[i][2];
}

static bool is_hole(const masked *m, unsigned triangle, double u, double v)
{
    const uint32_t *corners = m->part->indices + 3 * (size_t)triangle;
    const double at[3] = {1.0 - u - v, u, v};
    double alpha = (double)m->material->base_color[3], uv[2], vertex = 0.0;
    for (int k = 0; k < 3; k++) {
        const float *color = attribute_of(m, TL_GLTF_COLOR, corners[k], 4);
        vertex += at[k] * (color ? (double)color[3] : 1.0);
    }
    if (m->texels) {
        look_up_place(m, corners, at, uv);
        alpha *= alpha_at(m, uv);
    }
    return alpha * vertex < (double)m->material->alpha_cutoff;
}

/* Rays come one at a time, whose hit is an RTCHit then. */
static void let_through(const struct RTCFilterFunctionNArguments *arguments)
{
    const masked *m = arguments->geometryUserPtr;
    const struct RTCHit *hit = (const struct RTCHit *)(const void *)arguments->hit;
    if (arguments->valid[0] != 0 && is_hole(m, hit->primID, (double)hit->u, (double)hit->v))
        arguments->valid[0] = 0;
}

static tl_status prepare_mask(ray_scene *s, size_t draw, tl_error *err)
{
    masked *m = &s->draws[draw];
    const tl_texture_slot *slot = &m->material->slots[TL_GLTF_BASE_COLOR];
    if (slot->texture == -1)
        return TL_OK;
    const tl_texture *texture = &s->model->textures[slot->texture];
    tl_texels *texels = &s->texels[texture->pixels];
    m->width = s->model->pixels[texture->pixels].width;
    m->height = s->model->pixels[texture->pixels].height;
    m->wraps[0] = texture->sampler.wrap_s;
    m->wraps[1] = texture->sampler.wrap_t;
    m->texels = texels;
    return texels->rgba ? TL_OK : tl_model_decode(s->model, texture->pixels, 1, texels, err);
}

/* --- triangles ------------------------------------------------------------------------------------- */

static void copy_vertices(const tl_vertices *from, const tl_affine *world, float *to)
{
    const float *positions = from->attributes[TL_GLTF_POSITION];
    for (size_t i = 0; i < from->count; i++) {
        const double local[3] = {(double)positions[3 * i], (double)positions[3 * i + 1],
                                 (double)positions[3 * i + 2]};
        double placed[3];
        tl_affine_point(world, local, placed);
        for (int k = 0; k < 3; k++)
            to[3 * i + (size_t)k] = (float)placed[k];
    }
}

static tl_status add_draw(ray_scene *s, size_t draw, tl_error *err)
{
    tl_status status = TL_OK;
    const tl_draw *of = &s->model->draws[draw];
    const tl_part *part = &s->model->parts[of->part];
    const tl_vertices *vertices = &s->model->vertices[part->vertices];
    masked *m = &s->draws[draw];
    if (part->index_count == 0)
        return TL_OK;
    *m = (masked){
        .model = s->model, .part = part, .material = &s->model->materials[part->material]};
    RTCGeometry geometry = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        3 * sizeof(float), vertices->count);
    uint32_t *indices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), part->index_count / 3);
    if (!to || !indices)
        TRY(tl_fail(err, TL_ERR_MEMORY, "no memory for the rays' triangles"));
    copy_vertices(vertices, &of->world, to);
    memcpy(indices, part->indices, part->index_count * sizeof *indices);
    if (m->material->alpha_cutoff > 0.0f) {
        TRY(prepare_mask(s, draw, err));
        rtcSetGeometryUserData(geometry, m);
        rtcSetGeometryOccludedFilterFunction(geometry, let_through);
        rtcSetGeometryIntersectFilterFunction(geometry, let_through);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(s->scene, geometry);
done:
    rtcReleaseGeometry(geometry);
    return status;
}

tl_status ray_scene_open(const char *path, ray_scene **out, tl_error *err)
{
    tl_status status = TL_OK;
    const tl_moment rest = {NULL, 0.0, false};
    ray_scene *s = calloc(1, sizeof *s);
    if (!s)
        return tl_fail(err, TL_ERR_MEMORY, "no memory for a scene of rays");
    TRY(tl_model_load(path, &rest, NULL, NULL, &s->model, err));
    s->draws = calloc(s->model->draw_count + 1, sizeof *s->draws);
    s->texels = calloc(s->model->pixels_count + 1, sizeof *s->texels);
    s->device = rtcNewDevice(NULL);
    if (!s->draws || !s->texels || !s->device)
        TRY(tl_fail(err, TL_ERR_DEVICE, "Embree does not start"));
    s->scene = rtcNewScene(s->device);
    rtcSetSceneFlags(s->scene, RTC_SCENE_FLAG_ROBUST);
    for (size_t i = 0; i < s->model->draw_count; i++)
        TRY(add_draw(s, i, err));
    rtcCommitScene(s->scene);
    *out = s;
    s = NULL;
done:
    ray_scene_close(s);
    return status;
}

void ray_scene_close(ray_scene *s)
{
    if (!s)
        return;
    if (s->scene)
        rtcReleaseScene(s->scene);
    if (s->device)
        rtcReleaseDevice(s->device);
    for (size_t i = 0; s->texels && i < s->model->pixels_count; i++)
        free(s->texels[i].rgba);
    free(s->texels);
    free(s->draws);
    tl_model_destroy(s->model);
    free(s);
}

static struct RTCRay ray_of(const double from[3],
                            const double direction[3],
                            double near,
                            double far)
{
    return (struct RTCRay){.org_x = (float)from[0],
                           .org_y = (float)from[1],
                           .org_z = (float)from[2],
                           .dir_x = (float)direction[0],
                           .dir_y = (float)direction[1],
                           .dir_z = (float)direction[2],
                           .tnear = (float)near,
                           .tfar = (float)far,
                           .mask = ~0u};
}

bool ray_scene_blocks(const ray_scene *s,
                      const double from[3],
                      const double direction[3],
                      double near,
                      double far)
{
    struct RTCIntersectContext context;
    struct RTCRay ray = ray_of(from, direction, near, far);
    rtcInitIntersectContext(&context);
    rtcOccluded1(s->scene, &context, &ray);
    return ray.tfar < 0.0f;
}

bool ray_scene_normal(const ray_scene *s,
                      const double from[3],
                      const double direction[3],
                      double near,
                      double far,
                      double normal[3])
{
    struct RTCIntersectContext context;
    struct RTCRayHit met = {.ray = ray_of(from, direction, near, far),
                            .hit.geomID = RTC_INVALID_GEOMETRY_ID};
    rtcInitIntersectContext(&context);
    rtcIntersect1(s->scene, &context, &met);
    const double across[3] = {(double)met.hit.Ng_x, (double)met.hit.Ng_y, (double)met.hit.Ng_z};
    double along = 0.0, square = 0.0;
    for (int i = 0; i < 3; i++) {
        along += across[i] * direction[i];
        square += across[i] * across[i];
    }
    if (met.hit.geomID == RTC_INVALID_GEOMETRY_ID || !(square > 0.0))
        return false;
    for (int i = 0; i < 3; i++)
        normal[i] = copysign(1.0 / sqrt(square), -along) * across[i];
    return true;
}
