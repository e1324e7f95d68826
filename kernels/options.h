/* The constants a kernel build is specialised by: these, and the knobs of knobs.h.
 *
 * The host turns this list into the fields of tl_kernel_options and into -D flags
 * (host/lighting/kernel_program.c). None has a default on the device, so a forgotten flag is a compile
 * error, and two builds that differ at all differ in this list. What changes from frame to frame
 * without another kernel being worth it (tile size, culling, counts) is in tl_frame. */
#ifndef TL_OPTIONS_H
#define TL_OPTIONS_H

#include "knobs.h"

/* X(name of the -D flag, field of tl_kernel_options)
 *
 *   width          lanes: 16 (AVX-512), 8 (AVX2), 4 or 1 (GPU)
 *   by_pixel       1: the path for GPUs, width 1: work-groups cull, a work-item shades a pixel
 *   real_double    1: compute in double; G-buffer and radiance remain float
 *   precise_power  1: log2 and exp2 of the library for our polynomials; slow, other bits
 *   orthographic   1: parallel rays
 *   layout         how pixels are packed: a row of layout.h
 *   present        the planes of the frame, bits 1 << plane
 *   specular       1: some light has a specular lobe and the frame a specular material
 *   falloffs       the rows of falloff.h that lights of the scene use, bits 1 << row
 *   model          how surfaces reflect that do not say: a row of models.h
 *   spots          1: some light has a cone; lights have tl_view_spots behind them then
 *   one_color      1: both lobes can be added before colours: needs.h
 *   ambient        1: there is ambient light
 *   idle           planes of the frame that are not read, for they change nothing: needs.h
 *   models         the rows of models.h that surfaces of the scene use, bits 1 << row: `model`, and those
 *                  of its materials
 *   choices        effects that tiles choose for themselves, bits of choices.h
 *   fixed_exponent 1: surfaces have the exponent of the frame
 *   timed          1: shade_tiles takes another argument and says there when it began and ended a tile
 *   shapes         what lights have beside the rest, bits of needs.h; 0: none has shapes
 *   sky            0, or how the sky is painted: needs.h
 *   surroundings   1: there is ambient light, and what stands around keeps it from pixels
 *   split          terms of the radiance that are written by themselves, bits 1 << term of aovs.h
 *   sky_light      0, or what surfaces have of the sky's light: bits of needs.h
 *   window         1: planes are a part of a picture, and begin at tl_rays.column0, row0 */
#define TL_KERNEL_OPTIONS(X)             \
    X(TL_WIDTH, width)                   \
    X(TL_BY_PIXEL, by_pixel)             \
    X(TL_REAL_DOUBLE, real_double)       \
    X(TL_PRECISE_POWER, precise_power)   \
    X(TL_ORTHOGRAPHIC, orthographic)     \
    X(TL_LAYOUT, layout)                 \
    X(TL_PRESENT, present)               \
    X(TL_SPECULAR, specular)             \
    X(TL_FALLOFFS_USED, falloffs)        \
    X(TL_MODEL, model)                   \
    X(TL_SPOTS, spots)                   \
    X(TL_ONE_COLOR, one_color)           \
    X(TL_AMBIENT, ambient)               \
    X(TL_IDLE, idle)                     \
    X(TL_MODELS_USED, models)            \
    X(TL_CHOICES, choices)               \
    X(TL_TIMED, timed)                   \
    X(TL_FIXED_EXPONENT, fixed_exponent) \
    X(TL_SHAPES, shapes)                 \
    X(TL_SKY, sky)                       \
    X(TL_SURROUNDINGS, surroundings)     \
    X(TL_SPLIT, split)                   \
    X(TL_SKY_LIGHT, sky_light)           \
    X(TL_WINDOW, window)

#ifdef __OPENCL_C_VERSION__
#    if !defined(TL_WIDTH) || !defined(TL_BY_PIXEL) || !defined(TL_REAL_DOUBLE) ||        \
        !defined(TL_PRECISE_POWER) || !defined(TL_ORTHOGRAPHIC) || !defined(TL_LAYOUT) || \
        !defined(TL_PRESENT) || !defined(TL_SPECULAR) || !defined(TL_FALLOFFS_USED) ||    \
        !defined(TL_MODEL) || !defined(TL_SPOTS) || !defined(TL_ONE_COLOR) ||             \
        !defined(TL_AMBIENT) || !defined(TL_IDLE) || !defined(TL_MODELS_USED) ||          \
        !defined(TL_CHOICES) || !defined(TL_FIXED_EXPONENT) || !defined(TL_TIMED) ||      \
        !defined(TL_SHAPES) || !defined(TL_SKY) || !defined(TL_SURROUNDINGS) ||           \
        !defined(TL_SKY_LIGHT) || !defined(TL_SPLIT) || !defined(TL_POWER) ||             \
        !defined(TL_WINDOW) || !defined(TL_FORM) || !defined(TL_ROOT) ||                  \
        !defined(TL_ARITHMETIC)
#        error "build the kernels through tl_program_build(), which passes every option"
#    endif
#    if TL_BY_PIXEL && TL_WIDTH != 1
#        error "a work-item for a pixel has a vector of one"
#    endif
#    if TL_WIDTH != 1 && TL_WIDTH != 4 && TL_WIDTH != 8 && TL_WIDTH != 16
#        error "TL_WIDTH must be 1, 4, 8 or 16"
#    endif
#endif

#endif
