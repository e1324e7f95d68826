/* How far apart two pictures are. */
#ifndef TL_COMPARE_H
#define TL_COMPARE_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Differences of channels, a - b; `relative` ones are divided by b's mean. */
typedef struct tl_difference {
    double mean_value;           /* of b, over all channels */
    double max, mean, rms, p999; /* absolute; p999: 99.9 % of values are at most this far */
    double relative_max, relative_mean, relative_rms, relative_p999; /* 0 / 0 is 0 */
    double psnr;               /* dB against b's largest value; INFINITY when equal */
    uint64_t different_count;  /* values whose bits differ */
    uint64_t not_finite_count; /* values NaN or infinite in either; they count as INFINITY */
    uint32_t worst_x, worst_y, worst_channel; /* the first of the largest, row by row */
    float worst_a, worst_b;
} tl_difference;

/* Fails with TL_ERR_ARGUMENT when sizes differ, or TL_ERR_MEMORY. */
tl_status tl_compare(const tl_image *a, const tl_image *b, tl_difference *out, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
