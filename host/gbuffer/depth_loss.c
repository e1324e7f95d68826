#include "depth_loss.h"

#include "packing.h"
#include "try.h"

#include <assert.h>
#include <math.h>

enum { SAMPLES = 512 };

static tl_camera camera_of_samples(const tl_camera *camera)
{
    tl_camera c = *camera;
    c.width = SAMPLES;
    c.height = 1;
    return c;
}

/* The number that is stored, as it counts. */
static double number_of(const tl_layout *layout, const tl_words *words)
{
    const tl_channel c = layout->depth.channels[0];
    const word32 field = field_of(words->of[c.word], c.shift, c.bits);
    if (c.number == TL_NUMBER_UNORM)
        return field / (double)((1u << c.bits) - 1u);
    if (c.number == TL_NUMBER_BYTES24)
        return swapped_bytes24(field) / (double)0xffffffu;
    return (double)number_value(c.number, words->of[c.word], c.shift, c.bits);
}

/* From a convention of a projection to what it is linear in: 1/depth = slope d + offset. */
typedef struct projection {
    double slope, offset;
} projection;

static projection projection_of(const tl_camera *camera, tl_u32 code)
{
    const double near = 1.0 / (double)camera->near, far = 1.0 / (double)camera->far;
    if (code == TL_DEPTH_FORWARD)
        return (projection){far - near, near};
    if (code == TL_DEPTH_NDC)
        return (projection){0.5 * (far - near), 0.5 * (far + near)};
    return (projection){near - far, far};
}

/* Of a position that is stored. */
static double position_depth(const tl_camera *camera,
                             const tl_layout *layout,
                             const tl_words *words)
{
    double stored[3], view[3];
    for (int i = 0; i < 3; i++) {
        const tl_channel c = layout->depth.channels[i];
        stored[i] = (double)number_value(c.number, words->of[c.word], c.shift, c.bits);
    }
    if (layout->depth.code == TL_DEPTH_VIEW_POSITION)
        return -stored[2];
    tl_camera_view_point(camera, stored, view);
    return -view[2];
}

/* m, in double from what is stored. */
static double exact_depth(const tl_camera *camera,
                          const tl_layout *layout,
                          const tl_words *words)
{
    const tl_u32 code = layout->depth.code;
    const double near = (double)camera->near, far = (double)camera->far;
    if (TL_IS_POSITION(code))
        return position_depth(camera, layout, words);
    const double number = number_of(layout, words);
    if (code == TL_DEPTH_METRES)
        return number;
    if (code == TL_DEPTH_FRACTION)
        return number * (far - near) + near;
    const projection p = projection_of(camera, code);
    return 1.0 / (number * p.slope + p.offset);
}

static float textbook_depth(const tl_camera *camera,
                            const tl_layout *layout,
                            const tl_words *words)
{
    const projection p = projection_of(camera, layout->depth.code);
    return 1.0f / fmaf((float)number_of(layout, words), (float)p.slope, (float)p.offset);
}

static void add(double *worst, double value, double exact)
{
    *worst = fmax(*worst, fabs(value - exact) / exact);
}

/* Spread evenly, and at no round fractions, which few bits hold exactly. */
static double sample(const tl_camera *camera, double depth, uint32_t i)
{
    static const double golden_ratio = 0.6180339887498949;
    const double most = fmin(1.1 * depth, (double)camera->far);
    const double share = i * golden_ratio - floor(i * golden_ratio);
    return (double)(float)(depth + (most - depth) * share);
}

static tl_depth_loss losses_of(const tl_gbuffer *packed, double depth)
{
    const tl_camera *camera = &packed->camera;
    const tl_word_planes planes = tl_word_planes_of(packed);
    const tl_layout *layout = planes.layout;
    const tl_needs needs = {.present = packed->present, .layout = packed->layout};
    const bool is_projected = TL_IS_NEARNESS(layout->depth.code);
    tl_depth_loss loss = {.textbook = is_projected ? 0.0 : (double)NAN};
    tl_frame frame = {.tile_size = 0};
    tl_view_set(camera, packed->layout, &frame);
    for (uint32_t i = 0; i < SAMPLES; i++) {
        const tl_words words = tl_words_at(&planes, i);
        const double exact = exact_depth(camera, layout, &words);
        const vec3 position = position_of(&frame, needs, layout, &words, (real)i, R(0.0));
        add(&loss.stored, exact, sample(camera, depth, i));
        add(&loss.read, -(double)position.z, exact);
        if (is_projected)
            add(&loss.textbook, (double)textbook_depth(camera, layout, &words), exact);
    }
    return loss;
}

tl_status tl_depth_loss_find(const tl_camera *camera,
                             enum tl_layout_name layout,
                             double depth,
                             tl_depth_loss *out,
                             tl_error *err)
{
    const tl_camera wide = camera_of_samples(camera);
    tl_status status = TL_OK;
    tl_gbuffer *plain = NULL, *packed = NULL;
    assert(camera->projection == TL_PERSPECTIVE);
    assert(depth >= (double)camera->near && depth <= (double)camera->far);
    TRY(tl_gbuffer_create(&wide, TL_GROUP_BASE, &plain, err));
    for (uint32_t i = 0; i < SAMPLES; i++)
        tl_gbuffer_plane(plain, TL_DEPTH)[i] = (float)sample(camera, depth, i);
    TRY(tl_gbuffer_pack(plain, layout, &packed, NULL, err));
    *out = losses_of(packed, depth);
done:
    tl_gbuffer_destroy(packed);
    tl_gbuffer_destroy(plain);
    return status;
}
