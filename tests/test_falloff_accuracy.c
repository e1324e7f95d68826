/* Are falloffs, cones and directions of pictures what docs/conventions.md says of them, to within what
 * kernels/falloff.h, spot.h and texture.h derive for float and for double?
 *
 * Expected is tests/oracle/falloffs.h. Lights' numbers are rounded to float once, in either arithmetic, as
 * frames hold them: in double that is nearly all of the bound. */
#include "formula_cases.h"
#include "oracle/falloffs.h"

#include "falloff.h"
#include "spot_cone.h"

static const wide f24 = 0x1p-24Q; /* what rounding a light's number to float leaves */

/* A range from 1e-30 to 1e30 m, and a distance: anywhere in it, far within, about its end. */
static void distance_in(uint64_t *seed, int i, double most, float *range, float *distance)
{
    const double end = pow(10, most * (2 * uniform_of(seed) - 1)), share = uniform_of(seed);
    *range = (float)end;
    *distance = (float)(end * share);
    if (i % 4 == 1)
        *distance = (float)(end * pow(10, -20 * share));
    if (i % 4 == 2)
        *distance = nextafterf(*range, i % 8 == 2 ? 0.0f : INFINITY);
    if (i % 16 == 3)
        *distance = *range;
}

static void linear_is_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const wide u = arithmetics[k]->u;
        figure f = figure_of_light("linear", "kernels/falloff.h", "weight", arithmetics[k],
                                   "1/range rounded, product and sum");
        uint64_t seed = 2005;
        for (int i = 0; i < scaled_count(20000); i++) {
            float range, d;
            distance_in(&seed, i, 30, &range, &d);
            const formula_falloff of = {.row = TL_FADE_LINEAR,
                                        .fade = (float)(1.0 / (double)range)};
            const wide share = (wide)d / range, want = tl_oracle_linear(d, 0, range);
            const wide got = arithmetics[k]->fade(&of, (double)d);
            figure_sees(&f, (double)fabsq(got - want),
                        (double)((share * f24 + fabsq(1 - share) * u) * (1 + 0x1p-20Q)),
                        "distance %a of %a", (double)d, (double)range);
        }
        figure_report(&f);
    }
}

static void linear_from_is_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        figure f = figure_of_light("linear from a distance", "kernels/falloff.h",
                                   "weight, of range/(range - begin)", arithmetics[k],
                                   "both numbers rounded, sum");
        uint64_t seed = 2007;
        for (int i = 0; i < scaled_count(20000); i++) {
            float range, d;
            distance_in(&seed, i, 30, &range, &d);
            const double wide_share = pow(10, -7 * uniform_of(&seed));
            const float begin = (float)((double)range * (i % 3 ? wide_share : 1 - wide_share));
            const double width = (double)range - (double)begin;
            if (!(width > 0.0) || d >= range)
                continue;
            const formula_falloff of = {.row = TL_FADE_LINEAR_FROM,
                                        .fade = (float)(1.0 / width),
                                        .offset = (float)((double)range / width)};
            const wide offset = (wide)range / width, want = tl_oracle_linear(d, begin, range);
            const wide got = arithmetics[k]->fade(&of, (double)d);
            figure_sees(&f, (double)(fabsq(got - want) / offset),
                        (double)((2 * f24 + (wide)arithmetics[k]->u) * (1 + 0x1p-20Q)),
                        "distance %a of %a, from %a", (double)d, (double)range, (double)begin);
        }
        figure_report(&f);
    }
}

/* The argument is the square of the distance. */
static void inverse_square_is_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const wide u = arithmetics[k]->u;
        figure f =
            figure_of_light("inverse square", "kernels/falloff.h",
                            "weight, of that without a range", arithmetics[k],
                            "window: 1/range^2 rounded, product, square; root, quotient, "
                            "square, product");
        uint64_t seed = 2017;
        for (int i = 0; i < scaled_count(20000); i++) {
            float range, d;
            distance_in(&seed, i, 18, &range, &d);
            const float d2 = d * d;
            if (!(d2 > 1e-36f)) /* light.h asks for 1e-24 */
                continue;
            const int has_range = i % 5 != 0;
            const double fade = 1.0 / ((double)range * (double)range);
            const formula_falloff of = {.row = TL_FADE_INVERSE_SQUARE,
                                        .fade = has_range ? (float)fade : 0.0f};
            const wide distance = sqrtq(d2), end = has_range ? (wide)range : HUGE_VALQ;
            const wide whole = tl_oracle_inverse_square(distance, HUGE_VALQ);
            const wide want = tl_oracle_inverse_square(distance, end);
            const wide got = arithmetics[k]->fade(&of, (double)d2),
                       s2 = has_range ? d2 / (end * end) : 0;
            const wide fade_off = 2 * s2 * s2 * (f24 + u) + fabsq(1 - s2 * s2) * u;
            /* 1/range^2 leaves the numbers where the range is beyond 1e18 or below 1e-18. */
            const wide lost = has_range ? (wide)d2 * 0x1p-149Q : 0;
            figure_sees(
                &f, (double)(fabsq(got - want) / whole),
                (double)((fade_off + 2 * lost + 6 * u * (want / whole)) * (1 + 0x1p-10Q)),
                "distance^2 %a, range %a", (double)d2, (double)(has_range ? range : INFINITY));
        }
        figure_report(&f);
    }
}

enum { SAMPLES_OF_TABLE = 9 };

/* What the table may give where the place in it is off by this much. */
static wide table_slack(const float *values, wide place, wide off)
{
    wide steepest = 0;
    for (int j = -1; j <= 1; j++) {
        const int at = (int)place + j;
        if (at >= 0 && at + 1 < SAMPLES_OF_TABLE && place + off >= at && place - off <= at + 1)
            steepest = fmaxq(steepest, fabsq((wide)values[at + 1] - values[at]));
    }
    return steepest * off;
}

static void tables_are_within(void **state)
{
    static const float values[SAMPLES_OF_TABLE] = {3.0f, 0.0f, 1.0f,   0.25f, 2.0f,
                                                   0.5f, 0.5f, 0.125f, 0.0f};
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const wide u = arithmetics[k]->u;
        figure f = figure_of_light("table", "kernels/falloff.h", "weight", arithmetics[k],
                                   "place: last/range rounded, product; difference, sum");
        uint64_t seed = 1905;
        for (int i = 0; i < scaled_count(20000); i++) {
            float range, d;
            distance_in(&seed, i, 30, &range, &d);
            if (d >= range)
                continue;
            const double last = SAMPLES_OF_TABLE - 1;
            const formula_falloff of = {.row = TL_FADE_TABLE,
                                        .fade = (float)(last / (double)range),
                                        .table = values,
                                        .last = SAMPLES_OF_TABLE - 1};
            const wide place = (wide)d / range * last;
            const size_t at = place < last ? (size_t)place : (size_t)last - 1;
            const wide want = tl_oracle_table(d, range, values, SAMPLES_OF_TABLE);
            const wide got = arithmetics[k]->fade(&of, (double)d);
            const wide slack = table_slack(values, place, place * (f24 + u) * (1 + 0x1p-20Q));
            figure_sees(&f, (double)fabsq(got - want),
                        (double)(slack + 4 * u * fmaxq(values[at], values[at + 1])),
                        "distance %a of %a", (double)d, (double)range);
        }
        figure_report(&f);
    }
}

/* --- cones -------------------------------------------------------------------------------------------- */

/* Half-angles: soft, hard, hair-thin, half of space, more than that, all of it. */
static const float cones[][2] = {{0.3f, 0.6f},        {0.5f, 0.5f},
                                 {0.0f, 1e-3f},       {0.0f, 0.02f},
                                 {0.0f, 1.57079637f}, {1.57f, 1.57079637f},
                                 {1.0f, 2.5f},        {0.0f, 3.14159274f},
                                 {3.0f, 3.14159274f}, {3.1415925f, 3.14159274f},
                                 {1.55f, 1.6f}};

/* A way to a light with the angle to its axis anywhere, or about one of the cone's edges. */
static void cone_case(uint64_t *seed, int i, tl_light *light, wide3 *way)
{
    const wide3 axis = direction_of(seed), none = {0, 0, 0};
    const size_t at = (size_t)i % COUNT_OF(cones);
    const wide3 side = direction_of(seed);
    const wide3 across = wide3_unit(wide3_sum(side, -wide3_dot(side, axis), axis));
    double angle = 3.141592653589793 * uniform_of(seed);
    if (i % 3)
        angle = (double)cones[at][i / 3 % 2] * (1 + 1e-3 * (uniform_of(seed) - 0.5));
    const wide length = pow(10, 29 * uniform_of(seed) - 11);
    *light = tl_light_default();
    light->type = TL_LIGHT_SPOT;
    light->inner_cone = cones[at][0];
    light->outer_cone = cones[at][1];
    light->direction[0] = (float)axis.x;
    light->direction[1] = (float)axis.y;
    light->direction[2] = (float)axis.z;
    *way = wide3_sum(wide3_sum(none, length * cos(angle), axis), length * sin(angle), across);
}

/* Parts of the bound in double: axis, least cosine and steepness are floats. */
static void cones_are_within(void **state)
{
    static const double eye[3] = {0, 0, 0}, ahead[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, ahead, up, 1.0, 8, 8, 0.1, 10.0);
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const wide u = arithmetics[k]->u;
        figure f = figure_of_light(
            "cone of a spot", "kernels/spot.h",
            "share before its square, of 1/(cos inner - cos outer)", arithmetics[k],
            "l.axis, length of l, axis and cosine rounded; difference, product");
        uint64_t seed = 1875;
        for (int i = 0; i < scaled_count(20000); i++) {
            tl_light light;
            wide3 way;
            wide want;
            int is_in;
            cone_case(&seed, i, &light, &way);
            const float l[3] = {(float)-way.x, (float)-way.y, (float)-way.z};
            const tl_view_spot spot = tl_spot_cone(&camera, &light);
            const formula_cone cone = {{spot.axis[0], spot.axis[1], spot.axis[2]},
                                       spot.least_cos,
                                       spot.least_cos2,
                                       spot.scale};
            const double to_light[3] = {(double)l[0], (double)l[1], (double)l[2]};
            const wide3 from = {-(wide)l[0], -(wide)l[1], -(wide)l[2]};
            tl_oracle_cone(wide3_of(light.direction), from, light.inner_cone, light.outer_cone,
                           &want);
            const wide got = sqrtq(arithmetics[k]->cone_share(&cone, to_light, &is_in));
            const wide scale = tl_oracle_cone_steepness(light.inner_cone, light.outer_cone);
            const wide off = (7.5Q * u + 2 * f24) * scale + 2 * u + f24;
            if (is_in ? want + off <= 0 : want > off)
                fail_msg("a way is %s the cone of %g", is_in ? "in" : "not in",
                         (double)light.outer_cone);
            if (is_in)
                figure_sees(&f, (double)(fabsq(got - want) / scale),
                            (double)((off + u) / scale), "half-angles %.9g to %.9g",
                            (double)light.inner_cone, (double)light.outer_cone);
        }
        figure_report(&f);
    }
}

/* --- directions --------------------------------------------------------------------------------------- */

static void longitudes_are_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        figure f = figure_of_light("longitude", "kernels/texture.h", "turns", arithmetics[k],
                                   "quotient, polynomial, product, two differences");
        f.unit = "u";
        uint64_t seed = 1569;
        for (int i = 0; i < scaled_count(20000); i++) {
            const double tilt = i % 2 ? uniform_of(&seed) : pow(10, -30 * uniform_of(&seed));
            const float big = (float)(i % 8 < 4 ? 1.0 : pow(10, 36 * uniform_of(&seed) - 18));
            const float small = (float)(tilt * (double)big);
            const float x = (i & 4 ? 1.0f : -1.0f) * (i & 8 ? big : small),
                        y = (i & 16 ? 1.0f : -1.0f) * (i & 8 ? small : big);
            const wide got = arithmetics[k]->longitude((double)y, (double)x);
            figure_sees(&f, (double)fabsq(got - tl_oracle_longitude(y, x)),
                        2 * arithmetics[k]->u, "(%a, %a)", (double)y, (double)x);
        }
        figure_report(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_is_within),         cmocka_unit_test(linear_from_is_within),
        cmocka_unit_test(inverse_square_is_within), cmocka_unit_test(tables_are_within),
        cmocka_unit_test(cones_are_within),         cmocka_unit_test(longitudes_are_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
