/* The passes of a frame on a device: cull, then shade. */
#ifndef TL_PASSES_H
#define TL_PASSES_H

#include "buffers.h"
#include "prepared.h"
#include "program.h"

/* What the passes of one frame work on; everything is borrowed. */
typedef struct tl_pass_context {
    const tl_device *device;
    const tl_program *program;
    tl_buffers *buffers;
    const tl_prepared *prepared;
    int precision_is_double;
} tl_pass_context;

/* Makes the lists of every tile: none are longer than needed, none is cut. *list_length is their
 * sum. TL_BUFFER_PLANES and TL_BUFFER_LIGHTS are set. Fails with TL_ERR_DEVICE, or
 * TL_ERR_UNSUPPORTED for lists of more than 2^32 entries in all. */
tl_status tl_pass_cull(const tl_pass_context *context, uint64_t *list_length, tl_error *err);

/* In place of tl_pass_cull: every tile lists every light that has a range. */
tl_status tl_pass_list_all(const tl_pass_context *context,
                           uint64_t *list_length,
                           tl_error *err);

/* Writes TL_BUFFER_RADIANCE. Returns when the device is done. */
tl_status tl_pass_shade(const tl_pass_context *context, tl_error *err);

#endif
