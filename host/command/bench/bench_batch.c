/* How near a batch comes to what its frames cost: child processes that light the same frames one after another,
 * and several under way at a time. */
#define _POSIX_C_SOURCE 200809L
#include "bench_child.h"
#include "bench_json.h"
#include "bench_session.h"
#include "console.h"
#include "json_values.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/report.h"
#include "try.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Both take seconds a turn: three turns, or fewer where fewer are asked for. */
enum { FRAMES = 12, MOST_TURNS = 3 };

/* Figures of a batch, per frame. X(name, word, unit) */
#define BATCH_FIGURES(X)                            \
    X(FRAME_MS, "ms", "frame ms")                   \
    X(PROCESSOR_MS, "processor_ms", "processor ms") \
    X(BUSY, "processors_busy", "busy")              \
    X(RESIDENT_MB, "most_resident_mb", "MB")

typedef enum batch_figure {
#define NAME(name, word, unit) name,
    BATCH_FIGURES(NAME)
#undef NAME
        FIGURE_COUNT
} batch_figure;

static const struct {
    const char *word, *unit;
} figures[FIGURE_COUNT] = {
#define ROW(name, word, unit) [name] = {word, unit},
    BATCH_FIGURES(ROW)
#undef ROW
};

typedef struct batch_way {
    const char *name, *in_flight; /* an argument; NULL: the usual */
    tl_samples of[FIGURE_COUNT];
} batch_way;

typedef struct batch_bench {
    char folder[BENCH_PATH_SIZE];
    char cache[BENCH_PATH_SIZE + 16], report[BENCH_PATH_SIZE + 16], input[BENCH_PATH_SIZE + 16],
        output[BENCH_PATH_SIZE + 16];
    char device[TL_BENCH_WORD_SIZE]; /* selector; "": the default */
    batch_way ways[2];               /* in turn, under way together */
    tl_samples
        ratios; /* wall time together over processor time in turn, spread over the processors */
    json_t *stages; /* of the last turn, together */
} batch_bench;

/* One capture under many names. */
static tl_status make_frames(bench_session *s, batch_bench *b, tl_error *err)
{
    tl_bench_lists lists = s->options->lists;
    char first[BENCH_PATH_SIZE + 32], name[BENCH_PATH_SIZE + 32];
    tl_status status = TL_OK;
    TRY(tl_bench_cases_add(&s->cases, &lists, err));
    const char *word = s->cases.cases[0].words[TL_AXIS_DEVICE];
    if (strcmp(word, tl_bench_axes[TL_AXIS_DEVICE].usual) != 0)
        snprintf(b->device, sizeof b->device, "%s", word);
    console_stage("making the frame");
    TRY(tl_bench_frame_make(&s->frame, &s->cases.cases[0], err));
    TRY(bench_folder_make("--batch", b->folder, err));
    snprintf(b->cache, sizeof b->cache, "%s/cache", b->folder);
    snprintf(b->report, sizeof b->report, "%s/report.json", b->folder);
    snprintf(b->input, sizeof b->input, "%s/g.#.exr", b->folder);
    snprintf(b->output, sizeof b->output, "%s/lit.#.exr", b->folder);
    snprintf(first, sizeof first, "%s/g.1.exr", b->folder);
    TRY(tl_gbuffer_write(first, s->frame.gbuffer, &s->frame.lights, err));
    for (int i = 2; i <= FRAMES; i++) {
        snprintf(name, sizeof name, "%s/g.%d.exr", b->folder, i);
        if (link(first, name) != 0)
            TRY(tl_fail(err, TL_ERR_WRITE, "%s: cannot be linked: %s", name, strerror(errno)));
    }
done:
    return status;
}

/* The report of a batch; the caller releases it. */
static tl_status run_batch(batch_bench *b, const char *in_flight, json_t **out, tl_error *err)
{
    char name[] = "tilelight", batch[] = "batch", o[] = "-o", json[] = "--json",
         quiet[] = "--quiet", force[] = "--force", flight_option[] = "--in-flight",
         device_option[] = "--device", flight[8] = "";
    char *arguments[16] = {name, batch, b->input, o, b->output, json, quiet, force};
    size_t count = 8;
    tl_status status = TL_OK;
    if (in_flight) {
        snprintf(flight, sizeof flight, "%s", in_flight);
        arguments[count++] = flight_option;
        arguments[count++] = flight;
    }
    if (b->device[0]) {
        arguments[count++] = device_option;
        arguments[count++] = b->device;
    }
    TRY(bench_child_run(arguments, b->cache, b->report, err));
    TRY(tl_json_read(b->report, out, err));
done:
    return status;
}

static double number(const json_t *report, const char *word)
{
    return json_number_value(json_object_get(report, word));
}

static tl_status add(batch_way *way,
                     const json_t *report,
                     double of[FIGURE_COUNT],
                     tl_error *err)
{
    of[FRAME_MS] = 1e3 * number(report, "seconds") / FRAMES;
    of[PROCESSOR_MS] = 1e3 * number(report, "processor_s") / FRAMES;
    of[BUSY] = number(report, "processors_busy");
    of[RESIDENT_MB] = 1e-6 * number(report, "most_resident_bytes");
    for (int i = 0; i < FIGURE_COUNT; i++) {
        const tl_status status = tl_samples_add(&way->of[i], of[i], err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

/* A turn of each way. */
static tl_status take_turn(batch_bench *b, tl_error *err)
{
    double of[2][FIGURE_COUNT], processors = 1.0;
    tl_status status = TL_OK;
    json_t *report = NULL;
    for (int i = 0; i < 2; i++) {
        json_decref(report);
        report = NULL;
        console_stage(b->ways[i].name);
        TRY(run_batch(b, b->ways[i].in_flight, &report, err));
        TRY(add(&b->ways[i], report, of[i], err));
        processors = number(report, "processors");
    }
    TRY(tl_samples_add(&b->ratios, of[1][FRAME_MS] * processors / of[0][PROCESSOR_MS], err));
    json_decref(b->stages);
    b->stages = json_incref(json_object_get(report, "stages"));
done:
    json_decref(report);
    return status;
}

static tl_status measure(const bench_session *s, batch_bench *b, tl_error *err)
{
    const size_t asked = s->options->rule.least_samples;
    tl_status status = TL_OK;
    json_t *unused = NULL;
    console_stage("compiling");
    TRY(run_batch(b, NULL, &unused, err));
    for (size_t i = 0; i < MOST_TURNS && i < asked; i++)
        TRY(take_turn(b, err));
    console_stage(NULL);
done:
    json_decref(unused);
    return status;
}

static void print(FILE *out, batch_bench *b, const char *size)
{
    const tl_summary ratio = tl_samples_summarize(&b->ratios);
    const char *stage;
    json_t *of;
    fprintf(out, "%d frames of %s\n%-16s", FRAMES, size, "");
    for (int i = 0; i < FIGURE_COUNT; i++)
        fprintf(out, " %12s", figures[i].unit);
    for (int way = 0; way < 2; way++) {
        fprintf(out, "\n%-16s", b->ways[way].name);
        for (int i = 0; i < FIGURE_COUNT; i++)
            fprintf(out, " %12.2f", tl_samples_summarize(&b->ways[way].of[i]).median);
    }
    fprintf(out, "\n%-16s %12.3f  of its processor time in turn, spread over the processors\n",
            "a frame takes", ratio.median);
    fprintf(out, "%-16s %12s %12s\n", "stage, together", "frame ms", "processor ms");
    json_object_foreach(b->stages, stage, of)
        fprintf(out, "%-16s %12.2f %12.2f\n", stage, 1e3 * number(of, "wall_s") / FRAMES,
                1e3 * number(of, "processor_s") / FRAMES);
}

static json_t *way_json(const batch_way *way)
{
    json_t *all = json_object();
    for (int i = 0; i < FIGURE_COUNT; i++) {
        const tl_summary summary = tl_samples_summarize(&way->of[i]);
        json_object_set_new(all, figures[i].word, tl_bench_json_summary(&summary));
    }
    return all;
}

static tl_status write_report(const bench_session *s, batch_bench *b, tl_error *err)
{
    const tl_summary ratio = tl_samples_summarize(&b->ratios);
    json_t *report = tl_bench_json_begin(&s->machine);
    json_object_set_new(report, "batch",
                        json_pack("{si so so so so sO}", "frames", FRAMES, "case",
                                  tl_bench_json_case(&s->cases.cases[0]), "in_turn",
                                  way_json(&b->ways[0]), "together", way_json(&b->ways[1]),
                                  "ratio", tl_bench_json_summary(&ratio), "stages", b->stages));
    return tl_json_write(s->options->json, report, err);
}

static void release(batch_bench *b)
{
    bench_folder_remove(b->folder);
    for (int way = 0; way < 2; way++)
        for (int i = 0; i < FIGURE_COUNT; i++)
            tl_samples_clear(&b->ways[way].of[i]);
    tl_samples_clear(&b->ratios);
    json_decref(b->stages);
}

tl_status bench_run_batch(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    batch_bench b = {.ways = {{.name = "in turn", .in_flight = "1"}, {.name = "together"}}};
    TRY(make_frames(s, &b, err));
    TRY(measure(s, &b, err));
    if (s->table)
        print(s->table, &b, s->cases.cases[0].words[TL_AXIS_SIZE]);
    if (s->options->json)
        TRY(write_report(s, &b, err));
done:
    release(&b);
    return status;
}
