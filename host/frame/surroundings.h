/* What lighting needs to keep ambient light from pixels by what stands around them (kernels/occlusion.h). */
#ifndef TL_SURROUNDINGS_H
#define TL_SURROUNDINGS_H

#include "prepared.h"

/* Adds a tl_view_surroundings and its table of slices as sections, at frame.surroundings_at, and room for
 * its planes behind, prepared->planes_size: no section may follow. samples: of a row of
 * TL_OCCLUSION_SAMPLES, or 0. Fails as tl_section_add does, and with TL_ERR_ARGUMENT for other samples. */
tl_status tl_surroundings_add(const tl_gbuffer *gbuffer,
                              const tl_light_set *lights,
                              uint32_t samples,
                              tl_prepared *prepared,
                              tl_error *err);

#endif
