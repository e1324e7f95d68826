/* Ambient occlusion by what stands around a pixel: how many samples of the picture it may take. */
#ifndef TL_OCCLUSION_SAMPLES_H
#define TL_OCCLUSION_SAMPLES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Samples a pixel: slices of its hemisphere, times two sides, times steps to each.
 * X(samples, slices, steps) */
#define TL_OCCLUSION_SAMPLES(X) \
    X(4, 1, 2)                  \
    X(8, 1, 4)                  \
    X(16, 2, 4)                 \
    X(32, 2, 8)                 \
    X(64, 4, 8)                 \
    X(128, 8, 8)                \
    X(256, 8, 16)

#define TL_DEFAULT_OCCLUSION_SAMPLES 16

/* Of a row of the table. */
typedef struct tl_occlusion_slices {
    uint32_t samples, slices, steps;
} tl_occlusion_slices;

/* The row of so many samples, of TL_DEFAULT_OCCLUSION_SAMPLES for 0; NULL: there is none. */
const tl_occlusion_slices *tl_occlusion_slices_of(uint32_t samples);

#ifdef __cplusplus
}
#endif

#endif
