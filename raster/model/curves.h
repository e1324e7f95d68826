/* Values between the keys of an animation: glTF 2.0, section 3.11 and appendix C. Nothing is checked
 * here, and nothing can fail. */
#ifndef TL_CURVES_H
#define TL_CURVES_H

#include <stdbool.h>
#include <stddef.h>

/* X(name, word of the file, elements per key, keys at least) */
#define TL_INTERPOLATIONS(X)     \
    X(TL_LINEAR, "LINEAR", 1, 1) \
    X(TL_STEP, "STEP", 1, 1)     \
    X(TL_CUBIC, "CUBICSPLINE", 3, 2)

enum tl_interpolation {
#define TL_INTERPOLATION_NAME(name, word, elements, keys) name,
    TL_INTERPOLATIONS(TL_INTERPOLATION_NAME)
#undef TL_INTERPOLATION_NAME
        TL_INTERPOLATION_COUNT
};

typedef struct tl_curve {
    enum tl_interpolation interpolation;
    bool rotates;            /* values are quaternions x y z w, none of length 0; width is 4 */
    size_t key_count, width; /* at least 1 */
    const float *times;      /* [key_count], s, each after the one before */
    const float *values; /* [key_count][width]; TL_CUBIC: [key_count][3][width], of which the
                              * first is the tangent before the key, the second its value */
} tl_curve;

/* out: [width], the value at `time`: the first key's before it, the last one's behind it. Rotations
 * are unit quaternions, or all 0 where a spline passes through that. */
void tl_curve_sample(const tl_curve *curve, double time, double *out);

#endif
