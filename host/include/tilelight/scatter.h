/* Lights scattered over the visible surfaces of a frame, for benchmarks and tests. */
#ifndef TL_SCATTER_H
#define TL_SCATTER_H

#include "gbuffer.h"
#include "lights.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { TL_MAX_SCATTERED = 1000000 };

typedef struct tl_scatter_options {
    uint32_t count; /* 1 to TL_MAX_SCATTERED */
    uint32_t seed;
    float overlap; /* lights that reach a visible pixel on average; sets the range */
    float range;   /* m; 0: from overlap */
    tl_falloff falloff;
    float intensity; /* 0: so that overlapping lights give a white surface about 0.5 */
} tl_scatter_options;

/* 1024 lights, seed 1, overlap 12, linear. */
tl_scatter_options tl_scatter_options_default(void);

/* Adds point lights, spread evenly over the visible surfaces of a repaired G-buffer of any layout, the
 * same for the same seed on every machine. Fails with TL_ERR_ARGUMENT (a frame that is all sky, options out of
 * range) or TL_ERR_MEMORY. */
tl_status tl_scatter(const tl_gbuffer *gbuffer,
                     const tl_scatter_options *options,
                     tl_light_set *lights,
                     tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
