/* What a block of pixels sends out, to the planes of the picture and of its terms (aovs.h): those of the
 * picture, then three for each term of needs.split, in their order. OpenCL only. */
#ifndef TL_STORE_PIXEL_H
#define TL_STORE_PIXEL_H

#include "block.h"
#include "pixel.h"

/* Three planes of plane_size numbers; at: the block's first pixel. */
TL_INLINE void store_block_color(
    vec3 color, __global float *planes, size_t plane_size, size_t at, uint pitch)
{
    store_block(color.x, planes + at, pitch);
    store_block(color.y, planes + plane_size + at, pitch);
    store_block(color.z, planes + 2 * plane_size + at, pitch);
}

TL_INLINE void store_term(const tl_frame *frame,
                          tl_needs needs,
                          tl_u32 term,
                          vec3 color,
                          __global float *radiance,
                          size_t at)
{
    const size_t plane_size = (size_t)frame->rows * frame->pitch;
    store_block_color(color, radiance + TL_AOV_PLANE(needs.split, term) * plane_size,
                      plane_size, at, frame->pitch);
}

/* Terms of surfaces; of a block without any they are 0. */
TL_INLINE void store_surface_terms(const tl_frame *frame,
                                   tl_needs needs,
                                   pixel of,
                                   substance m,
                                   received sum,
                                   __global float *radiance,
                                   size_t at)
{
#pragma unroll
    for (tl_u32 term = 0; term < TL_AOV_BACKGROUND; term++)
        if (needs.split >> term & 1u)
            store_term(frame, needs, term, surface_term(frame, needs, term, of, m, sum),
                       radiance, at);
}

TL_INLINE void store_no_terms(const tl_frame *frame,
                              tl_needs needs,
                              __global float *radiance,
                              size_t at)
{
    const vec3 none = {R(0.0), R(0.0), R(0.0)};
#pragma unroll
    for (tl_u32 term = 0; term < TL_AOV_BACKGROUND; term++)
        if (needs.split >> term & 1u)
            store_term(frame, needs, term, none, radiance, at);
}

/* The picture, and its background. */
TL_INLINE void store_seen(const tl_frame *frame,
                          tl_needs needs,
                          real depth,
                          vec3 seen,
                          __global float *radiance,
                          size_t at)
{
    store_block_color(seen, radiance, (size_t)frame->rows * frame->pitch, at, frame->pitch);
    if (needs.split >> TL_AOV_BACKGROUND & 1u)
        store_term(frame, needs, TL_AOV_BACKGROUND, background_term(depth, seen), radiance, at);
}

#endif
