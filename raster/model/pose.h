/* Where the nodes of a file are, each beside its parent: as the file has them, but for what an
 * animation moves. */
#ifndef TL_POSE_H
#define TL_POSE_H

#include "gltf.h"
#include "matrix.h"

/* What of a node an animation can move. X(name, word of the file, what its keys are read as, numbers;
 * 0: as many as the mesh has morph targets) */
#define TL_PATHS(X)                                              \
    X(TL_PATH_TRANSLATION, "translation", TL_USE_KEY_VECTORS, 3) \
    X(TL_PATH_ROTATION, "rotation", TL_USE_KEY_ROTATIONS, 4)     \
    X(TL_PATH_SCALE, "scale", TL_USE_KEY_VECTORS, 3)             \
    X(TL_PATH_WEIGHTS, "weights", TL_USE_KEY_WEIGHTS, 0)

enum tl_path {
#define TL_PATH_NAME(name, word, use, width) name,
    TL_PATHS(TL_PATH_NAME)
#undef TL_PATH_NAME
        TL_PATH_COUNT
};

typedef struct tl_node_pose {
    double *values[TL_PATH_COUNT]; /* owned; NULL: the file's */
} tl_node_pose;

typedef struct tl_pose {
    size_t count;        /* of nodes */
    tl_node_pose *nodes; /* [count], owned; NULL: all as the file has them */
} tl_pose;

/* Accepts an all-zero one. */
void tl_pose_clear(tl_pose *pose);

/* parent_from_node of node `index`. Fails with TL_ERR_FORMAT, naming the node, for numbers that make no
 * affine transform. */
tl_status tl_pose_local(
    const tl_gltf *gltf, const tl_pose *pose, size_t index, tl_affine *out, tl_error *err);

/* The morph targets of each primitive of a mesh, which has been through tl_pose_weights; before
 * that, of the first. */
size_t tl_mesh_target_count(const tl_gltf_mesh *mesh);

/* The weights of the morph targets of node `index`: the animation's, else the node's, else the mesh's;
 * *out is [target_count], NULL: all 0; the pose's or the file's own. Fails with TL_ERR_FORMAT where
 * they are not as many as the targets of each primitive. The node's mesh has been checked. */
tl_status tl_pose_weights(
    const tl_gltf *gltf, const tl_pose *pose, size_t index, const double **out, tl_error *err);

/* Translation, rotation and scale as one transform, in that order from the left; NULL: none. False
 * where the rotation's length is 0 or not finite. */
bool tl_transform_of_parts(const double translation[3],
                           const double rotation[4],
                           const double scale[3],
                           tl_affine *out);

#endif
