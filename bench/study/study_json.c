#include "study_json.h"

#include "bench_json.h"
#include "claims_json.h"
#include "json_values.h"
#include "maps.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static json_t *rows_json(const tl_study_row *rows, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(array, json_pack("{ss ss ss}", "name", rows[i].name, "unit",
                                               rows[i].unit, "meaning", rows[i].meaning));
    return array;
}

static json_t *knobs_json(void)
{
    json_t *array = json_array();
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++) {
        const tl_study_knob *k = &tl_study_knobs[i];
        json_array_append_new(array, json_pack("{ss ss ss ss sb ss ss ss?}", "name", k->name,
                                               "meaning", k->meaning, "trades", k->trades,
                                               "cause", tl_study_cause_words[k->cause],
                                               "of_files", k->is_of_files, "usual", k->usual,
                                               "exact", k->exact, "words", k->all));
    }
    return array;
}

static json_t *causes_json(void)
{
    json_t *array = json_array();
    for (int i = 0; i < TL_STUDY_CAUSE_COUNT; i++)
        json_array_append_new(array, json_pack("{ss ss}", "name", tl_study_cause_words[i],
                                               "meaning", tl_study_cause_meanings[i]));
    return array;
}

static json_t *time_json(const tl_study_time *t)
{
    if (isnan(t->median))
        return json_null();
    return json_pack("{so so so si sb}", "median", tl_json_number(t->median), "low",
                     tl_json_number(t->low), "high", tl_json_number(t->high), "samples",
                     (int)t->samples, "unstable", t->is_unstable);
}

/* Of a second run. */
static json_t *again_json(const tl_study_record *r)
{
    json_t *time = time_json(&r->again);
    if (json_is_object(time)) {
        json_object_set_new(time, "of",
                            json_string(tl_study_time_rows[tl_study_judged(r)].name));
        json_object_set_new(time, "stays", json_boolean(tl_study_stays(r)));
    }
    return time;
}

/* Of lighting, for a study that goes on. */
static json_t *blocks_json(const tl_study_blocks *lit)
{
    json_t *object = json_pack("{si si}", "count", lit->count, "samples", (int)lit->samples);
    for (int i = 0; i < TL_STUDY_LIT_COUNT; i++) {
        json_t *medians = json_array();
        for (int k = 0; k < lit->count; k++)
            json_array_append_new(medians, tl_json_number(lit->medians[i][k]));
        json_object_set_new(object, tl_study_time_rows[tl_study_lit_times[i]].name, medians);
    }
    return object;
}

static json_t *record_json(const tl_study_record *r)
{
    char title[1024];
    json_t *knobs = json_object(), *times = json_object(), *values = json_object();
    tl_study_config_title(&r->config, title, sizeof title);
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++)
        json_object_set_new(knobs, tl_study_knobs[i].name, json_string(r->config.words[i]));
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++)
        json_object_set_new(times, tl_study_time_rows[i].name, time_json(&r->times[i]));
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++)
        json_object_set_new(values, tl_study_value_rows[i].name, tl_json_number(r->values[i]));
    return json_pack("{ss so so ss so so ss s{ss ss} ss so so}", "title", title, "knobs", knobs,
                     "seconds", tl_json_number(r->seconds), "errors_of",
                     tl_study_is_for_screen(&r->config) ? "screen" : "radiance", "times", times,
                     "values", values, "main_cause", tl_study_main_cause(r), "worst", "cause",
                     r->worst_cause, "detail", r->worst_detail, "map", r->map, "again",
                     again_json(r), "blocks", blocks_json(&r->lit));
}

static json_t *planes_json(uint32_t present)
{
    static const char *const names[TL_PLANE_COUNT] = {
#define CHANNEL_NAME(name, channel, empty, meaning) [name] = channel,
        TL_PLANES(CHANNEL_NAME)
#undef CHANNEL_NAME
    };
    json_t *array = json_array();
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (present & TL_HAS(p))
            json_array_append_new(array, json_string(names[p]));
    return array;
}

static json_t *result_json(const tl_study_result *result)
{
    json_t *records = json_array();
    for (size_t i = 0; i < result->count; i++)
        json_array_append_new(records, record_json(&result->records[i]));
    return json_pack("{ss ss ss s[ii] so sI so so ss ss so}", "name", result->name, "source",
                     result->source, "identity", result->identity, "size", (int)result->width,
                     (int)result->height, "planes", planes_json(result->present), "lights",
                     (json_int_t)result->light_count, "mean_radiance",
                     tl_json_number(result->mean), "exposure", tl_json_number(result->exposure),
                     "reference", result->reference, "picture", result->picture,
                     "configurations", records);
}

tl_status tl_study_json_write(const tl_study *study, const char *path, tl_error *err)
{
    json_t *frames = json_array();
    for (size_t i = 0; i < study->count; i++)
        json_array_append_new(frames, result_json(&study->results[i]));
    json_t *report = json_pack(
        "{si s{ss si so} so ss so so so so s{si sf} s[ff] so so}", "tilelight_study",
        TL_STUDY_JSON_VERSION, "machine", "processor", study->machine.processor, "threads",
        (int)study->machine.threads, "load_before", tl_json_number(study->machine.load),
        "device", tl_bench_json_device(&study->device), "command", study->command, "knobs",
        knobs_json(), "causes", causes_json(), "times",
        rows_json(tl_study_time_rows, TL_STUDY_TIME_COUNT), "values",
        rows_json(tl_study_value_rows, TL_STUDY_VALUE_COUNT), "intervals", "blocks",
        TL_STUDY_BLOCK_COUNT, "coverage", tl_study_interval_coverage(), "map_errors",
        TL_STUDY_MAP_LOW, TL_STUDY_MAP_HIGH, "claims", tl_claims_json(study->claims), "frames",
        frames);
    return tl_json_write(path, report, err);
}

/* A copy of a string into an array; empty where it is missing. */
static void read_text(const json_t *object, const char *key, char *out, size_t size)
{
    const char *text = json_string_value(json_object_get(object, key));
    snprintf(out, size, "%s", text ? text : "");
}

static double read_number(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

static tl_study_time read_time(const json_t *object)
{
    if (!json_is_object(object))
        return tl_study_time_known((double)NAN);
    return (tl_study_time){.median = read_number(object, "median"),
                           .low = read_number(object, "low"),
                           .high = read_number(object, "high"),
                           .samples =
                               (size_t)json_integer_value(json_object_get(object, "samples")),
                           .is_unstable = json_is_true(json_object_get(object, "unstable"))};
}

/* As many as there are of all. */
static tl_study_blocks read_blocks(const json_t *object)
{
    tl_study_blocks lit = {.count = (int)json_integer_value(json_object_get(object, "count")),
                           .samples =
                               (size_t)json_integer_value(json_object_get(object, "samples"))};
    lit.count = lit.count < 0 || lit.count > TL_STUDY_BLOCK_COUNT ? 0 : lit.count;
    for (int i = 0; i < TL_STUDY_LIT_COUNT; i++) {
        const json_t *medians =
            json_object_get(object, tl_study_time_rows[tl_study_lit_times[i]].name);
        if (json_array_size(medians) < (size_t)lit.count)
            return (tl_study_blocks){.count = 0};
        for (int k = 0; k < lit.count; k++)
            lit.medians[i][k] = json_number_value(json_array_get(medians, (size_t)k));
    }
    return lit;
}

static tl_status read_record(const json_t *object,
                             const char *path,
                             tl_study_record *out,
                             tl_error *err)
{
    const json_t *knobs = json_object_get(object, "knobs");
    const json_t *times = json_object_get(object, "times");
    const json_t *values = json_object_get(object, "values");
    tl_study_config config = tl_study_config_default();
    tl_error said;
    if (!json_is_object(knobs) || !json_is_object(times) || !json_is_object(values))
        return tl_fail(err, TL_ERR_FORMAT, "%s: a configuration without knobs, times or values",
                       path);
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++) {
        const char *word = json_string_value(json_object_get(knobs, tl_study_knobs[i].name));
        if (word && tl_study_config_set(&config, (tl_study_knob_name)i, word, &said) != TL_OK)
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s", path, said.message);
    }
    *out = tl_study_record_empty(&config, read_number(object, "seconds"));
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++)
        out->times[i] = read_time(json_object_get(times, tl_study_time_rows[i].name));
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++)
        out->values[i] = read_number(values, tl_study_value_rows[i].name);
    const json_t *worst = json_object_get(object, "worst");
    read_text(worst, "cause", out->worst_cause, sizeof out->worst_cause);
    read_text(worst, "detail", out->worst_detail, sizeof out->worst_detail);
    read_text(object, "map", out->map, sizeof out->map);
    out->lit = read_blocks(json_object_get(object, "blocks"));
    out->again = read_time(json_object_get(object, "again"));
    return TL_OK;
}

static uint32_t read_planes(const json_t *array)
{
    uint32_t present = 0;
#define READ_PLANE(name, channel, empty, meaning)                              \
    for (size_t i = 0; i < json_array_size(array); i++)                        \
        if (json_is_string(json_array_get(array, i)) &&                        \
            strcmp(json_string_value(json_array_get(array, i)), channel) == 0) \
            present |= TL_HAS(name);
    TL_PLANES(READ_PLANE)
#undef READ_PLANE
    return present;
}

static tl_status read_result(const json_t *object,
                             const char *path,
                             tl_study_result *out,
                             tl_error *err)
{
    const json_t *records = json_object_get(object, "configurations");
    const json_t *size = json_object_get(object, "size");
    tl_study_result made = {.width = (uint32_t)json_integer_value(json_array_get(size, 0)),
                            .height = (uint32_t)json_integer_value(json_array_get(size, 1)),
                            .present = read_planes(json_object_get(object, "planes")),
                            .light_count =
                                (size_t)json_integer_value(json_object_get(object, "lights")),
                            .mean = read_number(object, "mean_radiance"),
                            .exposure = read_number(object, "exposure"),
                            .count = json_array_size(records)};
    tl_status status = TL_OK;
    read_text(object, "name", made.name, sizeof made.name);
    read_text(object, "identity", made.identity, sizeof made.identity);
    read_text(object, "source", made.source, sizeof made.source);
    read_text(object, "reference", made.reference, sizeof made.reference);
    read_text(object, "picture", made.picture, sizeof made.picture);
    if (!made.name[0] || !made.identity[0] || !json_is_array(records))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: a frame without name, identity or configurations",
                    path));
    made.records = calloc(made.count + 1, sizeof *made.records);
    if (!made.records)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a study"));
    for (size_t i = 0; i < made.count; i++)
        TRY(read_record(json_array_get(records, i), path, &made.records[i], err));
    *out = made;
    made.records = NULL;
done:
    free(made.records);
    return status;
}

static void read_machine(const json_t *root, tl_study *study)
{
    const json_t *machine = json_object_get(root, "machine");
    const json_t *device = json_object_get(root, "device");
    read_text(machine, "processor", study->machine.processor, sizeof study->machine.processor);
    study->machine.threads = (unsigned)json_integer_value(json_object_get(machine, "threads"));
    study->machine.load = read_number(machine, "load_before");
    read_text(device, "name", study->device.name, sizeof study->device.name);
    read_text(device, "platform", study->device.platform, sizeof study->device.platform);
    read_text(device, "driver", study->device.driver, sizeof study->device.driver);
    read_text(device, "kind", study->device.kind, sizeof study->device.kind);
    study->device.compute_units =
        (uint32_t)json_integer_value(json_object_get(device, "units"));
    study->device.vector_width = (uint32_t)json_integer_value(json_object_get(device, "lanes"));
    read_text(root, "command", study->command, sizeof study->command);
}

tl_status tl_study_json_read(const char *path, tl_study *study, tl_error *err)
{
    json_t *root = NULL;
    tl_study made = {0};
    tl_status status = TL_OK;
    TRY(tl_json_read(path, &root, err));
    const json_t *version = json_object_get(root, "tilelight_study");
    const json_t *frames = json_object_get(root, "frames");
    if (!json_is_integer(version) || !json_is_array(frames))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: it is no study that `tilelight study' wrote",
                    path));
    if (json_integer_value(version) != TL_STUDY_JSON_VERSION)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: a study of version %lld; this program reads %d",
                    path, (long long)json_integer_value(version), TL_STUDY_JSON_VERSION));
    read_machine(root, &made);
    tl_claims_of_json(json_object_get(root, "claims"), made.claims);
    made.results = calloc(json_array_size(frames) + 1, sizeof *made.results);
    if (!made.results)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a study"));
    for (; made.count < json_array_size(frames); made.count++)
        TRY(read_result(json_array_get(frames, made.count), path, &made.results[made.count],
                        err));
    *study = made;
    made = (tl_study){0};
done:
    tl_study_clear(&made);
    json_decref(root);
    return status;
}
