/* What kernels in float read of where a packed pixel is, for those who compute in double. */
#ifndef TL_FLOAT_POSITION_H
#define TL_FLOAT_POSITION_H

#include "packing.h"

/* out: in view space, m; z is -infinity where nothing was hit; x and y are 0 of layouts that store depth
 * in their place. */
typedef void tl_float_position(const tl_frame *frame,
                               tl_needs needs,
                               const tl_words *words,
                               float out[3]);

/* Of each layout its own, in which what is read of the table is constants. */
extern tl_float_position *const tl_float_position_of[TL_LAYOUT_COUNT];

#endif
