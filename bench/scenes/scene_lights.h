/* The lights of a bench scene. */
#ifndef TL_SCENE_LIGHTS_H
#define TL_SCENE_LIGHTS_H

#include "bench_scene.h"

/* Adds options->light_count lights; their range is options->range, or what makes tiles list
 * options->lights_per_tile of them. Fails with TL_ERR_ARGUMENT or TL_ERR_MEMORY. */
tl_status tl_scene_lights(const tl_gbuffer *gbuffer,
                          const tl_bench_scene_options *options,
                          tl_light_set *lights,
                          tl_error *err);

#endif
