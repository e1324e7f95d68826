/* What packing needs of a camera; for files in which real is double. */
#ifndef TL_PACKING_SETUP_H
#define TL_PACKING_SETUP_H

#include "pack.h"

#include "tilelight/camera.h"

/* What is the same for every pixel. *frame, filled here, has to live as long. Cannot fail. */
tl_packing tl_packing_of(const tl_camera *camera,
                         enum tl_layout_name layout,
                         uint32_t present,
                         tl_frame *frame);

#endif
