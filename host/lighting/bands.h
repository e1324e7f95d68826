/* A frame on a device: whole where it fits, else band after band of its tile rows. Bands cannot
 * show: a tile is lit from its own pixels and its own list alone. */
#ifndef TL_BANDS_H
#define TL_BANDS_H

#include "passes.h"

/* What is kept of the lists of a frame: arrays of the caller's. */
typedef struct tl_kept_lists {
    uint32_t *lights; /* [tiles_y][tiles_x] of the frame: gets lengths of lists */
    /* the same: gets the effects that listed lights call for, bits TL_ON(effect) */
    uint64_t *effects;
    uint64_t *pairs; /* [TL_EFFECT_COUNT]: is raised by the entries that call for it */
    const uint64_t *light_effects; /* [light_count]: what each light calls for */
} tl_kept_lists;

typedef struct tl_band_options {
    int cull;                  /* 0: every tile lists every light */
    uint64_t memory_limit;     /* bytes of the device's own buffers; 0: what the device has */
    const tl_kept_lists *kept; /* NULL: nothing is */
    /* Of a layer, on devices that share memory: where its own radiance goes, of the image's size */
    tl_image *lit;
} tl_band_options;

/* Whether tiles are to have lists of their own: of what all share there may be nothing to cull. */
int tl_bands_cull(const tl_prepared *prepared, const tl_band_options *options);

/* Copies rows of the G-buffer's words, plane after plane, to TL_BUFFER_PLANES: context->frame.rows of them,
 * from frame.first_row - frame.buffer_row on. Fails with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_bands_upload_words(tl_pass_context *context,
                                const tl_gbuffer *gbuffer,
                                tl_error *err);

/* Lights the frame of context->prepared into the image; a layer, over what the image has. context->frame is
 * its own. *counts gets list_length, band_count, device_bytes and the device's times. Fails with
 * TL_ERR_ARGUMENT when one row of tiles is beyond the limit, TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_bands_light(tl_pass_context *context,
                         const tl_band_options *options,
                         const tl_gbuffer *gbuffer,
                         tl_image *image,
                         tl_timings *timings,
                         tl_lighting_counts *counts,
                         tl_error *err);

/* Shades the frame that was lit last once more, from the lists that are there, into an image of its size,
 * by the context's program for shading; *ms is the device's time. Fails with TL_ERR_UNSUPPORTED where it was
 * lit in bands, of whose lists the last alone are there; with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_bands_shade_again(tl_pass_context *context,
                               const tl_gbuffer *gbuffer,
                               tl_image *image,
                               const tl_lighting_counts *counts,
                               double *ms,
                               tl_error *err);

#endif
