/* The passes of a frame on a device: cull, then shade. */
#ifndef TL_PASSES_H
#define TL_PASSES_H

#include "buffers.h"
#include "kernel_program.h"
#include "prepared.h"

enum { TL_MAX_LAUNCHES = 8 };

/* What the passes of one band work on; everything but `frame` and `launches` is borrowed. */
typedef struct tl_pass_context {
    const tl_device *device;
    const tl_program *program;
    tl_buffers *buffers;
    const tl_prepared *prepared;
    tl_frame frame; /* of the band */
    int precision_is_double;
    double first_start_s; /* of the first launch that has finished, on tl_seconds' clock; or 0 */
    int launch_count;
    struct {
        cl_event event;
        double *ms; /* where its time is added */
    } launches[TL_MAX_LAUNCHES];
} tl_pass_context;

/* Bounds the tiles and lists their lights. *list_length is how many entries the lists have in all:
 * if that is more than the list buffer has had room for, they are not complete, and
 * tl_pass_cull_again makes them. TL_BUFFER_PLANES and TL_BUFFER_LIGHTS are set; there is a light with
 * a range. Waits for the device. Device time is added to *ms by tl_pass_finish. Fails with
 * TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_pass_cull(tl_pass_context *context,
                       uint64_t *list_length,
                       double *ms,
                       tl_error *err);

/* Makes room for lists of this length, below 2^32, and makes them again, where there was none. */
tl_status tl_pass_cull_again(tl_pass_context *context,
                             uint64_t list_length,
                             double *ms,
                             tl_error *err);

/* In place of the two: every tile lists every light that has a range. */
tl_status tl_pass_list_all(tl_pass_context *context, uint64_t *list_length, tl_error *err);

/* Writes TL_BUFFER_RADIANCE. */
tl_status tl_pass_shade(tl_pass_context *context, double *ms, tl_error *err);

/* Waits for the device, adds up the times of what was launched, and forgets the launches. To be
 * called whether or not a pass failed. */
tl_status tl_pass_finish(tl_pass_context *context, tl_error *err);

#endif
