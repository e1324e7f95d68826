/* Pictures of another size in C: what the text of the kernels, compiled once per arithmetic, is called
 * with. */
#ifndef TL_SCALE_ROWS_H
#define TL_SCALE_ROWS_H

#include "scale.h"

#include <stddef.h>

typedef struct tl_scale_job {
    tl_view_scale of;
    const float *tables;
    const float *from; /* [3][from_rows][from_pitch] */
    float *to;         /* [3][rows][pitch] */
    float *between;    /* [rows to be written][from_pitch], of one colour */
    unsigned color;
} tl_scale_job;

/* Rows [begin, end) of those to be written, of the job's colour: along columns into `between`, then along
 * rows into `to`. */
typedef void tl_scale_rows_twin(void *job, size_t begin, size_t end);

#endif
