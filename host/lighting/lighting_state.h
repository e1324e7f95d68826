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
    uint64_t *tile_effects; /* the same */
    size_t tile_capacity;
    uint64_t *light_effects; /* [light_capacity], of prepared lights; owned */
    size_t light_capacity;
    tl_effect_use use;
    tl_lighting_counts counts; /* of the last frame */
    tl_gbuffer *unpacked;      /* of the last frame, where a user's kernel lit a packed one */
    /* [layer_capacity], of layers, each with lists and buffers of its own; owned; NULL: not needed yet */
    struct tl_lighting **layers;
    uint32_t layer_capacity;
    tl_image *lit;              /* a layer's radiance, where the device shares memory; owned */
    tl_explanation explanation; /* of the last frame, layers included */
    const tl_light_part *part;  /* that is being lit; NULL: all there is */
};

/* Whether a precision needs no OpenCL. */
int tl_precision_is_on_host(tl_precision precision);

/* Whether it lights without OpenCL. */
int tl_lighting_is_on_host(const tl_lighting *lighting);

/* Lights a surface alone; a layer, over what the image has: lit is where its radiance goes, of the image's
 * size, NULL where the device does not share memory. As tl_lighting_run. */
tl_status tl_lighting_surface(tl_lighting *lighting,
                              const tl_gbuffer *gbuffer,
                              const tl_light_set *lights,
                              tl_image *image,
                              tl_image *lit,
                              tl_timings *timings,
                              const tl_notices *notices,
                              tl_lighting_counts *counts,
                              tl_error *err);

/* Lights the layers of a frame whose surfaces are lit, and blends them over the image: stage "layers". Raises
 * *counts, and adds to lighting->explanation. As tl_lighting_run. */
tl_status tl_lighting_layers(tl_lighting *lighting,
                             const tl_gbuffer *gbuffer,
                             const tl_light_set *lights,
                             tl_image *image,
                             tl_timings *timings,
                             tl_lighting_counts *counts,
                             tl_error *err);

/* Accepts what has none. */
void tl_lighting_layers_clear(tl_lighting *lighting);

/* The vectors, path and precision that kernels are built with; the rest is 0. */
tl_kernel_options tl_lighting_arithmetic(const tl_device *device,
                                         const tl_lighting_options *options);

/* What kernels are built with for a frame of these needs. */
tl_kernel_options tl_lighting_kernels(const tl_lighting *lighting, const tl_needs *needs);

#endif
