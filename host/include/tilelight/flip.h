/* How visible the difference of two pictures is to somebody who flips between them.
 *
 * P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A
 * Difference Evaluator for Alternating Images", HPG 2020, for what a screen shows; P. Andersson,
 * J. Nilsson, P. Shirley, T. Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range
 * Images", Eurographics 2021, for radiance. */
#ifndef TL_FLIP_H
#define TL_FLIP_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where somebody 0.7 m away from a screen of 0.7 m and 3840 px sits, as both papers have it. */
#define TL_FLIP_PIXELS_PER_DEGREE 67.0206432765823

/* Of one pixel 0 is no difference that shows, 1 that of the two colours of a screen that are
 * furthest apart. */
typedef struct tl_flip {
    double mean, max;
    uint32_t worst_x, worst_y; /* the first of the largest, row by row */
    /* Of radiance: its exposures, in stops; each pixel has the largest difference of any of them. */
    double first_exposure, last_exposure;
    uint32_t exposure_count; /* of values for a screen: 0 */
} tl_flip;

/* What pictures hold: values in [0, 1] that are encoded for a screen (sRGB), or linear radiance.
 * Radiance is shown at every exposure between that which brings its brightest pixel to 0.85 and
 * that which brings its median there, a stop or less apart, by the ACES curve of the paper.
 * Of the median, pixels that are black do not count: pictures are black where nothing was hit. */
typedef enum tl_flip_range { TL_FLIP_SCREEN, TL_FLIP_RADIANCE } tl_flip_range;

/* `seen` against `reference`, of one size. Values below 0 and NaN count as 0, those too large for
 * the range as its end. pixels_per_degree: of the eye, 1 to 1000. map: [height][width], or NULL.
 * On all threads; the same bits on any number of them. Fails with TL_ERR_ARGUMENT where sizes
 * differ, or TL_ERR_MEMORY. */
tl_status tl_flip_compare(const tl_image *seen,
                          const tl_image *reference,
                          tl_flip_range range,
                          double pixels_per_degree,
                          float *map,
                          tl_flip *out,
                          tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
