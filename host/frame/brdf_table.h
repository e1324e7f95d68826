/* Rows of materials by the indices of a frame: which surfaces reflect by what. */
#ifndef TL_BRDF_TABLE_H
#define TL_BRDF_TABLE_H

#include "frame.h"

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

#include <stdbool.h>

enum { TL_BRDF_COUNT = TL_MAX_MATERIALS + 1 };

/* By the index of a pixel. */
typedef struct tl_brdf_table {
    /* those without a row of the set have its model, and give nothing */
    tl_brdf rows[TL_BRDF_COUNT];
    int sources[TL_BRDF_COUNT]; /* rows of the set; -1: none */
    /* whether a surface has it; all that have a row where it is not known */
    bool occurs[TL_BRDF_COUNT];
    bool selects;    /* an index that occurs has a row */
    uint32_t models; /* of indices that occur: bits 1 << model */
} tl_brdf_table;

/* Fails with TL_ERR_FORMAT, naming the row and the material, for a name that the capture does not have, two
 * rows of one index, and an index that occurs and has neither row nor name. */
tl_status tl_brdf_table_make(const tl_gbuffer *gbuffer,
                             const tl_light_set *lights,
                             tl_brdf_table *out,
                             tl_error *err);

#endif
