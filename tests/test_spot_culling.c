/* Does a box that the cone of a spot does not meet hold no position in it, to the last bit? And are not
 * many more boxes met than the cone touches?
 *
 * Positions are found at the edge of the cone, where rounding decides whether they are in it; boxes are
 * put around them, of no size and of all sizes. */
#include "directions.h"
#include "frames.h"

#include "bounds/cone_verdict.h"
#include "oracle/cone.h"

#include "spot.h"

static const float half_angles[] = {3e-4f,       0.001f, 0.01f, 0.1f,  0.5f,
                                    0.785398f,   1.2f,   1.5f,  1.57f, 1.57079625f,
                                    1.57079637f, 1.6f,   2.5f,  3.1f,  3.14159274f};

enum { CASES_PER_ANGLE = 60000 };

/* A light, a cone of it, and a position at its edge or anywhere in it. */
typedef struct edge_case {
    tl_view_light light;
    tl_view_spot spot;
    vec3 position;
} edge_case;

static edge_case edge_case_of(float outer, uint32_t *seed)
{
    static const float distances[] = {1e-6f, 1e-3f, 1.0f, 30.0f, 1e6f};
    static const float places[] = {0.0f, 1.0f, 100.0f, 1e4f};
    const float distance = distances[(int)uniform(seed, 0.0f, COUNT_OF(distances))];
    const float place = places[(int)uniform(seed, 0.0f, COUNT_OF(places))];
    const double share =
        uniform(seed, 0.0f, 1.0f) < 0.7f ? 1.0 : (double)uniform(seed, 0.0f, 1.0f);
    const double slip = (double)uniform(seed, -3e-7f, 3e-7f);
    double direction[3], other[3], way[3];
    float at[3];
    edge_case out = {.light = {.range2 = INFINITY}};
    random_direction(seed, direction);
    if (uniform(seed, 0.0f, 1.0f) < 0.1f) /* along an axis of space */
        for (int i = 0; i < 3; i++)
            direction[i] = i == 1 ? -1.0 : 0.0;
    random_direction(seed, other);
    turn_towards(direction, other, fabs((double)outer * share + slip), way);
    out.spot = tl_test_spot(direction, outer);
    for (int i = 0; i < 3; i++) {
        out.light.position[i] = uniform(seed, -place, place);
        at[i] = (float)((double)out.light.position[i] + (double)distance * way[i]);
    }
    out.position = (vec3){at[0], at[1], at[2]};
    return out;
}

static int is_lit(const edge_case *c)
{
    const vec3 l = vector_to_light(c->position, c->light);
    const float d2 = dot3(l, l);
    return d2 > 1e-24f && in_cone(c->spot, l, d2);
}

/* No size; a few ulps; as large as the distance in some axes. */
static box box_around(const edge_case *c, uint32_t *seed)
{
    const vec3 l = vector_to_light(c->position, c->light);
    const float distance = sqrtf(dot3(l, l));
    const float sizes[] = {0.0f, 3e-7f, 0.01f, 0.3f, 3.0f};
    const float p[3] = {c->position.x, c->position.y, c->position.z};
    float low[3], high[3];
    const int kind = (int)uniform(seed, 0.0f, 3.0f);
    for (int i = 0; i < 3; i++) {
        const float size =
            kind == 0 ? 0.0f : distance * sizes[(int)uniform(seed, 0.0f, COUNT_OF(sizes))];
        low[i] = p[i] - size * uniform(seed, 0.0f, 1.0f);
        high[i] = p[i] + size * uniform(seed, 0.0f, 1.0f);
    }
    return (box){{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

static void no_position_is_lost(void **state)
{
    uint32_t seed = 2003, at_edge = 0;
    (void)state;
    for (size_t a = 0; a < COUNT_OF(half_angles); a++) {
        uint32_t lit = 0;
        for (int k = 0; k < CASES_PER_ANGLE; k++) {
            const edge_case c = edge_case_of(half_angles[a], &seed);
            const box around = box_around(&c, &seed);
            at_edge += !is_lit(&c);
            if (!is_lit(&c))
                continue;
            lit++;
            if (!cone_meets_box(c.spot, c.light, around))
                fail_msg("half-angle %g, light (%a, %a, %a), axis (%a, %a, %a): no box around "
                         "(%a, %a, %a)",
                         (double)half_angles[a], (double)c.light.position[0],
                         (double)c.light.position[1], (double)c.light.position[2],
                         (double)c.spot.axis[0], (double)c.spot.axis[1], (double)c.spot.axis[2],
                         (double)c.position.x, (double)c.position.y, (double)c.position.z);
        }
        assert_in_range(lit, CASES_PER_ANGLE / 10, CASES_PER_ANGLE);
    }
    assert_in_range(at_edge, COUNT_OF(half_angles) * CASES_PER_ANGLE / 20,
                    COUNT_OF(half_angles) * CASES_PER_ANGLE);
}

/* What has no number, or no end, is met: reach.h sees to it. */
static void what_is_no_number_is_met(void **state)
{
    static const double down[3] = {0.0, -1.0, 0.0};
    const tl_view_light light = {.range2 = 1.0f};
    const box endless = {{-INFINITY, -1e30f, -1.0f}, {1.0f, INFINITY, 1e38f}};
    const box none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    (void)state;
    for (size_t a = 0; a < COUNT_OF(half_angles); a++) {
        const tl_view_spot spot = tl_test_spot(down, half_angles[a]);
        assert_true(cone_meets_box(spot, light, endless));
        assert_true(cone_meets_box(spot, light, none));
    }
    assert_true(cone_meets_box(whole_space(), light, endless));
}

/* By the oracle: all angles, distances and boxes that are hard, and the deepest position of each box.
 * scripts/prove-bounds tries more. */
static void cones_are_where_the_oracle_says(void **state)
{
    enum { CASES = 20000 };
    (void)state;
    for (int f = 0; f < TL_CONE_FAMILIES; f++) {
        tl_tally tally = {.cases = 0};
        for (uint64_t i = 0; i < CASES; i++) {
            tl_draws draws = draws_of(2011, (uint64_t)f, i);
            const tl_cone_case c = tl_cone_families[f].draw(&draws);
            tl_try_cone(&c, &tally);
        }
        if (tally_violations(&tally) > 0)
            fail_msg("%s: of %d cases %d lost positions, %d light one that is out of the cone, "
                     "%d do not light one that is in it",
                     tl_cone_families[f].name, (int)CASES, (int)tally.lost,
                     (int)tally.falsely_kept, (int)tally.falsely_empty);
        assert_in_range(tally.hits, CASES / 20, CASES);
    }
}

/* The most that l.a - cos |l| comes to in a box of ways. */
static double top_of(const tl_view_spot *spot, const double low[3], const double high[3])
{
    const double axis[3] = {(double)spot->axis[0], (double)spot->axis[1],
                            (double)spot->axis[2]};
    double l[3];
    tl_oracle_deepest_way(axis, (double)spot->least_cos, low, high, 300, l);
    return axis[0] * l[0] + axis[1] * l[1] + axis[2] * l[2] -
           (double)spot->least_cos * sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
}

/* Boxes in reach of a light of range 1: how many are met, over how many the cone touches. */
static void few_boxes_are_met_in_vain(void **state)
{
    static const struct {
        float outer, size, depth;
        double most;
    } cases[] = {
        {0.2f, 0.05f, 1.0f, 1.03}, {0.2f, 0.15f, 1.0f, 1.06}, {0.5f, 0.15f, 1.0f, 1.03},
        {1.2f, 0.15f, 1.0f, 1.03}, {0.2f, 0.15f, 6.0f, 1.25}, {0.5f, 0.15f, 6.0f, 1.12},
        {1.2f, 0.15f, 6.0f, 1.03},
    };
    uint32_t seed = 5;
    (void)state;
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        int met = 0, touched = 0;
        for (int n = 0; n < 50000; n++) {
            double direction[3], low[3], high[3];
            float half[3] = {0.5f, 0.5f, 0.5f * cases[k].depth}, bounds[2][3];
            const tl_view_light light = {.range2 = 1.0f};
            random_direction(&seed, direction);
            const tl_view_spot spot = tl_test_spot(direction, cases[k].outer);
            for (int i = 0; i < 3; i++) {
                const float middle = uniform(&seed, -1.0f, 1.0f);
                bounds[0][i] = middle - half[i] * cases[k].size;
                bounds[1][i] = middle + half[i] * cases[k].size;
                low[i] = -(double)bounds[1][i];
                high[i] = -(double)bounds[0][i];
            }
            const box of = {{bounds[0][0], bounds[0][1], bounds[0][2]},
                            {bounds[1][0], bounds[1][1], bounds[1][2]}};
            if (!reaches_box(light, of))
                continue;
            met += cone_meets_box(spot, light, of);
            touched += top_of(&spot, low, high) > 0.0;
        }
        print_message("half-angle %.1f, %g x %g: %d met, %d touched, %.3f\n",
                      (double)cases[k].outer, (double)cases[k].size, (double)cases[k].depth,
                      met, touched, (double)met / touched);
        assert_true(touched > 100 && met >= touched - touched / 1000);
        assert_true((double)met <= cases[k].most * touched);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_position_is_lost),
        cmocka_unit_test(cones_are_where_the_oracle_says),
        cmocka_unit_test(what_is_no_number_is_met),
        cmocka_unit_test(few_boxes_are_met_in_vain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
