#include "float_position.h"

void tl_float_position(const tl_frame *frame,
                       tl_needs needs,
                       const tl_layout *layout,
                       const tl_words *words,
                       uint32_t column,
                       uint32_t row,
                       float out[3])
{
    const vec3 p = position_of(frame, needs, layout, words, (real)column, (real)row);
    out[0] = p.x;
    out[1] = p.y;
    out[2] = p.z;
}
