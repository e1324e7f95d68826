/* Between samples a picture, a table and a gradient are linear along each axis. So over an interval of
 * places they are extreme at its ends or at samples between them, whatever the samples are: each is looked
 * at. Beside that they are off by rounding, in proportion to the largest sample that is touched. u and the
 * manner are those of allowance.c. */
#include "allowance_map.h"

#include "profile.h"
#include "sections.h"

/* What a place on an axis rounds by beside its quotient or angle: product with the extent and sum with its
 * half, of numbers no larger than the extent. */
static const double place_error = 2.0; /* u of the extent */

/* Of mixed() three times over, 3u each of the largest sample. */
static const double mix_error = 9.0; /* u */

/* 1 / sqrt(a.a) as allowance.c has it. */
static const double unit_length = 13.5; /* u */

static double length_of(vec3 v)
{
    return sqrt(dot3(v, v));
}

typedef struct axis {
    interval at; /* places, 0 at the first sample */
    long count;  /* samples */
    int is_around;
} axis;

/* Cut to what is looked up: at the ends that go on, to the samples; around, to one round. */
static axis bounded(axis a)
{
    const double last = (double)(a.count - 1);
    if (a.is_around) {
        if (!(a.at.high - a.at.low < (double)a.count))
            a.at = (interval){0.0, (double)a.count};
        return a;
    }
    a.at.low = fmin(clamp_low(a.at.low), last);
    a.at.high = fmin(clamp_low(a.at.high), last);
    return a;
}

/* How many places are looked at: both ends, and the samples between. */
static long place_count(axis a)
{
    const long between = (long)(ceil(a.at.high) - 1.0) - (long)(floor(a.at.low) + 1.0) + 1;
    return 2 + (between > 0 ? between : 0);
}

static double place_of(axis a, long i)
{
    return i == 0 ? a.at.low : i == 1 ? a.at.high : floor(a.at.low) + (double)(i - 1);
}

static long sample_of(axis a, double whole)
{
    const long i = (long)whole;
    if (a.is_around)
        return ((i % a.count) + a.count) % a.count;
    return i < 0 ? 0 : i < a.count ? i : a.count - 1;
}

/* The exact value at a place; *most grows to the samples that were touched. */
static double shown_at(
    const float *pixels, long stride, axis x, axis y, double at_x, double at_y, double *most)
{
    const double left = floor(at_x), top = floor(at_y), fx = at_x - left, fy = at_y - top;
    double row[2];
    for (int i = 0; i < 2; i++) {
        const long line = sample_of(y, top + i) * x.count;
        const double a = (double)pixels[stride * (line + sample_of(x, left))];
        const double b = (double)pixels[stride * (line + sample_of(x, left + 1.0))];
        *most = fmax(*most, fmax(a, b));
        row[i] = a * (1.0 - fx) + b * fx;
    }
    return row[0] * (1.0 - fy) + row[1] * fy;
}

/* stride: floats from sample to sample. */
static interval channel_allowance(const float *pixels, long stride, axis x, axis y)
{
    interval out = {(double)INFINITY, 0.0};
    double most = 0.0;
    for (long j = 0; j < place_count(y); j++)
        for (long i = 0; i < place_count(x); i++) {
            const double v =
                shown_at(pixels, stride, x, y, place_of(x, i), place_of(y, j), &most);
            out.low = fmin(out.low, v);
            out.high = fmax(out.high, v);
        }
    const double error = mix_error * U * most + flushed;
    return (interval){clamp_low(out.low - error), out.high + error};
}

static vec3 vector_of(const float v[3])
{
    return (vec3){(real)v[0], (real)v[1], (real)v[2]};
}

/* A product with one of the map's directions, `scale` long: it moves as d does, and its sum rounds. */
static interval along(vec3 d, vec3 direction, double moved)
{
    const double exact = dot3(d, direction), scale = length_of(direction);
    const double error = scale * (moved + 3.0 * U * length_of(d)) + flushed;
    return (interval){exact - error, exact + error};
}

/* Quotients of two intervals, rounded: of all places where the second may be 0. */
static axis projected_axis(interval over, interval under, double sign, long count)
{
    const double middle = 0.5 * (double)(count - 1);
    axis a = {.count = count, .at = {0.0, (double)count}};
    if (under.low <= 0.0 && under.high >= 0.0)
        return a;
    const double q[4] = {over.low / under.low, over.low / under.high, over.high / under.low,
                         over.high / under.high};
    double low = q[0], high = q[0];
    for (int i = 1; i < 4; i++) {
        low = fmin(low, q[i]);
        high = fmax(high, q[i]);
    }
    const double most = fmax(fabs(low), fabs(high));
    const double error = (division + 1.0) * U * most + place_error * U * (most + (double)count);
    const double near = sign > 0.0 ? low : -high, far = sign > 0.0 ? high : -low;
    a.at = (interval){middle + near - error, middle + far + error};
    return a;
}

/* How far a direction of a plane, `length` long, may turn as its end moves, in turns. */
static double turned(double moved, double length)
{
    const double pi = 4.0 * atan(1.0);
    return moved < length ? asin(moved / length) / (2.0 * pi) : 0.5;
}

/* kernels/texture.h's longitude_of is off by 2u; a library's arc tangent and a product are no more than
 * 4u. */
static const double turn_error = 4.0; /* u */

/* Turns about an axis, and away from it. */
typedef struct two_turns {
    double longitude, colatitude, longitude_off, colatitude_off;
} two_turns;

/* Longitude from `ahead` towards `right`, -1/2 to 1/2; colatitude from `up`, 0 to 1/2. */
static two_turns turns_of(vec3 d, double moved, vec3 to_right, vec3 to_up, vec3 to_ahead)
{
    const double pi = 4.0 * atan(1.0), length = length_of(d);
    const double right = dot3(d, to_right), up = dot3(d, to_up), ahead = dot3(d, to_ahead);
    const double level = hypot(right, ahead);
    /* In one of the map's directions, which are of length 1 to rounding; squares and root of the level. */
    const double one = (1.0 + 4.0 * U) * (moved + 3.0 * U * length) + flushed;
    const double level_moved = sqrt(2.0) * one + (2.0 + root) * U * length;
    return (two_turns){.longitude = atan2(right, ahead) / (2.0 * pi),
                       .colatitude = atan2(level, up) / (2.0 * pi),
                       .longitude_off = turned(sqrt(2.0) * one, level) + turn_error * U,
                       .colatitude_off =
                           turned(hypot(level_moved, one), length) + turn_error * U};
}

static void around_axes(const tl_view_map *map, vec3 d, double moved, axis *x, axis *y)
{
    const two_turns of =
        turns_of(d, moved, vector_of(map->right), vector_of(map->up), vector_of(map->ahead));
    const double width = (double)map->width, height = (double)map->height;
    const double error_x = width * (of.longitude_off + place_error * U);
    const double error_y = height * (2.0 * of.colatitude_off + place_error * U);
    const double at_x = width * (of.longitude + 0.5) - 0.5,
                 at_y = height * 2.0 * of.colatitude - 0.5;
    *x = (axis){{at_x - error_x, at_x + error_x}, (long)map->width, 1};
    *y = (axis){{at_y - error_y, at_y + error_y}, (long)map->height, 0};
}

/* Beyond the first and the last row there is nothing; what may be there may be nothing, too. */
interval tl_profile_allowance(const tl_prepared *prepared,
                              const tl_view_shape *shape,
                              vec3 d,
                              double moved)
{
    if (!shape || shape->profile_at == 0 || !(prepared->needs.shapes & TL_SHAPE_PROFILE))
        return (interval){1.0, 1.0};
    const tl_view_profile p = profile_behind((tl_numbers)prepared->lights, shape->profile_at);
    const two_turns of =
        turns_of(d, moved, vector_of(p.c90), vector_of(p.nadir), vector_of(p.c0));
    const double columns = (double)p.columns, turn = 2.0 * (double)p.rows_of_half_turn;
    const double at_x = columns * of.longitude,
                 at_y = turn * of.colatitude - (double)p.first_row;
    const double error_x = columns * (of.longitude_off + place_error * U);
    const double error_y = turn * (of.colatitude_off + place_error * U);
    const double last = (double)(p.rows - 1);
    const axis x = {{at_x - error_x, at_x + error_x}, (long)p.columns, 1};
    const axis y = {{at_y - error_y, at_y + error_y}, (long)p.rows, 0};
    if (y.at.high < 0.0 || y.at.low > last)
        return (interval){0.0, 0.0};
    interval out =
        channel_allowance(tl_section_at(prepared, p.shares_at), 1, bounded(x), bounded(y));
    if (y.at.low < 0.0 || y.at.high > last)
        out.low = 0.0;
    return out;
}

void tl_map_allowance(const tl_prepared *prepared,
                      const tl_view_map *map,
                      int is_projected,
                      vec3 d,
                      double moved,
                      interval out[3])
{
    const float *pixels = tl_section_at(prepared, map->pixels_at);
    axis x, y;
    if (is_projected) {
        const interval under = along(d, vector_of(map->ahead), moved);
        x = projected_axis(along(d, vector_of(map->right), moved), under, 1.0,
                           (long)map->width);
        y = projected_axis(along(d, vector_of(map->up), moved), under, -1.0, (long)map->height);
    } else {
        around_axes(map, d, moved, &x, &y);
    }
    x = bounded(x);
    y = bounded(y);
    for (int c = 0; c < 3; c++)
        out[c] = channel_allowance(pixels + c, 4, x, y);
}

/* A product for the place, and another where fade is a quotient. */
interval tl_table_allowance(const tl_prepared *prepared,
                            const tl_view_shape *shape,
                            double fade,
                            interval distance)
{
    const float *table = tl_section_at(prepared, shape->table_at);
    const axis a = bounded(
        (axis){{distance.low * fade * (1.0 - 2.0 * U), distance.high * fade * (1.0 + 2.0 * U)},
               (long)shape->table_last + 1,
               0});
    interval out = {(double)INFINITY, 0.0};
    double most = 0.0;
    for (long i = 0; i < place_count(a); i++) {
        const double at = place_of(a, i), whole = floor(at);
        const double low = (double)table[sample_of(a, whole)],
                     high = (double)table[sample_of(a, whole + 1.0)];
        const double v = low + (at - whole) * (high - low);
        most = fmax(most, fmax(low, high));
        out.low = fmin(out.low, v);
        out.high = fmax(out.high, v);
    }
    const double error = mix_error * U * most + flushed;
    return (interval){clamp_low(out.low - error), out.high + error};
}

/* The sine turns as the ray does; sum, 3u, root, quotient and product with it. */
static interval elevation_of(const tl_view_sky *sky, vec3 ray, double moved)
{
    const double length = length_of(ray), s = dot3(ray, vector_of(sky->map.up)) / length;
    const double turn = moved < length ? asin(moved / length) : 2.0;
    const double error = turn + (4.0 + unit_length) * U;
    return (interval){fmax(s - error, -1.0), fmin(s + error, 1.0)};
}

static double gradient_at(double horizon, double zenith, double ground, double s)
{
    return s > 0.0 ? horizon + s * (zenith - horizon) : horizon - s * (ground - horizon);
}

void tl_sky_allowance(const tl_prepared *prepared, vec3 ray, double moved, interval out[3])
{
    const tl_view_sky *sky = tl_section_at(prepared, prepared->frame.sky_at);
    if (prepared->needs.sky != TL_GRADIENT_SKY) {
        tl_map_allowance(prepared, &sky->map, 0, ray, moved, out);
        return;
    }
    const interval s = elevation_of(sky, ray, moved);
    const double middle = fmin(fmax(0.0, s.low), s.high);
    for (int c = 0; c < 3; c++) {
        const double level = (double)prepared->frame.sky[c], zenith = (double)sky->zenith[c],
                     ground = (double)sky->ground[c];
        const double a = gradient_at(level, zenith, ground, s.low),
                     b = gradient_at(level, zenith, ground, s.high),
                     m = gradient_at(level, zenith, ground, middle);
        const double error = mix_error * U * fmax(level, fmax(zenith, ground)) + flushed;
        out[c] =
            (interval){clamp_low(fmin(m, fmin(a, b)) - error), fmax(m, fmax(a, b)) + error};
    }
}
