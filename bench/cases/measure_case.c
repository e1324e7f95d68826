#include "bench_record.h"

#include "pass_bytes.h"
#include "try.h"

#include <string.h>

/* One G-buffer, lit again and again. */
typedef struct side {
    tl_lighting *lighting;
    const tl_gbuffer *gbuffer;
    tl_samples frame, cull, shade;
    double frame_now, cull_now, shade_now; /* ms, of the last frame */
} side;

/* What every sample adds to. */
typedef struct measuring {
    /* theirs: in the other layout, or without layers; no lighting where there is neither */
    side ours, theirs;
    tl_samples frame_ratio, cull_ratio, shade_ratio;
    tl_samples post, processors, stages[TL_MAX_STAGES];
    int stage_count;
    const char *stage_names[TL_MAX_STAGES];
} measuring;

static double milliseconds_since(double start)
{
    return 1e3 * (tl_seconds() - start);
}

static tl_samples *stage_of(measuring *m, const char *name)
{
    int i = 0;
    while (i < m->stage_count && strcmp(m->stage_names[i], name) != 0)
        i++;
    if (i == m->stage_count && i < TL_MAX_STAGES)
        m->stage_names[m->stage_count++] = name;
    return &m->stages[i];
}

static tl_status light(side *s,
                       tl_bench_frame *frame,
                       tl_timings *timings,
                       tl_lighting_counts *counts,
                       tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    TRY(tl_lighting_run(s->lighting, s->gbuffer, &frame->lights, frame->image, timings, NULL,
                        counts, err));
    s->frame_now = milliseconds_since(start);
    s->cull_now = counts->device_cull_ms;
    s->shade_now = counts->device_shade_ms;
    TRY(tl_samples_add(&s->frame, s->frame_now, err));
    TRY(tl_samples_add(&s->cull, s->cull_now, err));
    TRY(tl_samples_add(&s->shade, s->shade_now, err));
done:
    return status;
}

static tl_status sample_ours(measuring *m,
                             tl_bench_frame *frame,
                             tl_lighting_counts *counts,
                             tl_error *err)
{
    tl_status status = TL_OK;
    tl_timings timings = {0};
    TRY(light(&m->ours, frame, &timings, counts, err));
    const double start = tl_seconds();
    tl_image_to_rgb8(frame->image, 0.0f, (tl_look){0}, frame->rgb);
    TRY(tl_samples_add(&m->post, milliseconds_since(start), err));
    if (counts->shade_wall_ms > 0.0)
        TRY(tl_samples_add(&m->processors, counts->shade_processor_ms / counts->shade_wall_ms,
                           err));
    for (int i = 0; i < timings.count; i++)
        TRY(tl_samples_add(stage_of(m, timings.stages[i].name), timings.stages[i].ms, err));
done:
    return status;
}

static tl_status sample_theirs(measuring *m, tl_bench_frame *frame, tl_error *err)
{
    tl_status status = TL_OK;
    tl_lighting_counts counts;
    TRY(light(&m->theirs, frame, NULL, &counts, err));
    TRY(tl_samples_add(&m->frame_ratio, m->ours.frame_now / m->theirs.frame_now, err));
    if (counts.device_shade_ms > 0.0) {
        TRY(tl_samples_add(&m->cull_ratio, m->ours.cull_now / m->theirs.cull_now, err));
        TRY(tl_samples_add(&m->shade_ratio, m->ours.shade_now / m->theirs.shade_now, err));
    }
done:
    return status;
}

static void clear_side(side *s)
{
    tl_lighting_destroy(s->lighting);
    tl_samples_clear(&s->frame);
    tl_samples_clear(&s->cull);
    tl_samples_clear(&s->shade);
}

static void clear(measuring *m)
{
    clear_side(&m->ours);
    clear_side(&m->theirs);
    tl_samples_clear(&m->frame_ratio);
    tl_samples_clear(&m->cull_ratio);
    tl_samples_clear(&m->shade_ratio);
    tl_samples_clear(&m->post);
    tl_samples_clear(&m->processors);
    for (int i = 0; i < TL_MAX_STAGES; i++)
        tl_samples_clear(&m->stages[i]);
}

/* The first frame is apart: it builds, and makes buffers. */
static tl_status warm_up(measuring *m,
                         tl_bench_frame *frame,
                         tl_bench_record *out,
                         tl_error *err)
{
    tl_timings timings = {0};
    tl_status status = TL_OK;
    const double start = tl_seconds();
    TRY(tl_lighting_run(m->ours.lighting, m->ours.gbuffer, &frame->lights, frame->image,
                        &timings, NULL, NULL, err));
    out->first_ms = milliseconds_since(start);
    for (int i = 0; i < timings.count; i++)
        if (strcmp(timings.stages[i].name, "compile") == 0)
            out->build_ms = timings.stages[i].ms;
    if (m->theirs.lighting)
        TRY(tl_lighting_run(m->theirs.lighting, m->theirs.gbuffer, &frame->lights, frame->image,
                            NULL, NULL, NULL, err));
done:
    return status;
}

static void summarize(const measuring *m, tl_bench_record *out)
{
    out->frame_ms = tl_samples_summarize(&m->ours.frame);
    out->kernel_cull_ms = tl_samples_summarize(&m->ours.cull);
    out->kernel_shade_ms = tl_samples_summarize(&m->ours.shade);
    out->turns.frame_ms = tl_samples_summarize(&m->theirs.frame);
    out->turns.frame = tl_samples_summarize(&m->frame_ratio);
    out->turns.cull = tl_samples_summarize(&m->cull_ratio);
    out->turns.shade = tl_samples_summarize(&m->shade_ratio);
    out->post_ms = tl_samples_summarize(&m->post);
    out->shade_processors = tl_samples_summarize(&m->processors);
    out->stage_count = m->stage_count;
    for (int i = 0; i < m->stage_count; i++) {
        out->stage_names[i] = m->stage_names[i];
        out->stage_ms[i] = tl_samples_summarize(&m->stages[i]);
    }
}

static void describe(const tl_bench_frame *frame, const measuring *m, tl_bench_record *out)
{
    const tl_gbuffer *gbuffer = m->ours.gbuffer;
    out->pairs = frame->pairs;
    out->range = frame->lights.count ? (double)frame->lights.lights[0].range : 0.0;
    out->plane_count = (uint32_t)__builtin_popcount(frame->gbuffer->present);
    out->pixel_bytes = tl_gbuffer_pixel_size(gbuffer);
    out->depth_bytes = tl_words_size(
        gbuffer->layout, tl_pass_words_of(gbuffer->layout, gbuffer->present, true).positions);
    out->pitch = gbuffer->pitch;
    out->rows = gbuffer->rows;
    if (m->theirs.gbuffer)
        out->turns.pixel_bytes = tl_gbuffer_pixel_size(m->theirs.gbuffer);
}

static tl_status prepare(tl_device *device,
                         const tl_bench_case *of,
                         tl_bench_frame *frame,
                         measuring *m,
                         tl_error *err)
{
    tl_status status = TL_OK;
    tl_lighting_options others = of->lighting;
    TRY(tl_bench_frame_in(frame, of->layout, &m->ours.gbuffer, err));
    TRY(tl_lighting_create(device, &of->lighting, &m->ours.lighting, err));
    if (of->against == of->layout)
        others.layers = 0;
    if (of->against != of->layout || m->ours.gbuffer->layers.count > 0) {
        TRY(tl_bench_frame_in(frame, of->against, &m->theirs.gbuffer, err));
        TRY(tl_lighting_create(device, &others, &m->theirs.lighting, err));
    }
done:
    return status;
}

tl_status tl_bench_measure(tl_device *device,
                           const tl_peaks *peaks,
                           const tl_bench_case *of,
                           tl_bench_frame *frame,
                           const tl_sampling_rule *rule,
                           tl_bench_record *out,
                           tl_error *err)
{
    tl_status status = TL_OK;
    measuring m = {0};
    tl_bench_record record = {.of = *of};

    TRY(tl_bench_frame_make(frame, of, err));
    TRY(prepare(device, of, frame, &m, err));
    describe(frame, &m, &record);
    if (peaks)
        record.peaks = *peaks;
    if (device)
        record.device = tl_device_describe(device);
    TRY(tl_storage_error_find(device, of, frame, &record.error, err));
    TRY(warm_up(&m, frame, &record, err));
    const tl_samples *sampled = m.theirs.lighting ? &m.frame_ratio : &m.ours.frame;
    const double start = tl_seconds();
    do {
        TRY(sample_ours(&m, frame, &record.counts, err));
        if (m.theirs.lighting)
            TRY(sample_theirs(&m, frame, err));
    } while (!tl_sampling_done(rule, sampled, start));
    summarize(&m, &record);
    tl_lighting_build_options(m.ours.lighting, record.build_options,
                              sizeof record.build_options);
    *out = record;
done:
    clear(&m);
    return status;
}
