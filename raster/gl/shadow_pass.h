/* Renders what the lights of a scene see of it into their shadow maps. */
#ifndef TL_SHADOW_PASS_H
#define TL_SHADOW_PASS_H

#include "shadow_plan.h"
#include "upload.h"

/* Fills the texels of the maps of `gbuffer`: of every surface, from both sides, but for holes. Stage
 * "shadows". Fails with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_shadow_pass(const tl_gl *gl,
                         const tl_model *model,
                         const tl_scene_objects *objects,
                         uint32_t anisotropy,
                         tl_gbuffer *gbuffer,
                         tl_timings *timings,
                         tl_error *err);

#endif
