#include "tilelight/gbuffer.h"

#include "aligned.h"
#include "packing.h"
#include "plane_shape.h"
#include "try.h"

#include <assert.h>
#include <stdlib.h>

const tl_plane_group tl_plane_groups[TL_PLANE_GROUP_COUNT] = {
    {"normal", TL_THREE(TL_NORMAL_X)},
    {"albedo", TL_THREE(TL_ALBEDO_R)},
    {"specular and shininess", TL_GROUP_PHONG},
    {"metallic and roughness", TL_GROUP_METAL_ROUGH},
    {"ao", TL_GROUP_OCCLUSION},
    {"emissive", TL_GROUP_EMISSIVE},
    {"brdf", TL_GROUP_BRDF},
    {"tangent", TL_GROUP_TANGENT},
};

uint32_t tl_samples_side(uint32_t samples)
{
    uint32_t side = 0;
    while (side * side < samples && samples <= TL_MAX_SAMPLES)
        side++;
    return side * side == samples ? side : 0;
}

tl_status tl_planes_check(uint32_t present, tl_error *err)
{
    if ((present & TL_GROUP_BASE) != TL_GROUP_BASE)
        return tl_fail(err, TL_ERR_ARGUMENT, "a G-buffer needs depth, normal and albedo");
    if (present >> TL_PLANE_COUNT)
        return tl_fail(err, TL_ERR_ARGUMENT, "a G-buffer has %d planes at most",
                       TL_PLANE_COUNT);
    if ((present & TL_GROUP_PHONG) && (present & TL_GROUP_METAL_ROUGH))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "a G-buffer holds specular and shininess or metallic and roughness, not "
                       "both: albedo means another colour in each");
    for (size_t i = 0; i < TL_PLANE_GROUP_COUNT; i++) {
        const uint32_t planes = tl_plane_groups[i].planes;
        if (planes == TL_GROUP_PHONG && (present & planes) == TL_HAS(TL_SHININESS) &&
            (present & TL_GROUP_BRDF))
            continue;
        if ((present & planes) && (present & planes) != planes)
            return tl_fail(err, TL_ERR_ARGUMENT, "a G-buffer with a part of %s needs all of it",
                           tl_plane_groups[i].name);
    }
    return TL_OK;
}

static tl_status allocate(tl_gbuffer *made, tl_error *err)
{
    const size_t size = (size_t)made->pitch * made->rows * tl_gbuffer_pixel_size(made);
    made->planes = tl_aligned_alloc(size);
    if (!made->planes)
        return tl_fail(err, TL_ERR_MEMORY,
                       "out of memory for a G-buffer of %u x %u pixels (%zu MB)",
                       made->camera.width, made->camera.height, size >> 20);
    return TL_OK;
}

static void fill_with_sky(const tl_gbuffer *made)
{
    const tl_word_planes planes = tl_word_planes_of(made);
    const tl_words sky = tl_sky_words(&made->camera, made->layout, made->present);
    for (size_t at = 0; at < (size_t)made->pitch * made->rows; at++)
        tl_words_put(&planes, at, sky);
}

tl_status tl_gbuffer_create_packed(const tl_camera *camera,
                                   enum tl_layout_name layout,
                                   uint32_t present,
                                   tl_gbuffer **out,
                                   tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;

    TRY(tl_camera_check(camera, err));
    TRY(tl_planes_check(present, err));
    TRY(tl_layout_suits(camera, layout, err));
    assert((present & ~tl_layout_planes(layout)) == 0);
    made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a G-buffer"));
    made->camera = *camera;
    made->samples = 1;
    made->layout = layout;
    made->present = present;
    made->pitch = tl_plane_pitch(camera->width);
    made->rows = tl_plane_rows(camera->height);
    if (TL_IS_POSITION(tl_layouts[layout].depth.code))
        made->slack_x = made->slack_y = INFINITY;
    TRY(allocate(made, err));
    fill_with_sky(made);
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}

tl_status tl_gbuffer_create(const tl_camera *camera,
                            uint32_t present,
                            tl_gbuffer **out,
                            tl_error *err)
{
    return tl_gbuffer_create_packed(camera, TL_LAYOUT_FLOAT, present, out, err);
}

void tl_gbuffer_destroy(tl_gbuffer *gbuffer)
{
    if (!gbuffer)
        return;
    tl_material_names_clear(&gbuffer->materials);
    tl_shadow_maps_clear(&gbuffer->shadows);
    tl_layers_clear(&gbuffer->layers);
    free(gbuffer->opacity);
    free(gbuffer->ids);
    tl_objects_clear(&gbuffer->objects);
    free(gbuffer->planes);
    free(gbuffer);
}

const tl_gbuffer *tl_gbuffer_owner(const tl_gbuffer *gbuffer)
{
    return gbuffer->layer_of ? gbuffer->layer_of : gbuffer;
}

uint32_t tl_gbuffer_word_size(const tl_gbuffer *gbuffer, uint32_t index)
{
    const tl_layout *layout = &tl_layouts[gbuffer->layout];
    return index < layout->word_count ? word_bytes(layout, gbuffer->present, index) : 0;
}

/* Of the words before `end`. */
static uint32_t size_before(const tl_gbuffer *gbuffer, uint32_t end)
{
    uint32_t size = 0;
    for (uint32_t i = 0; i < end; i++)
        size += tl_gbuffer_word_size(gbuffer, i);
    return size;
}

uint32_t tl_gbuffer_pixel_size(const tl_gbuffer *gbuffer)
{
    return size_before(gbuffer, TL_MAX_WORDS);
}

void *tl_gbuffer_words(const tl_gbuffer *gbuffer, uint32_t index)
{
    const size_t pixels = (size_t)gbuffer->pitch * gbuffer->rows;
    if (tl_gbuffer_word_size(gbuffer, index) == 0)
        return NULL;
    return gbuffer->planes + pixels * size_before(gbuffer, index);
}

float *tl_gbuffer_plane(const tl_gbuffer *gbuffer, enum tl_plane plane)
{
    assert(gbuffer->layout == TL_LAYOUT_FLOAT);
    return tl_gbuffer_words(gbuffer, plane);
}
