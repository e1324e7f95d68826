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

/* The frame under a lamp at the camera: albedo |N.V| + emissive; alpha says what is covered. V is
 * turned into world space by parts: what a row shares, and what grows with x. */
static void compute_preview(const void *context, uint32_t y, float *const rows[PREVIEW_COUNT])
{
    const preview *from = context;
    const tl_gbuffer *gbuffer = from->gbuffer;
    const tl_camera *camera = &gbuffer->camera;
    const size_t first = (size_t)y * gbuffer->pitch;
    const float slope = camera->projection == TL_PERSPECTIVE ? 1.0f : 0.0f;
    const float x_step = slope * (camera->right - camera->left) / (float)camera->width;
    const float y_step = slope * (camera->top - camera->bottom) / (float)camera->height;
    const float view_y = slope * camera->top - ((float)y + 0.5f) * y_step;
    const float *right = camera->view_from_world[0];
    float in_row[3];
    for (int i = 0; i < 3; i++)
        in_row[i] = camera->view_from_world[2][i] - view_y * camera->view_from_world[1][i];

    for (uint32_t x = 0; x < camera->width; x++) {
        const size_t i = first + x;
        const float view_x = slope * camera->left + ((float)x + 0.5f) * x_step;
        const float cosine = from->normal[0][i] * (in_row[0] - view_x * right[0]) +
                             from->normal[1][i] * (in_row[1] - view_x * right[1]) +
                             from->normal[2][i] * (in_row[2] - view_x * right[2]);
        rows[3][x] = fabsf(cosine) / sqrtf(view_x * view_x + view_y * view_y + 1.0f);
    }
    for (int c = 0; c < 3; c++)
        for (uint32_t x = 0; x < camera->width; x++) {
            const size_t i = first + x;
            const float sent = from->emissive[c] ? from->emissive[c][i] : 0.0f;
            const float value = from->albedo[c][i] * rows[3][x] + sent;
            const float kept = value < largest_half ? value : largest_half;
            rows[c][x] = from->depth[i] < INFINITY ? kept : 0.0f;
        }
    for (uint32_t x = 0; x < camera->width; x++)
        rows[3][x] = from->depth[first + x] < INFINITY ? 1.0f : 0.0f;
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
