/* The joints of a skin, where they are. */
#ifndef TL_JOINTS_H
#define TL_JOINTS_H

#include "loading.h"

/* Vertices are kept in floats: around an anchor near the mesh they stay fine where the scene is far
 * from the origin. */
typedef struct tl_joints {
    size_t count;
    tl_affine *anchor_from_mesh; /* [count], owned: by each joint */
    double anchor[3];            /* in the world: where the first joint is */
} tl_joints;

/* The joints of skin `skin`, which the file has. The caller releases *out with tl_joints_clear
 * whether it succeeds or not. Fails as tl_accessor_read does, and with TL_ERR_FORMAT for no
 * joints, joints that are not in the scene, and inverse bind matrices that are too few or not
 * affine. */
tl_status tl_joints_open(const tl_gltf *gltf,
                         int skin,
                         const tl_placements *placements,
                         tl_joints *out,
                         tl_error *err);

/* Accepts an all-zero one. */
void tl_joints_clear(tl_joints *joints);

#endif
