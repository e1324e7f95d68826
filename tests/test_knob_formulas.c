/* Is each row of kernels/knobs.h that C can say off by as much as it says, and hardly less?
 *
 * The formulas are built with variables in place of a build's constants. */
#include "testing.h"

#include "tilelight/approximations.h"

static unsigned power_row, form_row, root_row;
#define TL_POWER power_row
#define TL_FORM form_row
#define TL_ROOT root_row
#include "specular.h"

static const double u = 0x1p-24;

/* What a row says it is off by may be rounded up, not made up. */
static void assert_is_worst(const char *word, const char *what, double worst, double said)
{
    print_message("%-10s %-10s %.4g of %.4g\n", word, what, worst, said);
    if (!(worst <= said))
        fail_msg("%s, %s: off by %.9g, said to be %.9g", word, what, worst, said);
    if (!(worst >= 0.9 * said))
        fail_msg("%s, %s: off by %.9g only, said to be %.9g", word, what, worst, said);
}

static void polynomials_are_off_as_they_say(void **state)
{
    const double low = sqrt(0.5) - 1.0, high = sqrt(2.0) - 1.0;
    const tl_knob *knob = &tl_knobs[TL_KNOB_POWER];
    int seen = 0;
    (void)state;
    for (power_row = 0; power_row < knob->count; power_row++) {
        const tl_off off = knob->rows[power_row].off;
        double log2_off = 0.0, exp2_off = 0.0;
        if (!(off.log2 > 0.0))
            continue;
        for (int i = 1; i < 100000; i++) {
            const float m = (float)(low + (high - low) * i / 100000.0), r = -1e-5f * (float)i;
            const double p = log2(1.0 + (double)m) / (double)m,
                         q = (exp2((double)r) - 1.0) / (double)r;
            log2_off = fmax(log2_off, fabs((double)lower_log2_polynomial(m) - p));
            exp2_off = fmax(exp2_off, fabs((double)lower_exp2_polynomial(r) - q));
        }
        assert_is_worst(knob->rows[power_row].word, "log2", log2_off, off.log2);
        assert_is_worst(knob->rows[power_row].word, "exp2", exp2_off, off.exp2);
        seen++;
    }
    assert_int_equal(seen, 5);
}

/* Every float of two octaves: further ones have the same bits but for the exponent's. */
static void guesses_are_off_as_they_say(void **state)
{
    const tl_knob *knob = &tl_knobs[TL_KNOB_ROOT];
    int seen = 0;
    (void)state;
    for (root_row = 0; root_row < knob->count; root_row++) {
        const tl_off off = knob->rows[root_row].off;
        double root_off = 0.0, quotient_off = 0.0;
        if (!(off.root > 0.0))
            continue;
        for (integer i = 0; i < 1 << 24; i += 3) {
            const float x = AS_REAL(0x3f800000 + i);
            const double wide = (double)x;
            root_off =
                fmax(root_off, fabs((double)lengths_of(x).per_length * sqrt(wide) - 1.0));
            quotient_off = fmax(quotient_off, fabs((double)reciprocal(x) * wide - 1.0));
        }
        assert_is_worst(knob->rows[root_row].word, "1/sqrt", root_off, off.root);
        assert_is_worst(knob->rows[root_row].word, "1/x", quotient_off, off.quotient);
        seen++;
    }
    assert_int_equal(seen, 3);
}

/* Relative to the peak. 40u and the shares of knobs.h; a quotient is in sine and cosine alike: near the
 * peak it counts 0.43 times at most, e/2 c^e times elsewhere, where c^2 <= 3/4, so 1.28 times. In the
 * textbook's form it counts e/2 times, and so do 21u of cos^2. */
static double bound_of(tl_off off, int is_textbook, double exponent)
{
    const double quotient = off.quotient * (1.0 + 2.0 * off.quotient);
    const double polynomial = 0.31 * off.log2 + off.exp2;
    if (is_textbook)
        return 11.0 * u + polynomial + fmax(exponent, 1.0) * (10.5 * u + 0.5 * quotient);
    return 40.0 * u + polynomial + 1.28 * quotient;
}

/* The largest error of random vectors about the peak, as a share of what is derived. */
static double worst_share(tl_off off, float e)
{
    uint64_t random = 1977;
    double worst = 0.0;
    for (int i = 0; i < 20000; i++) {
        float v[6];
        for (int k = 0; k < 6; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            v[k] = (float)(random >> 40) * 0x1p-23f - 1.0f;
        }
        const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        const vec3 n = {v[0] / length, v[1] / length, v[2] / length};
        const float spread = 2.0f / sqrtf(e);
        const vec3 h = {n.x + spread * v[3], n.y + spread * v[4], n.z + spread * v[5]};
        const double nh =
            (double)n.x * (double)h.x + (double)n.y * (double)h.y + (double)n.z * (double)h.z;
        const double across[3] = {(double)h.x - nh * (double)n.x,
                                  (double)h.y - nh * (double)n.y,
                                  (double)h.z - nh * (double)n.z};
        const double hh =
            (double)h.x * (double)h.x + (double)h.y * (double)h.y + (double)h.z * (double)h.z;
        const double sin2 =
            (across[0] * across[0] + across[1] * across[1] + across[2] * across[2]) / hh;
        const double want = nh > 0.0 ? exp(0.5 * (double)e * log1p(-sin2)) : 0.0;
        const double got = (double)blinn_phong_specular(n, h, e);
        worst = fmax(worst,
                     fabs(got - want) / bound_of(off, form_row == TL_FORM_TEXTBOOK, (double)e));
    }
    return worst;
}

static int is_ours(int knob, unsigned row)
{
    return (tl_knobs[knob].rows[row].traits & TL_KNOB_SAME_BITS) != 0;
}

/* Each row with each of the other knobs. */
static void powers_stay_within_the_bound(void **state)
{
    static const float exponents[] = {1.0f, 10.0f, 100.0f, 1000.0f, 10000.0f};
    double largest = 0.0;
    (void)state;
    for (power_row = 0; power_row < TL_POWER_COUNT; power_row++)
        for (form_row = 0; form_row < TL_FORM_COUNT; form_row++)
            for (root_row = 0; root_row < TL_ROOT_COUNT; root_row++) {
                const tl_approximations of = {{power_row, form_row, root_row}};
                const tl_off off = tl_approximations_off(&of);
                if (!is_ours(TL_KNOB_POWER, power_row) || !is_ours(TL_KNOB_ROOT, root_row))
                    continue;
                for (size_t i = 0; i < COUNT_OF(exponents); i++) {
                    const double share = worst_share(off, exponents[i]);
                    largest = fmax(largest, share);
                    if (!(share <= 1.0))
                        fail_msg("%s, %s, %s, exponent %g: %.3g of what is derived",
                                 tl_knobs[TL_KNOB_POWER].rows[power_row].word,
                                 tl_knobs[TL_KNOB_FORM].rows[form_row].word,
                                 tl_knobs[TL_KNOB_ROOT].rows[root_row].word,
                                 (double)exponents[i], share);
                }
            }
    print_message("largest share of a bound: %.3f\n", largest);
    assert_true(largest > 0.5);
}

/* What the textbook's form is there to show. */
static void the_textbook_fails_at_the_peak(void **state)
{
    const tl_off none = {0};
    (void)state;
    power_row = root_row = 0;
    form_row = TL_FORM_TEXTBOOK;
    const double share =
        worst_share(none, 10000.0f) * bound_of(none, 1, 10000.0) / bound_of(none, 0, 10000.0);
    print_message("off by %.0f times what the stable form may be\n", share);
    assert_true(share > 100.0);
    form_row = TL_FORM_STABLE;
    assert_true(worst_share(none, 10000.0f) <= 1.0);
}

/* Options and axes name the usual row by its word. */
static void the_usual_row_is_the_first(void **state)
{
    static const char *const usual_words[] = {
#define USUAL(name, flag, word, usual, rows, kind, kinds, meaning) [name] = usual,
        TL_KNOBS(USUAL)
#undef USUAL
    };
    (void)state;
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++) {
        assert_string_equal(tl_knobs[knob].rows[0].word, usual_words[knob]);
        assert_int_equal(tl_knobs[knob].rows[0].traits, TL_KNOB_OURS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polynomials_are_off_as_they_say),
        cmocka_unit_test(guesses_are_off_as_they_say),
        cmocka_unit_test(powers_stay_within_the_bound),
        cmocka_unit_test(the_textbook_fails_at_the_peak),
        cmocka_unit_test(the_usual_row_is_the_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
