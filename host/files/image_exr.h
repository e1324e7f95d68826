/* The OpenEXR half of tl_image_read. */
#ifndef TL_IMAGE_EXR_H
#define TL_IMAGE_EXR_H

#include "tilelight/image.h"

/* The channels R, G, B of a file that starts as OpenEXR files do. */
tl_status tl_image_read_exr(const char *path, tl_image **out, tl_error *err);

#endif
