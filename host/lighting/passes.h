/* The passes of a frame on a device: cull, then shade. */
#ifndef TL_PASSES_H
#define TL_PASSES_H

#include "buffers.h"
#include "kernel_program.h"
#include "prepared.h"

enum { TL_MAX_LAUNCHES = 16 };

/* What the passes of one band work on; everything but `frame` and `launches` is borrowed. */
typedef struct tl_pass_context {
    const tl_device *device;
    const tl_program *programs[TL_PART_COUNT]; /* NULL: the part is not needed */
    tl_buffers *buffers;
    const tl_prepared *prepared;
    tl_frame frame; /* of the band */
    int precision_is_double;
    int by_pixel;         /* 1: the path for GPUs, and a program for it */
    int ignores_lists;    /* 1: shading takes every list for empty */
    int has_surroundings; /* 1: their planes in TL_BUFFER_LIGHTS are those of this picture */
    /* of the first launch that has finished, on tl_seconds' clock; or 0 */
    double first_start_s;
    int launch_count;
    struct {
        cl_event event;
        double *ms; /* where its time is added */
    } launches[TL_MAX_LAUNCHES];
} tl_pass_context;

/* Tiles of a band. */
size_t tl_tile_count(const tl_frame *frame);

/* Entries that lists have in all. */
typedef struct tl_list_lengths {
    uint64_t tiles, cells; /* cells: 0 where lights are not listed by cell first */
} tl_list_lengths;

/* Bounds the tiles and lists their lights. If the lengths are more than the list buffers have had room
 * for (tl_lists_fit), the lists are not complete; if that holds for those of cells, the length of
 * those of tiles is not known yet and 0. TL_BUFFER_PLANES and TL_BUFFER_LIGHTS are set; there is a
 * light with a range. Waits for the device. Device time is added to *ms by tl_pass_finish. Fails with
 * TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_pass_cull(tl_pass_context *context,
                       tl_list_lengths *lengths,
                       double *ms,
                       tl_error *err);

/* Whether what was culled last is complete. */
int tl_lists_fit(const tl_pass_context *context, const tl_list_lengths *lengths);

/* Makes room for lists of these lengths, below 2^32, and makes them again; says their lengths anew. */
tl_status tl_pass_cull_again(tl_pass_context *context,
                             tl_list_lengths *lengths,
                             double *ms,
                             tl_error *err);

/* In place of culling: every tile lists every light that has a range. */
tl_status tl_pass_list_all(tl_pass_context *context, uint64_t *list_length, tl_error *err);

/* Writes the planes of surroundings in TL_BUFFER_LIGHTS, where the frame, whole and with all its planes,
 * needs some. Device time is added to *ms by tl_pass_finish. */
tl_status tl_pass_occlude(tl_pass_context *context, double *ms, tl_error *err);

/* Writes TL_BUFFER_RADIANCE, and TL_BUFFER_TIMES where the program is a timed one. */
tl_status tl_pass_shade(tl_pass_context *context, double *ms, tl_error *err);

/* TL_BUFFER_BEHIND becomes what is seen through a layer: TL_BUFFER_RADIANCE by TL_BUFFER_OPACITY over it. */
tl_status tl_pass_blend(tl_pass_context *context, double *ms, tl_error *err);

/* Waits for the device, adds up the times of what was launched, and forgets the launches. To be
 * called whether or not a pass failed. */
tl_status tl_pass_finish(tl_pass_context *context, tl_error *err);

#endif
