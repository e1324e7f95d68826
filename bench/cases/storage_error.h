/* What a layout's bytes cost in accuracy: the picture lit from it against the one lit from full float,
 * both in double, so that what is left is the error of storing alone. */
#ifndef TL_STORAGE_ERROR_H
#define TL_STORAGE_ERROR_H

#include "bench_frame.h"
#include "tilelight/compare.h"
#include "tilelight/lighting.h"

typedef struct tl_storage_error {
    int is_known;     /* 0: in full float, in the dark, on a device without double precision */
    uint32_t lost;    /* planes that the layout has no place for; they are part of the error */
    tl_difference of; /* relative to the mean of the picture from full float */
} tl_storage_error;

/* Of the case's layout on its frame, which is made. device may be NULL. Fails as tl_lighting_run and
 * tl_gbuffer_pack do. */
tl_status tl_storage_error_find(tl_device *device,
                                const tl_bench_case *of,
                                tl_bench_frame *frame,
                                tl_storage_error *out,
                                tl_error *err);

#endif
