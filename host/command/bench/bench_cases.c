/* The cases of the axes, one after another. */
#define _DEFAULT_SOURCE /* strsep */
#include "bench_csv.h"
#include "bench_json.h"
#include "bench_session.h"
#include "bench_table.h"
#include "comparison.h"
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

static bool is_first_of_its_name(int set)
{
    return set == 0 || strcmp(tl_bench_sets[set].name, tl_bench_sets[set - 1].name) != 0;
}

static tl_status unknown_set(const char *name, tl_error *err)
{
    char list[512] = "";
    for (int i = 0; i < tl_bench_set_count; i++)
        if (is_first_of_its_name(i))
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
        int found = 0;
        for (int i = 0; i < tl_bench_set_count; i++)
            if (strcmp(tl_bench_sets[i].name, name) == 0) {
                found++;
                TRY(add_set(s, &tl_bench_sets[i], err));
            }
        if (!found)
            TRY(unknown_set(name, err));
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
        if (!tl_bench_sets[i].only_if_named)
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

/* All zero to begin with. */
typedef struct compared {
    json_t *report;             /* the earlier one; NULL: nothing to compare with */
    tl_comparison *comparisons; /* [cases.count] */
    size_t slower_count;
} compared;

static void warn_of_other_machine(const bench_session *s, const json_t *report)
{
    const json_t *machine = json_object_get(report, "machine");
    const char *processor = json_string_value(json_object_get(machine, "processor"));
    const json_int_t threads = json_integer_value(json_object_get(machine, "threads"));
    if (processor && (strcmp(processor, s->machine.processor) != 0 ||
                      threads != (json_int_t)s->machine.threads))
        tl_notice(&console_notices,
                  "%s is of another machine: %s with %lld threads, this one is %s with %u",
                  s->options->compare, processor, (long long)threads, s->machine.processor,
                  s->machine.threads);
}

static tl_status begin_comparing(const bench_session *s, compared *c, tl_error *err)
{
    tl_status status = TL_OK;
    if (!s->options->compare)
        goto done;
    TRY(tl_bench_report_read(s->options->compare, &c->report, err));
    warn_of_other_machine(s, c->report);
done:
    return status;
}

static void print_comparison(FILE *out, const tl_bench_record *record, const tl_comparison *c)
{
    char title[512];
    tl_bench_case_title(&record->of, title, sizeof title);
    if (c->verdict == TL_NEW) {
        fprintf(out, "%-34s %9s %9.2f %34s %s\n", title, "-", c->now_ms, "",
                tl_verdict_words[c->verdict]);
        return;
    }
    fprintf(out, "%-34s %9.2f %9.2f %7.3f %16.3f to %5.3f  %s\n", title, c->before_ms,
            c->now_ms, c->ratio, c->low, c->high, tl_verdict_words[c->verdict]);
}

static tl_status compare_all(const bench_session *s,
                             const tl_bench_record *records,
                             compared *c,
                             tl_error *err)
{
    tl_status status = TL_OK;
    if (!c->report)
        goto done;
    c->comparisons = calloc(s->cases.count, sizeof *c->comparisons);
    if (!c->comparisons)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for comparisons"));
    if (s->table)
        fprintf(s->table, "\n%-34s %9s %9s %7s %25s  %s\n", "against the report", "before ms",
                "now ms", "ratio", "interval", "verdict");
    for (size_t i = 0; i < s->cases.count; i++) {
        TRY(tl_compare_record(c->report, s->options->compare, &records[i],
                              s->options->threshold, &c->comparisons[i], err));
        c->slower_count += c->comparisons[i].verdict == TL_SLOWER;
        if (s->table)
            print_comparison(s->table, &records[i], &c->comparisons[i]);
    }
done:
    return status;
}

static tl_status write_json(const bench_session *s,
                            const tl_bench_record *records,
                            const compared *c,
                            tl_error *err)
{
    if (!s->options->json)
        return TL_OK;
    json_t *report = tl_bench_json_begin(&s->machine), *array = json_array();
    for (size_t i = 0; i < s->cases.count; i++) {
        json_t *record = tl_bench_json_record(&records[i]);
        if (c->comparisons)
            json_object_set_new(record, "comparison", tl_comparison_json(&c->comparisons[i]));
        json_array_append_new(array, record);
    }
    json_object_set_new(report, "records", array);
    return tl_json_write(s->options->json, report, err);
}

static tl_status judge(const bench_session *s, const compared *c, tl_error *err)
{
    if (!s->options->fail_if_slower || c->slower_count == 0)
        return TL_OK;
    return tl_fail(err, TL_ERR_DIFFERENT, "%zu of %zu cases are slower than in %s",
                   c->slower_count, s->cases.count, s->options->compare);
}

tl_status bench_run_cases(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    tl_bench_record *records = NULL;
    compared c = {0};
    TRY(choose_cases(s, err));
    TRY(begin_comparing(s, &c, err));
    records = calloc(s->cases.count, sizeof *records);
    if (!records)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for records"));
    TRY(measure(s, records, err));
    TRY(compare_all(s, records, &c, err));
    TRY(write_csv(s, records, err));
    TRY(write_json(s, records, &c, err));
    TRY(judge(s, &c, err));
done:
    json_decref(c.report);
    free(c.comparisons);
    free(records);
    return status;
}
