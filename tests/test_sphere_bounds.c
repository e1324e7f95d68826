/* Does tl_sphere_bounds keep every pixel whose ray meets the sphere, and at most one more per side? And do
 * textbooks' bounds not?
 *
 * tests/oracle/sphere.h says what is met, tests/bounds/ has the cases; scripts/prove-bounds tries many
 * more. */
#include "testing.h"

#include "bounds/named_losses.h"

enum { CASES_PER_FAMILY = 20000, VERDICTS_PER_FAMILY = 1500 };

static void assert_clean(const tl_tally *t, const char *what)
{
    if (tally_violations(t) > 0)
        fail_msg("%s: of %llu cases %llu lost pixels, %llu kept more than one beyond, %llu are "
                 "empty and should not be, %llu are not and should be",
                 what, (unsigned long long)t->cases, (unsigned long long)t->lost,
                 (unsigned long long)t->extra, (unsigned long long)t->falsely_empty,
                 (unsigned long long)t->falsely_kept);
}

static void named_cases_are_bounded(void **state)
{
    static const double fovs[] = {0.01, 1, 60, 120, 179.9}, offsets[] = {0, 0.3, -2};
    static const uint32_t extents[] = {1, 3, 1920, TL_MAX_EXTENT};
    (void)state;
    for (size_t i = 0; i < TL_NAMED_SPHERES; i++) {
        const tl_named_sphere *n = &tl_named_spheres[i];
        tl_tally tally = {.cases = 0};
        for (size_t f = 0; f < COUNT_OF(fovs); f++)
            for (size_t o = 0; o < COUNT_OF(offsets); o++)
                for (size_t e = 0; e < COUNT_OF(extents); e++)
                    for (int projection = 0; projection < 2; projection++) {
                        tl_sphere_case c = {
                            tl_test_camera(fovs[f], offsets[o], extents[e], extents[e] / 2 + 1),
                            {n->center[0], n->center[1], n->center[2]},
                            n->radius};
                        c.camera.projection = (tl_projection)projection;
                        tl_try_sphere(&c, &tally);
                    }
        assert_clean(&tally, n->name);
    }
}

static tl_sphere_case drawn(int family, uint64_t index)
{
    tl_draws draws = draws_of(2005, (uint64_t)family, index);
    return tl_sphere_families[family].draw(&draws);
}

/* Scenes of every scale go beyond what tl_camera_check lets in; bounds have no limit there. */
static void assert_is_camera(const tl_camera *c)
{
    assert_true(c->left < c->right && c->bottom < c->top && c->near < c->far);
    assert_true(c->near > 0.0f || c->projection == TL_ORTHOGRAPHIC);
    assert_in_range(c->width, 1, TL_MAX_EXTENT);
    assert_in_range(c->height, 1, TL_MAX_EXTENT);
}

static void families_are_bounded(void **state)
{
    (void)state;
    for (int f = 0; f < TL_SPHERE_FAMILIES; f++) {
        tl_tally tally = {.cases = 0};
        for (uint64_t i = 0; i < CASES_PER_FAMILY; i++) {
            const tl_sphere_case c = drawn(f, i);
            assert_is_camera(&c.camera);
            tl_try_sphere(&c, &tally);
        }
        assert_clean(&tally, tl_sphere_families[f].name);
        assert_in_range(tally.hits, CASES_PER_FAMILY / 10, CASES_PER_FAMILY - 1);
        assert_in_range(tally.undecided, 0, CASES_PER_FAMILY / 200);
    }
}

/* What the first look in long double would wave through, by the verdict in 128-bit floats. */
static void verdicts_in_full_agree(void **state)
{
    (void)state;
    for (int f = 0; f < TL_SPHERE_FAMILIES; f++)
        for (uint64_t i = 0; i < VERDICTS_PER_FAMILY; i++) {
            const tl_sphere_case c = drawn(f, CASES_PER_FAMILY + i);
            tl_pixel_rect rect;
            tl_sphere_bounds(&c.camera, c.center, c.radius, &rect);
            const tl_sphere_verdict v = tl_judge_sphere(&c, &rect);
            if (v.lost_px || v.extra || v.falsely_empty || v.falsely_kept)
                fail_msg("%s: case %llu", tl_sphere_families[f].name, (unsigned long long)i);
        }
}

/* A verdict that finds nothing proves nothing: rectangles that are a pixel short, or two too long. */
static void verdicts_see_what_is_wrong(void **state)
{
    int short_ones = 0, long_ones = 0, empty_ones = 0;
    (void)state;
    for (uint64_t i = 0; i < VERDICTS_PER_FAMILY; i++) {
        const tl_sphere_case c = drawn(0, i);
        const tl_pixel_rect none = {0, 0, 0, 0};
        tl_pixel_rect rect;
        tl_sphere_bounds(&c.camera, c.center, c.radius, &rect);
        if (rect.x1 < rect.x0 + 4 || rect.y1 < rect.y0 + 4 || rect.x1 + 2 > c.camera.width)
            continue;
        tl_pixel_rect cut = rect, grown = rect;
        cut.x0 += 2;
        grown.x1 += 2;
        short_ones += tl_judge_sphere(&c, &cut).lost_px == 0;
        long_ones += !tl_judge_sphere(&c, &grown).extra;
        empty_ones += !tl_judge_sphere(&c, &none).falsely_empty;
    }
    assert_int_equal(short_ones, 0);
    assert_int_equal(long_ones, 0);
    assert_int_equal(empty_ones, 0);
}

static void textbooks_lose_pixels(void **state)
{
    int by_listing_16 = 0, by_mara_mcguire = 0;
    (void)state;
    for (size_t i = 0; i < TL_NAMED_SPHERES; i++) {
        const tl_named_loss loss = tl_lose_named(&tl_named_spheres[i]);
        assert_int_equal(loss.ours, 0);
        by_listing_16 += loss.listing_16 > 0;
        by_mara_mcguire += loss.mara_mcguire > 0;
    }
    print_message(
        "of %d named spheres listing 16 loses pixels of %d, Mara and McGuire's of %d\n",
        (int)TL_NAMED_SPHERES, by_listing_16, by_mara_mcguire);
    assert_in_range(by_listing_16, 5, TL_NAMED_SPHERES);
    assert_in_range(by_mara_mcguire, 1, TL_NAMED_SPHERES);
}

static void not_finite_is_the_whole_image(void **state)
{
    const tl_camera camera = tl_test_camera(60, 0, 64, 48);
    const float bad[][4] = {
        {NAN, 0, -1, 1}, {0, INFINITY, -1, 1}, {0, 0, -1, NAN}, {0, 0, -1, -1}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        tl_pixel_rect rect;
        tl_sphere_bounds(&camera, bad[i], bad[i][3], &rect);
        assert_int_equal(rect.x1 * 1000 + rect.y1, 64048);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(named_cases_are_bounded),
        cmocka_unit_test(families_are_bounded),
        cmocka_unit_test(verdicts_in_full_agree),
        cmocka_unit_test(verdicts_see_what_is_wrong),
        cmocka_unit_test(textbooks_lose_pixels),
        cmocka_unit_test(not_finite_is_the_whole_image),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
