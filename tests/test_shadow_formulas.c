/* Does a surface never shadow itself, and does what is behind another one lie in its shadow?
 *
 * Maps are made of planes (shadow_scenes.h): one at every angle to the light, two that meet at a fold, to
 * which both are turned, whatever their normals say, and a step narrower than a texel. On them all light
 * arrives everywhere, in every kind of map, with every filter; in maps without slopes it does not. Behind the
 * rim of a plate the share falls from 1 to 0 over the filter's width, and is a half at the rim. */
#include "shadow_scenes.h"

enum { POINTS = 1500 };

static uint32_t seed = 1;

static const uint32_t filters[] = {1, 2, 3, 5, TL_MOST_SHADOW_FILTER};

/* Of both planes, as smooth shading has it at their fold. */
static void mean_normal(const solid *s, double n[3])
{
    double sum[3];
    for (int i = 0; i < 3; i++)
        sum[i] = s->of[0].n[i] + s->of[1].n[i];
    for (int i = 0; i < 3; i++)
        n[i] = sum[i] / sqrt(dot(sum, sum));
}

/* At random points of it; with the normals of its planes, or, smooth, with their mean. */
static void hold_points_lit(
    const lookup *l, const solid *s, int is_smooth, const char *what, double tilt)
{
    for (int i = 0; i < POINTS; i++) {
        double point[3], normal[3];
        const plane *on = random_point(l, s, &seed, point);
        if (!is_lit_well(l, s, point))
            continue;
        memcpy(normal, on->n, sizeof normal);
        if (is_smooth)
            mean_normal(s, normal);
        const float share = share_on(l, point, normal);
        if (!(share >= 1.0f))
            fail_msg("%s%s, tilted by %g, kind %u, filter %u: a share of %g arrives at "
                     "(%g, %g, %g)",
                     what, is_smooth ? ", smooth" : "", tilt, l->shadow.kind, l->shadow.filter,
                     (double)share, point[0], point[1], point[2]);
    }
}

static void hold_lit(const solid *s, const char *what, double tilt)
{
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++) {
        lookup l;
        begin(&l, kind, filters[0], s);
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            l.shadow.filter = filters[f];
            for (int is_smooth = 0; is_smooth <= (s->how != ONE); is_smooth++)
                hold_points_lit(&l, s, is_smooth, what, tilt);
        }
        end(&l);
    }
}

static const double tilts[] = {0.0, 0.3, 0.8, 1.2, 1.4, 1.44};

static void planes_are_lit(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(tilts); i++) {
        const solid s = {{tilted(tilts[i], random_in(&seed, 0.0, 6.28))}, ONE};
        hold_lit(&s, "a plane", tilts[i]);
    }
}

static void folds_are_lit(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(tilts); i++)
        for (joint how = RIDGE; how <= VALLEY; how++) {
            const solid s = {{tilted(tilts[i], random_in(&seed, 0.0, 6.28)),
                              tilted(random_in(&seed, 0.0, 1.4), random_in(&seed, 0.0, 6.28))},
                             how};
            hold_lit(&s, how == RIDGE ? "a ridge" : "a valley", tilts[i]);
        }
}

/* What the naive form does: a plane aslant is dark in stripes. */
static void without_slopes_planes_are_dark(void **state)
{
    const solid s = {{tilted(1.2, 0.5)}, ONE};
    (void)state;
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++) {
        lookup l;
        int dark = 0;
        begin(&l, kind, 2, &s);
        forget_slopes(&l);
        for (int i = 0; i < POINTS; i++) {
            double point[3];
            const plane *on = random_point(&l, &s, &seed, point);
            dark += share_on(&l, point, on->n) < 0.75f;
        }
        assert_true(dark > POINTS / 10);
        end(&l);
    }
}

/* Where a ray of the view is across it, at a depth. */
static double across_at(const tl_camera *view, double x, double depth)
{
    double from[3], along[3];
    world_ray(view, x, MAP_SIZE / 2, from, along);
    return from[0] + along[0] * depth;
}

/* A step of three texels' width down, which takes three tenths of a texel: its riser is under no texel's
 * centre, and only its own normal tells of it. */
static void risers_are_lit(void **state)
{
    static const double upper = 4.0, begins = MAP_SIZE / 2 + 0.1, ends = MAP_SIZE / 2 + 0.4;
    (void)state;
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++)
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            lookup l;
            const tl_shadow_map like = map_of(kind);
            begin_map(&l, &like);
            const tl_camera *view = &l.maps.of[0].views[kind == TL_SHADOW_CUBE ? 5 : 0];
            const double texel =
                fabs(across_at(view, ends, upper) - across_at(view, begins, upper)) / 0.3;
            const double lower = upper + 3.0 * texel;
            const plane high = {{0, 0, 1}, -upper}, low = {{0, 0, 1}, -lower};
            fill_with_plate(&l.maps.of[0], &high, &low);
            look_up(&l, filters[f]);
            const double run = across_at(view, ends, lower) - across_at(view, begins, upper);
            const double length = hypot(run, lower - upper);
            const double normal[3] = {(lower - upper) / length, 0.0, run / length};
            for (int i = 0; i < POINTS / 10; i++) {
                const double part = random_in(&seed, 0.2, 0.8);
                const double depth = upper + part * (lower - upper);
                double from[3], along[3];
                world_ray(view, MAP_SIZE / 2, random_in(&seed, 20, MAP_SIZE - 20), from, along);
                const double point[3] = {across_at(view, begins, upper) + part * run,
                                         from[1] + along[1] * depth, -depth};
                const float share = share_on(&l, point, normal);
                if (!(share >= 1.0f))
                    fail_msg("kind %u, filter %u: a share of %g arrives at %g of a riser", kind,
                             filters[f], (double)share, part);
            }
            end(&l);
        }
}

/* Where the square around a place is half beside the plate, half of the light arrives; and so on, linearly.
 * */
static void rims_are_as_wide_as_the_filter(void **state)
{
    const solid s = {{tilted(0.4, 1.0)}, ONE};
    const plane plate = {{0.0, 0.0, 1.0}, -2.5};
    (void)state;
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++)
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            lookup l;
            const tl_shadow_map like = map_of(kind);
            begin_map(&l, &like);
            fill_with_plate(&l.maps.of[0], &plate, &s.of[0]);
            look_up(&l, filters[f]);
            const tl_camera *view = &l.maps.of[0].views[kind == TL_SHADOW_CUBE ? 5 : 0];
            for (int i = 0; i < POINTS; i++) {
                const double x = MAP_SIZE / 2 + random_in(&seed, -8.0, 8.0),
                             y = random_in(&seed, 20, MAP_SIZE - 20);
                double from[3], along[3], point[3];
                world_ray(view, x, y, from, along);
                const double far = met_at(&s.of[0], from, along);
                for (int k = 0; k < 3; k++)
                    point[k] = from[k] + far * along[k];
                const double want = fmin(fmax(0.5 + (x - MAP_SIZE / 2) / filters[f], 0.0), 1.0);
                const double got = (double)share_on(&l, point, s.of[0].n);
                if (fabs(got - want) > 1e-3)
                    fail_msg("kind %u, filter %u: %g of the light arrives %g texels from the "
                             "rim, not %g",
                             kind, filters[f], got, x - MAP_SIZE / 2, want);
            }
            end(&l);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_lit),
        cmocka_unit_test(folds_are_lit),
        cmocka_unit_test(risers_are_lit),
        cmocka_unit_test(rims_are_as_wide_as_the_filter),
        cmocka_unit_test(without_slopes_planes_are_dark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
