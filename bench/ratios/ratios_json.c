#include "bench_json.h"
#include "json_values.h"
#include "ratios.h"

#include <string.h>

static json_t *stages_json(const tl_ratio *r)
{
    json_t *object = json_object();
    for (int i = 0; i < r->stage_count; i++)
        json_object_set_new(object, r->stage_names[i], tl_bench_json_summary(&r->stage_ms[i]));
    return object;
}

static double ns_per_pair(const tl_ratio *r, uint64_t pair_count)
{
    return 1e6 * r->theirs_ms.median / (double)pair_count;
}

/* The ratio's own summary first, then what it came from. */
static json_t *ratio_json(const tl_ratio *r, uint64_t pair_count)
{
    json_t *object = r->ratio.count > 0 ? tl_bench_json_summary(&r->ratio)
                                        : json_pack("{sn sn si ss}", "median", "interval",
                                                    "samples", 0, "refusal", r->refusal);
    json_t *more = json_pack(
        "{ss ss ss so so so so so so so sb}", "method", r->baseline->name, "meaning",
        r->baseline->meaning, "source", r->baseline->source, "ours_ms",
        tl_bench_json_summary(&r->ours_ms), "theirs_ms", tl_bench_json_summary(&r->theirs_ms),
        "theirs_stages_ms", stages_json(r), "theirs_created_in_ms",
        tl_json_number(r->create_ms), "ns_per_pair", tl_json_number(ns_per_pair(r, pair_count)),
        "rms_difference", tl_json_number(r->rms_difference), "max_difference",
        tl_json_number(r->max_difference), "same_picture", tl_ratio_is_of_same_picture(r));
    if (!object || !more || json_object_update(object, more) != 0) {
        json_decref(object);
        object = NULL;
    }
    json_decref(more);
    return object;
}

json_t *tl_ratios_json(const tl_ratio *ratios, size_t count, uint64_t pair_count)
{
    json_t *object = json_object();
    const tl_ratio *multipass = tl_ratio_multipass(ratios, count);
    for (size_t i = 0; i < count; i++) {
        const char *name = ratios[i].baseline->name;
        json_object_set_new(object, name, ratio_json(&ratios[i], pair_count));
        if (strcmp(name, "hand_relaxed") == 0)
            json_object_set_new(object, "hand_relaxed_ns_per_pair",
                                tl_json_number(ns_per_pair(&ratios[i], pair_count)));
    }
    if (multipass)
        json_object_set_new(object, "multipass", ratio_json(multipass, pair_count));
    return object;
}
