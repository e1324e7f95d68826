/* Renders a model into a G-buffer: depth first, then what the visible surfaces are made of; then layers of
 * what blends (peeling.h). */
#ifndef TL_GEOMETRY_PASS_H
#define TL_GEOMETRY_PASS_H

#include "upload.h"

#include "tilelight/gbuffer.h"

/* Fills the words of `gbuffer`, which is as it was created, as its camera sees the model; textures that have
 * mipmaps are looked up with an anisotropy of 1 (as samplers alone do) to 16. Of what blends it gets up to
 * most_layers layers; 0: none, what blends is there where it is at least half opaque. Stages "raster",
 * "readback" and, where anything blends, "layers". Fails with TL_ERR_DEVICE, TL_ERR_MEMORY, or as
 * tl_blending_ranks does. */
tl_status tl_geometry_pass(const tl_gl *gl,
                           const tl_model *model,
                           const tl_scene_objects *objects,
                           uint32_t anisotropy,
                           uint32_t most_layers,
                           tl_gbuffer *gbuffer,
                           tl_timings *timings,
                           tl_error *err);

#endif
