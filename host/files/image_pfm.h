/* The PFM half of tl_image_read. */
#ifndef TL_IMAGE_PFM_H
#define TL_IMAGE_PFM_H

#include "tilelight/image.h"

/* Of three numbers a pixel; of one, which all three channels have then. */
tl_status tl_image_read_pfm(const char *path, tl_image **out, tl_error *err);

#endif
