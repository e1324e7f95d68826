/* What a surface reflects of a light, as an interval that every correct kernel stays in: rough_lobes.c. */
#ifndef TL_ROUGH_LOBES_H
#define TL_ROUGH_LOBES_H

#include "rough.h"

#include "tilelight/check.h"

/* Of light that comes with weight 1 and without colours: reflection of kernels/surface.h. */
typedef struct rough_reflection {
    interval diffuse, specular, grazing;
} rough_reflection;

/* cosine: n.l, 0 and above. has_specular: kernels have the specular lobe at all. */
rough_reflection tl_rough_reflection(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form);

/* Reflectance at grazing angles: grazing_reflectance of kernels/finish.h. */
interval tl_rough_f90(const substance *made);

#endif
