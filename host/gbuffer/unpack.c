#include "packing.h"

#include "parallel.h"
#include "try.h"

#include <string.h>

/* The rotation's rows are orthonormal, so its inverse is its transpose. */
static vec3 world_direction(const tl_frame *frame, vec3 view)
{
    vec3 w = {0.0f, 0.0f, 0.0f};
    real *const to[3] = {&w.x, &w.y, &w.z};
    for (int i = 0; i < 3; i++)
        *to[i] = fmaf(
            frame->view_from_world[0][i], view.x,
            fmaf(frame->view_from_world[1][i], view.y, frame->view_from_world[2][i] * view.z));
    return w;
}

static void put(float *const to[TL_PLANE_COUNT], int plane, size_t at, real value)
{
    if (to[plane])
        to[plane][at] = value;
}

static void put_three(float *const to[TL_PLANE_COUNT], int first, size_t at, vec3 v)
{
    put(to, first, at, v.x);
    put(to, first + 1, at, v.y);
    put(to, first + 2, at, v.z);
}

static void put_pixel(float *const to[TL_PLANE_COUNT], size_t at, pixel p)
{
    put(to, TL_DEPTH, at, p.depth);
    put_three(to, TL_NORMAL_X, at, p.normal);
    put_three(to, TL_ALBEDO_R, at, p.albedo);
    put_three(to, TL_SPECULAR_R, at, p.specular);
    put_three(to, TL_EMISSIVE_R, at, p.emissive);
    put(to, TL_SHININESS, at, p.shininess);
    put(to, TL_METALLIC, at, p.metallic);
    put(to, TL_ROUGHNESS, at, p.roughness);
    put(to, TL_OCCLUSION, at, p.occlusion);
    put(to, TL_BRDF, at, p.brdf);
    put_three(to, TL_TANGENT_X, at, p.tangent);
}

tl_unpacking tl_unpacking_of(const tl_gbuffer *from)
{
    tl_unpacking made = {.from = from,
                         .words = tl_word_planes_of(from),
                         .needs = {.present = from->present,
                                   .orthographic = from->camera.projection == TL_ORTHOGRAPHIC,
                                   .window = (tl_u32)tl_camera_is_moved(&from->camera),
                                   .layout = from->layout}};
    tl_view_set(&from->camera, from->layout, &made.frame);
    return made;
}

void tl_unpack_span(const tl_unpacking *u,
                    uint32_t row,
                    uint32_t begin,
                    uint32_t end,
                    float *const to[TL_PLANE_COUNT])
{
    const tl_layout *layout = u->words.layout;
    for (uint32_t column = begin; column < end; column++) {
        const tl_words words = tl_words_at(&u->words, (size_t)row * u->from->pitch + column);
        const vec3 position =
            position_of(&u->frame, u->needs, layout, &words, (real)column, (real)row);
        pixel p = pixel_of(u->needs, layout, &words, -position.z);
        if (layout->normal_space == TL_NORMALS_IN_VIEW)
            p.normal = world_direction(&u->frame, p.normal);
        put_pixel(to, column - begin, p);
    }
}

typedef struct job {
    tl_unpacking unpacking;
    tl_gbuffer *to;
} job;

static void unpack_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t row = begin; row < end; row++) {
        float *to[TL_PLANE_COUNT];
        for (int p = 0; p < TL_PLANE_COUNT; p++) {
            float *plane = tl_gbuffer_plane(j->to, (enum tl_plane)p);
            to[p] = plane ? plane + row * j->to->pitch : NULL;
        }
        tl_unpack_span(&j->unpacking, (uint32_t)row, 0, j->to->camera.width, to);
    }
}

static void unpack_surface(const tl_gbuffer *from, tl_gbuffer *to)
{
    job j = {.unpacking = tl_unpacking_of(from), .to = to};
    to->knows_indices = from->knows_indices;
    memcpy(to->indices, from->indices, sizeof from->indices);
    tl_parallel(to->camera.height, 4, unpack_rows, &j);
}

static tl_status unpack_layers(const tl_gbuffer *from, tl_gbuffer *to, tl_error *err)
{
    tl_status status = TL_OK;
    to->layers.left = from->layers.left;
    for (uint32_t i = 0; i < from->layers.count; i++) {
        tl_gbuffer *layer = NULL;
        TRY(tl_layers_add(to, &layer, err));
        tl_layer_copy_opacity(from->layers.of[i], layer);
        TRY(tl_ids_copy(from->layers.of[i], layer, err));
        unpack_surface(from->layers.of[i], layer);
    }
done:
    return status;
}

tl_status tl_gbuffer_unpack(const tl_gbuffer *from, tl_gbuffer **out, tl_error *err)
{
    tl_gbuffer *made = NULL;
    tl_status status = TL_OK;
    TRY(tl_gbuffer_create(&from->camera, from->present, &made, err));
    made->samples = from->samples;
    TRY(tl_material_names_copy(&from->materials, &made->materials, err));
    TRY(tl_ids_copy(from, made, err));
    TRY(tl_shadow_maps_copy(&from->shadows, &made->shadows, err));
    unpack_surface(from, made);
    TRY(unpack_layers(from, made, err));
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}
