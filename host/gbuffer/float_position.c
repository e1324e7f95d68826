#include "float_position.h"

static inline vec3 position_in(const tl_layout *layout,
                               const tl_frame *frame,
                               tl_needs needs,
                               const tl_words *words)
{
    if (TL_IS_POSITION(layout->depth.code))
        return stored_position(frame, layout, words);
    return (vec3){0.0f, 0.0f,
                  -depth_of(frame, needs, layout->depth.code, stored_depth(layout, words))};
}

#define POSITION_OF(name, row, word)                                                      \
    static __attribute__((flatten)) void in_##name(const tl_frame *frame, tl_needs needs, \
                                                   const tl_words *words, float out[3])   \
    {                                                                                     \
        const vec3 p = position_in(&tl_layouts[name], frame, needs, words);               \
        out[0] = p.x;                                                                     \
        out[1] = p.y;                                                                     \
        out[2] = p.z;                                                                     \
    }
TL_LAYOUTS(POSITION_OF)
#undef POSITION_OF

tl_float_position *const tl_float_position_of[TL_LAYOUT_COUNT] = {
#define POSITION_OF(name, row, word) [name] = in_##name,
    TL_LAYOUTS(POSITION_OF)
#undef POSITION_OF
};
