/* Where a packed pixel is as kernels in float read it, for those who compute in double. */
#ifndef TL_FLOAT_POSITION_H
#define TL_FLOAT_POSITION_H

#include "packing.h"

/* out: in view space, m; z is -infinity where nothing was hit. */
void tl_float_position(const tl_frame *frame,
                       tl_needs needs,
                       const tl_layout *layout,
                       const tl_words *words,
                       uint32_t column,
                       uint32_t row,
                       float out[3]);

#endif
