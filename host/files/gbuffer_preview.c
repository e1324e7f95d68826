#include "gbuffer_preview.h"

#include "ranges.h"

#include <math.h>

enum { SPAN = 128 /* pixels that are unpacked at a time, 5 kB */ };

/* Pixels in full float, one after another. */
typedef struct span {
    const float *depth, *normal[3], *albedo[3];
    const float *emissive[3]; /* NULL where the frame has none */
} span;

static span span_of(float *const planes[TL_PLANE_COUNT])
{
    span made = {.depth = planes[TL_DEPTH]};
    for (int i = 0; i < 3; i++) {
        made.normal[i] = planes[TL_NORMAL_X + i];
        made.albedo[i] = planes[TL_ALBEDO_R + i];
        made.emissive[i] = planes[TL_EMISSIVE_R + i];
    }
    return made;
}

/* The frame under a lamp at the camera: albedo |N.V| + emissive; alpha says what is covered. V is
 * turned into world space by parts: what a row shares, and what grows with x. rows: from column `begin`
 * on, as `from`. */
static void compute_preview(const tl_camera *camera,
                            const span *from,
                            uint32_t y,
                            uint32_t begin,
                            uint32_t end,
                            float *const rows[TL_PREVIEW_COUNT])
{
    const uint32_t count = end - begin;
    const float slope = camera->projection == TL_PERSPECTIVE ? 1.0f : 0.0f;
    const float x_step = slope * (camera->right - camera->left) / (float)camera->width;
    const float y_step = slope * (camera->top - camera->bottom) / (float)camera->height;
    const float view_y = slope * camera->top - ((float)y + 0.5f) * y_step;
    const float *right = camera->view_from_world[0];
    float in_row[3];
    for (int i = 0; i < 3; i++)
        in_row[i] = camera->view_from_world[2][i] - view_y * camera->view_from_world[1][i];

    for (uint32_t i = 0; i < count; i++) {
        const float view_x = slope * camera->left + ((float)(begin + i) + 0.5f) * x_step;
        const float cosine = from->normal[0][i] * (in_row[0] - view_x * right[0]) +
                             from->normal[1][i] * (in_row[1] - view_x * right[1]) +
                             from->normal[2][i] * (in_row[2] - view_x * right[2]);
        rows[3][i] = fabsf(cosine) / sqrtf(view_x * view_x + view_y * view_y + 1.0f);
    }
    for (int c = 0; c < 3; c++)
        for (uint32_t i = 0; i < count; i++) {
            const float sent = from->emissive[c] ? from->emissive[c][i] : 0.0f;
            const float value = from->albedo[c][i] * rows[3][i] + sent;
            const float kept = value < TL_MOST_HALF ? value : TL_MOST_HALF;
            rows[c][i] = from->depth[i] < INFINITY ? kept : 0.0f;
        }
    for (uint32_t i = 0; i < count; i++)
        rows[3][i] = from->depth[i] < INFINITY ? 1.0f : 0.0f;
}

static void preview_of_float(const tl_gbuffer *gbuffer,
                             uint32_t y,
                             float *const rows[TL_PREVIEW_COUNT])
{
    float *planes[TL_PLANE_COUNT];
    for (int p = 0; p < TL_PLANE_COUNT; p++) {
        planes[p] = tl_gbuffer_plane(gbuffer, (enum tl_plane)p);
        if (planes[p])
            planes[p] += (size_t)y * gbuffer->pitch;
    }
    const span row = span_of(planes);
    compute_preview(&gbuffer->camera, &row, y, 0, gbuffer->camera.width, rows);
}

static void preview_of_words(const tl_unpacking *from,
                             uint32_t y,
                             float *const rows[TL_PREVIEW_COUNT])
{
    static const uint32_t shown = TL_GROUP_BASE | TL_GROUP_EMISSIVE;
    const tl_camera *camera = &from->from->camera;
    float values[TL_PLANE_COUNT][SPAN], *planes[TL_PLANE_COUNT] = {NULL};
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (shown & from->from->present & TL_HAS(p))
            planes[p] = values[p];
    const span unpacked = span_of(planes);
    for (uint32_t begin = 0; begin < camera->width; begin += SPAN) {
        const uint32_t end = camera->width - begin < SPAN ? camera->width : begin + SPAN;
        float *const here[TL_PREVIEW_COUNT] = {rows[0] + begin, rows[1] + begin,
                                               rows[2] + begin, rows[3] + begin};
        tl_unpack_span(from, y, begin, end, planes);
        compute_preview(camera, &unpacked, y, begin, end, here);
    }
}

void tl_preview_row(const tl_unpacking *from, uint32_t y, float *const rows[TL_PREVIEW_COUNT])
{
    if (from->from->layout == TL_LAYOUT_FLOAT)
        preview_of_float(from->from, y, rows);
    else
        preview_of_words(from, y, rows);
}
