/* Two ways to light that must give one picture, by turns. */
#ifndef TL_FRAME_RATIO_H
#define TL_FRAME_RATIO_H

#include "sampling.h"
#include "tilelight/lighting.h"

/* What is lit, and how. */
typedef struct tl_frame_side {
    const tl_gbuffer *gbuffer;
    const tl_light_set *lights;
    tl_lighting_options options;
    /* Pictures of a part of the lights each, that are lit beside the whole: light i is in that of number i
     * modulo this. 0: none. */
    uint32_t group_count;
} tl_frame_side;

typedef struct tl_frame_ratio {
    tl_summary ratio; /* of the frames' wall times, second over first, pair by pair */
    /* the same of processor time, which what else runs changes less */
    tl_summary processor_ratio;
    tl_summary frame_ms[2];     /* tl_lighting_run, wall time */
    tl_summary processor_ms[2]; /* processor time that the process took for it */
    tl_summary cull_ms[2];      /* of that, the culling kernels, from profiling events */
    tl_summary shade_ms[2];     /* and the shading kernel */
    tl_lighting_counts counts[2];
    int same_bits; /* 1: both pictures have the same bits, or the second those of its part of the first */
} tl_frame_ratio;

/* Lights sides[0], sides[1], then sides[1], sides[0], and so on, after once each to warm up, until `rule`
 * has enough of the ratio. Both G-buffers have one size, or the second is a part of the first. Fails as tl_lighting_create and tl_lighting_run
 * do. */
tl_status tl_frame_ratio_measure(tl_device *device,
                                 const tl_frame_side sides[2],
                                 const tl_sampling_rule *rule,
                                 tl_frame_ratio *out,
                                 tl_error *err);

#endif
