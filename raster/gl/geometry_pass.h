/* Renders a model into a G-buffer: depth first, then what the visible surfaces are made of. */
#ifndef TL_GEOMETRY_PASS_H
#define TL_GEOMETRY_PASS_H

#include "upload.h"

#include "tilelight/gbuffer.h"

/* Fills the words of `gbuffer`, which is as it was created, as its camera sees the model;
 * textures that have mipmaps are looked up with an anisotropy of 1 (as samplers alone do) to
 * 16. Stages "raster" and "readback". Fails with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_geometry_pass(const tl_gl *gl,
                           const tl_model *model,
                           const tl_scene_objects *objects,
                           uint32_t anisotropy,
                           tl_gbuffer *gbuffer,
                           tl_timings *timings,
                           tl_error *err);

#endif
