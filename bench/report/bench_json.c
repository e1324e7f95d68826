#include "bench_json.h"

#include "json_values.h"
#include "pair_flops.h"
#include "tilelight/layouts.h"

json_t *tl_bench_json_begin(const tl_machine *machine)
{
    return json_pack("{si s{ss si so}}", "tilelight_bench", TL_BENCH_JSON_VERSION, "machine",
                     "processor", machine->processor, "threads", (int)machine->threads,
                     "load_before", tl_json_number(machine->load));
}

json_t *tl_bench_json_summary(const tl_summary *s)
{
    json_t *interval = s->count < 2 ? json_null()
                                    : json_pack("[oo]", tl_json_number(s->interval.low),
                                                tl_json_number(s->interval.high));
    return json_pack("{so so so so sf si}", "median", tl_json_number(s->median), "interval",
                     interval, "least", tl_json_number(s->least), "p90", tl_json_number(s->p90),
                     "coverage", s->interval.coverage, "samples", (int)s->count);
}

json_t *tl_bench_json_device(const tl_device_info *d)
{
    if (d->name[0] == '\0')
        return json_null();
    return json_pack("{ss ss ss ss si si}", "name", d->name, "platform", d->platform, "driver",
                     d->driver, "kind", d->kind, "units", (int)d->compute_units, "lanes",
                     (int)d->vector_width);
}

json_t *tl_bench_json_peaks(const tl_peaks *p)
{
    if (p->flops <= 0.0)
        return json_null();
    return json_pack("{so so so si si}", "gflop_per_s", tl_json_number(1e-9 * p->flops),
                     "read_gbyte_per_s", tl_json_number(1e-9 * p->read_bytes),
                     "copy_gbyte_per_s", tl_json_number(1e-9 * p->copy_bytes), "flops_of_test",
                     (int)TL_FLOPS_OF_TEST, "flops_of_pair", (int)TL_FLOPS_OF_PAIR);
}

json_t *tl_bench_json_case(const tl_bench_case *of)
{
    json_t *object = json_object();
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++)
        json_object_set_new(object, tl_bench_axes[axis].name, json_string(of->words[axis]));
    return object;
}

static json_t *times_json(const tl_bench_record *r)
{
    json_t *object = json_object(), *stages = json_object();
    for (int i = 0; i < tl_bench_time_count; i++)
        json_object_set_new(object, tl_bench_times[i].name,
                            tl_bench_json_summary(tl_bench_time_of(&tl_bench_times[i], r)));
    for (int i = 0; i < r->stage_count; i++)
        json_object_set_new(stages, r->stage_names[i], tl_bench_json_summary(&r->stage_ms[i]));
    json_object_set_new(object, "stages", stages);
    return object;
}

static json_t *figures_json(const tl_bench_record *r)
{
    json_t *object = json_object(), *impossible = json_array();
    for (int i = 0; i < tl_figure_count; i++) {
        const double value = tl_figures[i].of(r);
        json_object_set_new(object, tl_figures[i].name, tl_json_number(value));
        if (!tl_figure_is_possible(&tl_figures[i], value))
            json_array_append_new(impossible, json_string(tl_figures[i].name));
    }
    json_object_set_new(object, "above_the_roof", impossible);
    return object;
}

/* null where the case was lit alone. */
static json_t *turns_json(const tl_bench_record *r)
{
    json_t *object;
    if (r->turns.frame.count == 0)
        return json_null();
    object = json_pack("{ss si so}", "layout", tl_layout_word(r->of.against), "pixel_bytes",
                       (int)r->turns.pixel_bytes, "frame_ms",
                       tl_bench_json_summary(&r->turns.frame_ms));
    for (int i = 0; object && i < tl_bench_ratio_count; i++)
        json_object_set_new(object, tl_bench_ratios[i].name,
                            tl_bench_json_summary(tl_bench_time_of(&tl_bench_ratios[i], r)));
    return object;
}

/* null where it is not known; numbers are relative to the picture's mean. */
static json_t *error_json(const tl_storage_error *e)
{
    static const char *const names[TL_PLANE_COUNT] = {
#define CHANNEL_NAME(name, channel, empty, meaning) [name] = channel,
        TL_PLANES(CHANNEL_NAME)
#undef CHANNEL_NAME
    };
    json_t *lost = json_array();
    if (!e->is_known) {
        json_decref(lost);
        return json_null();
    }
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (e->lost & TL_HAS(p))
            json_array_append_new(lost, json_string(names[p]));
    return json_pack("{so so so so so}", "max", tl_json_number(e->of.relative_max), "p999",
                     tl_json_number(e->of.relative_p999), "rms",
                     tl_json_number(e->of.relative_rms), "mean",
                     tl_json_number(e->of.relative_mean), "lost", lost);
}

json_t *tl_bench_json_record(const tl_bench_record *r)
{
    const tl_lighting_counts *c = &r->counts;
    json_t *object =
        json_pack("{so so so so so}", "case", tl_bench_json_case(&r->of), "device",
                  tl_bench_json_device(&r->device), "peaks", tl_bench_json_peaks(&r->peaks),
                  "times_ms", times_json(r), "figures", figures_json(r));
    json_t *frame =
        json_pack("{so si si sI sI si sI}", "range_m", tl_json_number(r->range), "planes",
                  (int)r->plane_count, "pixel_bytes", (int)r->pixel_bytes, "tiles",
                  (json_int_t)c->tile_count, "list_entries", (json_int_t)c->list_length,
                  "bands", (int)c->band_count, "device_bytes", (json_int_t)c->device_bytes);
    json_t *pairs = json_pack("{sI sI sI}", "culled", (json_int_t)c->pair_count, "in_range",
                              (json_int_t)r->pairs.in_range, "lit", (json_int_t)r->pairs.lit);
    if (!object || json_object_set_new(object, "frame", frame) != 0 ||
        json_object_set_new(object, "build_options", json_string(r->build_options)) != 0 ||
        json_object_set_new(object, "shade_processors",
                            tl_bench_json_summary(&r->shade_processors)) != 0 ||
        json_object_set_new(object, "pairs", pairs) != 0 ||
        json_object_set_new(object, "against", turns_json(r)) != 0 ||
        json_object_set_new(object, "error", error_json(&r->error)) != 0 ||
        json_object_set_new(object, "first_frame_ms", tl_json_number(r->first_ms)) != 0 ||
        json_object_set_new(object, "build_ms", tl_json_number(r->build_ms)) != 0) {
        json_decref(object);
        return NULL;
    }
    return object;
}
