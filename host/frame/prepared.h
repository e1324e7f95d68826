/* A frame as the kernels take it, before any device is involved: view-space lights, what the scene
 * calls for, the constants of the frame. The device and the reference light the same one. */
#ifndef TL_PREPARED_H
#define TL_PREPARED_H

#include "frame.h"
#include "needs.h"
#include "tile_rect.h"

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

typedef struct tl_prepared {
    tl_frame frame;
    tl_needs needs;
    tl_view_light *lights; /* [capacity], the first frame.light_count are set; owned */
    uint32_t *sources;     /* [capacity], of each its index in the light set; owned */
    size_t capacity;
    uint32_t left_out_count; /* lights of types that lighting does not know */
} tl_prepared;

/* box_count: tl_frame.box_count. Fills *prepared, growing its lights where they do not fit; all zero is a valid start. Names the
 * lights it leaves out in a notice. Fails with TL_ERR_ARGUMENT (more than 2^31 lights) or
 * TL_ERR_MEMORY. */
tl_status tl_prepare(const tl_gbuffer *gbuffer,
                     const tl_light_set *lights,
                     uint32_t tile_size,
                     uint32_t box_count,
                     float light_cutoff,
                     const tl_notices *notices,
                     tl_prepared *prepared,
                     tl_error *err);

/* Leaves it all zero. */
void tl_prepared_clear(tl_prepared *prepared);

#endif
