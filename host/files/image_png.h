/* The PNG half of tl_image_read. */
#ifndef TL_IMAGE_PNG_H
#define TL_IMAGE_PNG_H

#include "tilelight/camera.h"
#include "tilelight/image.h"

/* A PNG of any colour type; 16-bit samples are divided by 65535, others by 255. */
tl_status tl_image_read_png(const char *path, tl_image **out, tl_error *err);

#endif
