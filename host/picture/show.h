/* How codes are made, prepared once for a picture: what the kernel of host/post/ and the twin in C both
 * take. */
#ifndef TL_SHOW_H
#define TL_SHOW_H

#include "tone.h"

#include "tilelight/image.h"

#include <stddef.h>
#include <stdint.h>

/* Numbers behind one another in memory, as the kernel has them. */
enum {
    TL_SHOW_TILE =
        0, /* [TL_DITHER_SIDE][TL_DITHER_SIDE]: what is added before a value is cut */
    TL_SHOW_THRESHOLDS =
        TL_DITHER_SIDE * TL_DITHER_SIDE, /* [257]: the least radiance of each code; NaN */
    TL_SHOW_NUMBERS = TL_SHOW_THRESHOLDS + 257
};

typedef struct tl_show {
    tl_view_look look;
    float numbers[TL_SHOW_NUMBERS];
} tl_show;

/* Cannot fail. */
void tl_show_prepare(tl_show *show, float exposure, tl_look look);

/* Whether a kernel's codes are those of tl_image_to_rgb8: where floats hold the exposure. */
int tl_show_fits(float exposure);

/* What the text of the kernel, compiled once per instruction set, is called with: rows [begin, end). */
typedef struct tl_show_job {
    const tl_show *show;
    const float *from[3]; /* [rows][pitch] */
    size_t pitch, width;
    uint8_t *rgb; /* [rows][width][3] */
} tl_show_job;

typedef void tl_show_rows_twin(void *job, size_t begin, size_t end);

#endif
