/* Each lobe of kernels/lobe_*.h in intervals. Vectors move by what allowance.c says; a formula then carries
 * the ends of what it takes to the ends of what it gives, each step widened by what it may round:
 *
 *   angle of n and h    h moves, n moves, n.h rounds: `turn`
 *   sin^2, cos^2        as stable_error has them: 40u of sin^2 and 900u^2, 62u of cos^2; where sin^2 is
 *                       1 - (n.h)^2, 80u more
 *   v.h                 h and |l| move; 40u of itself for lengths, roots and quotients, 4u for a sum
 *   n.v                 n and v move; 4u for its sum, 27u of itself for lengths
 *   alpha^2             10u of itself: four products, or a sum and a quotient
 *
 * Where the half vector is not known, for light and eye are opposite, any angle is. */
#include "rough_lobes.h"

#include <math.h>

static double length_of(vec3 v)
{
    return sqrt(dot3(v, v));
}

static const double right = 1.57079632679489661923;

/* The half vector h = l + |l| v, or that divided by |l|: l moves, as a unit vector its length errs by 13.5u;
 * |l| is off by what the distance is; v moves; the products and sums round. The angle between n and h is then
 * known to within a turn, and 3u more for the rounding of n.h. */
typedef struct rough_half {
    vec3 h;                     /* exact */
    double length, angle, turn; /* angle: of n and h */
    int is_known, is_below;     /* is_below: whatever rounding does */
    interval cos2, sin2, eye;   /* eye: v.h of unit vectors */
} rough_half;

static interval squares_of(double low, double high, double of_itself, double beside)
{
    const interval square = {low * low * (1.0 - of_itself * U) - beside,
                             high * high * (1.0 + of_itself * U) + beside};
    return at_most((interval){clamp_low(square.low), square.high}, 1.0);
}

static rough_half half_of(const rough_surface *s, const way *w, tl_cosine form)
{
    const surface *e = &s->exact;
    rough_half a = {.h = fma3(e->to_eye, w->exact, w->l)};
    a.length = length_of(a.h);
    const double distance_off = fmax(w->distance.high - w->exact, w->exact - w->distance.low);
    const double h_moved =
        w->l_moved + distance_off + U * a.length + w->exact * (s->eye_moved + 8.0 * U);
    a.is_known = s->has_normal && s->has_eye && h_moved < 0.5 * a.length &&
                 a.length * a.length > 1e-30 && a.length * a.length < 1e37;
    a.cos2 = a.sin2 = a.eye = (interval){0.0, 1.0};
    if (!a.is_known)
        return a;
    const vec3 n = e->normal, h = a.h;
    const vec3 cross = {n.y * h.z - n.z * h.y, n.z * h.x - n.x * h.z, n.x * h.y - n.y * h.x};
    a.angle = atan2(length_of(cross), dot3(n, h));
    a.turn = asin(h_moved / a.length) + s->normal_moved + 3.0 * U;
    a.is_below = a.angle - a.turn > right;
    const double least = fmin(clamp_low(a.angle - a.turn), right),
                 most = fmin(a.angle + a.turn, right);
    const double beside = 900.0 * U * U + (form == TL_COSINE_TEXTBOOK ? 80.0 * U : 0.0);
    a.sin2 = squares_of(sin(least), sin(most), 40.0, beside);
    a.cos2 = squares_of(cos(most), cos(least), 62.0, 0.0);
    const double low = (a.length - h_moved) / (2.0 * w->distance.high),
                 high = (a.length + h_moved) / (2.0 * w->distance.low);
    a.eye = at_most((interval){clamp_low(low * (1.0 - 40.0 * U) - 4.0 * U),
                               high * (1.0 + 40.0 * U) + 4.0 * U},
                    1.0);
    return a;
}

/* cos^e by its logarithm, e ln cos, which falls with the angle. */
static double log_of_power(double cosine, double exponent)
{
    return exponent > 0.0 ? exponent * log(cosine) : 0.0;
}

/* What an approximated quotient does to both squares, beyond the first order: less than as much again,
 * times it. */
static double squared_off(const tl_off *off)
{
    return off->quotient * (1.0 + 2.0 * off->quotient);
}

/* What an approximated exp2 does to a power, which is at least half of the power of two above. */
static double power_off(const tl_off *off)
{
    return 2.1 * off->exp2;
}

/* How far the logarithm may be off in the stable form, for exact n and h. Of s = sin, c = cos:
 *   near the peak  sin^2 is off by 9u s^2 for its squares and quotient, 4u s^2 for a division less
 *                  exact than IEEE's, 27u s^2 where h is made unit beforehand, and by (30u)^2 for
 *                  the length of n, which moves the part of h across n along n. The logarithm of
 *                  1 - sin^2 is steeper by 1/c^2.
 *   elsewhere      cos^2 is off by 27u for the length of n, 27u for that of h, 8u for its product
 *                  and quotient. (What rounds in n.h itself counts as a turn of h.)
 * Both branches meet at s^2 = 1/4; the second bound is the larger one there. Then log2 or log1p,
 * its factor, and the product with e/2: 14u of the logarithm; and the power itself. */
static double stable_error(const tl_off *off, double cosine, double exponent, double log_power)
{
    const double sin2 = clamp_low(1.0 - cosine * cosine), cos2 = cosine * cosine;
    const double quotient = squared_off(off);
    const double near_peak =
        (U * (40.0 * sin2 + 900.0 * U) + quotient * sin2 + off->cosine) / cos2;
    const double of_square = sin2 < 0.2 ? near_peak : 62.0 * U + quotient + off->cosine;
    return 0.5 * exponent * of_square + (14.0 * U + off->log2) * -log_power + power * U +
           power_off(off);
}

/* A power below 2^-63 is as good as 0: kernels/specular.h ends at 2^-64. */
static const double floor_of_power = 0x1p-63;

/* pow(n.h, e): n.h is off by 3u for its sum, and by 27u + 6u of itself for lengths and quotient. */
static interval textbook_power(const tl_off *off, interval cosine, interval exponent)
{
    const double steps = 33.0 * U + 0.5 * (squared_off(off) + off->cosine);
    const double low = clamp_low(cosine.low * (1.0 - steps) - 3.0 * U);
    const double high = cosine.high * (1.0 + steps) + 3.0 * U;
    const double low_exponent = high < 1.0 ? exponent.low : exponent.high;
    const double dim = log_of_power(low, exponent.high),
                 bright = log_of_power(high, low_exponent);
    const double by = power * U + power_off(off);
    const double more = 1.0 + off->log2, less = 1.0 - off->log2;
    return (interval){
        clamp_low(exp(dim * (dim < 0.0 ? more : less)) * (1.0 - by) - floor_of_power),
        exp(bright * (bright < 0.0 ? less : more)) * (1.0 + by) + floor_of_power};
}

static interval stable_power(const tl_off *off, interval cosine, interval exponent)
{
    const double low = log_of_power(cosine.low, exponent.high);
    const double high = log_of_power(cosine.high, exponent.low);
    const double dim =
        exp(low - stable_error(off, cosine.low, exponent.high, low)) - floor_of_power;
    const double bright =
        exp(high + stable_error(off, cosine.high, exponent.low, high)) + floor_of_power;
    const double most = 1.0 + power * U;
    return (interval){cosine.low > 0.0 ? clamp_low(dim) : 0.0, bright < most ? bright : most};
}

static const interval nothing = {0.0, 0.0};

static interval power_of(const rough_surface *s, interval cosine, tl_cosine form)
{
    if (cosine.high < 0.0)
        return nothing;
    return form == TL_COSINE_TEXTBOOK ? textbook_power(&s->off, cosine, s->exponent)
                                      : stable_power(&s->off, cosine, s->exponent);
}

/* Of an angle known to within a turn; what is behind is below 0. */
static interval cosine_of(double angle, double turn)
{
    return (interval){angle + turn < right ? cos(angle + turn) : 0.0, angle < turn ? 1.0
                                                                      : angle - turn < right
                                                                          ? cos(angle - turn)
                                                                          : -1.0};
}

static const interval unknown_power = {0.0, 1.0 + 0x1p-18};

static interval blinn_power(const rough_surface *s, const way *w, tl_cosine form)
{
    const rough_half a = half_of(s, w, form);
    return a.is_known ? power_of(s, cosine_of(a.angle, a.turn), form) : unknown_power;
}

/* The angle that a direction has turned by when the end of a vector moved. */
static double turn_of(double by, double length)
{
    return by < length ? asin(by / length) : 2.0 * right;
}

/* R = 2 (n.l) n - l turns as l does, and twice as n does; 2 (n.l) is off by 6u |l|, the parts of R by 2u
 * more, and lengths of n and l, 27u each, tilt it by twice as much: 120u. */
static interval mirror_power(const rough_surface *s, const way *w, tl_cosine form)
{
    const vec3 n = s->exact.normal, v = s->exact.to_eye;
    if (!s->has_normal || !s->has_eye || !(w->exact > 0.0))
        return unknown_power;
    const vec3 back = {-w->l.x, -w->l.y, -w->l.z};
    const vec3 r = fma3(n, 2.0 * dot3(n, w->l), back);
    const vec3 cross = {v.y * r.z - v.z * r.y, v.z * r.x - v.x * r.z, v.x * r.y - v.y * r.x};
    const double turn =
        turn_of(w->l_moved, w->exact) + 2.0 * s->normal_moved + s->eye_moved + 120.0 * U;
    return power_of(s, cosine_of(atan2(length_of(cross), dot3(v, r)), turn), form);
}

/* n.v, with its sign. */
static interval facing_eye(const rough_surface *s)
{
    if (!s->has_normal || !s->has_eye)
        return (interval){-1.0, 1.0};
    const double exact = dot3(s->exact.normal, s->exact.to_eye);
    const double off = s->normal_moved + s->eye_moved + 4.0 * U + 27.0 * U * fabs(exact);
    return (interval){exact - off, exact + off};
}

static interval magnitude(interval a)
{
    const double low = fabs(a.low), high = fabs(a.high);
    return (interval){a.low <= 0.0 && a.high >= 0.0 ? 0.0 : fmin(low, high), fmax(low, high)};
}

static interval at_least(interval a, double least)
{
    return (interval){fmax(a.low, least), fmax(a.high, least)};
}

/* (1 - v.h)^5; the difference rounds, and what it is raised to by whatever means. */
static interval schlick_interval(interval eye)
{
    const double low = clamp_low(1.0 - eye.high - U), high = clamp_low(1.0 - eye.low) + U;
    return (interval){pow(low, 5.0) * (1.0 - power * U), pow(high, 5.0) * (1.0 + power * U)};
}

/* F0 is off by 4u (0.04 + itself) where it is mixed of metal and dielectric. */
interval tl_rough_f90(const substance *made)
{
    const double f0 = largest(made->specular);
    const double error = U * (50.0 * 4.0 * (TL_DIELECTRIC + f0) + 2.0 * 50.0 * f0);
    return at_most(around(50.0 * f0, f0 > 0.0 ? error : 0.0), 1.0);
}

/* sqrt(alpha^2 + (1 - alpha^2) cos^2): a sum of numbers above 0; 1 - alpha^2 is off by u of 1, which is as
 * large as the sum where it counts. */
static double root_of(double alpha2, double cosine)
{
    return sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
}

/* n.l / (n.l m + n.v r(n.l)): it grows with n.l and falls with n.v. */
static double unmasked(double light, double eye, double alpha2, double by)
{
    if (!(light > 0.0))
        return 0.0;
    return light / (by * (light * root_of(alpha2, eye) + eye * root_of(alpha2, light)));
}

static rough_reflection metal_rough(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form)
{
    const rough_half a = half_of(s, w, form);
    const interval graze = schlick_interval(a.eye), f90 = tl_rough_f90(&s->made);
    rough_reflection r = {
        .diffuse = rounded((interval){cosine.low * clamp_low(1.0 - f90.high * graze.high - U),
                                      cosine.high * (1.0 - f90.low * graze.low + U)},
                           3.0)};
    if (!has_specular || a.is_below)
        return r;
    const interval eye = magnitude(facing_eye(s)), alpha2 = s->alpha2;
    const double low = unmasked(cosine.low, eye.high, alpha2.high, 1.0 + 14.0 * U),
                 high = unmasked(cosine.high, eye.low, alpha2.low, 1.0 - 14.0 * U);
    const interval spread = rounded((interval){alpha2.low * a.cos2.low + a.sin2.low,
                                               alpha2.high * a.cos2.high + a.sin2.high},
                                    2.0);
    const interval lobe = {0.5 * alpha2.low / (spread.high * spread.high) * low,
                           0.5 * alpha2.high / (spread.low * spread.low) * high};
    r.specular = rounded(lobe, 2.0 * division + 8.0);
    /* Denominators below 1e-12 are not taken, nor |h| below 2^-10, nor what is below the horizon. */
    if (cosine.low < 1e-9 || a.eye.low < 0x1p-10 || !a.is_known || a.angle + a.turn > right)
        r.specular.low = 0.0;
    r.grazing = times(r.specular, graze);
    return r;
}

/* exp(-x)/cos^4 with x = tan^2/alpha^2, alpha the wider: it is never more than at cos^2 = 1/(2 alpha^2), or
 * at 1. Kernels may end at 2^-64. Two quotients and a product in x; the power, the square and a quotient. */
static interval slopes_of(interval slope2, interval cos2, double wide2)
{
    const double steps = (2.0 * division + 4.0) * U;
    const double least = slope2.low / cos2.high * (1.0 - steps);
    const double most = cos2.low > 0.0 ? slope2.high / cos2.low * (1.0 + steps) : 1e30;
    const double cap = wide2 > 0.5 ? 4.0 * wide2 * wide2 * exp(1.0 / wide2 - 2.0) : 1.0;
    const double bright = cos2.low > 0.0 ? exp(-least) / (cos2.low * cos2.low) : 2.0 * cap;
    const interval lobe = {exp(-most) / (cos2.high * cos2.high),
                           bright < 2.0 * cap ? bright : 2.0 * cap};
    const interval out = rounded(lobe, power + division + 4.0);
    return (interval){clamp_low(out.low - 0x1p-50), out.high};
}

static rough_reflection cook_torrance(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form)
{
    const rough_half a = half_of(s, w, form);
    rough_reflection r = {.diffuse = cosine};
    if (!has_specular || a.is_below)
        return r;
    const interval eye = at_least(magnitude(facing_eye(s)), TL_LEAST_FACING);
    const interval slope2 = {a.sin2.low / s->alpha2.high, a.sin2.high / s->alpha2.low};
    const interval facets = slopes_of(slope2, a.cos2, s->alpha2.high);
    /* 2 n.h / v.h, and min(1, that n.v, that n.l) over n.v. */
    const interval valley = {
        2.0 * sqrt(a.cos2.low) / a.eye.high * (1.0 - 20.0 * U),
        a.eye.low > 0.0 ? 2.0 * sqrt(a.cos2.high) / a.eye.low * (1.0 + 20.0 * U) : 1e30};
    const interval shown = {
        fmin(1.0 / eye.high, valley.low * fmin(1.0, cosine.low / eye.high)),
        fmin(1.0 / eye.low, valley.high * fmin(1.0, cosine.high / eye.low))};
    r.specular = rounded((interval){facets.low / (4.0 * s->alpha2.high) * shown.low,
                                    facets.high / (4.0 * s->alpha2.low) * shown.high},
                         2.0 * division + 8.0);
    if (!a.is_known || a.angle + a.turn > right)
        r.specular.low = 0.0;
    r.grazing = times(r.specular, schlick_interval(a.eye));
    return r;
}

/* What the direction of the lobe adds to sin^2/wide^2: the square of p.sharp, p the part of h across n over
 * |h|. p moves as h turns; the axis by its own rotation, 3u in each number, and by what n does to it, more
 * the nearer it is to n. The difference of 1/ax^2 and 1/ay^2 is off by 20u of the larger. */
static interval along_of(const rough_surface *s, const rough_half *a)
{
    const substance *m = &s->made;
    const double sharp2 = fmin(m->alpha2, m->across2), wide2 = fmax(m->alpha2, m->across2);
    const double steep = sqrt(1.0 / sharp2 - 1.0 / wide2);
    const vec3 n = s->exact.normal;
    const double length = length_of(m->along), across = dot3(n, m->along);
    const double tangent = sqrt(clamp_low(length * length - across * across));
    const double axis_moved =
        tangent > 0.0 ? fmin(2.0, (s->normal_moved + 26.0 * U) * length / tangent) : 2.0;
    if (!a->is_known || axis_moved > 0.5)
        return (interval){0.0, steep * steep * a->sin2.high * (1.0 + 40.0 * U)};
    const double per_length = 1.0 / a->length;
    const vec3 p = fma3(n, -dot3(n, a->h), a->h);
    const double along = fabs(dot3(p, sharp_axis(s->exact, *m))) * per_length;
    const double off = steep * (a->turn + sqrt(a->sin2.high) * axis_moved + 40.0 * U * along) +
                       30.0 * U * along;
    const double beside = 20.0 * U / sharp2 * a->sin2.high;
    const double low = clamp_low(along - off), high = along + off;
    return (interval){clamp_low(low * low * (1.0 - 20.0 * U) - beside),
                      high * high * (1.0 + 20.0 * U) + beside};
}

static rough_reflection ward(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form)
{
    const rough_half a = half_of(s, w, form);
    rough_reflection r = {.diffuse = cosine};
    if (!has_specular || a.is_below)
        return r;
    const int is_round = !(s->traits & TL_LOBE_TANGENT);
    const double across2 = is_round ? s->made.alpha2 : s->made.across2;
    const double wide2 = fmax(s->made.alpha2, across2);
    const interval per_wide2 = {(1.0 - 16.0 * U) / wide2, (1.0 + 16.0 * U) / wide2};
    const interval along = is_round ? nothing : along_of(s, &a);
    const interval slope2 = rounded((interval){a.sin2.low * per_wide2.low + along.low,
                                               a.sin2.high * per_wide2.high + along.high},
                                    2.0);
    const interval lobe = slopes_of(slope2, a.cos2, wide2 * (1.0 + 10.0 * U));
    const double area = 4.0 * sqrt(s->made.alpha2 * across2);
    const interval half2 =
        at_least((interval){a.eye.low * a.eye.low, a.eye.high * a.eye.high}, TL_LEAST_HALF2);
    r.specular = rounded((interval){cosine.low * lobe.low / (area * half2.high),
                                    cosine.high * lobe.high / (area * half2.low)},
                         10.0 + root + 3.0 * division + 8.0);
    if (!a.is_known || a.angle + a.turn > right)
        r.specular.low = 0.0;
    return r;
}

/* l.v moves as its directions do; sigma^2, the root of alpha^2, is off by 5u + 6u of itself, A and B by 24u
 * and 30u of what differs from 1 or 0. */
static rough_reflection oren_nayar(const rough_surface *s, const way *w, interval cosine)
{
    const double sigma2 = sqrt(s->made.alpha2);
    const double flat = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33),
                 bent = 0.45 * sigma2 / (sigma2 + 0.09);
    const interval facing = facing_eye(s);
    const interval eye = {clamp_low(facing.low), clamp_low(facing.high)};
    interval together = {-1.0, 1.0};
    if (s->has_eye && w->exact > 0.0) {
        const double exact = dot3(w->l, s->exact.to_eye) / w->exact;
        const double off = turn_of(w->l_moved, w->exact) + s->eye_moved + 40.0 * U;
        together = (interval){exact - off - cosine.high * eye.high - U,
                              exact + off - cosine.low * eye.low + U};
    }
    const interval ahead = {clamp_low(together.low), clamp_low(together.high)};
    const interval share = {eye.high > cosine.low ? cosine.low / eye.high : 1.0,
                            eye.low > cosine.high ? cosine.high / eye.low : 1.0};
    const interval turned = {ahead.low * share.low * bent * (1.0 - 40.0 * U),
                             ahead.high * share.high * bent * (1.0 + 40.0 * U)};
    const rough_reflection r = {
        .diffuse = rounded((interval){cosine.low * (flat - 24.0 * U) + turned.low,
                                      cosine.high * (flat + 24.0 * U) + turned.high},
                           2.0)};
    return r;
}

/* log2 of the power, and how far it is off: logarithms 10u of themselves, k 14u of 1/2, the sums of what
 * they add, 10 subtracted and added. */
static interval minnaert_power(double light, double eye, double k)
{
    const double to_light = log2(fmax(light, TL_LEAST_COSINE)),
                 to_eye = log2(fmax(eye, TL_LEAST_EYE_COSINE));
    const double log_power = k * to_light + (k - 1.0) * to_eye;
    const double off = U * (14.0 * (k * -to_light + fabs(k - 1.0) * -to_eye) +
                            7.0 * (-to_light - to_eye) + 2.0 * (fabs(log_power) + 10.0));
    return (interval){exp2(log_power - off) * (1.0 - power * U),
                      exp2(log_power + off) * (1.0 + power * U)};
}

static rough_reflection minnaert(const rough_surface *s, interval cosine)
{
    const double k = s->made.k;
    const interval eye = magnitude(facing_eye(s));
    const interval dim = minnaert_power(cosine.low, k < 1.0 ? eye.high : eye.low, k),
                   bright = minnaert_power(cosine.high, k < 1.0 ? eye.low : eye.high, k);
    const double scale = 0.5 * (k + 1.0);
    /* kernels/lobe_minnaert.h ends at 2^-54. */
    const rough_reflection r = {.diffuse =
                                    rounded((interval){clamp_low(scale * dim.low - 0x1p-50),
                                                       scale * bright.high + 0x1p-50},
                                            20.0)};
    return r;
}

static rough_reflection plain(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form)
{
    rough_reflection r = {.diffuse = cosine};
    if (has_specular && (s->traits & TL_LOBE_SPECULAR)) {
        r.specular = blinn_power(s, w, form);
        if (s->traits & TL_LOBE_COSINE)
            r.specular = times(r.specular, cosine);
    }
    return r;
}

static rough_reflection mirror(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form)
{
    const rough_reflection r = {.diffuse = cosine,
                                .specular = has_specular ? mirror_power(s, w, form) : nothing};
    return r;
}

rough_reflection tl_rough_reflection(
    const rough_surface *s, const way *w, interval cosine, int has_specular, tl_cosine form)
{
    switch (s->model) {
    case TL_MODEL_PHONG_REFLECTION: return mirror(s, w, cosine, has_specular, form);
    case TL_MODEL_OREN_NAYAR: return oren_nayar(s, w, cosine);
    case TL_MODEL_WARD:
    case TL_MODEL_WARD_ANISOTROPIC: return ward(s, w, cosine, has_specular, form);
    case TL_MODEL_COOK_TORRANCE: return cook_torrance(s, w, cosine, has_specular, form);
    case TL_MODEL_MINNAERT: return minnaert(s, cosine);
    case TL_MODEL_METAL_ROUGH: return metal_rough(s, w, cosine, has_specular, form);
    default: return plain(s, w, cosine, has_specular, form);
    }
}
