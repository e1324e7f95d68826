/* The sky's light is looked up by directions that are off as normal and eye are. Between texels a level is
 * linear along each axis, so where the place moves by less than a texel, what is looked up moves by no more
 * than the steepest of the nine cells around it allows; between levels it is linear in the roughness, by no
 * more than two neighbouring ones differ. Rounding comes on top, in proportion to the largest number that is
 * touched. u and the manner are those of allowance.c. */
#include "allowance_sky.h"

#include "sections.h"

/* 1 / sqrt(a.a) as allowance.c has it. */
static const double unit_length = 13.5; /* u */

static const tl_view_sky_light *sky_of(const tl_prepared *prepared)
{
    return tl_section_at(prepared, prepared->frame.sky_light_at);
}

/* irradiance_of: what its terms are at most, and by how much it changes with the normal. */
static interval irradiance(const float c[12], const rough_surface *s)
{
    double first = 0.0, second = 0.0;
    for (int i = 1; i < 4; i++)
        first += fabs((double)c[i]);
    for (int i = 4; i < 10; i++)
        second += fabs((double)c[i]);
    const double most = fabs((double)c[0]) + first + second;
    if (!s->is_lit)
        return (interval){0.0, 0.0};
    if (!s->has_normal)
        return (interval){0.0, most * (1.0 + 20.0 * U)};
    const double exact = irradiance_of(c, s->exact.normal);
    const double moved = s->normal_moved + unit_length * U;
    /* Where exact is cut at 0, what is cut is below it. */
    return around(exact, (first + 2.0 * second) * moved + 20.0 * U * most + flushed);
}

/* A level of roughness. */
typedef struct level {
    const float *texels; /* [size + 2][size + 2][4] */
    long size;
} level;

static level level_at(const tl_prepared *prepared, long index)
{
    const tl_view_sky_light *sky = sky_of(prepared);
    const float *levels = tl_section_at(prepared, sky->levels_at);
    const float *texels = tl_section_at(prepared, sky->texels_at);
    return (level){texels + 4 * (size_t)levels[2 * index], (long)levels[2 * index + 1]};
}

/* Of a texel up to two beyond the edges, across which the map goes on in the mirror image along them. */
static double texel(const level *of, long x, long y, int c)
{
    const long last = of->size - 1;
    if (x < 0 || x > last) {
        x = x < 0 ? -1 - x : 2 * last + 1 - x;
        y = last - y;
    }
    if (y < 0 || y > last) {
        y = y < 0 ? -1 - y : 2 * last + 1 - y;
        x = last - x;
    }
    return (double)of->texels[4 * ((y + 1) * (of->size + 2) + x + 1) + c];
}

/* What the nine cells around a place have. */
typedef struct around_place {
    double value, most, steepest;
} around_place;

static around_place look(const level *of, double at_x, double at_y, int c)
{
    const double left = floor(at_x), top = floor(at_y), fx = at_x - left, fy = at_y - top;
    around_place out = {0.0, 0.0, 0.0};
    double v[4][4];
    for (long y = 0; y < 4; y++)
        for (long x = 0; x < 4; x++)
            v[y][x] = texel(of, (long)left + x - 1, (long)top + y - 1, c);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++) {
            out.most = fmax(out.most, v[y][x]);
            if (x > 0)
                out.steepest = fmax(out.steepest, fabs(v[y][x] - v[y][x - 1]));
            if (y > 0)
                out.steepest = fmax(out.steepest, fabs(v[y][x] - v[y - 1][x]));
        }
    out.value = (v[1][1] * (1.0 - fx) + v[1][2] * fx) * (1.0 - fy) +
                (v[2][1] * (1.0 - fx) + v[2][2] * fx) * fy;
    return out;
}

/* Anything that a level has. */
static interval any_of(const tl_prepared *prepared, int c)
{
    double most = 0.0;
    for (long index = 0; index < TL_SKY_LEVELS; index++) {
        const level of = level_at(prepared, index);
        const long count = (of.size + 2) * (of.size + 2);
        for (long i = 0; i < count; i++)
            most = fmax(most, (double)of.texels[4 * i + c]);
    }
    return (interval){0.0, most * (1.0 + 20.0 * U)};
}

/* Of one level: the place is off by `moved` of the direction, which octahedron_of turns into (1 + sqrt(3)) of
 * it and 10u, and the product with the level's size and its sum, 2u of that. */
static interval on_level(const level *of, vec2 e, double moved, int c)
{
    const double size = (double)of->size;
    const double at_x = e.x * 0.5 * size + 0.5 * size - 0.5,
                 at_y = e.y * 0.5 * size + 0.5 * size - 0.5;
    const double off = size * (0.5 * ((1.0 + sqrt(3.0)) * moved + 10.0 * U) + 2.0 * U);
    const around_place at = look(of, at_x, at_y, c);
    const double error = 2.0 * at.steepest * off + 12.0 * U * at.most + flushed;
    return off < 1.0 ? around(at.value, error) : (interval){0.0, -1.0};
}

/* Levels beside each other, and where between them. */
static interval mirrored_channel(
    const tl_prepared *prepared, vec2 e, double moved, double at, double off, int c)
{
    const long last = TL_SKY_LEVELS - 1, first = (long)fmin(at, (double)(last - 1));
    const double share = at - (double)first;
    interval of[2] = {{0.0, 0.0}, {0.0, 0.0}};
    interval before = {0.0, -1.0};
    double differ = 0.0, most = 0.0;
    for (long index = first - 1; index <= first + 2; index++) {
        if (index < 0 || index > last)
            continue;
        const level l = level_at(prepared, index);
        const interval seen = on_level(&l, e, moved, c);
        if (seen.high < 0.0)
            return any_of(prepared, c);
        if (index >= first && index <= first + 1)
            of[index - first] = seen;
        if (before.high >= 0.0)
            differ = fmax(differ, fmax(seen.high - before.low, before.high - seen.low));
        before = seen;
        most = fmax(most, seen.high);
    }
    const double error = off * differ + 3.0 * U * most + flushed;
    return (interval){clamp_low(of[0].low * (1.0 - share) + of[1].low * share - error),
                      of[0].high * (1.0 - share) + of[1].high * share + error};
}

/* sky_roughness: roots, 9u, and alpha^2, a quarter of what that is off; the difference and its product. */
static double roughness_of(const rough_surface *s, double alpha2, double *off)
{
    const double rough = sqrt(sqrt(alpha2));
    const double share = fmin(1.0, clamp_low(sky_roughness(alpha2)));
    const double spread = (s->alpha2.high - s->alpha2.low) / s->alpha2.high;
    *off = (rough * (0.25 * spread + 12.0 * U) + 8.0 * U) / (1.0 - TL_SKY_LEAST_ROUGHNESS) +
           8.0 * U * share;
    return share;
}

static double entry(const float *table, double x, double y, int c)
{
    const long left = (long)fmin(x, (double)(TL_SKY_TABLE - 2)),
               top = (long)fmin(y, (double)(TL_SKY_TABLE - 2));
    const double fx = x - (double)left, fy = y - (double)top;
    const float *at = table + 4 * (top * TL_SKY_TABLE + left) + c;
    const double above = (double)at[0] * (1.0 - fx) + (double)at[4] * fx;
    const double below =
        (double)at[4 * TL_SKY_TABLE] * (1.0 - fx) + (double)at[4 * TL_SKY_TABLE + 4] * fx;
    return above * (1.0 - fy) + below * fy;
}

/* Ends of an interval of places in the table, and a whole one between them, where there is one: they are
 * narrower than that, but at the edge of a surface, where all between is looked at. */
static interval share_over(const tl_prepared *prepared, interval x, interval y, int c)
{
    const float *table = tl_section_at(prepared, sky_of(prepared)->table_at);
    interval out = {2.0, 0.0};
    for (double at_y = y.low;; at_y = fmin(floor(at_y) + 1.0, y.high)) {
        for (double at_x = x.low;; at_x = fmin(floor(at_x) + 1.0, x.high)) {
            const double v = entry(table, at_x, at_y, c);
            out.low = fmin(out.low, v);
            out.high = fmax(out.high, v);
            if (!(at_x < x.high))
                break;
        }
        if (!(at_y < y.high))
            break;
    }
    return rounded(out, 12.0);
}

static interval on_table(double value, double off)
{
    const double last = (double)(TL_SKY_TABLE - 1);
    return (interval){last * clamp_low(fmin(1.0, value - off)),
                      last * clamp_low(fmin(1.0, value + off))};
}

/* Grows with the cosine: a root of a sum, a product, two differences. */
static interval share_of_mirrored(double arrives, interval eye, double alpha2)
{
    const double error = 30.0 * U;
    return (interval){clamp_low(mirrored_share(arrives, eye.low, alpha2) - error),
                      fmin(1.0, mirrored_share(arrives, eye.high, alpha2) + error)};
}

rough_sky tl_rough_sky(const tl_prepared *prepared,
                       const rough_surface *s,
                       double arrives,
                       interval f90)
{
    const tl_view_sky_light *sky = sky_of(prepared);
    rough_sky out = {.base = {0.0, 0.0}};
    for (int c = 0; c < 3; c++) {
        const interval light = irradiance(sky->irradiance[c], s);
        out.diffuse[c] = rounded((interval){light.low * arrives, light.high * arrives}, 3.0);
    }
    if (!mirrors_sky(prepared->needs) || !s->is_lit)
        return out;
    const double alpha2 = sky_alpha2(prepared->needs, s->made);
    const vec3 n = s->exact.normal, v = s->exact.to_eye;
    const double known = s->has_normal && s->has_eye ? 1.0 : 2.0;
    const double moved = 4.0 * (s->normal_moved + unit_length * U) +
                         2.0 * (s->eye_moved + unit_length * U) + 24.0 * U + (known - 1.0);
    const double n_dot_v = dot3(n, v), eye = fmin(1.0, fabs(n_dot_v));
    double off;
    const double roughness = roughness_of(s, alpha2, &off);
    const interval cosine = {clamp_low(eye - moved), fmin(1.0, eye + moved)};
    const interval x = {on_table(sqrt(cosine.low), 8.0 * U).low,
                        on_table(sqrt(cosine.high), 8.0 * U).high};
    const interval y = on_table(roughness, off);
    const vec3 against = {-v.x, -v.y, -v.z};
    const vec3 d = fma3(n, 2.0 * n_dot_v, against);
    const vec2 e =
        octahedron_of((vec3){dot3(d, sky_axis(sky->right)), dot3(d, sky_axis(sky->ahead)),
                             dot3(d, sky_axis(sky->up))});
    const interval share = share_of_mirrored(arrives, cosine, alpha2);
    const double last = (double)(TL_SKY_LEVELS - 1);
    out.base = share_over(prepared, x, y, 0);
    out.grazing = share_over(prepared, x, y, 1);
    for (int c = 0; c < 3; c++) {
        const interval seen =
            mirrored_channel(prepared, e, moved, last * roughness, last * off, c);
        out.mirrored[c] = times(seen, share);
    }
    if (s->traits & TL_LOBE_BELOW) {
        const interval lost = share_over(prepared, x, y, 2);
        const interval kept = {clamp_low(1.0 - f90.high * lost.high - 4.0 * U),
                               1.0 - f90.low * lost.low + 4.0 * U};
        for (int c = 0; c < 3; c++)
            out.diffuse[c] = times(out.diffuse[c], kept);
    }
    return out;
}
