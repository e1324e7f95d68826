/* Which joints move a vertex, and by how much: JOINTS_n and WEIGHTS_n of a primitive. */
#ifndef TL_INFLUENCES_H
#define TL_INFLUENCES_H

#include "accessor.h"

enum { TL_JOINTS_PER_SET = 4 };

/* One set: [count][TL_JOINTS_PER_SET] each. */
typedef struct tl_influence_set {
    float *joints, *weights; /* owned; joints are whole numbers, of a skin's joints */
} tl_influence_set;

typedef struct tl_influences {
    size_t count, set_count; /* vertices */
    tl_influence_set *sets;  /* [set_count], owned */
} tl_influences;

/* Reads all sets of a primitive with `count` vertices for a skin of `joint_count` joints. The
 * caller releases *out with tl_influences_clear whether it succeeds or not. Fails as
 * tl_accessor_read does, and with TL_ERR_FORMAT for a set without its half, no set at all, a
 * joint that the skin has not and that does move the vertex, or a negative weight. */
tl_status tl_influences_read(const tl_gltf *gltf,
                             const char *user,
                             const tl_gltf_primitive *primitive,
                             size_t count,
                             size_t joint_count,
                             tl_budget *budget,
                             tl_influences *out,
                             tl_error *err);

/* Accepts an all-zero one. */
void tl_influences_clear(tl_influences *influences);

/* The sum of a vertex's weights, over all sets. */
double tl_influences_sum(const tl_influences *influences, size_t vertex);

#endif
