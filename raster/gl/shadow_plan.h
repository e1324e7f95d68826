/* Which shadow maps a capture gets, and what each of them sees. */
#ifndef TL_SHADOW_PLAN_H
#define TL_SHADOW_PLAN_H

#include "model.h"

#include "tilelight/gbuffer.h"

/* A map for each light of the set that casts shadows, in their order and still empty, in *out, which has
 * none; released with tl_shadow_maps_clear. A light's map has as many texels as the pixels in its reach ask
 * for (shadow_size.h); a directional one's sees what the camera sees, by the depths of `gbuffer`, which is
 * rendered. Where all would take more than `memory` bytes, they are made smaller, which is told
 * (shadow_budget.h). near: m ahead of lights; 0: a small share of the scene's extent. Fails with
 * TL_ERR_ARGUMENT where no size is small enough, or TL_ERR_MEMORY. */
tl_status tl_shadow_plan(const tl_model *model,
                         const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         uint64_t memory,
                         double near,
                         const tl_notices *notices,
                         tl_shadow_maps *out,
                         tl_error *err);

#endif
