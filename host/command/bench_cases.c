/* The cases of the axes, one after another. */
#define _DEFAULT_SOURCE /* strsep */
#include "bench_csv.h"
#include "bench_json.h"
#include "bench_session.h"
#include "bench_table.h"
#include "console.h"
#include "json_values.h"
#include "try.h"
#include "whole_file.h"

#include <stdlib.h>
#include <string.h>

/* The lists of a set, those given on the command line in place of its own. */
static tl_status add_set(bench_session *s, const tl_bench_set *set, tl_error *err)
{
    const tl_bench_lists *given = &s->options->lists;
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

static tl_status add_named_sets(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    char *names = strdup(s->options->sets), *rest = names;
    if (!names)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for cases"));
    for (const char *name; (name = strsep(&rest, ","));) {
        const tl_bench_set *set = tl_bench_set_find(name);
        if (!set)
            TRY(unknown_set(name, err));
        TRY(add_set(s, set, err));
    }
done:
    free(names);
    return status;
}

static tl_status choose_cases(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    if (s->options->sets)
        return add_named_sets(s, err);
    if (s->options->lists_given)
        return tl_bench_cases_add(&s->cases, &s->options->lists, err);
    for (int i = 0; i < tl_bench_set_count; i++)
        TRY(add_set(s, &tl_bench_sets[i], err));
done:
    return status;
}

static void show_progress(const bench_session *s, size_t number)
{
    char title[512], stage[640];
    tl_bench_case_title(&s->cases.cases[number], title, sizeof title);
    snprintf(stage, sizeof stage, "case %zu of %zu: %s", number + 1, s->cases.count, title);
    console_stage(stage);
}

static tl_status measure(bench_session *s, tl_bench_record *records, tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < s->cases.count; i++) {
        const tl_bench_case *of = &s->cases.cases[i];
        TRY(bench_session_device(s, of, err));
        TRY(bench_session_peaks(s, err));
        show_progress(s, i);
        TRY(tl_bench_measure(s->device, &s->peaks, of, &s->frame, &s->options->rule,
                             &records[i], err));
        console_stage(NULL);
        if (!s->table)
            continue;
        if (i == 0)
            tl_bench_table_heading(s->table);
        tl_bench_table_line(s->table, &records[i]);
    }
done:
    return status;
}

static tl_status write_csv(const bench_session *s,
                           const tl_bench_record *records,
                           tl_error *err)
{
    char *text = NULL;
    tl_status status = TL_OK;
    if (!s->options->csv)
        goto done;
    TRY(tl_bench_csv(records, s->cases.count, &text, err));
    TRY(tl_whole_file_write(s->options->csv, text, strlen(text), err));
done:
    free(text);
    return status;
}

static tl_status write_json(const bench_session *s,
                            const tl_bench_record *records,
                            tl_error *err)
{
    if (!s->options->json)
        return TL_OK;
    json_t *report = tl_bench_json_begin(&s->machine), *array = json_array();
    for (size_t i = 0; i < s->cases.count; i++)
        json_array_append_new(array, tl_bench_json_record(&records[i]));
    json_object_set_new(report, "records", array);
    return tl_json_write(s->options->json, report, err);
}

tl_status bench_run_cases(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    tl_bench_record *records = NULL;
    TRY(choose_cases(s, err));
    records = calloc(s->cases.count, sizeof *records);
    if (!records)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for records"));
    TRY(measure(s, records, err));
    TRY(write_csv(s, records, err));
    TRY(write_json(s, records, err));
done:
    free(records);
    return status;
}
