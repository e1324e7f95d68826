/* What a depth loses between the surface and the kernel, found by trying: stored, and read in float by the
 * form that kernels use and by the textbook's. */
#ifndef TL_DEPTH_LOSS_H
#define TL_DEPTH_LOSS_H

#include "tilelight/layouts.h"

/* The largest of depths from `depth` to a tenth beyond it, relative to the depth. */
typedef struct tl_depth_loss {
    /* what the number says, computed exactly, against the depth that was packed */
    double stored;
    double read; /* what kernels make of the number in float, against computing it exactly */
    /* the same by 1 / (d/P34 + P33/P34), "Deferred Shading Tricks", d/P34 one fma and P33/P34 as
     * floats; NAN where the layout stores no depth of a projection */
    double textbook;
} tl_depth_loss;

/* Under a perspective camera; depth, m, from its near to its far plane. Fails with TL_ERR_UNSUPPORTED
 * (the layout's convention is none of the camera's) or TL_ERR_MEMORY. */
tl_status tl_depth_loss_find(const tl_camera *camera,
                             enum tl_layout_name layout,
                             double depth,
                             tl_depth_loss *out,
                             tl_error *err);

#endif
