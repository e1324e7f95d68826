/* Is what a sample says of a picture never less than what the whole of it shows? */
#include "promise_frames.h"

#include "bound.h"
#include "codes.h"
#include "random.h"
#include "windows.h"

#include "tilelight/flip.h"

/* Expectation 1 of 200 numbers that are 0 or c: so rare that samples miss them all. Counts trials whose
 * bound, or whose plain sum, is below the truth. */
static void count_misses(double chance, double doubt, int *of_bound, int *of_sum)
{
    enum { NUMBERS = 200, TRIALS = 20000 };
    uint64_t state = 7;
    const double truth = 1.0, each = truth / (NUMBERS * chance);
    *of_bound = *of_sum = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        double sum = 0.0;
        for (int i = 0; i < NUMBERS; i++)
            if ((double)(tl_random(&state) >> 11) * 0x1p-53 < chance)
                sum += each;
        *of_bound += tl_sum_bound(sum, each, doubt) < truth;
        *of_sum += sum < truth;
    }
}

/* At doubt 3 the chance is exp(-3): 996 of 20,000. Four standard deviations more are allowed. */
static void rare_numbers(void **state)
{
    static const double chances[] = {0.5, 0.1, 0.02, 0.005, 0.0005};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(chances); i++) {
        int of_bound, of_sum;
        count_misses(chances[i], 3.0, &of_bound, &of_sum);
        print_message("chance %g: %d of 20000 below the truth, of plain sums %d\n", chances[i],
                      of_bound, of_sum);
        assert_true(of_bound <= 996 + 4 * 31);
        assert_true(of_sum > 6000);
    }
}

/* Cases whose bound is known: nothing seen, nothing possible, and the equation that defines it. */
static void its_equation(void **state)
{
    (void)state;
    assert_true(fabs(tl_sum_bound(0.0, 2.0, 5.0) - 10.0) < 1e-12);
    assert_true(tl_sum_bound(3.0, 0.0, 5.0) == 3.0);
    for (double sum = 1e-6; sum < 1e6; sum *= 10.0) {
        const double m = tl_sum_bound(sum, 2.0, 5.0);
        assert_true(fabs(m - sum - sum * log(m / sum) - 10.0) <= 1e-9 * m);
    }
}

/* What a few pairs buy: some pixels of every tile. */
static tl_sample *draw(const promise_frame *f, uint64_t seed, double pairs)
{
    tl_sample *sample = NULL;
    tl_sample_options options = tl_sample_options_default();
    tl_error err;
    options.seed = seed;
    options.pairs = pairs;
    ASSERT_OK(tl_sample_draw(f->gbuffer, &f->lights, f->picture, &options, &sample, &err), err);
    return sample;
}

typedef struct misses {
    int of_bound, of_seen;
    double tightest, loosest; /* bound over truth */
} misses;

static misses try_samples(const promise_frame *f, double pairs, int trials)
{
    misses m = {0, 0, 1e30, 0.0};
    const double truth = true_rms(f->picture, f->reference);
    for (int trial = 0; trial < trials; trial++) {
        tl_sample *sample = draw(f, (uint64_t)trial + 1, pairs);
        tl_deviation deviation;
        tl_error err;
        assert_false(tl_sample_is_whole(sample));
        ASSERT_OK(tl_deviation_find(sample, f->picture, &deviation, &err), err);
        const tl_estimate e = tl_deviation_rms(sample, &deviation, TL_PROMISE_DOUBT);
        m.of_bound += e.bound < truth;
        m.of_seen += e.seen < truth;
        m.tightest = fmin(m.tightest, e.bound / truth);
        m.loosest = fmax(m.loosest, e.bound / truth);
        tl_sample_destroy(sample);
    }
    return m;
}

/* Of 40 samples none may be below: the chance is 1 in 1000 each. What is seen alone is, of half of them. */
static void frames_of_the_bench(void **state)
{
    static const char *const scenes[] = {"spheres", "foliage", "grazing"};
    enum { TRIALS = 40 };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        promise_frame f = bench_frame(scenes[i], 256, 160, 64);
        const misses m = try_samples(&f, 3e4, TRIALS);
        print_message(
            "%s: %d of %d bounds below the truth, of plain estimates %d; %.2f to %.2f times\n",
            scenes[i], m.of_bound, TRIALS, m.of_seen, m.tightest, m.loosest);
        assert_int_equal(m.of_bound, 0);
        assert_true(m.of_seen > TRIALS / 10);
        promise_frame_clear(&f);
    }
}

/* Errors that samples find hard: of every size down to nothing, the largest of them few, in no more than one
 * pixel of a hundred. */
static void plant(promise_frame *f, uint64_t seed, double largest)
{
    for (uint32_t y = 0; y < f->picture->height; y++)
        for (uint32_t x = 0; x < f->picture->width; x++) {
            const double u = (double)(tl_random(&seed) >> 11) * 0x1p-53;
            const double rarity = (double)tl_random_below(&seed, 100) == 0.0 ? 1.0 : 1e-3;
            for (unsigned c = 0; c < 3; c++) {
                const size_t at = (size_t)y * f->picture->pitch + x;
                const float want = tl_image_plane(f->reference, c)[at];
                tl_image_plane(f->picture, c)[at] =
                    (float)((double)want * (1.0 + rarity * largest * u * u));
            }
        }
}

static void rare_errors(void **state)
{
    static const double largest[] = {1e-4, 1e-2, 0.5};
    enum { TRIALS = 40 };
    (void)state;
    promise_frame f = bench_frame("spheres", 256, 160, 64);
    for (size_t i = 0; i < COUNT_OF(largest); i++) {
        plant(&f, i + 1, largest[i]);
        const misses m = try_samples(&f, 3e4, TRIALS);
        print_message("planted %g: %d of %d bounds below the truth, of plain estimates %d; "
                      "%.2f to %.2f\n",
                      largest[i], m.of_bound, TRIALS, m.of_seen, m.tightest, m.loosest);
        assert_int_equal(m.of_bound, 0);
        assert_true(m.of_seen > TRIALS / 10);
    }
    promise_frame_clear(&f);
}

/* All pixels: what is seen is what there is. */
static void a_whole_picture_is_exact(void **state)
{
    (void)state;
    promise_frame f = bench_frame("spheres", 70, 50, 16);
    tl_sample *sample = draw(&f, 1, 1e9);
    tl_deviation deviation;
    tl_error err;
    assert_true(tl_sample_is_whole(sample));
    plant(&f, 3, 1e-3);
    ASSERT_OK(tl_deviation_find(sample, f.picture, &deviation, &err), err);
    const tl_estimate e = tl_deviation_rms(sample, &deviation, TL_PROMISE_DOUBT);
    const double truth = true_rms(f.picture, f.reference);
    assert_true(fabs(e.seen / truth - 1.0) < 1e-3); /* over the picture's own mean */
    assert_true(e.bound >= truth && e.bound < 1.002 * truth);
    tl_sample_destroy(sample);
    promise_frame_clear(&f);
}

/* A picture that is not finite somewhere is off by no finite number. */
static void not_finite(void **state)
{
    (void)state;
    promise_frame f = bench_frame("spheres", 70, 50, 16);
    tl_sample *sample = draw(&f, 1, 1e9);
    tl_deviation deviation;
    tl_error err;
    tl_image_plane(f.picture, 1)[f.picture->pitch + 3] = NAN;
    ASSERT_OK(tl_deviation_find(sample, f.picture, &deviation, &err), err);
    assert_false(tl_deviation_rms(sample, &deviation, TL_PROMISE_DOUBT).bound < 1e30);
    tl_sample_destroy(sample);
    promise_frame_clear(&f);
}

static int true_codes(const promise_frame *f, const tl_goal *goal)
{
    const size_t size = 3 * (size_t)f->picture->width * f->picture->height;
    uint8_t *a = malloc(size), *b = malloc(size);
    int most = 0;
    tl_image_to_rgb8(f->picture, goal->exposure, goal->look, a);
    tl_image_to_rgb8(f->reference, goal->exposure, goal->look, b);
    for (size_t i = 0; i < size; i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    free(a);
    free(b);
    return most;
}

/* No sample shows the worst pixel; the bound has it all the same. */
static void codes_of_all_pixels(void **state)
{
    /* pictures that are too bright, and too dark */
    static const double largest[] = {1e-5, 1e-3, 0.1, -1e-3, -0.1};
    const tl_goal goal = {.kind = TL_GOAL_CODES, .limit = 1.0};
    (void)state;
    promise_frame f = bench_frame("spheres", 256, 160, 64);
    for (size_t i = 0; i < COUNT_OF(largest); i++) {
        plant(&f, i + 1, largest[i]);
        const int truth = true_codes(&f, &goal);
        int missed = 0;
        for (uint64_t seed = 1; seed <= 12; seed++) {
            tl_sample *sample = draw(&f, seed, 3e4);
            tl_deviation deviation;
            tl_estimate e;
            tl_error err;
            ASSERT_OK(tl_deviation_find(sample, f.picture, &deviation, &err), err);
            ASSERT_OK(tl_codes_off(&goal, sample, &deviation, f.picture, 1, &e, &err), err);
            assert_true(e.bound >= truth);
            assert_true(e.seen <= truth);
            missed += e.seen < truth;
            tl_sample_destroy(sample);
        }
        print_message("planted %g: off by %d codes, %d of 12 samples saw less\n", largest[i],
                      truth, missed);
    }
    promise_frame_clear(&f);
}

static double true_flip(const promise_frame *f, const tl_goal *goal, float *map)
{
    const tl_image *of[2] = {f->picture, f->reference};
    tl_image *shown[2];
    tl_flip flip;
    tl_error err;
    for (int i = 0; i < 2; i++) {
        uint8_t *rgb = malloc(3 * (size_t)of[i]->width * of[i]->height);
        tl_image_to_rgb8(of[i], goal->exposure, goal->look, rgb);
        ASSERT_OK(tl_image_create(of[i]->width, of[i]->height, &shown[i], &err), err);
        for (uint32_t y = 0; y < of[i]->height; y++)
            for (uint32_t x = 0; x < of[i]->width; x++)
                for (unsigned c = 0; c < 3; c++)
                    tl_image_plane(shown[i], c)[(size_t)y * shown[i]->pitch + x] =
                        (float)rgb[3 * ((size_t)y * of[i]->width + x) + c] / 255.0f;
        free(rgb);
    }
    ASSERT_OK(tl_flip_compare(shown[0], shown[1], TL_FLIP_SCREEN, TL_FLIP_PIXELS_PER_DEGREE,
                              map, &flip, &err),
              err);
    tl_image_destroy(shown[0]);
    tl_image_destroy(shown[1]);
    return flip.mean;
}

/* Windows see what the eye sees of the whole, and one window that is all of it sees exactly that. */
static void flip_of_windows(void **state)
{
    const tl_goal goal = {.kind = TL_GOAL_FLIP, .limit = 0.01};
    (void)state;
    promise_frame f = bench_frame("spheres", 256, 160, 64);
    plant(&f, 5, 0.1);
    const double truth = true_flip(&f, &goal, NULL);
    int below = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        tl_windows *windows = NULL;
        tl_estimate e;
        tl_error err;
        ASSERT_OK(
            tl_windows_draw(f.gbuffer, &f.lights, seed == 20 ? 1e6 : 2e4, seed, &windows, &err),
            err);
        ASSERT_OK(tl_windows_flip(windows, &goal, f.picture, TL_PROMISE_DOUBT, &e, &err), err);
        assert_true(e.bound >= truth * (1.0 - 1e-9));
        below += e.seen < truth * (1.0 - 1e-9);
        if (seed == 20)
            assert_true(fabs(e.seen / truth - 1.0) < 1e-6 && e.bound == e.seen);
        tl_windows_destroy(windows);
    }
    print_message("FLIP %g, of 20 estimates %d below\n", truth, below);
    assert_true(truth > 1e-4 && below > 0);
    promise_frame_clear(&f);
}

/* In each window the sums are those of the whole picture there, whatever is around it. */
static void a_window_is_part_of_the_whole(void **state)
{
    const tl_goal goal = {.kind = TL_GOAL_FLIP, .limit = 0.01};
    (void)state;
    promise_frame f = bench_frame("spheres", 250, 155, 64);
    const uint32_t width = f.picture->width;
    float *map = malloc((size_t)width * f.picture->height * sizeof *map);
    plant(&f, 5, 0.3);
    true_flip(&f, &goal, map);
    for (uint64_t seed = 1; seed <= 4; seed++) {
        tl_windows *windows = NULL;
        tl_error err;
        ASSERT_OK(tl_windows_draw(f.gbuffer, &f.lights, 2e4, seed, &windows, &err), err);
        assert_true(windows->count > 3 && windows->count < windows->cell_count);
        for (uint32_t i = 0; i < windows->count; i++) {
            const tl_window *w = &windows->of[i];
            double got, want = 0.0;
            for (uint32_t y = w->y; y < w->y + w->height; y++)
                for (uint32_t x = w->x; x < w->x + w->width; x++)
                    want += (double)map[(size_t)y * width + x];
            ASSERT_OK(tl_window_flip(w, &goal, f.picture, 0.0f, &got, &err), err);
            if (!(fabs(got - want) <= 1e-5 * want))
                fail_msg("the window at (%u, %u) has %g, the picture there %g", w->x, w->y, got,
                         want);
        }
        tl_windows_destroy(windows);
    }
    free(map);
    promise_frame_clear(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rare_numbers),
        cmocka_unit_test(its_equation),
        cmocka_unit_test(frames_of_the_bench),
        cmocka_unit_test(rare_errors),
        cmocka_unit_test(not_finite),
        cmocka_unit_test(a_whole_picture_is_exact),
        cmocka_unit_test(codes_of_all_pixels),
        cmocka_unit_test(flip_of_windows),
        cmocka_unit_test(a_window_is_part_of_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
