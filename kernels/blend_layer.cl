/* Blending a lit layer over the picture of what lies behind it: a work-item a vector of pixels of a row.
 *
 * Floor, of a layer that covers a share c of the picture, in bytes a pixel: 4 of opacity, and c times 12 of
 * radiance and 12 of the picture read, and 12 written. docs/translucency.md has its time. */
#include "blend.h"
#include "frame.h"
#include "aovs.h"

/* opacity  [rows][pitch], 0 where the layer has no surface: there nothing else is read or written
 * lit      [3][rows][pitch], the layer's radiance; with TL_SPLIT as many for each of its terms behind
 * behind   the same, becomes what is seen
 * Global size: pixels of the band's rows, padding included, by TL_WIDTH. */
__kernel void blend_layer(const tl_frame frame,
                          __global const float *restrict opacity,
                          __global const float *restrict lit,
                          __global float *restrict behind)
{
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const size_t at =
        (size_t)frame.buffer_row * frame.pitch + get_global_id(0) * (size_t)TL_WIDTH;
    const real share = LOAD(opacity, at);
    if (!any_lane(share > R(0.0)))
        return;
    for (uint color = 0; color < TL_PICTURE_PLANES(TL_SPLIT); color++) {
        const size_t here = color * plane_size + at;
        STORE_FLOAT(blended(share, LOAD(lit, here), LOAD(behind, here)), behind, here);
    }
}
