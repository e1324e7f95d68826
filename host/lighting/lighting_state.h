/* What a tl_lighting holds from frame to frame, for the files that light and shade again. */
#ifndef TL_LIGHTING_STATE_H
#define TL_LIGHTING_STATE_H

#include "bands.h"

#include "tilelight/lighting.h"

struct tl_lighting {
    tl_device *device;
    tl_lighting_options options;
    tl_prepared prepared;
    tl_buffers buffers;
    uint32_t *tile_lights;  /* [tile_capacity]; NULL unless it is asked for; owned */
    uint32_t *tile_effects; /* the same */
    size_t tile_capacity;
    uint32_t *light_effects; /* [light_capacity], of prepared lights; owned */
    size_t light_capacity;
    tl_effect_use use;
    tl_lighting_counts counts; /* of the last frame */
    tl_gbuffer *unpacked;      /* of the last frame, where a user's kernel lit a packed one */
};

/* Whether it lights without OpenCL. */
int tl_lighting_is_on_host(const tl_lighting *lighting);

/* What kernels are built with for a frame of these needs. */
tl_kernel_options tl_lighting_kernels(const tl_lighting *lighting, const tl_needs *needs);

#endif
