#include "tilelight/gbuffer.h"

#include "aligned.h"
#include "plane_shape.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

/* Groups that a frame has whole or not at all. */
static const struct {
    const char *name;
    uint32_t planes;
} groups[] = {
    {"normal", TL_THREE(TL_NORMAL_X)},
    {"albedo", TL_THREE(TL_ALBEDO_R)},
    {"specular and shininess", TL_GROUP_PHONG},
    {"metallic and roughness", TL_GROUP_METAL_ROUGH},
    {"emissive", TL_GROUP_EMISSIVE},
};

static const float empty_values[TL_PLANE_COUNT] = {
#define EMPTY_VALUE(name, channel, empty, meaning) [name] = empty,
    TL_PLANES(EMPTY_VALUE)
#undef EMPTY_VALUE
};

static tl_status check_planes(uint32_t present, tl_error *err)
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
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++)
        if ((present & groups[i].planes) && (present & groups[i].planes) != groups[i].planes)
            return tl_fail(err, TL_ERR_ARGUMENT, "a G-buffer with a part of %s needs all of it",
                           groups[i].name);
    return TL_OK;
}

tl_status tl_gbuffer_create(const tl_camera *camera,
                            uint32_t present,
                            tl_gbuffer **out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;

    TRY(tl_camera_check(camera, err));
    TRY(check_planes(present, err));
    made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a G-buffer"));
    made->camera = *camera;
    made->present = present;
    made->pitch = tl_plane_pitch(camera->width);
    made->rows = tl_plane_rows(camera->height);

    const size_t plane_count = (size_t)__builtin_popcount(present);
    const size_t plane = (size_t)made->pitch * made->rows;
    made->planes = tl_aligned_alloc(plane_count * plane * sizeof(float));
    if (!made->planes)
        TRY(tl_fail(err, TL_ERR_MEMORY,
                    "out of memory for a G-buffer of %u x %u pixels (%zu MB)", camera->width,
                    camera->height, plane_count * plane * sizeof(float) >> 20));
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++) {
        float *values = tl_gbuffer_plane(made, p);
        for (size_t i = 0; values && i < plane; i++)
            values[i] = empty_values[p];
    }
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}

void tl_gbuffer_destroy(tl_gbuffer *gbuffer)
{
    if (!gbuffer)
        return;
    free(gbuffer->planes);
    free(gbuffer);
}

float *tl_gbuffer_plane(const tl_gbuffer *gbuffer, enum tl_plane plane)
{
    const size_t size = (size_t)gbuffer->pitch * gbuffer->rows;
    if (!(gbuffer->present & TL_HAS(plane)))
        return NULL;
    return gbuffer->planes + TL_SLOT(gbuffer->present, plane) * size;
}
