/* Does `tilelight bench` measure a tiny case, and say all that it knows of it, in every form? */
#define _GNU_SOURCE
#include "program.h"

#include <jansson.h>

static json_t *read_json(const char *path)
{
    json_error_t error;
    json_t *root = json_load_file(path, 0, &error);
    if (!root)
        fail_msg("%s: line %d: %s", path, error.line, error.text);
    return root;
}

/* The value at "a.b.0.c". */
static const json_t *at(const json_t *root, const char *path)
{
    char copy[256], *rest = copy;
    snprintf(copy, sizeof copy, "%s", path);
    for (const char *name; root && (name = strsep(&rest, "."));)
        root = json_is_array(root) ? json_array_get(root, (size_t)atoi(name))
                                   : json_object_get(root, name);
    if (!root)
        fail_msg("%s is missing", path);
    return root;
}

static double number_at(const json_t *root, const char *path)
{
    const json_t *value = at(root, path);
    if (!json_is_number(value))
        fail_msg("%s is no number", path);
    return json_number_value(value);
}

static void assert_summary(const json_t *root, const char *path, double samples)
{
    char name[256];
    const char *const keys[] = {"least", "interval.0", "median", "interval.1", "p90"};
    double values[COUNT_OF(keys)];
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        snprintf(name, sizeof name, "%s.%s", path, keys[i]);
        values[i] = number_at(root, name);
    }
    for (int i = 0; i < 3; i++) /* p90 may lie below the interval's end */
        if (!(values[i] <= values[i + 1]))
            fail_msg("%s: %s is above %s", path, keys[i], keys[i + 1]);
    snprintf(name, sizeof name, "%s.samples", path);
    assert_true(number_at(root, name) == samples);
}

static void cases_are_recorded(void **state)
{
    static const char *const numbers[] = {"peaks.gflop_per_s",
                                          "peaks.read_gbyte_per_s",
                                          "peaks.copy_gbyte_per_s",
                                          "first_frame_ms",
                                          "build_ms",
                                          "frame.range_m",
                                          "frame.tiles",
                                          "frame.device_bytes",
                                          "figures.ns_per_pair",
                                          "figures.ns_per_lit_pair",
                                          "figures.mpixel_per_s",
                                          "figures.share_of_peak_flops",
                                          "figures.share_of_peak_bytes"};
    (void)state;
    expect_run("$T bench --size 64x64 --lights 8 --tile 8,16 --samples 6 --seconds 0 "
               "--json a.json --csv a.csv",
               0, "ns/pair", "");
    json_t *root = read_json("a.json");
    assert_int_equal(json_array_size(at(root, "records")), 2);
    for (int i = 0; i < 2; i++) {
        char path[128];
        snprintf(path, sizeof path, "records.%d", i);
        const json_t *record = at(root, path);
        assert_string_equal(json_string_value(at(record, "case.tile")), i ? "16" : "8");
        assert_string_equal(json_string_value(at(record, "case.scene")), "spheres");
        assert_non_null(json_string_value(at(record, "device.driver")));
        for (size_t k = 0; k < COUNT_OF(numbers); k++)
            assert_true(number_at(record, numbers[k]) >= 0.0);
        assert_non_null(strstr(json_string_value(at(record, "build_options")), "-D TL_WIDTH="));
        assert_summary(record, "shade_processors", 6.0);
        assert_summary(record, "times_ms.frame", 6.0);
        assert_summary(record, "times_ms.kernel_shade", 6.0);
        assert_summary(record, "times_ms.post", 6.0);
        assert_summary(record, "times_ms.stages.shade", 6.0);
        /* 64 x 64 pixels: whole tiles, so what is listed bounds what is in range, and that what
         * is lit. */
        const double culled = number_at(record, "pairs.culled");
        assert_true(culled == number_at(record, "frame.list_entries") * (i ? 256.0 : 64.0));
        assert_true(number_at(record, "pairs.in_range") <= culled);
        assert_true(number_at(record, "pairs.lit") <= number_at(record, "pairs.in_range"));
        assert_true(number_at(record, "pairs.lit") > 0.0);
    }
    json_decref(root);
}

/* compact-16 by turns with full float: its bytes, both times, and an error that is there and small. */
static void layouts_are_compared(void **state)
{
    (void)state;
    expect_run("$T bench --size 64x64 --lights 8 --layout float,compact-16 --samples 6 "
               "--seconds 0 --json l.json",
               0, "of the frame's time in float", "");
    json_t *root = read_json("l.json");
    assert_true(json_is_null(at(root, "records.0.against")));
    assert_true(json_is_null(at(root, "records.0.error")));
    assert_true(number_at(root, "records.0.frame.pixel_bytes") == 44.0);
    assert_true(number_at(root, "records.1.frame.pixel_bytes") == 16.0);
    assert_true(number_at(root, "records.1.against.pixel_bytes") == 44.0);
    assert_string_equal(json_string_value(at(root, "records.1.against.layout")), "float");
    assert_summary(root, "records.1.against.frame", 6.0);
    assert_summary(root, "records.1.against.cull", 6.0);
    assert_summary(root, "records.1.against.shade", 6.0);
    assert_summary(root, "records.1.against.frame_ms", 6.0);
    assert_true(number_at(root, "records.1.error.mean") > 1e-6);
    assert_true(number_at(root, "records.1.error.rms") < 0.05);
    assert_int_equal(json_array_size(at(root, "records.1.error.lost")), 0);
    /* Fewer bytes, and the same share of the pixels' time as the figures have it. */
    assert_true(number_at(root, "records.0.figures.bytes_moved") >
                number_at(root, "records.1.figures.bytes_moved") + 64.0 * 64.0 * 27.0);
    json_decref(root);
}

static void layouts_without_a_place_are_refused(void **state)
{
    (void)state;
    expect_run("$T bench --layout thick", 2, "", "no layout is called \"thick\"");
    expect_run("$T bench --size 64x64 --layout dxr", 2, "",
               "cannot say what --material phong has");
    expect_run("$T bench --baselines --layout merlin", 2, "",
               "--layout and --against are for cases");
}

static void csv_has_a_value_per_name(void **state)
{
    static char text[65536];
    size_t commas[3] = {0}, line = 0;
    (void)state;
    read_text("a.csv", text, sizeof text);
    assert_memory_equal(text, "device,scene,size,material,", 27);
    for (const char *c = text; *c && line < 3; c++) {
        commas[line] += *c == ',';
        line += *c == '\n';
    }
    assert_int_equal(line, 3);
    assert_int_equal(commas[1], commas[0]);
    assert_int_equal(commas[2], commas[0]);
}

/* Against itself made a thousand times faster: slower, and said by the exit status if asked for. */
static void slower_cases_are_found(void **state)
{
    (void)state;
    json_t *root = read_json("a.json");
    for (size_t i = 0; i < 2; i++) {
        json_t *frame = json_object_get(
            json_object_get(json_array_get(json_object_get(root, "records"), i), "times_ms"),
            "frame");
        json_object_set_new(frame, "median", json_real(1e-4));
        json_object_set_new(frame, "interval", json_pack("[ff]", 0.9e-4, 1.1e-4));
    }
    assert_int_equal(json_dump_file(root, "fast.json", 0), 0);
    json_decref(root);
    expect_run("$T bench --size 64x64 --lights 8 --tile 8 --seconds 0 --compare fast.json", 0,
               "slower", "");
    expect_run("$T bench --size 64x64 --lights 8 --tile 8,32 --seconds 0 --compare fast.json "
               "--fail-if-slower --json b.json",
               1, "", "1 of 2 cases are slower than in fast.json");
    root = read_json("b.json");
    assert_string_equal(json_string_value(at(root, "records.0.comparison.verdict")), "slower");
    assert_string_equal(json_string_value(at(root, "records.1.comparison.verdict")), "new");
    json_decref(root);
}

static void ratios_have_their_keys(void **state)
{
    (void)state;
    expect_run("$T bench --baselines --quick --size 64x64 --lights 8 --seconds 0 --json r.json",
               0, "hand_relaxed", "");
    json_t *root = read_json("r.json");
    assert_summary(root, "ratios.hand", 10.0);
    assert_summary(root, "ratios.hand_relaxed", 10.0);
    assert_true(number_at(root, "hand_relaxed_ns_per_pair") > 0.0);
    assert_true(json_is_true(at(root, "ratios.hand.same_picture")));
    json_decref(root);
}

/* A cold start compiles, a warm one does not; each begins a kernel before it ends. */
static void starts_are_measured(void **state)
{
    (void)state;
    expect_run("$T bench --startup --samples 1 --seconds 0 --json s.json", 0, "warm", "");
    json_t *root = read_json("s.json");
    assert_true(number_at(root, "startup.cold.first_kernel_ms.samples") == 1.0);
    assert_true(number_at(root, "startup.warm.first_kernel_ms.samples") == 1.0);
    assert_true(json_is_null(at(root, "startup.warm.first_kernel_ms.interval")));
    assert_true(number_at(root, "startup.cold.first_kernel_ms.median") > 0.0);
    assert_true(number_at(root, "startup.warm.first_kernel_ms.least") > 0.0);
    assert_true(number_at(root, "startup.warm.process_ms.least") >
                number_at(root, "startup.warm.first_kernel_ms.least"));
    json_decref(root);
}

/* A frame takes no less than its processor time, but where a few milliseconds of noise are much of it. */
static void batches_are_measured(void **state)
{
    (void)state;
    expect_run("$T bench --batch --size 64x48 --lights 8 --samples 1 --json b.json", 0,
               "a frame takes", "");
    json_t *root = read_json("b.json");
    assert_true(number_at(root, "batch.frames") > 1.0);
    assert_true(number_at(root, "batch.ratio.median") > 0.3);
    assert_true(number_at(root, "batch.in_turn.processor_ms.median") > 0.0);
    assert_true(number_at(root, "batch.together.processors_busy.median") > 0.0);
    assert_true(number_at(root, "batch.stages.read.wall_s") > 0.0);
    json_decref(root);
}

/* Of no device. */
static void skies_are_measured(void **state)
{
    (void)state;
    expect_run("$T bench --sky --samples 1 --seconds 0 --json y.json", 0, "1024 x 512", "");
    json_t *root = read_json("y.json");
    json_t *skies = json_object_get(root, "skies");
    assert_int_equal(json_array_size(skies), 6);
    for (size_t i = 0; i < json_array_size(skies); i++)
        assert_true(number_at(json_array_get(skies, i), "processor_ms.median") > 0.0);
    json_decref(root);
    expect_run("$T bench --sky --size 64x64", 2, "", "it takes no axis");
}

/* By the twin, which compiles nothing. */
static void effects_are_measured(void **state)
{
    static const char *const lists[] = {"frames", "unused", "stages"};
    static const char *const sides[] = {"chosen", "with", "with"};
    static const size_t least[] = {5, 13, 3};
    (void)state;
    const program_run *run =
        expect_run("$T bench --effects --size 32x16 --precision twin --samples 2 --seconds 0 "
                   "--json e.json",
                   0, "pictures: the same bits in every pair", "");
    assert_non_null(strstr(run->out, "\nsun "));
    json_t *root = read_json("e.json");
    for (size_t k = 0; k < COUNT_OF(lists); k++) {
        char path[128];
        snprintf(path, sizeof path, "effects.%s", lists[k]);
        const json_t *list = at(root, path);
        assert_true(json_array_size(list) >= least[k]);
        for (size_t i = 0; i < json_array_size(list); i++) {
            const json_t *row = json_array_get(list, i);
            assert_summary(row, "ratio", 2.0);
            assert_summary(row, "processor_ratio", 2.0);
            snprintf(path, sizeof path, "%s.frame_ms", sides[k]);
            assert_summary(row, path, 2.0);
            /* Of stages, these are another picture. */
            const char *name = json_string_value(at(row, "name"));
            assert_int_equal(json_is_true(at(row, "same_bits")),
                             strcmp(name, "ambient-occlusion") != 0 &&
                                 strcmp(name, "sky-light") != 0 && strcmp(name, "links") != 0);
        }
    }
    assert_true(number_at(root, "effects.gain_of_plainest") > 0.0);
    assert_true(number_at(root, "effects.most_of_unused") > 0.0);
    json_decref(root);
    expect_run("$T bench --effects --material full", 2, "",
               "--effects has frames of its own; leave out --material");
    expect_run("$T bench --effects --tile 8,16", 2, "", "one word of each axis");
}

static void standard_output_is_the_report_alone(void **state)
{
    (void)state;
    const program_run *run =
        expect_run("$T bench --size 64x64 --lights 8 --seconds 0 --json -", 0, "records", "");
    json_error_t error;
    json_t *root = json_loads(run->out, 0, &error);
    assert_non_null(root);
    json_decref(root);
}

static int enter_folder(void **state)
{
    (void)state;
    enter_empty_folder("command-bench");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_are_recorded),
        cmocka_unit_test(layouts_are_compared),
        cmocka_unit_test(layouts_without_a_place_are_refused),
        cmocka_unit_test(csv_has_a_value_per_name),
        cmocka_unit_test(slower_cases_are_found),
        cmocka_unit_test(ratios_have_their_keys),
        cmocka_unit_test(starts_are_measured),
        cmocka_unit_test(batches_are_measured),
        cmocka_unit_test(skies_are_measured),
        cmocka_unit_test(effects_are_measured),
        cmocka_unit_test(standard_output_is_the_report_alone),
    };
    return cmocka_run_group_tests(tests, enter_folder, NULL);
}
