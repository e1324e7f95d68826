/* Ambient occlusion by what stands around a pixel: how many samples of the picture it may take. */
#ifndef TL_OCCLUSION_SAMPLES_H
#define TL_OCCLUSION_SAMPLES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Samples a pixel: slices of its hemisphere, times two sides, times looks to each: steps away from the pixel,
 * and halvings of the one at which its horizon is. X(samples, slices, steps, halvings) */
#define TL_OCCLUSION_SAMPLES(X) \
    X(8, 1, 2, 1)               \
    X(16, 2, 2, 1)              \
    X(32, 2, 4, 2)              \
    X(64, 4, 4, 2)              \
    X(128, 4, 10, 3)            \
    X(256, 8, 10, 3)

#define TL_DEFAULT_OCCLUSION_SAMPLES 64

/* Of a row of the table. */
typedef struct tl_occlusion_slices {
    uint32_t samples, slices, steps, halvings;
} tl_occlusion_slices;

/* The row of so many samples, of TL_DEFAULT_OCCLUSION_SAMPLES for 0; NULL: there is none. */
const tl_occlusion_slices *tl_occlusion_slices_of(uint32_t samples);

#ifdef __cplusplus
}
#endif

#endif
