/* From radiance to the codes of a screen: exposure, tone curve, transfer curve, rounding. One text: in double
 * with the library's powers it says what a code is, in float it makes them, with the powers of power.h.
 *
 * Errors, in codes of 255 and u = 2^-24. A power x^(1/2.4) of x in [0, 1] by power.h is off by 11u at most:
 * log2 x by 9.6u of itself, of which z |ln z| <= 0.37 is left in z = x^(1/2.4), and exp2 by 7u. Times 255 and
 * 1.055 that is 1.8e-4 codes. What rounding x by k u does to it is k u of x |dz/dx| 255 1.055 <= 112 k u. A
 * tone curve of + - * / rounds its result by no more than 12u of itself where terms are of one sign, 8.0e-5
 * codes in all. So codes of curves that take each channel by itself are off by less than TL_CODE_SLACK before
 * they are rounded: tests/test_show.c holds all curves against formulas of its own. */
#ifndef TL_TONE_H
#define TL_TONE_H

#include "power.h"
#include "tones.h"
#include "vec3.h"

#define TL_CODE_SLACK R(0x1p-10) /* codes; 4 times what is derived above */

/* Radiance that curves are given: NaN and what is not above 0 is 0; beyond 2^60 every curve is white. */
TL_INLINE real exposed(real radiance, real scale)
{
    const real x = radiance * scale;
    return pick(x > R(0.0), pick(x < R(0x1p60), x, R(0x1p60)), R(0.0));
}

TL_INLINE real cut_to_unit(real x)
{
    return pick(x > R(0.0), pick(x < R(1.0), x, R(1.0)), R(0.0));
}

TL_INLINE real smaller_of(real a, real b)
{
    return pick(a < b, a, b);
}

TL_INLINE real larger_of(real a, real b)
{
    return pick(a > b, a, b);
}

TL_INLINE real curve_none(real x, scalar per_white2)
{
    (void)per_white2;
    return smaller_of(x, R(1.0));
}

/* E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 3. */
TL_INLINE real curve_reinhard(real x, scalar per_white2)
{
    (void)per_white2;
    return x / (R(1.0) + x);
}

/* Equation 4: what is `white` becomes 1; per_white2 = 1 / white^2. */
TL_INLINE real curve_reinhard_extended(real x, scalar per_white2)
{
    return smaller_of(x * (R(1.0) + x * per_white2) / (R(1.0) + x), R(1.0));
}

/* K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016: x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14). It
 * passes 1 at x = 7.24 and is cut there. */
TL_INLINE real curve_aces(real x, scalar per_white2)
{
    (void)per_white2;
    const real cut = smaller_of(x, R(8.0));
    const real y =
        cut * (R(2.51) * cut + R(0.03)) / (cut * (R(2.43) * cut + R(0.59)) + R(0.14));
    return smaller_of(y, R(1.0));
}

/* J. Hable, "Filmic Tonemapping Operators", 2010: A 0.15, B 0.50, C 0.10, D 0.20, E 0.02, F 0.30, exposed
 * twice, white at 11.2. The quotient less E/F is brought to one fraction, x (x A (1 - E/F) + B (C - E/F))
 * over the same, which has no difference of like numbers near 0; its constants are 0.14 and 1/60. */
TL_INLINE real hable_quotient(real x)
{
    return x * (R(0.14) * x + R(0.016666666666666666)) / (x * (R(0.15) * x + R(0.5)) + R(0.06));
}

TL_INLINE real curve_hable(real x, scalar per_white2)
{
    (void)per_white2;
    const real twice = smaller_of(R(2.0) * x, R(11.2));
    return hable_quotient(twice) / hable_quotient((real)R(11.2));
}

#define TONE_OF_CHANNELS(name, curve)                                       \
    TL_INLINE vec3 name(vec3 c, scalar per_white2)                          \
    {                                                                       \
        const vec3 toned = {curve(c.x, per_white2), curve(c.y, per_white2), \
                            curve(c.z, per_white2)};                        \
        return toned;                                                       \
    }
TONE_OF_CHANNELS(tone_none, curve_none)
TONE_OF_CHANNELS(tone_reinhard, curve_reinhard)
TONE_OF_CHANNELS(tone_reinhard_extended, curve_reinhard_extended)
TONE_OF_CHANNELS(tone_aces, curve_aces)
TONE_OF_CHANNELS(tone_hable, curve_hable)

/* A row of a matrix times a colour. */
TL_INLINE real weighted(vec3 c, scalar x, scalar y, scalar z)
{
    return FMA(c.x, x, FMA(c.y, y, c.z * z));
}

/* S. Hill's fit, 2016, in M. Pettineo's BakingLab: into the space that ACES desaturates in, the reference and
 * output transforms as one fraction, and back. The rows of both matrices add up to 1, to 1e-5. */
TL_INLINE real hill_fraction(real v)
{
    return (v * (v + R(0.0245786)) - R(0.000090537)) /
           (v * (R(0.983729) * v + R(0.4329510)) + R(0.238081));
}

TL_INLINE vec3 tone_aces_hill(vec3 c, scalar per_white2)
{
    (void)per_white2;
    const real x = hill_fraction(weighted(c, R(0.59719), R(0.35458), R(0.04823)));
    const real y = hill_fraction(weighted(c, R(0.07600), R(0.90834), R(0.01566)));
    const real z = hill_fraction(weighted(c, R(0.02840), R(0.13383), R(0.83777)));
    const vec3 v = {x, y, z};
    const vec3 toned = {cut_to_unit(weighted(v, R(1.60475), R(-0.53108), R(-0.07367))),
                        cut_to_unit(weighted(v, R(-0.10208), R(1.10813), R(-0.00605))),
                        cut_to_unit(weighted(v, R(-0.00327), R(-0.07276), R(1.07602)))};
    return toned;
}

/* x^exponent of x in [0, 1]; 0 of what is below 2^-60, whose power is below any code. */
TL_INLINE real power_of_unit(real x, scalar exponent)
{
    const mask is_there = x > R(0x1p-60);
    const real kept = pick(is_there, x, R(1.0));
    return pick(is_there, exp2_of_negative(log2_of_cos2(kept, (real)R(1.0)) * exponent),
                R(0.0));
}

/* B. Wrensch, "Minimal AgX Implementation", 2023, of T. Sobotka's AgX (2022): inset, 16.5 stops of log2, a
 * polynomial in place of the sigmoid, whose mean square error he gives as 3.7e-6, outset, and from the
 * display's code, the 2.2th power, to light. */
TL_INLINE real agx_sigmoid(real stops_above_0)
{
    const real least = R(-12.47393), most = R(4.026069);
    const real kept = larger_of(stops_above_0, R(0x1p-20));
    const real stops = log2_of_cos2(kept, (real)R(1.0));
    const real x = (smaller_of(larger_of(stops, least), most) - least) / (most - least);
    real y = FMA(x, R(15.5), R(-40.14));
    y = FMA(x, y, R(31.96));
    y = FMA(x, y, R(-6.868));
    y = FMA(x, y, R(0.4298));
    y = FMA(x, y, R(0.1191));
    return FMA(x, y, R(-0.00232));
}

/* From the display's code to light. */
TL_INLINE real agx_light(real code)
{
    return power_of_unit(cut_to_unit(code), R(2.2));
}

TL_INLINE vec3 tone_agx(vec3 c, scalar per_white2)
{
    (void)per_white2;
    const real x = agx_sigmoid(
        weighted(c, R(0.842479062253094), R(0.0784335999999992), R(0.0792237451477643)));
    const real y = agx_sigmoid(
        weighted(c, R(0.0423282422610123), R(0.878468636469772), R(0.0791661274605434)));
    const real z =
        agx_sigmoid(weighted(c, R(0.0423756549057051), R(0.0784336), R(0.879142973793104)));
    const vec3 v = {x, y, z};
    const vec3 toned = {agx_light(weighted(v, R(1.19687900512017), R(-0.0980208811401368),
                                           R(-0.0990297440797205))),
                        agx_light(weighted(v, R(-0.0528968517574562), R(1.15190312990417),
                                           R(-0.0989611768448433))),
                        agx_light(weighted(v, R(-0.0529716355144438), R(-0.0980434501171241),
                                           R(1.15107367264116)))};
    return toned;
}

/* Khronos, "PBR Neutral Tone Mapper" (2024): less what 4 % of reflection adds, as it is up to 0.76, from
 * there a hyperbola of the largest channel, and towards white. */
TL_INLINE vec3 tone_neutral(vec3 c, scalar per_white2)
{
    (void)per_white2;
    const real low = smaller_of(c.x, smaller_of(c.y, c.z));
    const real offset = pick(low < R(0.08), low - R(6.25) * low * low, R(0.04));
    const vec3 less = {c.x - offset, c.y - offset, c.z - offset};
    const real peak = larger_of(less.x, larger_of(less.y, less.z));
    const mask is_bright = peak > R(0.76);
    const real kept = pick(is_bright, peak, R(1.0));
    const real squeezed = R(1.0) - R(0.0576) / (kept - R(0.52)); /* 0.24^2; 2 * 0.76 - 1 */
    const real ratio = squeezed / kept;
    const real white = R(1.0) - R(1.0) / (R(0.15) * (kept - squeezed) + R(1.0));
    const real color = ratio * (R(1.0) - white), gray = squeezed * white;
    const vec3 bright = {FMA(less.x, color, gray), FMA(less.y, color, gray),
                         FMA(less.z, color, gray)};
    const vec3 toned = pick3(is_bright, bright, less);
    const vec3 cut = {cut_to_unit(toned.x), cut_to_unit(toned.y), cut_to_unit(toned.z)};
    return cut;
}

/* Of exposed radiance; `tone` is the same for all lanes. */
TL_INLINE vec3 toned(vec3 c, tl_u32 tone, scalar per_white2)
{
#define TONE_ROW(name, word, mixes, function, source) \
    if (tone == name)                                 \
        return function(c, per_white2);
    TL_TONE_CURVES(TONE_ROW)
#undef TONE_ROW
    return c;
}

/* From display-linear [0, 1] to the signal, 0 to 1. */
TL_INLINE real signal_of(real y, tl_u32 curve)
{
    if (curve == TL_CURVE_GAMMA_22)
        return power_of_unit(y, R(0.45454545454545454));
    const real bent = FMA(power_of_unit(y, R(0.4166666666666667)), R(1.055), R(-0.055));
    return pick(y > R(0.0031308), smaller_of(bent, R(1.0)), R(12.92) * y);
}

/* What codes are made by, the same for all pixels. */
typedef struct tl_view_look {
    float scale;      /* 2^exposure */
    float per_white2; /* of tone curves that have a white */
    tl_u32 tone, curve;
    tl_u32
        is_exact; /* thresholds decide between codes: no dither, and a tone of single channels */
    tl_u32 unused[3];
} tl_view_look;
TL_STATIC_ASSERT(sizeof(tl_view_look) == 32, view_look_is_two_rows);

/* Three values of 0 to 255 on their way to codes. */
TL_INLINE vec3 shown_of(vec3 radiance, const tl_view_look *look)
{
    const vec3 c = {exposed(radiance.x, (real)(scalar)look->scale),
                    exposed(radiance.y, (real)(scalar)look->scale),
                    exposed(radiance.z, (real)(scalar)look->scale)};
    const vec3 y = toned(c, look->tone, (scalar)look->per_white2);
    const vec3 shown = {R(255.0) * signal_of(y.x, look->curve),
                        R(255.0) * signal_of(y.y, look->curve),
                        R(255.0) * signal_of(y.z, look->curve)};
    return shown;
}

/* thresholds: [257], the least radiance of each code, and NaN, which nothing reaches. `guess` is the code but
 * where a value, before it was cut to it, lay within TL_CODE_SLACK of another: there they decide. */
TL_INLINE integer code_by_thresholds(integer guess,
                                     real radiance,
                                     real before_cut,
                                     tl_numbers thresholds)
{
    const real above = before_cut - TO_REAL(guess);
    const mask is_near = (above < TL_CODE_SLACK) | (above > R(1.0) - TL_CODE_SLACK);
    if (!any_lane(is_near))
        return guess;
    const real own = GATHER(thresholds, guess), next = GATHER(thresholds, guess + 1);
    const real up = pick(radiance >= next, R(1.0), R(0.0));
    const real down = pick(radiance < own, R(1.0), R(0.0));
    return guess + TO_INTEGER(up - down);
}

/* The code of one channel: `added` is the dither's or the rounding. */
TL_INLINE integer
code_of(real shown, real added, real radiance, const tl_view_look *look, tl_numbers thresholds)
{
    const real before_cut = shown + added;
    const integer guess = TO_INTEGER(before_cut); /* truncates; none is below 0 */
    if (!look->is_exact)
        return guess;
    return code_by_thresholds(guess, pick(radiance > R(0.0), radiance, R(0.0)), before_cut,
                              thresholds);
}

#endif
