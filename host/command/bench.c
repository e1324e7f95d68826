/* tilelight bench: how fast frames are lit. */
#define _DEFAULT_SOURCE /* strsep */
#include "bench_csv.h"
#include "bench_json.h"
#include "bench_options.h"
#include "bench_table.h"
#include "commands.h"
#include "console.h"
#include "json_values.h"
#include "output.h"
#include "try.h"
#include "whole_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All zero to begin with; released with bench_release. */
typedef struct bench_session {
    tl_bench_cases cases;
    tl_device *device;
    char device_word[TL_BENCH_WORD_SIZE]; /* what it was opened by */
    tl_peaks peaks;
    tl_bench_frame frame;
    tl_bench_record *records; /* [cases.count], the first record_count are set */
    size_t record_count;
} bench_session;

static void release(bench_session *s)
{
    free(s->records);
    tl_bench_frame_clear(&s->frame);
    tl_device_close(s->device);
    tl_bench_cases_clear(&s->cases);
}

static void list_everything(void)
{
    puts("Axes:");
    for (int i = 0; i < TL_AXIS_COUNT; i++)
        printf("  --%-10s %s (default %s)\n", tl_bench_axes[i].name, tl_bench_axes[i].meaning,
               tl_bench_axes[i].usual);
    puts("\nSets of cases:");
    for (int i = 0; i < tl_bench_set_count; i++) {
        printf("  %-10s   %s:", tl_bench_sets[i].name, tl_bench_sets[i].meaning);
        for (int axis = 0; axis < TL_AXIS_COUNT; axis++)
            if (tl_bench_sets[i].lists.of[axis])
                printf(" --%s %s", tl_bench_axes[axis].name, tl_bench_sets[i].lists.of[axis]);
        putchar('\n');
    }
    puts("\nScenes:");
    for (int i = 0; i < tl_bench_scene_count; i++)
        printf("  %-10s   %s\n", tl_bench_scenes[i].name, tl_bench_scenes[i].meaning);
}

/* The lists of a set, those given on the command line in place of its own. */
static tl_status add_set(bench_session *s,
                         const tl_bench_set *set,
                         const tl_bench_lists *given,
                         tl_error *err)
{
    tl_bench_lists lists = set->lists;
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++)
        if (given->of[axis])
            lists.of[axis] = given->of[axis];
    return tl_bench_cases_add(&s->cases, &lists, err);
}

static tl_status unknown_set(const char *name, tl_error *err)
{
    char list[512] = "";
    for (int i = 0; i < tl_bench_set_count; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? ", " : "",
                 tl_bench_sets[i].name);
    return tl_fail(err, TL_ERR_ARGUMENT, "--case: no such set \"%s\"; sets: %s", name, list);
}

static tl_status add_named_sets(bench_session *s, const bench_options *options, tl_error *err)
{
    tl_status status = TL_OK;
    char *names = strdup(options->sets), *rest = names;
    if (!names)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for cases"));
    for (const char *name; (name = strsep(&rest, ","));) {
        const tl_bench_set *set = tl_bench_set_find(name);
        if (!set)
            TRY(unknown_set(name, err));
        TRY(add_set(s, set, &options->lists, err));
    }
done:
    free(names);
    return status;
}

static tl_status choose_cases(bench_session *s, const bench_options *options, tl_error *err)
{
    tl_status status = TL_OK;
    if (options->sets)
        return add_named_sets(s, options, err);
    if (options->lists_given)
        return tl_bench_cases_add(&s->cases, &options->lists, err);
    for (int i = 0; i < tl_bench_set_count; i++)
        TRY(add_set(s, &tl_bench_sets[i], &options->lists, err));
done:
    return status;
}

/* The device of the case, and its peaks, unless it is open already. */
static tl_status open_device(bench_session *s, const tl_bench_case *of, tl_error *err)
{
    const char *word = of->words[TL_AXIS_DEVICE];
    tl_status status = TL_OK;
    if (s->device && strcmp(s->device_word, word) == 0)
        return TL_OK;
    tl_device_close(s->device);
    s->device = NULL;
    TRY(tl_device_open(strcmp(word, tl_bench_axes[TL_AXIS_DEVICE].usual) == 0 ? NULL : word,
                       &s->device, err));
    memcpy(s->device_word, word, sizeof s->device_word);
    console_stage("measuring what the device can do at most");
    TRY(tl_peaks_measure(s->device, &s->peaks, err));
done:
    return status;
}

static tl_status measure(bench_session *s,
                         const bench_options *options,
                         FILE *table,
                         tl_error *err)
{
    tl_status status = TL_OK;
    s->records = calloc(s->cases.count, sizeof *s->records);
    if (!s->records)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for records"));
    if (table)
        tl_bench_table_heading(table);
    for (size_t i = 0; i < s->cases.count; i++) {
        char title[512], stage[640];
        tl_bench_record *record = &s->records[i];
        TRY(open_device(s, &s->cases.cases[i], err));
        tl_bench_case_title(&s->cases.cases[i], title, sizeof title);
        snprintf(stage, sizeof stage, "case %zu of %zu: %s", i + 1, s->cases.count, title);
        console_stage(stage);
        TRY(tl_bench_measure(s->device, &s->peaks, &s->cases.cases[i], &s->frame,
                             &options->rule, record, err));
        s->record_count++;
        console_stage(NULL);
        if (table)
            tl_bench_table_line(table, record);
    }
done:
    return status;
}

static tl_status write_csv(const bench_session *s, const char *path, tl_error *err)
{
    char *text = NULL;
    tl_status status = TL_OK;
    if (!path)
        goto done;
    TRY(tl_bench_csv(s->records, s->record_count, &text, err));
    TRY(tl_whole_file_write(path, text, strlen(text), err));
done:
    free(text);
    return status;
}

static tl_status write_json(const bench_session *s,
                            const tl_machine *machine,
                            const char *path,
                            tl_error *err)
{
    if (!path)
        return TL_OK;
    json_t *report = tl_bench_json_begin(machine), *records = json_array();
    for (size_t i = 0; i < s->record_count; i++)
        json_array_append_new(records, tl_bench_json_record(&s->records[i]));
    json_object_set_new(report, "records", records);
    return tl_json_write(path, report, err);
}

static bool is_standard(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

static tl_status run(bench_session *s, const bench_options *options, tl_error *err)
{
    const tl_machine machine = tl_machine_ask();
    FILE *table = is_standard(options->csv) || is_standard(options->json) ? NULL : stdout;
    tl_status status = TL_OK;
    if (options->csv)
        TRY(output_check(options->csv, NULL, err));
    if (options->json)
        TRY(output_check(options->json, NULL, err));
    TRY(choose_cases(s, options, err));
    TRY(measure(s, options, table, err));
    TRY(write_csv(s, options->csv, err));
    TRY(write_json(s, &machine, options->json, err));
done:
    return status;
}

int command_bench(int argc, char **argv)
{
    bench_options options = {.rule = tl_sampling_rule_default()};
    bench_session session = {0};
    tl_status status = TL_OK;
    tl_error err;
    bench_parse(argc, argv, &options);
    if (options.list)
        list_everything();
    else
        status = run(&session, &options, &err);
    release(&session);
    return console_finish(status, &err);
}
