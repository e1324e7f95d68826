#include "packing.h"

#include "parallel.h"
#include "try.h"

typedef struct job {
    const tl_gbuffer *from;
    tl_word_planes words;          /* of `from` */
    float *planes[TL_PLANE_COUNT]; /* of what is made */
    tl_frame frame;
    tl_needs needs;
} job;

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

static void put(const job *j, int plane, size_t at, real value)
{
    if (j->planes[plane])
        j->planes[plane][at] = value;
}

static void put_three(const job *j, int first, size_t at, vec3 v)
{
    put(j, first, at, v.x);
    put(j, first + 1, at, v.y);
    put(j, first + 2, at, v.z);
}

static void put_pixel(const job *j, size_t at, pixel p)
{
    put(j, TL_DEPTH, at, p.depth);
    put_three(j, TL_NORMAL_X, at, p.normal);
    put_three(j, TL_ALBEDO_R, at, p.albedo);
    put_three(j, TL_SPECULAR_R, at, p.specular);
    put_three(j, TL_EMISSIVE_R, at, p.emissive);
    put(j, TL_SHININESS, at, p.shininess);
    put(j, TL_METALLIC, at, p.metallic);
    put(j, TL_ROUGHNESS, at, p.roughness);
    put(j, TL_OCCLUSION, at, p.occlusion);
}

static void unpack_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    const tl_layout *layout = j->words.layout;
    for (size_t row = begin; row < end; row++)
        for (size_t column = 0; column < j->from->camera.width; column++) {
            const size_t at = row * j->from->pitch + column;
            const tl_words words = tl_words_at(&j->words, at);
            const vec3 position =
                position_of(&j->frame, j->needs, layout, &words, (real)column, (real)row);
            pixel p = pixel_of(j->needs, layout, &words, -position.z);
            if (layout->normal_space == TL_NORMALS_IN_VIEW)
                p.normal = world_direction(&j->frame, p.normal);
            put_pixel(j, at, p);
        }
}

tl_status tl_gbuffer_unpack(const tl_gbuffer *from, tl_gbuffer **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;
    job j = {.from = from,
             .words = tl_word_planes_of(from),
             .needs = {.present = from->present,
                       .orthographic = from->camera.projection == TL_ORTHOGRAPHIC,
                       .layout = from->layout}};
    TRY(tl_gbuffer_create(&from->camera, from->present, &made, err));
    tl_view_set(&from->camera, from->layout, &j.frame);
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        j.planes[p] = tl_gbuffer_plane(made, (enum tl_plane)p);
    tl_parallel(made->camera.height, 4, unpack_rows, &j);
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}
