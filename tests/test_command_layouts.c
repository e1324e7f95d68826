/* Does `tilelight layouts' tell of every layout what the library does with it, and of its bytes what the
 * passes move? */
#define _GNU_SOURCE
#include "program.h"

#include "layout.h"
#include "tilelight/layouts.h"

#include <jansson.h>

/* By way of a file: it is longer than what is kept of standard output. */
static json_t *report_of(const char *arguments)
{
    char command[256];
    json_error_t error;
    snprintf(command, sizeof command, "$T layouts %s --json >report.json", arguments);
    expect_run(command, 0, "", "");
    json_t *report = json_load_file("report.json", 0, &error);
    if (!report)
        fail_msg("%s: %s", command, error.text);
    return report;
}

static json_int_t whole_number(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    assert_true(json_is_integer(value));
    return json_integer_value(value);
}

static double number(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (!json_is_number(value))
        fail_msg("%s is no number", key);
    return json_number_value(value);
}

/* Bytes of a pixel, from a G-buffer that is made. */
static uint32_t size_of(enum tl_layout_name layout, uint32_t present)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 8, 8, 0.1, 100.0);
    tl_gbuffer *made = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create_packed(&camera, layout, present & tl_layout_planes(layout),
                                       &made, &err),
              err);
    const uint32_t size = tl_gbuffer_pixel_size(made);
    tl_gbuffer_destroy(made);
    return size;
}

static int holds(const json_t *layout, const char *what)
{
    size_t i;
    json_t *word;
    json_array_foreach(json_object_get(layout, "holds"), i,
                       word) if (strcmp(json_string_value(word), what) == 0) return 1;
    return 0;
}

static void every_layout_is_told_of_as_it_is(void **state)
{
    json_t *report = report_of("");
    const json_t *layouts = json_object_get(report, "layouts");
    (void)state;
    assert_int_equal(json_array_size(layouts), TL_LAYOUT_COUNT);
    for (int i = 0; i < TL_LAYOUT_COUNT; i++) {
        const enum tl_layout_name name = (enum tl_layout_name)i;
        const json_t *layout = json_array_get(layouts, (size_t)i);
        const uint32_t planes = tl_layout_planes(name);
        const uint32_t material =
            planes & TL_GROUP_METAL_ROUGH ? TL_GROUP_METAL_ROUGH : TL_GROUP_PHONG;
        const uint32_t plain = TL_GROUP_BASE | material;
        assert_string_equal(json_string_value(json_object_get(layout, "name")),
                            tl_layout_word(name));
        assert_int_equal(whole_number(layout, "bytes"), size_of(name, plain));
        assert_int_equal(whole_number(layout, "emission_adds"),
                         size_of(name, plain | TL_GROUP_EMISSIVE) - size_of(name, plain));
        assert_int_equal(whole_number(layout, "occlusion_adds"),
                         size_of(name, plain | TL_GROUP_OCCLUSION) - size_of(name, plain));
        assert_int_equal(holds(layout, "phong"), (planes & TL_GROUP_PHONG) != 0);
        assert_int_equal(holds(layout, "metal_rough"), (planes & TL_GROUP_METAL_ROUGH) != 0);
        assert_int_equal(holds(layout, "occlusion"), (planes & TL_GROUP_OCCLUSION) != 0);
        assert_int_equal(holds(layout, "emission"), (planes & TL_GROUP_EMISSIVE) != 0);
    }
    json_decref(report);
}

/* Every channel of every attribute, against the table that kernels are built with. */
static void bits_are_those_of_the_table(void **state)
{
    static const struct {
        const char *name;
        size_t offset;
    } attributes[] = {
        {"depth", offsetof(tl_layout, depth)},
        {"normal", offsetof(tl_layout, normal)},
        {"albedo", offsetof(tl_layout, albedo)},
        {"specular", offsetof(tl_layout, specular)},
        {"shininess", offsetof(tl_layout, shininess)},
        {"metallic", offsetof(tl_layout, metallic)},
        {"roughness", offsetof(tl_layout, roughness)},
        {"occlusion", offsetof(tl_layout, occlusion)},
        {"emission", offsetof(tl_layout, emissive)},
    };
    json_t *report = report_of("");
    (void)state;
    for (int i = 0; i < TL_LAYOUT_COUNT; i++)
        for (size_t a = 0; a < COUNT_OF(attributes); a++) {
            const tl_attribute *attribute =
                (const tl_attribute *)(const void *)((const char *)&tl_layouts[i] +
                                                     attributes[a].offset);
            const json_t *words = json_object_get(
                json_array_get(json_object_get(report, "layouts"), (size_t)i), "words");
            const json_t *told =
                json_object_get(json_object_get(words, "attributes"), attributes[a].name);
            const json_t *channels = json_object_get(told, "channels");
            size_t count = 0;
            assert_int_equal(told != NULL, attribute->code != 0);
            for (; attribute->code && count < 3 && attribute->channels[count].bits; count++) {
                const json_t *channel = json_array_get(channels, count);
                assert_int_equal(whole_number(channel, "word"),
                                 attribute->channels[count].word);
                assert_int_equal(whole_number(channel, "shift"),
                                 attribute->channels[count].shift);
                assert_int_equal(whole_number(channel, "bits"),
                                 attribute->channels[count].bits);
            }
            assert_int_equal(json_array_size(channels), count);
        }
    json_decref(report);
}

static void text_has_a_line_for_everything(void **state)
{
    (void)state;
    expect_run("$T layouts", 0, "compact-12", "");
    expect_run("$T layouts", 0, "octahedral normals", "");
    expect_run("$T layouts dxr", 0, "word 5", "");
    expect_run("$T layouts dxr", 0, "shininess   not stored", "");
    expect_run("$T layouts compact-16", 0, "RGB9E5", "");
    /* A row of table 2 beside both forms of equation 6. */
    expect_run("OCL_ICD_VENDORS=/nonexistent $T layouts --bandwidth | tr -s ' '", 0,
               " 4 18 26 42 17.8 25.0 39.3 17.0 24.1 38.5", "");
    expect_run("OCL_ICD_VENDORS=/nonexistent $T layouts compact-16 --bandwidth | tr -s ' '", 0,
               "compact-16 16 16 18.0 17.8 17.0 4 16 12 32 4", "");
}

static void measured_bytes_are_those_of_the_frame(void **state)
{
    json_t *report = report_of("dxr --bandwidth --size 64x48");
    const json_t *layout = json_array_get(json_object_get(report, "layouts"), 0);
    const json_t *measured = json_object_get(layout, "measured");
    const char *const passes[] = {"culling", "shading"};
    const double bytes_of_words[] = {64 * 48 * 8, 64 * 48 * 24};
    (void)state;
    if (!measured) { /* no device */
        json_decref(report);
        skip();
    }
    for (int i = 0; i < 2; i++) {
        const json_t *pass = json_object_get(measured, passes[i]);
        const json_t *counted = json_object_get(pass, "counted_bytes");
        const double ms = number(json_object_get(pass, "ms"), "median");
        const double sum = number(counted, "words") + number(counted, "lights") +
                           number(counted, "tiles") + number(counted, "lists") +
                           number(counted, "picture");
        assert_true(number(counted, "words") == bytes_of_words[i]);
        assert_true(ms > 0.0);
        /* Both have nine digits, so that each may be off by 5e-9. */
        assert_true(fabs(number(pass, "gbyte_per_s") * ms * 1e6 / sum - 1.0) < 1e-8);
    }
    assert_true(number(json_object_get(measured, "frame_over_float"), "median") > 0.0);
    assert_true(number(json_object_get(json_object_get(report, "measured_on"), "peaks"),
                       "copy_gbyte_per_s") > 0.0);
    json_decref(report);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_is_told_of_as_it_is),
        cmocka_unit_test(bits_are_those_of_the_table),
        cmocka_unit_test(text_has_a_line_for_everything),
        cmocka_unit_test(measured_bytes_are_those_of_the_frame),
    };
    enter_empty_folder("command_layouts");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
