/* Small pictures of a frame and of its errors. */
#ifndef TL_STUDY_MAPS_H
#define TL_STUDY_MAPS_H

#include "pictures.h"

/* Errors of the ends of tl_ramp, relative to the mean radiance: from left to right a logarithm. What is
 * below is as the lower end is, what is above as the upper. */
#define TL_STUDY_MAP_LOW 1e-8
#define TL_STUDY_MAP_HIGH 1.0

/* px of the longer side, at most: each pixel shows the largest of the square of errors that it stands for,
 * or the mean of radiance. */
enum { TL_STUDY_MAP_EXTENT = 480 };

/* errors: [height][width]. Black where nothing is off. Fails as tl_png_write does. */
tl_status tl_study_map_write(
    const char *path, const float *errors, uint32_t width, uint32_t height, tl_error *err);

/* As a screen would show it, at an exposure in stops. Fails alike, or with TL_ERR_MEMORY. */
tl_status tl_study_picture_write(const char *path,
                                 const tl_image *image,
                                 float exposure,
                                 tl_error *err);

#endif
