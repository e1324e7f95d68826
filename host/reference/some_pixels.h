/* Some pixels of a frame by the reference. */
#ifndef TL_SOME_PIXELS_H
#define TL_SOME_PIXELS_H

#include "packing.h"
#include "prepared.h"

typedef struct tl_pixel_at {
    uint32_t x, y;
} tl_pixel_at;

/* Pixels in groups, those of each near each other: lights that reach none of a group are left out for it. */
typedef struct tl_pixel_groups {
    const tl_pixel_at *at; /* group g: [begins[g], begins[g + 1]) */
    const size_t *begins;  /* [count + 1] */
    size_t count;
} tl_pixel_groups;

/* radiance[i] becomes that of pixel i, bit for bit what tl_reference_light gives in TL_TWIN_REFERENCE. On all
 * threads; surroundings, where the frame needs some, are those of tl_reference_surround. Cannot fail. */
void tl_reference_some(const tl_prepared *prepared,
                       const tl_gbuffer *gbuffer,
                       const tl_pixel_groups *pixels,
                       float (*radiance)[3]);

/* What one group is lit by, compiled once per instruction set. reaching: [lights of the frame], is written;
 * NULL: no light is left out. */
typedef void tl_some_twin(const tl_prepared *prepared,
                          const tl_word_planes *planes,
                          const tl_pixel_at *at,
                          size_t count,
                          uint32_t *reaching,
                          float (*radiance)[3]);

#endif
