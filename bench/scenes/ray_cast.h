/* The surfaces of a bench scene, by rays in double. */
#ifndef TL_RAY_CAST_H
#define TL_RAY_CAST_H

#include "bench_scene.h"

/* The frame of `scene` with the planes `present`, on all threads. The caller releases *out with
 * tl_gbuffer_destroy. Fails with TL_ERR_ARGUMENT for a size out of range, or TL_ERR_MEMORY. */
tl_status tl_ray_cast(const tl_bench_scene *scene,
                      uint32_t present,
                      uint32_t width,
                      uint32_t height,
                      tl_gbuffer **out,
                      tl_error *err);

#endif
