/* What the time and memory of a frame grow with: a fit to points from the smallest to the largest. */
#include "bench_json.h"
#include "bench_session.h"
#include "console.h"
#include "fit.h"
#include "json_values.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How the lights' range goes with their number. */
typedef enum series { HELD, SHRINKING, SERIES_COUNT } series;
static const struct {
    const char *name, *meaning;
} series_rows[SERIES_COUNT] = {
    [HELD] = {"held", "the same range for any number of lights: tiles list more and more"},
    [SHRINKING] = {"shrinking", "a range at which tiles list as many of any number of lights"},
};

/* Sizes one after another: they share the G-buffer, which takes longest to make. With one number of
 * lights per tile alone, pairs would be a multiple of pixels, and their prices not told apart. */
static const struct {
    const char *size, *lights, *per_tile; /* NULL: the series with the range held */
} points[] = {
    {"640x360", "64", NULL},      {"640x360", "1024", NULL},    {"640x360", "16384", NULL},
    {"640x360", "64", "27"},      {"640x360", "1024", "81"},    {"640x360", "16384", "27"},
    {"1280x720", "64", NULL},     {"1280x720", "4096", NULL},   {"1280x720", "256", "9"},
    {"1280x720", "4096", "27"},   {"1920x1080", "64", NULL},    {"1920x1080", "256", NULL},
    {"1920x1080", "1024", NULL},  {"1920x1080", "4096", NULL},  {"1920x1080", "16384", NULL},
    {"1920x1080", "65536", NULL}, {"1920x1080", "64", "27"},    {"1920x1080", "256", "27"},
    {"1920x1080", "1024", "27"},  {"1920x1080", "1024", "3"},   {"1920x1080", "1024", "9"},
    {"1920x1080", "1024", "81"},  {"1920x1080", "4096", "27"},  {"1920x1080", "16384", "27"},
    {"1920x1080", "65536", "27"}, {"3840x2160", "1024", NULL},  {"3840x2160", "16384", NULL},
    {"3840x2160", "1024", "9"},   {"3840x2160", "16384", "27"}, {"7680x4320", "64", NULL},
    {"7680x4320", "4096", NULL},  {"7680x4320", "65536", NULL}, {"7680x4320", "64", "9"},
    {"7680x4320", "4096", "3"},   {"7680x4320", "65536", "27"},
};
enum { POINT_COUNT = sizeof points / sizeof points[0] };

/* At this point of the held series tiles list as many as in the shrinking one. */
static const char held_size[] = "1920x1080", held_lights[] = "16384";

static const size_t growth_samples = 5;
static const double growth_seconds = 3.0;

/* What is wanted; the printed verdict says whether it was reached. */
static const double most_residual = 0.15, most_price_change = 0.20;

typedef struct growth {
    size_t counts[SERIES_COUNT];
    tl_bench_record records[SERIES_COUNT][POINT_COUNT]; /* the first [counts[series]] */
    tl_growth_point points[SERIES_COUNT][POINT_COUNT];  /* the same */
    tl_growth_fit fits[SERIES_COUNT];
    char held_range[TL_BENCH_WORD_SIZE]; /* m */
} growth;

static tl_status make_case(const bench_session *s,
                           const char *size,
                           const char *lights,
                           const char *per_tile,
                           const char *range,
                           tl_bench_case *out,
                           tl_error *err)
{
    tl_bench_lists lists = s->options->lists;
    tl_bench_cases made = {0};
    lists.of[TL_AXIS_SIZE] = size;
    lists.of[TL_AXIS_LIGHTS] = lights;
    lists.of[TL_AXIS_PER_TILE] = per_tile;
    lists.of[TL_AXIS_RANGE] = range;
    const tl_status status = tl_bench_cases_add(&made, &lists, err);
    if (status == TL_OK)
        *out = made.cases[0];
    tl_bench_cases_clear(&made);
    return status;
}

static tl_status choose_range(bench_session *s, growth *g, tl_error *err)
{
    tl_status status = TL_OK;
    tl_bench_case one;
    console_stage("making the frame that the held range is from");
    TRY(make_case(s, held_size, held_lights, NULL, NULL, &one, err));
    TRY(bench_session_device(s, &one, err));
    TRY(tl_bench_frame_make(&s->frame, &one, err));
    snprintf(g->held_range, sizeof g->held_range, "%.6g",
             (double)s->frame.lights.lights[0].range);
done:
    return status;
}

static tl_growth_point point_of(const tl_bench_record *r)
{
    return (tl_growth_point){
        .amounts = {[TL_TERM_PIXELS] =
                        (double)r->of.scene_options.width * r->of.scene_options.height,
                    [TL_TERM_PAIRS] = (double)r->counts.pair_count,
                    [TL_TERM_LIGHTS] = (double)r->of.scene_options.light_count,
                    [TL_TERM_TILES] = (double)r->counts.tile_count},
        .ns = 1e6 * r->frame_ms.median};
}

static tl_status measure(bench_session *s, growth *g, tl_error *err)
{
    tl_sampling_rule rule = s->options->rule;
    tl_status status = TL_OK;
    rule.least_samples = s->options->samples_given ? rule.least_samples : growth_samples;
    rule.seconds = s->options->seconds_given ? rule.seconds : growth_seconds;
    for (int i = 0; i < POINT_COUNT; i++) {
        const series k = points[i].per_tile ? SHRINKING : HELD;
        tl_bench_record *record = &g->records[k][g->counts[k]];
        tl_bench_case one;
        char stage[160];
        snprintf(stage, sizeof stage, "point %d of %d: %s, %s lights, range %s", i + 1,
                 (int)POINT_COUNT, points[i].size, points[i].lights, series_rows[k].name);
        console_stage(stage);
        TRY(make_case(s, points[i].size, points[i].lights, points[i].per_tile,
                      k == HELD ? g->held_range : NULL, &one, err));
        TRY(tl_bench_measure(s->device, NULL, &one, &s->frame, &rule, record, err));
        g->points[k][g->counts[k]++] = point_of(record);
    }
    console_stage(NULL);
done:
    return status;
}

/* What memory is held against: the picture and the lists. */
static double output_and_lists(const tl_bench_record *r)
{
    return 12.0 * r->pitch * r->rows + 4.0 * (double)r->counts.list_length;
}

static void print_series(FILE *out, const growth *g, series k)
{
    const tl_growth_fit *fit = &g->fits[k];
    fprintf(out, "\nrange %s: %s\n", series_rows[k].name, series_rows[k].meaning);
    fprintf(out, "%10s %7s %9s %9s %10s %9s %9s %12s\n", "pixels", "lights", "per tile",
            "Mpair", "frame ms", "residual", "ns/pair", "memory MB");
    for (size_t i = 0; i < g->counts[k]; i++) {
        const tl_bench_record *r = &g->records[k][i];
        const tl_growth_point *p = &g->points[k][i];
        fprintf(out, "%10s %7s %9.2f %9.1f %10.2f %8.1f%% %9.3f %12.1f\n",
                r->of.words[TL_AXIS_SIZE], r->of.words[TL_AXIS_LIGHTS],
                (double)r->counts.list_length / r->counts.tile_count,
                1e-6 * (double)r->counts.pair_count, 1e-6 * p->ns,
                100.0 * tl_growth_residual(fit, p), tl_growth_pair_price(fit, p),
                1e-6 * (double)r->counts.device_bytes);
    }
    for (int term = 0; term < TL_TERM_COUNT; term++)
        fprintf(out, "%s%s %.4g ns", term ? ", " : "a frame costs, per each of ",
                tl_term_words[term], fit->prices[term]);
    fprintf(out, "\nworst residual %.1f %% (%s); a pair at %.0f to %.0f %% of its price (%s)\n",
            100.0 * fit->worst_residual,
            fit->worst_residual <= most_residual ? "within 15" : "above 15",
            100.0 * fit->least_pair_price, 100.0 * fit->most_pair_price,
            fit->least_pair_price >= 1.0 - most_price_change &&
                    fit->most_pair_price <= 1.0 + most_price_change
                ? "within 20"
                : "beyond 20");
}

static json_t *fit_json(const tl_growth_fit *fit)
{
    json_t *prices = json_object();
    for (int term = 0; term < TL_TERM_COUNT; term++)
        json_object_set_new(prices, tl_term_words[term], tl_json_number(fit->prices[term]));
    return json_pack("{so so s[oo]}", "prices_ns", prices, "worst_residual",
                     tl_json_number(fit->worst_residual), "pair_price_range",
                     tl_json_number(fit->least_pair_price),
                     tl_json_number(fit->most_pair_price));
}

static json_t *point_json(const growth *g, series k, size_t i)
{
    const tl_bench_record *r = &g->records[k][i];
    const tl_growth_point *p = &g->points[k][i];
    json_t *amounts = json_object();
    for (int term = 0; term < TL_TERM_COUNT; term++)
        json_object_set_new(amounts, tl_term_words[term], tl_json_number(p->amounts[term]));
    return json_pack("{so so so so so so so}", "amounts", amounts, "fitted_ms",
                     tl_json_number(1e-6 * tl_growth_fitted_ns(&g->fits[k], p)), "residual",
                     tl_json_number(tl_growth_residual(&g->fits[k], p)), "pair_price_ns",
                     tl_json_number(tl_growth_pair_price(&g->fits[k], p)), "device_bytes",
                     json_integer((json_int_t)r->counts.device_bytes), "output_and_list_bytes",
                     tl_json_number(output_and_lists(r)), "record", tl_bench_json_record(r));
}

static tl_status write_json(const bench_session *s, const growth *g, tl_error *err)
{
    if (!s->options->json)
        return TL_OK;
    json_t *report = tl_bench_json_begin(&s->machine), *growth_object = json_object();
    for (int k = 0; k < SERIES_COUNT; k++) {
        json_t *array = json_array();
        for (size_t i = 0; i < g->counts[k]; i++)
            json_array_append_new(array, point_json(g, (series)k, i));
        json_object_set_new(growth_object, series_rows[k].name,
                            json_pack("{ss so so}", "meaning", series_rows[k].meaning, "fit",
                                      fit_json(&g->fits[k]), "points", array));
    }
    json_object_set_new(growth_object, "held_range_m",
                        tl_json_number(strtod(g->held_range, NULL)));
    json_object_set_new(report, "growth", growth_object);
    return tl_json_write(s->options->json, report, err);
}

tl_status bench_run_growth(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    growth *g = calloc(1, sizeof *g);
    if (!g)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the points of growth"));
    TRY(choose_range(s, g, err));
    TRY(measure(s, g, err));
    for (int k = 0; k < SERIES_COUNT; k++) {
        g->fits[k] = tl_growth_fit_make(g->points[k], g->counts[k]);
        if (s->table)
            print_series(s->table, g, (series)k);
    }
    TRY(write_json(s, g, err));
done:
    free(g);
    return status;
}
