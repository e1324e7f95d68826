/* What a surface reflects of one light, by the equations of docs/conventions.md ("Shading models") and the
 * papers it names, in angles and 128-bit floats.
 *
 * Nothing of it is shared with kernels/lobe_*.h, which work with products of vectors and have no angles.
 * Off by less than 2^-90 of itself: angles by 10v, v = 2^-113; the steepest functions of them are powers of
 * 10000 and exp(-tan^2/alpha^2), where an angle counts 2^14 times, and 1/cos at a right angle, which the
 * limits of numbers end at 2^24. */
#ifndef TL_ORACLE_MODELS_H
#define TL_ORACLE_MODELS_H

#include "oracle/vectors.h"

/* A surface, the light and the eye. Directions are of any length but 0. */
typedef struct tl_oracle_surface {
    wide3 normal, to_light, to_eye;
    wide exponent;
    wide alpha, across; /* widths of the lobe; across: at right angles to `along` */
    wide k;             /* Minnaert's exponent */
    wide f90;           /* reflectance at grazing angles */
    wide3 along;
} tl_oracle_surface;

/* Of light of weight 1, of a surface whose colours are 1. Fresnel's reflectance is left to the caller:
 * F0 specular + (F90 - F0) grazing. The factors of the model that do not change from light to light, as
 * (e + 2)/8 and the diffuse colour, are as well. */
typedef struct tl_oracle_reflected {
    wide diffuse, specular, grazing;
} tl_oracle_reflected;

/* model: its word in lights files. diffuse is below 0 where there is no such model. */
tl_oracle_reflected tl_oracle_reflection(const char *model, const tl_oracle_surface *s);

/* min(1, 50 times the largest F0). */
wide tl_oracle_f90(const wide f0[3]);

#endif
