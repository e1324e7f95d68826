/* The same frames on the CPU, from the same formulas: no tiles, no lists, no OpenCL. */
#ifndef TL_REFERENCE_H
#define TL_REFERENCE_H

#include "prepared.h"

#include "tilelight/image.h"

/* X(name, word) */
#define TL_ARITHMETICS(X)           \
    X(TL_TWIN_FLOAT, float)         \
    X(TL_TWIN_CHOSEN, chosen_float) \
    X(TL_TWIN_DOUBLE, double)       \
    X(TL_TWIN_REFERENCE, reference)

/* float and double give the bits of the kernels of that precision; chosen those of the kernels in float under
 * prepared->approximations; reference is double with the library's powers, the yardstick of every error. */
typedef enum tl_arithmetic {
#define TL_ARITHMETIC_NAME(name, word) name,
    TL_ARITHMETICS(TL_ARITHMETIC_NAME)
#undef TL_ARITHMETIC_NAME
        TL_ARITHMETIC_COUNT
} tl_arithmetic;

/* Lights every pixel with every light, on all threads; a layer, over what the image has. image has the
 * G-buffer's size. Cannot fail. */
void tl_reference_light(const tl_prepared *prepared,
                        const tl_gbuffer *gbuffer,
                        tl_arithmetic arithmetic,
                        tl_image *image);

#endif
