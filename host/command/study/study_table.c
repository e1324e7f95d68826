#include "study_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A front: whose times, and who is on it. */
typedef struct front {
    const char *title;
    tl_study_time_name time;
    tl_study_value_name is_on;
} front;

static const front fronts[] = {
    {"Lighting a frame in memory: what none beats in time and error", TL_TIME_LIGHT_RATIO,
     TL_VALUE_FRONT_LIGHT},
    {"Reading, lighting and writing: what none beats", TL_TIME_JOB_RATIO, TL_VALUE_FRONT_JOB},
};

/* For qsort, which takes no context. */
static tl_study_time_name sorted_by;

static int by_time(const void *a, const void *b)
{
    const tl_study_record *const *x = a, *const *y = b;
    const double first = (*x)->times[sorted_by].median, second = (*y)->times[sorted_by].median;
    return (first > second) - (first < second);
}

static void print_line(FILE *out, const tl_study_record *r, tl_study_time_name time)
{
    char title[1024], interval[64] = "-";
    const tl_study_time *t = &r->times[time];
    tl_study_config_title(&r->config, title, sizeof title);
    if (t->samples > 0)
        snprintf(interval, sizeof interval, "%.3f to %.3f%s", t->low, t->high,
                 t->is_unstable ? "!" : " ");
    fprintf(out, "%7.3f %17s %6.0f %9.1e %9.1e %9.1e  %-13s %s%s\n", t->median, interval,
            r->values[TL_VALUE_STORED], r->values[TL_VALUE_ERROR_RMS],
            r->values[TL_VALUE_ERROR_MAX], r->values[TL_VALUE_FLIP], tl_study_main_cause(r),
            title, tl_study_is_for_screen(&r->config) ? " (errors of the screen)" : "");
}

static void print_front(FILE *out, const front *f, const tl_study_record **sorted, size_t count)
{
    fprintf(out, "\n%s:\n%7s %17s %6s %9s %9s %9s  %-13s %s\n", f->title, "time", "interval",
            "B/px", "error RMS", "most", "FLIP", "mostly of", "configuration");
    for (size_t i = 0; i < count; i++)
        if (sorted[i]->values[f->is_on] > 0.0)
            print_line(out, sorted[i], f->time);
}

/* The fastest to light within each error, told once. */
static void print_advice(FILE *out, const tl_study_record **sorted, size_t count)
{
    static const double errors[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
    const tl_study_record *told = NULL;
    fputc('\n', out);
    for (size_t k = 0; k < sizeof errors / sizeof errors[0]; k++) {
        const tl_study_record *best = NULL;
        for (size_t i = 0; i < count && !best; i++)
            if (sorted[i]->values[TL_VALUE_FRONT_LIGHT] > 0.0 &&
                sorted[i]->values[TL_VALUE_ERROR_RMS] <= errors[k])
                best = sorted[i];
        if (!best || best == told)
            continue;
        char title[1024];
        tl_study_config_title(&best->config, title, sizeof title);
        fprintf(out, "For an error of %g: %s, %.2f of the default's time.\n", errors[k], title,
                best->times[TL_TIME_LIGHT_RATIO].median);
        told = best;
    }
}

static void print_faults(FILE *out, const tl_study_result *result)
{
    size_t unstable = 0, culled = 0;
    for (size_t i = 0; i < result->count; i++) {
        unstable += (size_t)result->records[i].times[TL_TIME_LIGHT_RATIO].is_unstable;
        culled += result->records[i].values[TL_VALUE_CULLING_DIFFERING] > 0.0;
    }
    if (unstable)
        fprintf(out, "Unstable (!): %zu of %zu times of lighting.\n", unstable, result->count);
    if (culled)
        fprintf(out, "CULLING CHANGES THE PICTURE in %zu configurations: that is a fault.\n",
                culled);
}

void study_print(FILE *out, const tl_study_result *result)
{
    const tl_study_record **sorted = malloc((result->count + 1) * sizeof *sorted);
    if (!sorted)
        return;
    for (size_t i = 0; i < result->count; i++)
        sorted[i] = &result->records[i];
    fprintf(out,
            "\n%s: %u x %u, %zu lights, %zu configurations; errors are relative to the mean "
            "radiance, against %s\n",
            result->name, result->width, result->height, result->light_count, result->count,
            result->reference);
    for (size_t k = 0; k < sizeof fronts / sizeof fronts[0]; k++) {
        sorted_by = fronts[k].time;
        qsort(sorted, result->count, sizeof *sorted, by_time);
        print_front(out, &fronts[k], sorted, result->count);
    }
    sorted_by = TL_TIME_LIGHT_RATIO;
    qsort(sorted, result->count, sizeof *sorted, by_time);
    print_advice(out, sorted, result->count);
    print_faults(out, result);
    free(sorted);
}

static void print_left(FILE *out, const char *frame, const tl_study_record *r)
{
    const tl_study_time *stated = &r->times[tl_study_judged(r)];
    char title[1024];
    tl_study_config_title(&r->config, title, sizeof title);
    fprintf(out, "  %s: %s: %s is %.3f, not from %.3f to %.3f\n", frame, title,
            tl_study_time_rows[tl_study_judged(r)].name, r->again.median, stated->low,
            stated->high);
}

void study_print_again(FILE *out, const tl_study *study)
{
    size_t twice, stay;
    tl_study_count_again(study, &twice, &stay);
    fprintf(out, "%zu of %zu stay inside their intervals%s\n", stay, twice,
            stay == twice ? "." : "; the others are marked unstable:");
    for (size_t i = 0; i < study->count; i++)
        for (size_t k = 0; k < study->results[i].count; k++)
            if (tl_study_stays(&study->results[i].records[k]) == 0)
                print_left(out, study->results[i].name, &study->results[i].records[k]);
}

void study_print_list(FILE *out)
{
    fputs("Knobs, for --knob NAME=WORD,...; (*): the usual word\n", out);
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++) {
        const tl_study_knob *k = &tl_study_knobs[i];
        fprintf(out,
                "  %-12s %s\n  %-12s trades %s; its error counts as %s\n  %-12s words: %s; (*) "
                "%s\n",
                k->name, k->meaning, "", k->trades, tl_study_cause_words[k->cause], "",
                k->all ? k->all : "numbers", k->usual);
    }
    fputs("\nCauses of errors, in the order in which a picture comes to be:\n", out);
    for (int i = 0; i < TL_STUDY_CAUSE_COUNT; i++)
        fprintf(out, "  %-14s %s\n", tl_study_cause_words[i], tl_study_cause_meanings[i]);
    fputs("\nBuilt-in frames, where no scene is given:\n", out);
    for (int i = 0; i < tl_study_built_in_count; i++)
        fprintf(out, "  %-12s %s\n", tl_study_built_ins[i].name, tl_study_built_ins[i].meaning);
}
