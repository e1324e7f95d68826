/* One pixel of a frame as it is packed, in the arithmetic of the file that includes this. */
#ifndef TL_TWIN_PIXEL_H
#define TL_TWIN_PIXEL_H

#include "lit_pixel.h"
#include "occlusion.h"
#include "twin.h"

/* What the eye sees there, lit by these lights, among which are all that reach it. */
TL_INLINE vec3 twin_pixel(const tl_prepared *prepared,
                          const tl_word_planes *planes,
                          light_choice lights,
                          uint32_t column,
                          uint32_t row)
{
    const size_t at = (size_t)row * prepared->frame.pitch + column;
    const tl_words words = tl_words_at(planes, at);
    const surface s = unpacked_surface(&prepared->frame, prepared->needs, planes->layout,
                                       &words, prepared->rows, (real)column, (real)row);
    pixel in = pixel_of(prepared->needs, planes->layout, &words, -s.position.z);
    in.occlusion = ambient_share(&prepared->frame, prepared->needs,
                                 (tl_numbers)prepared->lights, in.occlusion, at);
    return seen_radiance(&prepared->frame, prepared->needs, prepared->lights, in.depth,
                         light_surface_by(prepared, lights, in, s), (real)column, (real)row);
}

#endif
