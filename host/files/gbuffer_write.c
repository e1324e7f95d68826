#include "tilelight/gbuffer_file.h"

#include "camera_attributes.h"
#include "exr_writer.h"
#include "plane_channels.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

enum { PREVIEW_COUNT = 4 };
static const float largest_half = 65504.0f;

/* What a row of the preview is computed from. */
typedef struct preview {
    const tl_gbuffer *gbuffer;
    const float *depth, *normal[3], *albedo[3];
    const float *emissive[3]; /* NULL where the frame has none */
} preview;

static preview preview_of(const tl_gbuffer *gbuffer)
{
    preview made = {.gbuffer = gbuffer, .depth = tl_gbuffer_plane(gbuffer, TL_DEPTH)};
    for (unsigned i = 0; i < 3; i++) {
        made.normal[i] = tl_gbuffer_plane(gbuffer, (enum tl_plane)(TL_NORMAL_X + i));
        made.albedo[i] = tl_gbuffer_plane(gbuffer, (enum tl_plane)(TL_ALBEDO_R + i));
        made.emissive[i] = tl_gbuffer_plane(gbuffer, (enum tl_plane)(TL_EMISSIVE_R + i));
    }
    return made;
}

/* The unit vector from a pixel's surface to the camera, in world space. */
static void towards_camera(const tl_camera *camera, float x, float y, float out[3])
{
    const int is_perspective = camera->projection == TL_PERSPECTIVE;
    const float view[3] = {is_perspective ? -x : 0.0f, is_perspective ? -y : 0.0f, 1.0f};
    const float scale = 1.0f / sqrtf(view[0] * view[0] + view[1] * view[1] + 1.0f);
    for (int i = 0; i < 3; i++)
        out[i] = scale * (camera->view_from_world[0][i] * view[0] +
                          camera->view_from_world[1][i] * view[1] +
                          camera->view_from_world[2][i] * view[2]);
}

/* The frame under a lamp at the camera: albedo |N.V| + emissive; alpha says what is covered. */
static void compute_preview(const void *context, uint32_t y, float *const rows[PREVIEW_COUNT])
{
    const preview *from = context;
    const tl_gbuffer *gbuffer = from->gbuffer;
    const tl_camera *camera = &gbuffer->camera;
    const size_t first = (size_t)y * gbuffer->pitch;
    const float x_step = (camera->right - camera->left) / (float)camera->width;
    const float y_step = (camera->top - camera->bottom) / (float)camera->height;
    const float view_y = camera->top - ((float)y + 0.5f) * y_step;

    for (uint32_t x = 0; x < camera->width; x++) {
        const size_t i = first + x;
        const float covered = from->depth[i] < INFINITY ? 1.0f : 0.0f;
        float to_camera[3];
        towards_camera(camera, camera->left + ((float)x + 0.5f) * x_step, view_y, to_camera);
        const float cosine =
            fabsf(from->normal[0][i] * to_camera[0] + from->normal[1][i] * to_camera[1] +
                  from->normal[2][i] * to_camera[2]);
        for (int c = 0; c < 3; c++) {
            const float sent = from->emissive[c] ? from->emissive[c][i] : 0.0f;
            const float value = from->albedo[c][i] * cosine + sent;
            rows[c][x] = covered > 0.0f ? fminf(value, largest_half) : 0.0f;
        }
        rows[3][x] = covered;
    }
}

static tl_status set_attributes(tl_exr_stream *stream,
                                const tl_gbuffer *gbuffer,
                                const tl_light_set *lights,
                                tl_error *err)
{
    tl_status status = TL_OK;
    const exr_context_t context = stream->context;
    char *text = NULL;
    TRY(tl_exr_check(stream, exr_attr_set_int(context, 0, "tilelight:version", 1), err));
    TRY(tl_exr_check(stream, exr_attr_set_string(context, 0, "tilelight:layout", "float"),
                     err));
    TRY(tl_camera_attributes_write(stream, &gbuffer->camera, err));
    if (lights) {
        TRY(tl_lights_format(lights, &text, err));
        TRY(tl_exr_check(stream, exr_attr_set_string(context, 0, "tilelight:lights", text),
                         err));
    }
done:
    free(text);
    return status;
}

tl_status tl_gbuffer_write(const char *path,
                           const tl_gbuffer *gbuffer,
                           const tl_light_set *lights,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_writer writer = {.stream.context = NULL};
    const preview shown = preview_of(gbuffer);
    tl_exr_channel channels[PREVIEW_COUNT + TL_PLANE_COUNT] = {
        {.name = "R", .type = EXR_PIXEL_HALF},
        {.name = "G", .type = EXR_PIXEL_HALF},
        {.name = "B", .type = EXR_PIXEL_HALF},
        {.name = "A", .type = EXR_PIXEL_HALF},
    };
    tl_exr_picture picture = {.width = gbuffer->camera.width,
                              .height = gbuffer->camera.height,
                              .pitch = gbuffer->pitch,
                              .channel_count = PREVIEW_COUNT,
                              .channels = channels,
                              .compute = compute_preview,
                              .context = &shown};

    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        if (gbuffer->present & TL_HAS(p))
            channels[picture.channel_count++] =
                (tl_exr_channel){.name = tl_plane_channels[p],
                                 .type = EXR_PIXEL_FLOAT,
                                 .plane = tl_gbuffer_plane(gbuffer, p)};
    TRY(tl_exr_writer_begin(&writer, path, picture.width, picture.height, EXR_COMPRESSION_NONE,
                            err));
    TRY(set_attributes(&writer.stream, gbuffer, lights, err));
    TRY(tl_exr_writer_pixels(&writer, &picture, err));
    TRY(tl_exr_writer_commit(&writer, err));
done:
    tl_exr_writer_abandon(&writer);
    return status;
}
