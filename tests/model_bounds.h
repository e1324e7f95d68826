/* What an arithmetic may make of a light's reflection: the bounds of kernels/halfway.h, specular.h and
 * lobe_*.h, with their letters, evaluated for one surface and one light in 128-bit floats. */
#ifndef TL_MODEL_BOUNDS_H
#define TL_MODEL_BOUNDS_H

#include "oracle/models.h"

#include <stdint.h>

/* An interval that contains what is computed. */
typedef struct span {
    wide low, high;
} span;

typedef struct bounds_of_reflection {
    span diffuse, specular, grazing;
    int is_decided; /* 0: rounding may decide whether the light, or h, is above the surface */
    int is_known;   /* 0: light and eye are so nearly opposite that rounding turns h anywhere */
} bounds_of_reflection;

/* u: half an ulp of 1. f0: grey. model: a row of kernels/models.h. */
bounds_of_reflection tl_bounds_of_reflection(uint32_t model,
                                             const tl_oracle_surface *s,
                                             wide f0,
                                             wide u);

#endif
