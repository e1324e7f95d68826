#include "turns.h"

#include "frame_ratio.h"
#include "pass_bytes.h"
#include "tilelight/report.h"
#include "try.h"

#include <assert.h>

static tl_status run(const tl_turn *turn, double *ms, tl_error *err)
{
    const double start = tl_seconds();
    const tl_status status = turn->run(turn->context, err);
    *ms = 1e3 * (tl_seconds() - start);
    return status;
}

/* What the blocks say of one thing. */
typedef struct blocks {
    double medians[TL_STUDY_BLOCK_COUNT];
    size_t samples;
} blocks;

static tl_study_time time_of(const blocks *all)
{
    return tl_study_time_of(all->medians, TL_STUDY_BLOCK_COUNT, all->samples);
}

static void note(blocks *all, int block, tl_samples *samples)
{
    const tl_summary summary = tl_samples_summarize(samples);
    all->medians[block] = summary.median;
    all->samples += summary.count;
    tl_samples_clear(samples);
}

/* Of what the two took, and of the ratio. */
typedef struct pairs {
    tl_samples usual, other, ratio;
} pairs;

static tl_status take_pairs(const tl_turn *usual,
                            const tl_turn *other,
                            const tl_sampling_rule *rule,
                            pairs *p,
                            tl_error *err)
{
    const tl_turn *const turns[2] = {usual, other};
    const double start = tl_seconds();
    double ms[2];
    int first = 0;
    tl_status status = TL_OK;
    do {
        TRY(run(turns[first], &ms[first], err));
        TRY(run(turns[1 - first], &ms[1 - first], err));
        TRY(tl_samples_add(&p->usual, ms[0], err));
        TRY(tl_samples_add(&p->other, ms[1], err));
        TRY(tl_samples_add(&p->ratio, ms[1] / ms[0], err));
        first = 1 - first;
    } while (!tl_sampling_done(rule, &p->ratio, start));
done:
    return status;
}

tl_status tl_study_turns_take(const tl_turn *usual,
                              const tl_turn *other,
                              const tl_sampling_rule *rule,
                              tl_study_time *usual_ms,
                              tl_study_time *other_ms,
                              tl_study_time *ratio,
                              tl_error *err)
{
    blocks usuals = {0}, others = {0}, ratios = {0};
    pairs p = {0};
    double ms;
    tl_status status = TL_OK;
    TRY(run(usual, &ms, err));
    TRY(run(other, &ms, err));
    for (int i = 0; i < TL_STUDY_BLOCK_COUNT; i++) {
        TRY(take_pairs(usual, other, rule, &p, err));
        note(&usuals, i, &p.usual);
        note(&others, i, &p.other);
        note(&ratios, i, &p.ratio);
    }
    *usual_ms = time_of(&usuals);
    *other_ms = time_of(&others);
    *ratio = time_of(&ratios);
done:
    tl_samples_clear(&p.usual);
    tl_samples_clear(&p.other);
    tl_samples_clear(&p.ratio);
    return status;
}

static tl_status side_of(tl_study_pictures *p,
                         const tl_study_config *config,
                         tl_frame_side *out,
                         tl_error *err)
{
    tl_frame_side side = {.lights = &p->frame->lights, .options = tl_study_lighting(p, config)};
    const tl_status status = tl_study_gbuffer(p, config, &side.gbuffer, err);
    if (status == TL_OK)
        *out = side;
    return status;
}

static bool has_highlights(const tl_gbuffer *gbuffer, const tl_light_set *lights)
{
    bool any = false;
    for (size_t i = 0; i < lights->count; i++)
        any = any || lights->lights[i].specular > 0.0f;
    return any && (gbuffer->present & (TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH));
}

/* Per pixel of the picture. */
static double moved_bytes(const tl_frame_side *side, const tl_lighting_counts *counts)
{
    const tl_camera *camera = &side->gbuffer->camera;
    const double side_of_tile = side->options.tile_size;
    const tl_frame_extent extent = {
        .layout = side->gbuffer->layout,
        .present = side->gbuffer->present,
        .specular = has_highlights(side->gbuffer, side->lights),
        .pixels = counts->tile_count * side_of_tile * side_of_tile,
        .tiles = counts->tile_count,
        .lights = (double)side->lights->count,
        .list_entries = (double)counts->list_length,
    };
    const tl_pass_bytes culling = tl_culling_bytes(&extent),
                        shading = tl_shading_bytes(&extent);
    return (tl_pass_bytes_sum(&culling) + tl_pass_bytes_sum(&shading)) /
           ((double)camera->width * camera->height);
}

tl_status tl_study_block_take(tl_study_pictures *p,
                              const tl_sampling_rule *rule,
                              tl_study_record *record,
                              tl_error *err)
{
    const tl_study_config usual = tl_study_config_default();
    tl_study_blocks *lit = &record->lit;
    tl_frame_side sides[2];
    tl_frame_ratio took;
    tl_status status = TL_OK;
    assert(lit->count < TL_STUDY_BLOCK_COUNT);
    TRY(side_of(p, &usual, &sides[0], err));
    TRY(side_of(p, &record->config, &sides[1], err));
    TRY(tl_frame_ratio_measure(p->device, sides, rule, &took, err));
    /* By tl_study_lit_times. */
    const double medians[TL_STUDY_LIT_COUNT] = {took.cull_ms[1].median, took.shade_ms[1].median,
                                                took.frame_ms[1].median, took.ratio.median};
    for (int i = 0; i < TL_STUDY_LIT_COUNT; i++)
        lit->medians[i][lit->count] = medians[i];
    lit->count++;
    lit->samples += took.ratio.count;
    tl_study_note_blocks(record);
    record->values[TL_VALUE_MOVED] = moved_bytes(&sides[1], &took.counts[1]);
done:
    return status;
}
