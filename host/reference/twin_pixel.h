/* One pixel of a frame as it is packed, in the arithmetic of the file that includes this. */
#ifndef TL_TWIN_PIXEL_H
#define TL_TWIN_PIXEL_H

#include "lit_pixel.h"
#include "occlusion.h"
#include "twin.h"

typedef struct seen_pixel {
    vec3 radiance;
    vec3 terms[TL_AOV_COUNT]; /* those of needs.split */
} seen_pixel;

/* What the eye sees there, lit by these lights, among which are all that reach it. */
TL_INLINE seen_pixel twin_pixel(const tl_prepared *prepared,
                                const tl_word_planes *planes,
                                light_choice lights,
                                uint32_t column,
                                uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    const tl_needs needs = prepared->needs;
    const size_t at = (size_t)row * frame->pitch + column;
    const tl_words words = tl_words_at(planes, at);
    const surface s = unpacked_surface(frame, needs, planes->layout, &words, prepared->rows,
                                       (real)column, (real)row);
    pixel in = pixel_of(needs, planes->layout, &words, -s.position.z);
    in.occlusion = ambient_share(frame, needs, (tl_numbers)prepared->lights, in.occlusion, at);
    const substance m = substance_at(frame, needs, in, prepared->rows);
    const received sum = received_of(prepared, lights, in, s, m, at);
    seen_pixel seen;
    seen.radiance =
        seen_radiance(frame, needs, prepared->lights, in.depth,
                      radiance_of(frame, needs, in, m, sum), (real)column, (real)row);
    for (tl_u32 term = 0; term < TL_AOV_COUNT; term++)
        if (needs.split >> term & 1u)
            seen.terms[term] = term == TL_AOV_BACKGROUND
                                   ? background_term(in.depth, seen.radiance)
                                   : surface_term(frame, needs, term, in, m, sum);
    return seen;
}

#endif
