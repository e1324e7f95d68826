#define TL_REAL_DOUBLE 1
#include "packing_setup.h"

#include "float_pixel.h"
#include "packing.h"
#include "parallel.h"
#include "plane_values.h"
#include "try.h"

#include <stdatomic.h>
#include <string.h>

typedef struct job {
    const tl_gbuffer *from, *to;
    float *planes[TL_PLANE_COUNT]; /* of `from` */
    tl_word_planes words;          /* of `to` */
    tl_packing packing;            /* what is the same for every pixel */
    bool to_phong;
    atomic_ullong cut[TL_PLANE_COUNT];
} job;

tl_packing tl_packing_of(const tl_camera *camera,
                         enum tl_layout_name layout,
                         uint32_t present,
                         tl_frame *frame)
{
    tl_view_set(camera, layout, frame);
    return (tl_packing){.layout = &tl_layouts[layout],
                        .frame = frame,
                        .needs = {.present = present,
                                  .orthographic = camera->projection == TL_ORTHOGRAPHIC,
                                  .window = (tl_u32)tl_camera_is_moved(camera),
                                  .layout = layout},
                        .near = (double)camera->near,
                        .far = (double)camera->far};
}

tl_words tl_sky_words(const tl_camera *camera, enum tl_layout_name layout, uint32_t present)
{
    tl_frame frame = {.tile_size = 0};
    tl_packing packing = tl_packing_of(camera, layout, present, &frame);
    const pixel sky = {.depth = (real)tl_plane_empty[TL_DEPTH],
                       .occlusion = (real)tl_plane_empty[TL_OCCLUSION]};
    pack_pixel(&packing, sky, 0.0, 0.0);
    return packing.words;
}

static pixel phong_of(pixel p)
{
    const phong_material m = phong_of_metal_rough(p.albedo, p.metallic, p.roughness);
    p.albedo = m.diffuse;
    p.specular = m.specular;
    p.shininess = m.shininess;
    return p;
}

static void pack_rows(void *context, size_t begin, size_t end)
{
    job *j = context;
    unsigned long long cut[TL_PLANE_COUNT] = {0};
    for (size_t row = begin; row < end; row++)
        for (size_t column = 0; column < j->to->camera.width; column++) {
            const size_t at = row * j->to->pitch + column;
            const pixel given = pixel_at(j->planes, at);
            tl_packing packing = j->packing;
            pack_pixel(&packing, j->to_phong ? phong_of(given) : given, (real)column,
                       (real)row);
            tl_words_put(&j->words, at, packing.words);
            for (int p = 0; p < TL_PLANE_COUNT; p++)
                cut[p] += packing.cut >> p & 1u;
        }
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        atomic_fetch_add(&j->cut[p], cut[p]);
}

/* `made`, of the layout and planes of choice, becomes what `from` is; *sum is raised by what was lost and
 * cut. */
static tl_status pack_surface(const tl_gbuffer *from,
                              bool to_phong,
                              tl_gbuffer *made,
                              tl_packing_report *sum,
                              tl_error *err)
{
    tl_frame frame = {.tile_size = 0};
    tl_repairs repairs = {0};
    job j = {.from = from, .to = made, .to_phong = to_phong, .words = tl_word_planes_of(made)};
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        j.planes[p] = tl_gbuffer_plane(from, (enum tl_plane)p);
    j.packing = tl_packing_of(&made->camera, made->layout, made->present, &frame);
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        atomic_init(&j.cut[p], 0);
    tl_parallel(made->camera.height, 4, pack_rows, &j);
    const tl_status status =
        tl_gbuffer_repair(made, tl_layout_word(made->layout), false, &repairs, err);
    sum->lost += repairs.depth;
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        sum->cut[p] += atomic_load(&j.cut[p]);
    return status;
}

static tl_status pack_layers(const tl_gbuffer *from,
                             bool to_phong,
                             tl_gbuffer *made,
                             tl_packing_report *sum,
                             tl_error *err)
{
    tl_status status = TL_OK;
    made->layers.left = from->layers.left;
    for (uint32_t i = 0; i < from->layers.count; i++) {
        tl_gbuffer *layer = NULL;
        TRY(tl_layers_add(made, &layer, err));
        tl_layer_copy_opacity(from->layers.of[i], layer);
        TRY(tl_ids_copy(from->layers.of[i], layer, err));
        TRY(pack_surface(from->layers.of[i], to_phong, layer, sum, err));
    }
done:
    return status;
}

static const uint32_t materials = TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH;

tl_status tl_gbuffer_pack(const tl_gbuffer *from,
                          enum tl_layout_name layout,
                          tl_gbuffer **out,
                          tl_packing_report *report,
                          tl_error *err)
{
    const uint32_t can_hold = tl_layout_planes(layout);
    const bool to_phong =
        (from->present & TL_GROUP_METAL_ROUGH) && !(can_hold & TL_GROUP_METAL_ROUGH);
    const uint32_t offered =
        to_phong ? (from->present & ~materials) | TL_GROUP_PHONG : from->present;
    const uint32_t stored = tl_layout_planes_of(layout, offered);
    tl_packing_report sum = {.dropped = offered & ~stored};
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;

    if ((from->present & TL_GROUP_PHONG) && !(can_hold & TL_GROUP_PHONG) &&
        (can_hold & TL_GROUP_METAL_ROUGH))
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "layout %s holds metallic and roughness, this G-buffer has specular and "
                    "shininess, which they cannot say",
                    tl_layout_word(layout)));
    TRY(tl_gbuffer_create_packed(&from->camera, layout, stored, &made, err));
    made->samples = from->samples;
    TRY(tl_material_names_copy(&from->materials, &made->materials, err));
    TRY(tl_ids_copy(from, made, err));
    TRY(tl_shadow_maps_copy(&from->shadows, &made->shadows, err));
    TRY(pack_surface(from, to_phong, made, &sum, err));
    TRY(pack_layers(from, to_phong, made, &sum, err));
    if (report)
        *report = sum;
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}
