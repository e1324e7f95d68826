/* A frame on a device: whole where it fits, else band after band of its tile rows. Bands cannot
 * show: a tile is lit from its own pixels and its own list alone. */
#ifndef TL_BANDS_H
#define TL_BANDS_H

#include "passes.h"

typedef struct tl_band_options {
    int cull;              /* 0: every tile lists every light */
    uint64_t memory_limit; /* bytes of the device's own buffers; 0: what the device has */
    uint32_t *tile_lights; /* [tiles_y][tiles_x] of the frame: gets lengths of lists; or NULL */
} tl_band_options;

/* Lights the frame of context->prepared into the image; context->frame is its own. *counts gets
 * list_length, band_count, device_bytes and the device's times. Fails with TL_ERR_ARGUMENT when one
 * row of tiles is beyond the limit, TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_bands_light(tl_pass_context *context,
                         const tl_band_options *options,
                         const tl_gbuffer *gbuffer,
                         tl_image *image,
                         tl_timings *timings,
                         tl_lighting_counts *counts,
                         tl_error *err);

#endif
