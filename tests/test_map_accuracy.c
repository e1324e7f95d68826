/* Do pictures of lights and skies show in every direction what docs/conventions.md says, to within what
 * kernels/texture.h and sky.h derive for float and for double?
 *
 * Expected is tests/oracle/maps.h. The picture's directions are floats, which are handed over rounded: each
 * is off by 2^-24, whatever computes with it. A picture of steep ramps shows how far off its places are. */
#include "formula_cases.h"
#include "oracle/maps.h"

enum { WIDTH = 12, HEIGHT = 7, TEXELS = WIDTH * HEIGHT };

static const wide f24 = 0x1p-24Q;
/* How a picture stands: right, up, ahead. */
typedef struct stand {
    wide3 right, up, ahead;
} stand;

static stand random_stand(uint64_t *seed)
{
    const wide3 up = wide3_unit(direction_of(seed)), other = direction_of(seed);
    const wide3 ahead = wide3_unit(wide3_sum(other, -wide3_dot(other, up), up));
    return (stand){wide3_cross(ahead, up), up, ahead};
}

/* x: the column, else the row. */
static void ramp(float texels[1 + TEXELS][4], float values[TEXELS], int of_x)
{
    for (int i = 0; i < TEXELS; i++)
        texels[1 + i][0] = values[i] = (float)(of_x ? i % WIDTH : i / WIDTH);
}

static wide3 composed(const stand *s, wide right, wide up, wide ahead)
{
    const wide3 none = {0, 0, 0};
    return wide3_sum(wide3_sum(wide3_sum(none, right, s->right), up, s->up), ahead, s->ahead);
}

/* Of a slide: q = a/b is off by what its sums and directions are, 3u + 2^-24 of their lengths, and 2u of
 * itself; the sum with half the size by u of both; three mixtures by 9u of the largest sample. */
static wide slide_bound(wide a, wide b, wide length, wide scale, int size, wide u)
{
    const wide sum = (3 * u + f24) * length * scale, under = (3 * u + f24) * length;
    const wide q = fabsq(a / b);
    return (sum + q * under) / (fabsq(b) - under) + 2 * u * q + u * (q + size) + 9 * u * size;
}

static void slides_are_within(void **state)
{
    static const double halves[] = {0.01, 0.3, 0.8, 1.5};
    static float texels[1 + TEXELS][4], values[TEXELS];
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        figure f = figure_of_light(
            "place on a slide", "kernels/texture.h", "pixels of 12 x 7", arithmetics[k],
            "two sums, directions rounded; quotient, product, sum; mixtures");
        uint64_t seed = 1659;
        for (int i = 0; i < scaled_count(8000); i++) {
            const stand s = random_stand(&seed);
            const wide half = halves[(size_t)i % COUNT_OF(halves)],
                       per_edge = 1 / (2 * tanq(half));
            const int of_x = i & 1, size = of_x ? WIDTH : HEIGHT;
            const wide edge = tanq(half) * 1.1Q;
            const wide3 way = composed(&s, edge * (2 * uniform_of(&seed) - 1),
                                       edge * (2 * uniform_of(&seed) - 1), 1);
            formula_map map = {
                .is_projected = 1, .width = WIDTH, .height = HEIGHT, .texels = texels[0]};
            float d[3];
            round_to(map.right, s.right, per_edge * WIDTH);
            round_to(map.up, s.up, per_edge * HEIGHT);
            round_to(map.ahead, s.ahead, 1);
            round_to(d, way, pow(10, 24 * uniform_of(&seed) - 12));
            ramp(texels, values, of_x);
            const wide3 exact = wide3_of(d);
            const wide want = tl_oracle_shown(
                values, WIDTH, HEIGHT, 0,
                tl_oracle_slide_place(exact, s.right, s.up, s.ahead, half, WIDTH, HEIGHT));
            const wide scale = per_edge * size;
            const wide bound = slide_bound(scale * wide3_dot(exact, of_x ? s.right : s.up),
                                           wide3_dot(exact, s.ahead), wide3_length(exact),
                                           scale, size, arithmetics[k]->u);
            figure_sees(&f, (double)fabsq(arithmetics[k]->shown(&map, d) - want), (double)bound,
                        "half-angle %g", (double)half);
        }
        figure_report(&f);
    }
}

/* Of a map all around: directions and sums turn longitude and latitude by (3u + 2^-24) of the way's length,
 * sqrt(2) times that over its part in the plane; the level's root adds 2.5u; longitude_of 2u of a turn, the
 * product and the sum u of the size each. */
static wide globe_bound(wide in_plane, wide length, int size, int of_x, wide u)
{
    const wide one = (3 * u + f24) * length, two_pi = 2 * M_PIq;
    const wide turn = of_x ? asinq(fminq(1, sqrtq(2) * one / in_plane)) / two_pi
                           : 2 * (sqrtq(3) * one / length + 2.5Q * u) / two_pi;
    return size * (turn + (of_x ? 2 : 4) * u + 2 * u) + 9 * u * size;
}

static void globes_are_within(void **state)
{
    static float texels[1 + TEXELS][4], values[TEXELS];
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        figure f = figure_of_light(
            "place on a map of longitude and latitude", "kernels/texture.h", "pixels of 12 x 7",
            arithmetics[k], "two sums, directions rounded; longitude; product, sum; mixtures");
        uint64_t seed = 1569;
        for (int i = 0; i < scaled_count(8000); i++) {
            const stand s = random_stand(&seed);
            const int of_x = i & 1, size = of_x ? WIDTH : HEIGHT;
            formula_map map = {.width = WIDTH, .height = HEIGHT, .texels = texels[0]};
            float d[3];
            round_to(map.right, s.right, 1);
            round_to(map.up, s.up, 1);
            round_to(map.ahead, s.ahead, 1);
            const wide tilt = i % 3 ? 1 : powq(10, -4 * uniform_of(&seed));
            const wide3 any = direction_of(&seed);
            round_to(d, composed(&s, any.x * tilt, any.y, any.z * tilt),
                     pow(10, 24 * uniform_of(&seed) - 12));
            ramp(texels, values, of_x);
            const wide3 exact = wide3_of(d);
            const tl_oracle_place at =
                tl_oracle_globe_place(exact, s.right, s.up, s.ahead, WIDTH, HEIGHT);
            const wide in_plane = hypotq(wide3_dot(exact, s.right), wide3_dot(exact, s.ahead));
            const wide bound =
                globe_bound(in_plane, wide3_length(exact), size, of_x, arithmetics[k]->u);
            /* Across the seam the ramp falls from its end to its beginning. */
            if (of_x && (at.x < bound || at.x > WIDTH - 1 - bound))
                continue;
            const wide want = tl_oracle_shown(values, WIDTH, HEIGHT, 1, at);
            figure_sees(&f, (double)fabsq(arithmetics[k]->shown(&map, d) - want), (double)bound,
                        "%.3g of the way off the pole",
                        (double)(in_plane / wide3_length(exact)));
        }
        figure_report(&f);
    }
}

/* What comes round: half way over the seam both its pixels are mixed. */
static void seams_are_closed(void **state)
{
    static float texels[1 + TEXELS][4], values[TEXELS];
    const stand s = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    const formula_map map = {.right = {1, 0, 0},
                             .up = {0, 1, 0},
                             .ahead = {0, 0, -1},
                             .width = WIDTH,
                             .height = HEIGHT,
                             .texels = texels[0]};
    (void)state;
    ramp(texels, values, 1);
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++)
        for (int i = -8; i <= 8; i++) {
            const float d[3] = {(float)i * 0x1p-5f, 0.1f, 1.0f};
            const wide want = tl_oracle_shown(
                values, WIDTH, HEIGHT, 1,
                tl_oracle_globe_place(wide3_of(d), s.right, s.up, s.ahead, WIDTH, HEIGHT));
            assert_true(fabsq(arithmetics[k]->shown(&map, d) - want) < WIDTH * 0x1p-18Q);
        }
}

static void gradients_are_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const wide u = arithmetics[k]->u;
        figure f = figure_of_light("gradient of a sky", "kernels/sky.h",
                                   "radiance, of the largest", arithmetics[k],
                                   "sum, up rounded; root, quotient, product; mixture");
        uint64_t seed = 1871;
        for (int i = 0; i < scaled_count(8000); i++) {
            const wide3 up = direction_of(&seed);
            const formula_sky sky = {.up = {(float)up.x, (float)up.y, (float)up.z},
                                     .horizon = (float)uniform_of(&seed),
                                     .zenith = (float)uniform_of(&seed),
                                     .ground = i % 3 ? 0.0f : (float)uniform_of(&seed)};
            float ray[3];
            round_to(ray, i % 4 ? direction_of(&seed) : up, i % 8 ? 1 : -1);
            const wide3 exact = wide3_of(ray);
            const wide want =
                tl_oracle_gradient(exact, up, sky.horizon, sky.zenith, sky.ground);
            const wide most = fmaxq(sky.horizon, fmaxq(sky.zenith, sky.ground));
            /* 3u for the sum, 4.5u for squares, root, quotient and product, up; 3u for the mixture. */
            figure_sees(&f, (double)(fabsq(arithmetics[k]->gradient(&sky, ray) - want) / most),
                        (double)((7.5Q * u + f24 + 3 * u) * (1 + 0x1p-20Q)), "case %d", i);
        }
        figure_report(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slides_are_within),
        cmocka_unit_test(globes_are_within),
        cmocka_unit_test(seams_are_closed),
        cmocka_unit_test(gradients_are_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
