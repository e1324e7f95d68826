/* Depth and place of what is seen, from the definitions of cameras and depth buffers. */
#ifndef TL_ORACLE_DEPTH_H
#define TL_ORACLE_DEPTH_H

#include "oracle/wide.h"

/* Between which depths, in m, and how the share from near, 0, to far, 1, goes: linear in depth, or, as
 * projections have it, linear in 1/depth. far may be infinite where it is not linear. */
typedef struct tl_depth_range {
    wide near, far;
    int linear;
} tl_depth_range;

/* Off by 8v of themselves; a share also by 2v, for what near is taken from; a depth also by 4v of itself over
 * 1 - share, which may be small. */
wide tl_oracle_depth_of_share(tl_depth_range of, wide share);
wide tl_oracle_share_of_depth(tl_depth_range of, wide depth);

/* x/depth of the centre of a pixel (y/depth; m for parallel rays): of `count` between the edges `begin` and
 * `end`. Off by 4v of the edges. */
wide tl_oracle_ray(wide begin, wide end, wide count, wide index);

#endif
