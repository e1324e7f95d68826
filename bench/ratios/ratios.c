#include "ratios.h"

#include "tilelight/compare.h"
#include "try.h"

#include <stdio.h>
#include <string.h>

typedef struct pairing {
    const tl_baseline *baseline;
    void *state; /* of the baseline */
    tl_lighting *lighting;
    tl_bench_frame *frame;
    tl_image *image; /* theirs */
    tl_samples ratio, ours, theirs, stages[TL_MAX_STAGES];
} pairing;

static tl_status run_ours(const pairing *p, double *ms, tl_error *err)
{
    const double start = tl_seconds();
    const tl_status status = tl_lighting_run(p->lighting, p->frame->ours, &p->frame->lights,
                                             p->frame->image, NULL, NULL, NULL, err);
    *ms = 1e3 * (tl_seconds() - start);
    return status;
}

static tl_status run_theirs(const pairing *p, tl_timings *timings, double *ms, tl_error *err)
{
    *timings = (tl_timings){0};
    const tl_status status = p->baseline->run(p->state, p->image, timings, err);
    *ms = 0.0;
    for (int i = 0; i < timings->count; i++)
        *ms += timings->stages[i].ms;
    return status;
}

static tl_status sample(pairing *p, tl_ratio *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_timings timings;
    double ours = 0.0, theirs = 0.0;
    TRY(run_ours(p, &ours, err));
    TRY(run_theirs(p, &timings, &theirs, err));
    TRY(tl_samples_add(&p->ours, ours, err));
    TRY(tl_samples_add(&p->theirs, theirs, err));
    TRY(tl_samples_add(&p->ratio, ours / theirs, err));
    out->stage_count = timings.count;
    for (int i = 0; i < timings.count; i++) {
        out->stage_names[i] = timings.stages[i].name;
        TRY(tl_samples_add(&p->stages[i], timings.stages[i].ms, err));
    }
done:
    return status;
}

/* Once each; *slow where theirs took longer than the rule samples more than once. */
static tl_status warm_up(
    const pairing *p, const tl_ratio_rule *rule, int *slow, tl_ratio *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_timings timings;
    tl_difference difference;
    double ours = 0.0, theirs = 0.0;
    TRY(run_ours(p, &ours, err));
    TRY(run_theirs(p, &timings, &theirs, err));
    TRY(tl_compare(p->image, p->frame->image, &difference, err));
    out->rms_difference = difference.relative_rms;
    out->max_difference = difference.relative_max;
    *slow = 1e-3 * theirs > rule->once_above;
done:
    return status;
}

static void summarize(const pairing *p, tl_ratio *out)
{
    out->ratio = tl_samples_summarize(&p->ratio);
    out->ours_ms = tl_samples_summarize(&p->ours);
    out->theirs_ms = tl_samples_summarize(&p->theirs);
    for (int i = 0; i < out->stage_count; i++)
        out->stage_ms[i] = tl_samples_summarize(&p->stages[i]);
}

static tl_status take_pairs(pairing *p, const tl_ratio_rule *rule, tl_ratio *out, tl_error *err)
{
    tl_status status = TL_OK;
    int slow = 0;
    TRY(warm_up(p, rule, &slow, out, err));
    const double start = tl_seconds();
    do {
        TRY(sample(p, out, err));
    } while (!slow && !tl_sampling_done(&rule->sampling, &p->ratio, start));
    summarize(p, out);
done:
    return status;
}

static void release(pairing *p)
{
    p->baseline->destroy(p->state);
    tl_image_destroy(p->image);
    tl_samples_clear(&p->ratio);
    tl_samples_clear(&p->ours);
    tl_samples_clear(&p->theirs);
    for (int i = 0; i < TL_MAX_STAGES; i++)
        tl_samples_clear(&p->stages[i]);
}

tl_status tl_ratio_measure(const tl_baseline *baseline,
                           tl_device *device,
                           tl_lighting *lighting,
                           tl_bench_frame *frame,
                           const tl_ratio_rule *rule,
                           tl_ratio *out,
                           tl_error *err)
{
    const tl_baseline_input input = {
        .device = device, .gbuffer = frame->gbuffer, .lights = &frame->lights};
    pairing p = {.baseline = baseline, .lighting = lighting, .frame = frame};
    tl_ratio made = {.baseline = baseline};
    tl_status status = TL_OK;
    tl_error refusal;

    TRY(tl_image_create(frame->image->width, frame->image->height, &p.image, err));
    const double start = tl_seconds();
    if (baseline->create(&input, &p.state, &refusal) != TL_OK) {
        snprintf(made.refusal, sizeof made.refusal, "%.*s", (int)sizeof made.refusal - 1,
                 refusal.message);
    } else {
        made.create_ms = 1e3 * (tl_seconds() - start);
        TRY(take_pairs(&p, rule, &made, err));
    }
    *out = made;
done:
    release(&p);
    return status;
}

int tl_ratio_is_of_same_picture(const tl_ratio *ratio)
{
    return ratio->rms_difference <= ratio->baseline->rms_tolerance &&
           ratio->max_difference <= ratio->baseline->max_tolerance;
}

const tl_ratio *tl_ratio_multipass(const tl_ratio *ratios, size_t count)
{
    const tl_ratio *best = NULL;
    for (size_t i = 0; i < count; i++) {
        const char *name = ratios[i].baseline->name;
        if ((strcmp(name, "quads") == 0 || strcmp(name, "volumes") == 0) &&
            ratios[i].ratio.count > 0 &&
            (!best || ratios[i].theirs_ms.median < best->theirs_ms.median))
            best = &ratios[i];
    }
    return best;
}
