/* The frame that cases light, made once for all that share it. */
#ifndef TL_BENCH_FRAME_H
#define TL_BENCH_FRAME_H

#include "bench_case.h"
#include "pair_counts.h"
#include "tilelight/image.h"

/* All zero to begin with. */
typedef struct tl_bench_frame {
    tl_bench_case made_for; /* scene NULL: nothing is made */
    tl_gbuffer *gbuffer;    /* in full float */
    tl_gbuffer *packed[2];  /* as asked for last, in other layouts */
    int next;               /* of `packed`, to be replaced */
    const tl_gbuffer *ours; /* what our kernels light: one of the above */
    tl_light_set lights;
    tl_pair_counts pairs;
    tl_image *image;
    uint8_t *rgb; /* [height][width][3] */
} tl_bench_frame;

/* Makes *frame the one of this case, as far as it is not that already: cases of one scene, size and
 * material share the G-buffer. Fails with TL_ERR_ARGUMENT or
 * TL_ERR_MEMORY; then *frame is empty. */
tl_status tl_bench_frame_make(tl_bench_frame *frame, const tl_bench_case *of, tl_error *err);

/* The G-buffer of a frame that is made, in `layout`. *out is the frame's, until the second call after
 * this one that asks for another layout. Fails as tl_gbuffer_pack does. */
tl_status tl_bench_frame_in(tl_bench_frame *frame,
                            enum tl_layout_name layout,
                            const tl_gbuffer **out,
                            tl_error *err);

/* Leaves it all zero. */
void tl_bench_frame_clear(tl_bench_frame *frame);

#endif
