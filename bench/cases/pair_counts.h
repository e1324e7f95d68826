/* What there is to do in a frame at the least: the pairs of a pixel and a light that reaches it. */
#ifndef TL_PAIR_COUNTS_H
#define TL_PAIR_COUNTS_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

typedef struct tl_pair_counts {
    uint64_t in_range; /* the light's range ends beyond the pixel */
    uint64_t lit;      /* of those, the ones with the light above the surface: N.L > 0 */
} tl_pair_counts;

/* In double, whatever the device computes in, so a pair that rounding decides may count either way.
 * lights: point lights with a range. On all threads. Fails with TL_ERR_MEMORY. */
tl_status tl_pair_counts_take(const tl_gbuffer *gbuffer,
                              const tl_light_set *lights,
                              tl_pair_counts *out,
                              tl_error *err);

#endif
