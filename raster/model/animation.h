/* The animations of a file, checked where one is used. */
#ifndef TL_ANIMATION_H
#define TL_ANIMATION_H

#include "pose.h"

#include "tilelight/report.h"

/* When a scene is looked at. */
typedef struct tl_moment {
    const char *animation; /* name or index; NULL: the first, where a time is given */
    double time;           /* s */
    bool has_time;         /* false: 0 of the animation, or the rest pose where none is named */
} tl_moment;

/* Where nodes are at that moment; the caller releases *out with tl_pose_clear. An animation that has
 * ended before is told. Fails with TL_ERR_ARGUMENT (a time that is negative or not finite; no such
 * animation: says which there are), TL_ERR_FORMAT, naming the animation and what it moves, or
 * TL_ERR_MEMORY. */
tl_status tl_animation_pose(const tl_gltf *gltf,
                            const tl_moment *moment,
                            const tl_notices *notices,
                            tl_pose *out,
                            tl_error *err);

/* When animation `index` of the file ends, s: its last key. Checks it as tl_animation_pose
 * does, and fails as that does. */
tl_status tl_animation_end(const tl_gltf *gltf, size_t index, double *seconds, tl_error *err);

#endif
