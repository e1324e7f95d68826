/* Compiled once per arithmetic and instruction set: TL_TWIN is the name it then has. */
#include "occlusion.h"
#include "surround.h"

tl_surround_rows TL_TWIN;

static float *plane_of(const tl_frame *frame,
                       around_view a,
                       float *numbers,
                       enum tl_around_plane plane)
{
    return numbers + (around_plane(frame, a, plane) - numbers);
}

static void gather_pixel(const tl_prepared *prepared,
                         const tl_word_planes *planes,
                         around_view a,
                         uint32_t column,
                         uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    float *const numbers = (float *)(void *)prepared->lights;
    const size_t at = (size_t)row * frame->pitch + column;
    const tl_words words = tl_words_at(planes, at);
    const near_surface s = near_surface_of(frame, prepared->needs, planes->layout, &words,
                                           (real)column, (real)row);
    plane_of(frame, a, numbers, TL_AROUND_DEPTH)[at] = (float)s.depth;
    plane_of(frame, a, numbers, TL_AROUND_NORMAL_X)[at] = (float)s.normal.x;
    plane_of(frame, a, numbers, TL_AROUND_NORMAL_Y)[at] = (float)s.normal.y;
    plane_of(frame, a, numbers, TL_AROUND_NORMAL_Z)[at] = (float)s.normal.z;
}

static void occlude_pixel(const tl_prepared *prepared,
                          around_view a,
                          uint32_t column,
                          uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    float *const numbers = (float *)(void *)prepared->lights;
    const size_t at = (size_t)row * frame->pitch + column;
    const real depth = (real)around_plane(frame, a, TL_AROUND_DEPTH)[at];
    real share = R(1.0);
    if (depth < (real)INFINITY)
        share = rough_share(frame, prepared->needs, a, depth, around_normal(frame, a, at),
                            (real)column, (real)row);
    plane_of(frame, a, numbers, TL_AROUND_ROUGH)[at] = (float)share;
}

static void smooth_pixel(const tl_prepared *prepared,
                         around_view a,
                         uint32_t column,
                         uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    float *const numbers = (float *)(void *)prepared->lights;
    const size_t at = (size_t)row * frame->pitch + column;
    const real depth = (real)around_plane(frame, a, TL_AROUND_DEPTH)[at];
    real share = R(1.0);
    if (depth < (real)INFINITY)
        share = smooth_share(frame, prepared->needs, a, at, (real)column, (real)row);
    plane_of(frame, a, numbers, TL_AROUND_SHARE)[at] = (float)share;
}

void TL_TWIN(const tl_prepared *prepared,
             const tl_word_planes *planes,
             tl_surround_step step,
             size_t begin,
             size_t end)
{
    const uint32_t width = around_width(&prepared->frame);
    const around_view a = around_behind(&prepared->frame, (tl_numbers)prepared->lights);
    for (uint32_t row = (uint32_t)begin; row < end; row++)
        for (uint32_t column = 0; column < width; column++)
            if (step == TL_SURROUND_GATHER)
                gather_pixel(prepared, planes, a, column, row);
            else if (step == TL_SURROUND_OCCLUDE)
                occlude_pixel(prepared, a, column, row);
            else
                smooth_pixel(prepared, a, column, row);
}
