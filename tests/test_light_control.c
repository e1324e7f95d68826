/* Do controls select the lights that they name, scale each by all that select it, cost nothing where they
 * switch one off, and say what there is where they select none? */
#include "file_cases.h"

#include "prepared.h"
#include "tilelight/light_control.h"

#include <math.h>

/* Index, name and group of the lights below; their intensities are 1. */
static const struct {
    const char *name, *group;
} lights[] = {
    {"key", "studio"},
    {"fill", "studio"},
    {"lamp left", "street"},
    {"lamp right", "street"},
    {"", "street"},
    {"street", ""},
    {"9=8", ""},
    {"*", "odd [x]"},
};
enum { LIGHT_COUNT = sizeof lights / sizeof lights[0] };

static tl_light_set set_of_lights(void)
{
    tl_light_set set = {0};
    tl_error err;
    for (size_t i = 0; i < LIGHT_COUNT; i++) {
        tl_light light = tl_light_default();
        light.position[0] = (float)i;
        light.range = 3.0f + (float)i;
        tl_light_text(lights[i].name, light.name);
        tl_light_text(lights[i].group, light.group);
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    }
    return set;
}

#define LIGHT(name, scale)            \
    {                                 \
        TL_CONTROL_LIGHT, name, scale \
    }
#define GROUP(name, scale)            \
    {                                 \
        TL_CONTROL_GROUP, name, scale \
    }
#define SOLO(name)                  \
    {                               \
        TL_CONTROL_SOLO, name, 1.0f \
    }

static void controls_select_and_multiply(void **state)
{
    static const struct {
        tl_light_control controls[3];
        size_t count;
        float intensities[LIGHT_COUNT];
    } cases[] = {
        {{LIGHT("key", 0.5f)}, 1, {0.5f, 1, 1, 1, 1, 1, 1, 1}},
        {{LIGHT("3", 0.0f)}, 1, {1, 1, 1, 0, 1, 1, 1, 1}},
        {{LIGHT("lamp*", 2.0f)}, 1, {1, 1, 2, 2, 1, 1, 1, 1}},
        {{LIGHT("[4-5]", 3.0f)}, 1, {1, 1, 1, 1, 3, 1, 1, 1}}, /* one without a name */
        {{LIGHT("9=8", 3.0f)}, 1, {1, 1, 1, 1, 1, 1, 3, 1}},
        {{LIGHT("*", 3.0f)}, 1, {1, 1, 1, 1, 1, 1, 1, 3}}, /* it has that name */
        {{LIGHT("?*", 3.0f)}, 1, {3, 3, 3, 3, 3, 3, 3, 3}},
        {{LIGHT("street", 3.0f)}, 1, {1, 1, 1, 1, 1, 3, 1, 1}},
        {{GROUP("street", 3.0f)}, 1, {1, 1, 3, 3, 3, 1, 1, 1}},
        {{GROUP("st*", 0.25f), LIGHT("key", 2.0f)}, 2, {0.5f, .25f, .25f, .25f, .25f, 1, 1, 1}},
        {{LIGHT("key", 2.0f), GROUP("st*", 0.25f)}, 2, {0.5f, .25f, .25f, .25f, .25f, 1, 1, 1}},
        {{GROUP("odd [x]", 5.0f)}, 1, {1, 1, 1, 1, 1, 1, 1, 5}},
        {{SOLO("fill")}, 1, {0, 1, 0, 0, 0, 0, 0, 0}},
        {{SOLO("street")}, 1, {0, 0, 1, 1, 1, 1, 0, 0}}, /* a group, and a light */
        {{SOLO("fill"), SOLO("0"), GROUP("studio", 4.0f)}, 3, {4, 4, 0, 0, 0, 0, 0, 0}},
        {{SOLO("studio"), LIGHT("key", 0.0f)}, 2, {0, 1, 0, 0, 0, 0, 0, 0}},
    };
    (void)state;
    for (size_t c = 0; c < COUNT_OF(cases); c++) {
        tl_light_set set = set_of_lights();
        tl_error err;
        ASSERT_OK(tl_light_set_control(&set, cases[c].controls, cases[c].count, &err), err);
        for (size_t i = 0; i < LIGHT_COUNT; i++)
            if (!same_bits(set.lights[i].intensity, cases[c].intensities[i]))
                fail_msg("case %zu: light %zu has %g, not %g", c, i,
                         (double)set.lights[i].intensity, (double)cases[c].intensities[i]);
        tl_light_set_clear(&set);
    }
}

static void what_there_is_is_named(void **state)
{
    static const struct {
        tl_light_control control;
        const char *words[4];
    } cases[] = {
        {LIGHT("kez", 1.0f),
         {"--light: there is no light \"kez\"", "did you mean \"key\"?",
          "there are \"key\", \"fill\", \"lamp left\"", "by index 0 to 7"}},
        {LIGHT("8", 1.0f), {"no light \"8\"", "by index 0 to 7"}},
        {LIGHT("x*", 1.0f), {"no light \"x*\""}},
        {LIGHT("", 1.0f), {"no light \"\""}},
        {LIGHT("-1", 1.0f), {"no light \"-1\""}},
        {LIGHT("0x1", 1.0f), {"no light \"0x1\""}},
        {LIGHT("18446744073709551616", 1.0f), {"no light"}},
        {GROUP("studoi", 1.0f),
         {"--group: there is no group \"studoi\"; did you mean \"studio\"?",
          "there are \"odd [x]\", \"street\", \"studio\""}},
        {GROUP("0", 1.0f), {"no group \"0\""}},
        {GROUP("", 1.0f), {"no group \"\""}},
        {SOLO("nobody"),
         {"--solo: there is no light and no group \"nobody\"", "\"studio\"", "\"fill\""}},
        {LIGHT("key", 2e30f),
         {"lights[0] \"key\" is scaled to an intensity of 2e+30", "from 0 to 1e+30"}},
    };
    (void)state;
    tl_light_set set = set_of_lights();
    for (size_t c = 0; c < COUNT_OF(cases); c++) {
        tl_error err = {.message = ""};
        assert_int_equal(tl_light_set_control(&set, &cases[c].control, 1, &err),
                         TL_ERR_ARGUMENT);
        for (size_t w = 0; w < COUNT_OF(cases[c].words) && cases[c].words[w]; w++)
            if (!strstr(err.message, cases[c].words[w]))
                fail_msg("\"%s\" should say \"%s\"", err.message, cases[c].words[w]);
        for (size_t i = 0; i < LIGHT_COUNT; i++)
            assert_true(same_bits(set.lights[i].intensity, 1.0f));
    }
    tl_light_set_clear(&set);
}

/* Names without end are cut, and nothing is listed where there is nothing. */
static void many_and_none(void **state)
{
    const tl_light_control control = LIGHT("nobody", 1.0f);
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    assert_int_equal(tl_light_set_control(&set, &control, 1, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "there is none that has a name"));
    for (int i = 0; i < 500; i++) {
        tl_light light = tl_light_default();
        memset(light.name, 'a' + i % 26, sizeof light.name - 1);
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    }
    assert_int_equal(tl_light_set_control(&set, &control, 1, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, " more; by index 0 to 499"));
    tl_light_set_clear(&set);
}

/* A set with a light that is off is prepared as one without it: the same needs, and the same bytes. */
static void off_costs_nothing(void **state)
{
    const tl_light_control control = LIGHT("lamp right", 0.0f);
    const tl_prepare_options options = {.tile_size = 16, .box_count = 2};
    tl_prepared with = {0}, without = {0};
    tl_light_set off = set_of_lights(), removed = set_of_lights();
    tl_gbuffer *g = NULL;
    tl_error err;
    (void)state;
    const tl_camera camera = awkward_camera(9, 5);
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    tl_gbuffer_plane(g, TL_DEPTH)[0] = 2.0f;
    tl_gbuffer_plane(g, TL_NORMAL_Z)[0] = 1.0f;
    tl_gbuffer_plane(g, TL_ALBEDO_R)[0] = 1.0f;
    /* What only this light would call for. */
    off.lights[3].type = TL_LIGHT_SPOT;
    off.lights[3].ambient = 1.0f;
    ASSERT_OK(tl_light_set_control(&off, &control, 1, &err), err);
    memmove(removed.lights + 3, removed.lights + 4, 4 * sizeof *removed.lights);
    removed.count--;
    ASSERT_OK(tl_prepare(g, &off, &options, NULL, &with, &err), err);
    ASSERT_OK(tl_prepare(g, &removed, &options, NULL, &without, &err), err);
    assert_memory_equal(&with.needs, &without.needs, sizeof with.needs);
    assert_memory_equal(&with.frame, &without.frame, sizeof with.frame);
    assert_int_equal(tl_prepared_lights_size(&with), tl_prepared_lights_size(&without));
    assert_memory_equal(with.lights, without.lights, tl_prepared_lights_size(&with));
    assert_int_equal(with.frame.light_count, LIGHT_COUNT - 1);
    tl_prepared_clear(&with);
    tl_prepared_clear(&without);
    tl_light_set_clear(&off);
    tl_light_set_clear(&removed);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(controls_select_and_multiply),
        cmocka_unit_test(what_there_is_is_named),
        cmocka_unit_test(many_and_none),
        cmocka_unit_test(off_costs_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
