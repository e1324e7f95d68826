/* Our frame's time over that of other ways to light the same frame. */
#ifndef TL_RATIOS_H
#define TL_RATIOS_H

#include "baselines.h"
#include "bench_frame.h"
#include "sampling.h"

#include <jansson.h>

typedef struct tl_ratio {
    const tl_baseline *baseline;
    char refusal
        [512]; /* why it could not light the frame; empty: it did, and what follows holds */
    double create_ms; /* what it does once, compiling for example */
    tl_summary ratio; /* ours over theirs, pair by pair: below 1 we are faster */
    tl_summary ours_ms, theirs_ms;
    int stage_count; /* of theirs */
    const char *stage_names[TL_MAX_STAGES];
    tl_summary stage_ms[TL_MAX_STAGES];
    double rms_difference, max_difference; /* of their picture to ours, over our mean */
} tl_ratio;

typedef struct tl_ratio_rule {
    tl_sampling_rule sampling; /* of the ratio */
    double once_above; /* s; a baseline that takes longer is sampled once; INFINITY: none */
} tl_ratio_rule;

/* Lights the frame by turns, ours, theirs, ours, theirs, after once each to warm up: what the
 * machine does meanwhile, it does to both. Ours is tl_lighting_run's wall time, theirs the sum of
 * its stages. A baseline that cannot light the frame is no failure: see `refusal`. Fails with
 * TL_ERR_MEMORY, or as tl_lighting_run does. */
tl_status tl_ratio_measure(const tl_baseline *baseline,
                           tl_device *device,
                           tl_lighting *lighting,
                           tl_bench_frame *frame,
                           const tl_ratio_rule *rule,
                           tl_ratio *out,
                           tl_error *err);

/* The faster of the GL ones, `quads` and `volumes`; NULL where neither ran. */
const tl_ratio *tl_ratio_multipass(const tl_ratio *ratios, size_t count);

/* Whether their picture is as near to ours as the baseline promises to be to the double reference,
 * ours being nearer to that by orders of magnitude. If not it is no baseline. */
int tl_ratio_is_of_same_picture(const tl_ratio *ratio);

/* An object with a key for each of [count], `multipass`, and hand_relaxed_ns_per_pair. pair_count:
 * what our culling listed. A new reference, NULL out of memory. */
json_t *tl_ratios_json(const tl_ratio *ratios, size_t count, uint64_t pair_count);

#endif
