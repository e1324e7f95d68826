/* What tests that hold formulas against the oracle share: their cases are random, and each formula is tried
 * in float and in double. TILELIGHT_CASES in the environment is how many times as many cases are tried. */
#ifndef TL_FORMULA_CASES_H
#define TL_FORMULA_CASES_H

#include "figures.h"
#include "formulas.h"
#include "oracle/vectors.h"

static const formulas *const arithmetics[] = {&tl_formulas_float, &tl_formulas_double};

static inline int scaled_count(int count)
{
    const char *times = getenv("TILELIGHT_CASES");
    const long factor = times ? strtol(times, NULL, 10) : 1;
    return count * (int)(factor > 0 ? factor : 1);
}

/* Knuth's MMIX; its high bits. */
static inline uint64_t next_of(uint64_t *seed)
{
    return *seed = *seed * 6364136223846793005u + 1442695040888963407u;
}

static inline uint32_t bits_of(uint64_t *seed)
{
    return (uint32_t)(next_of(seed) >> 32);
}

/* In [0, 1). */
static inline double uniform_of(uint64_t *seed)
{
    return (double)(next_of(seed) >> 11) * 0x1p-53;
}

/* Of length 1, anywhere. */
static inline wide3 direction_of(uint64_t *seed)
{
    const double z = 2 * uniform_of(seed) - 1, phi = 6.283185307179586 * uniform_of(seed),
                 r = sqrt(1 - z * z);
    return (wide3){r * cos(phi), r * sin(phi), z};
}

/* a scale, as floats. */
static inline void round_to(float out[3], wide3 a, wide scale)
{
    out[0] = (float)(a.x * scale);
    out[1] = (float)(a.y * scale);
    out[2] = (float)(a.z * scale);
}

static inline figure figure_of(const char *section,
                               const char *formula,
                               const char *file,
                               const char *quantity,
                               const formulas *by,
                               const char *parts)
{
    return (figure){.section = section,
                    .formula = formula,
                    .file = file,
                    .quantity = quantity,
                    .arithmetic = by->name,
                    .unit = "u",
                    .parts = parts};
}

/* Of numbers that frames hold as floats, whatever computes with them: that is nearly all of the bound in
 * double. */
static inline figure figure_of_light(const char *formula,
                                     const char *file,
                                     const char *quantity,
                                     const formulas *by,
                                     const char *parts)
{
    figure f = figure_of("falloffs", formula, file, quantity, by, parts);
    if (by->u < 0x1p-24)
        f.unit = "u of float";
    return f;
}

#endif
