/* One pixel in C, in the arithmetic of the file that includes this: lit by all lights in index order,
 * without tiles. */
#ifndef TL_LIT_PIXEL_H
#define TL_LIT_PIXEL_H

#include "float_pixel.h"
#include "prepared.h"
#include "shape.h"
#include "sky.h"

/* Some lights of a frame, in index order: of: [count] indices, or NULL for the first `count`. */
typedef struct light_choice {
    const uint32_t *of;
    uint32_t count;
} light_choice;

/* What the surface of pixel `at` receives of these lights. Those that reach the pixel are among them; what
 * others add is exactly nothing. */
TL_INLINE received received_of(const tl_prepared *prepared,
                               light_choice lights,
                               pixel in,
                               surface s,
                               substance m,
                               size_t at)
{
    const tl_frame *frame = &prepared->frame;
    const tl_needs needs = prepared->needs;
    finish f = finish_of(needs, s, m);
    f.at = at;
    received sum = nothing_received();
    if (in.depth < (real)INFINITY) {
        for (uint32_t k = 0; k < lights.count; k++) {
            const uint32_t i = lights.of ? lights.of[k] : k;
            sum = add_any_light(sum, frame, needs, prepared->lights, s, f, prepared->lights[i],
                                prepared->spots[i], i < frame->global_count);
        }
        sum = add_sky(sum, frame, needs, prepared->lights, s, m, in.occlusion);
    }
    return sum;
}

/* What leaves it towards the eye, lit by every light of the frame. */
TL_INLINE vec3 light_surface(const tl_prepared *prepared, pixel in, surface s, size_t at)
{
    const light_choice all = {NULL, prepared->frame.light_count};
    const substance m = substance_at(&prepared->frame, prepared->needs, in, prepared->rows);
    return radiance_of(&prepared->frame, prepared->needs, in, m,
                       received_of(prepared, all, in, s, m, at));
}

/* Of a pixel that is not packed. */
TL_INLINE vec3 light_pixel(const tl_prepared *prepared, pixel in, uint32_t column, uint32_t row)
{
    const tl_needs needs = prepared->needs;
    return light_surface(
        prepared, in,
        surface_of(&prepared->frame, needs, in,
                   substance_at(&prepared->frame, needs, in, prepared->rows).shininess,
                   (real)column, (scalar)row),
        (size_t)row * prepared->frame.pitch + column);
}

#endif
