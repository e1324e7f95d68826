/* How long the program takes to its first kernel: child processes that light a small frame, with
 * nothing compiled before (cold) and with everything (warm). */
#include "bench_child.h"
#include "bench_json.h"
#include "bench_session.h"
#include "console.h"
#include "json_values.h"
#include "tilelight/gbuffer_file.h"
#include "try.h"

#include <stdio.h>
#include <string.h>

/* A cold start takes seconds, and differs little from the next: 3, or fewer where fewer are asked
 * for. */
enum { MOST_COLD_STARTS = 3 };

typedef struct start_times {
    tl_samples first_kernel, process; /* ms */
} start_times;

typedef struct startup {
    const char *device;            /* selector; NULL: the default */
    char folder[BENCH_PATH_SIZE];  /* of our own, removed at the end; empty: none */
    char gbuffer[BENCH_PATH_SIZE]; /* files in it */
    char picture[BENCH_PATH_SIZE], report[BENCH_PATH_SIZE];
    start_times cold, warm;
} startup;

static tl_status make_frame(bench_session *s, startup *u, tl_error *err)
{
    tl_bench_lists lists = s->options->lists;
    tl_status status = TL_OK;
    lists.of[TL_AXIS_SIZE] = "64x64";
    lists.of[TL_AXIS_LIGHTS] = "8";
    TRY(tl_bench_cases_add(&s->cases, &lists, err));
    const char *word = s->cases.cases[0].words[TL_AXIS_DEVICE];
    u->device = strcmp(word, tl_bench_axes[TL_AXIS_DEVICE].usual) == 0 ? NULL : word;
    TRY(tl_bench_frame_make(&s->frame, &s->cases.cases[0], err));
    TRY(bench_folder_make("--startup", u->folder, err));
    snprintf(u->gbuffer, sizeof u->gbuffer, "%.200s/frame.exr", u->folder);
    snprintf(u->picture, sizeof u->picture, "%.200s/lit.exr", u->folder);
    snprintf(u->report, sizeof u->report, "%.200s/report.json", u->folder);
    TRY(tl_gbuffer_write(u->gbuffer, s->frame.gbuffer, &s->frame.lights, err));
done:
    return status;
}

/* A `tilelight light` of the frame, its report going to a file. */
static tl_status run_child(const startup *u, const char *cache, tl_error *err)
{
    char name[] = "tilelight", light[] = "light", o[] = "-o", json[] = "--json",
         timings[] = "--timings", device[] = "--device";
    char gbuffer[BENCH_PATH_SIZE], picture[BENCH_PATH_SIZE], selector[TL_BENCH_WORD_SIZE] = "";
    char *arguments[] = {name,     light, gbuffer, o,
                         picture,  json,  timings, u->device ? device : NULL,
                         selector, NULL};
    snprintf(gbuffer, sizeof gbuffer, "%s", u->gbuffer);
    snprintf(picture, sizeof picture, "%s", u->picture);
    if (u->device)
        snprintf(selector, sizeof selector, "%s", u->device);
    return bench_child_run(arguments, cache, u->report, err);
}

/* times NULL: the start only fills the cache. */
static tl_status start_once(const startup *u,
                            const char *cache,
                            start_times *times,
                            tl_error *err)
{
    tl_status status = TL_OK;
    json_t *report = NULL;
    const double start = tl_seconds();
    TRY(run_child(u, cache, err));
    const double process_ms = 1e3 * (tl_seconds() - start);
    if (!times)
        goto done;
    TRY(tl_json_read(u->report, &report, err));
    TRY(tl_samples_add(&times->process, process_ms, err));
    TRY(tl_samples_add(&times->first_kernel,
                       json_number_value(json_object_get(report, "first_kernel_ms")), err));
done:
    json_decref(report);
    return status;
}

static tl_status measure(const bench_session *s, startup *u, tl_error *err)
{
    tl_status status = TL_OK;
    char cache[BENCH_PATH_SIZE + 16] = "";
    const size_t asked = s->options->rule.least_samples;
    for (size_t i = 0; i < MOST_COLD_STARTS && i < asked; i++) {
        console_stage("starting cold");
        snprintf(cache, sizeof cache, "%s/cache-%zu", u->folder, i);
        TRY(start_once(u, cache, &u->cold, err));
    }
    TRY(start_once(u, cache, NULL, err)); /* the disk's cache too */
    console_stage("starting warm");
    const double start = tl_seconds();
    do {
        TRY(start_once(u, cache, &u->warm, err));
    } while (!tl_sampling_done(&s->options->rule, &u->warm.first_kernel, start));
    console_stage(NULL);
done:
    return status;
}

static void print_times(FILE *out, const char *name, const start_times *times)
{
    const tl_summary first = tl_samples_summarize(&times->first_kernel);
    const tl_summary process = tl_samples_summarize(&times->process);
    fprintf(out, "%-6s %15.1f %10.1f %10.1f %15.1f %8zu\n", name, first.median, first.least,
            first.p90, process.median, first.count);
}

static json_t *times_json(const start_times *times)
{
    const tl_summary first = tl_samples_summarize(&times->first_kernel);
    const tl_summary process = tl_samples_summarize(&times->process);
    return json_pack("{so so}", "first_kernel_ms", tl_bench_json_summary(&first), "process_ms",
                     tl_bench_json_summary(&process));
}

static void release(startup *u)
{
    bench_folder_remove(u->folder);
    tl_samples_clear(&u->cold.first_kernel);
    tl_samples_clear(&u->cold.process);
    tl_samples_clear(&u->warm.first_kernel);
    tl_samples_clear(&u->warm.process);
}

tl_status bench_run_startup(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    startup u = {.device = NULL};
    TRY(make_frame(s, &u, err));
    TRY(measure(s, &u, err));
    if (s->table) {
        fprintf(s->table, "%-6s %15s %10s %10s %15s %8s\n", "start", "first kernel ms", "least",
                "p90", "whole process", "samples");
        print_times(s->table, "cold", &u.cold);
        print_times(s->table, "warm", &u.warm);
    }
    if (s->options->json) {
        json_t *report = tl_bench_json_begin(&s->machine);
        json_object_set_new(
            report, "startup",
            json_pack("{so so}", "cold", times_json(&u.cold), "warm", times_json(&u.warm)));
        TRY(tl_json_write(s->options->json, report, err));
    }
done:
    release(&u);
    return status;
}
