/* Do frames lit under the knobs of kernels/knobs.h keep what is said of them: errors within what is
 * derived, the same bits in C where they are the same everywhere, culling exact under all, and none that is
 * not asked for? */
#include "hard_pixels.h"

#include "reference.h"
#include "tilelight/check.h"

typedef struct hard {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    tl_image *image, *other;
} hard;

/* With cones, for what they let through is approximated too. */
static hard make_hard(void)
{
    hard h = {0};
    tl_error err;
    h.gbuffer = hard_frame(TL_PERSPECTIVE, TL_GROUP_BASE | TL_GROUP_PHONG, &h.lights);
    make_hard_spots(&h.lights);
    ASSERT_OK(tl_light_set_check(&h.lights, "hard", &err), err);
    h.image = image_like(h.gbuffer);
    h.other = image_like(h.gbuffer);
    return h;
}

static void clear_hard(hard *h)
{
    tl_light_set_clear(&h->lights);
    tl_gbuffer_destroy(h->gbuffer);
    tl_image_destroy(h->image);
    tl_image_destroy(h->other);
}

static const char *name_of(const tl_approximations *of)
{
    static char text[256];
    text[0] = '\0';
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        snprintf(text + strlen(text), sizeof text - strlen(text), " --%s %s",
                 tl_knobs[knob].word, tl_knobs[knob].rows[of->of[knob]].word);
    return text;
}

static void light(tl_device *device,
                  const tl_approximations *of,
                  tl_precision precision,
                  tl_cull cull,
                  const hard *h,
                  tl_image *image)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = precision;
    options.vector_width = device ? 4 : 0;
    options.cull = cull;
    options.approximations = *of;
    light_frame(device, &options, h->gbuffer, &h->lights, image);
}

/* Returns how much of what is allowed the worst value takes. */
static double assert_within(const hard *h, const tl_approximations *of, const tl_image *image)
{
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    ASSERT_OK(tl_check_create(h->gbuffer, &h->lights, 0.0f, TL_COSINE_STABLE, &check, &err),
              err);
    ASSERT_OK(tl_check_allow(check, of, &err), err);
    ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
    tl_check_destroy(check);
    const tl_check_value *worst = &report.worst;
    if (report.failed_count > 0)
        fail_msg(
            "%s: %u pixels outside; (%u, %u) %u: got %.9g, want %.9g, allowed %.9g to %.9g",
            name_of(of), (unsigned)report.failed_count, worst->x, worst->y, worst->channel,
            (double)worst->got, worst->expected, worst->low, worst->high);
    return report.rounding_ratio;
}

static int has(int knob, uint32_t row, enum tl_knob_trait trait)
{
    return (tl_knobs[knob].rows[row].traits & (uint32_t)trait) != 0;
}

/* Each row that C can say alone, in C: nothing is compiled for it. What the default may be off by is not
 * enough for those that are coarser than float. */
static void rows_stay_within_what_is_derived(void **state)
{
    hard h = make_hard();
    (void)state;
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        for (uint32_t row = 0; row < tl_knobs[knob].count; row++) {
            tl_approximations of = {{0}};
            of.of[knob] = row;
            if (!has(knob, row, TL_KNOB_SAME_BITS))
                continue;
            light(NULL, &of, TL_PRECISION_TWIN, TL_CULL_SPLIT, &h, h.image);
            print_message("%-60s %.3f\n", name_of(&of), assert_within(&h, &of, h.image));
        }
    clear_hard(&h);
}

static void nothing_chosen_is_the_twin(void **state)
{
    hard h = make_hard();
    tl_prepared prepared = {0};
    tl_error err;
    (void)state;
    ASSERT_OK(tl_prepare(h.gbuffer, &h.lights,
                         &(tl_prepare_options){.tile_size = 16, .box_count = 1}, NULL,
                         &prepared, &err),
              err);
    tl_reference_light(&prepared, h.gbuffer, TL_TWIN_FLOAT, h.image);
    tl_reference_light(&prepared, h.gbuffer, TL_TWIN_CHOSEN, h.other);
    assert_same_image(h.other, h.image, "nothing chosen");
    tl_prepared_clear(&prepared);
    clear_hard(&h);
}

/* Rows of a knob, but for the first: those that are the same everywhere, or those that are up to the device
 * and that someone bounds, or nobody. Returns how many. */
static uint32_t rows_that(int knob, int same_bits, int is_bounded, uint32_t rows[16])
{
    uint32_t count = 0;
    for (uint32_t row = 1; row < tl_knobs[knob].count; row++)
        if (has(knob, row, TL_KNOB_SAME_BITS) == same_bits &&
            has(knob, row, TL_KNOB_BOUNDED) == is_bounded)
            rows[count++] = row;
    return count;
}

/* Few builds, each of a row of every knob: number `build` of those rows, by turns. Returns how many builds
 * there are until each was there. */
static uint32_t choose(uint32_t build, int same_bits, int is_bounded, tl_approximations *of)
{
    uint32_t most = 0, rows[16];
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++) {
        const uint32_t count = rows_that(knob, same_bits, is_bounded, rows);
        of->of[knob] = count ? rows[build % count] : 0;
        most = count > most ? count : most;
    }
    return most;
}

static void culling_is_exact(tl_device *device, const hard *h, const tl_approximations *of)
{
    light(device, of, TL_PRECISION_FLOAT, TL_CULL_SPLIT, h, h->image);
    light(device, of, TL_PRECISION_FLOAT, TL_CULL_NONE, h, h->other);
    assert_same_image(h->image, h->other, name_of(of));
}

static void devices_agree_with_c(void **state)
{
    static const uint32_t builds[] = {1};
    hard h = make_hard();
    for (size_t i = 0; i < COUNT_OF(builds); i++) {
        tl_approximations of;
        choose(builds[i], 1, 1, &of);
        culling_is_exact(*state, &h, &of);
        light(NULL, &of, TL_PRECISION_TWIN, TL_CULL_SPLIT, &h, h.other);
        assert_same_image(h.image, h.other, name_of(&of));
        print_message("%s %.3f\n", name_of(&of), assert_within(&h, &of, h.image));
    }
    clear_hard(&h);
}

static void what_is_up_to_the_device_culls_exactly(void **state)
{
    hard h = make_hard();
    for (int is_bounded = 0; is_bounded < 2; is_bounded++) {
        tl_approximations of;
        for (uint32_t build = 0; build < choose(build, 0, is_bounded, &of); build++) {
            culling_is_exact(*state, &h, &of);
            const double share = is_bounded ? assert_within(&h, &of, h.image) : 0.0;
            print_message("%s %.3f\n", name_of(&of), share);
        }
    }
    clear_hard(&h);
}

static void assert_refused(const tl_approximations *of,
                           tl_precision precision,
                           tl_device *device,
                           const char *says)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_lighting *made = NULL;
    tl_error err;
    options.precision = precision;
    options.approximations = *of;
    assert_int_equal(tl_lighting_create(device, &options, &made, &err), TL_ERR_ARGUMENT);
    if (!strstr(err.message, says))
        fail_msg("\"%s\" does not say \"%s\"", err.message, says);
}

static void what_cannot_be_is_refused(void **state)
{
    const tl_approximations native = {.of[TL_KNOB_POWER] = TL_POWER_NATIVE},
                            newton = {.of[TL_KNOB_ROOT] = TL_ROOT_NEWTON_1},
                            none = {.of[TL_KNOB_FORM] = TL_FORM_COUNT};
    hard h = make_hard();
    tl_check *check = NULL;
    tl_error err;
    assert_refused(&newton, TL_PRECISION_REFERENCE, NULL, "the reference approximates nothing");
    assert_refused(&native, TL_PRECISION_TWIN, NULL, "--power native is up to the device");
    if (tl_device_describe(*state).has_double)
        assert_refused(&newton, TL_PRECISION_DOUBLE, *state, "--root newton-1 is of floats");
    assert_refused(&none, TL_PRECISION_FLOAT, *state, "row 2 of the knob specular");
    ASSERT_OK(tl_check_create(h.gbuffer, &h.lights, 0.0f, TL_COSINE_STABLE, &check, &err), err);
    assert_int_equal(tl_check_allow(check, &native, &err), TL_ERR_ARGUMENT);
    tl_check_destroy(check);
    clear_hard(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_stay_within_what_is_derived),
        cmocka_unit_test(nothing_chosen_is_the_twin),
        cmocka_unit_test(devices_agree_with_c),
        cmocka_unit_test(what_is_up_to_the_device_culls_exactly),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
