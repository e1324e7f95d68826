/* What the kernels' formulas for positions need to know of a camera. */
#ifndef TL_VIEW_H
#define TL_VIEW_H

#include "frame.h"
#include "layout_names.h"

#include "tilelight/camera.h"

/* Sets the rays, view_from_world, depth_slope and depth_offset of *frame. Cannot fail; of an infinite far
 * plane the slopes of TL_DEPTH_FRACTION, and of orthographic depth buffers, are no numbers. */
void tl_view_set(const tl_camera *camera, enum tl_layout_name layout, tl_frame *frame);

#endif
