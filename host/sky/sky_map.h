/* A sky as it lights surfaces, prepared once for all frames under it. */
#ifndef TL_SKY_MAP_H
#define TL_SKY_MAP_H

#include "sky_moments.h"

#include <stdbool.h>

/* Without the set's rotation, nor, of an image, its intensity. Axes are right, up and ahead. */
typedef struct tl_sky_map {
    tl_sky_moments moments[3]; /* a channel each */
    uint32_t size;             /* of the finest level, texels */
    size_t texel_count;
    float (*texels)[4]; /* [texel_count], of all levels (sky_prefilter.h), owned; or NULL */
    float brightest;    /* of them */
    bool was_kept;      /* it is from disk: sky_keep.h */
} tl_sky_map;

/* The finest level's side at most, texels: 0.35 degrees each on average. */
#define TL_SKY_MOST_SIZE 512
#define TL_SKY_LEAST_SIZE 128 /* of a map of few texels, and of gradients */

/* Makes it, or finds it again: in this process, where the last one is of the same sky, else on disk. Without
 * `mirrored` it may lack its levels, which take nearly all of the time. *out is shared: give it back with
 * tl_sky_map_release. Fails with TL_ERR_MEMORY. */
tl_status tl_sky_map_of(const tl_light_set *set,
                        bool mirrored,
                        tl_sky_map **out,
                        tl_error *err);

/* Accepts NULL. */
void tl_sky_map_release(tl_sky_map *map);

#endif
