#include "bench_record.h"

#include "try.h"

#include <string.h>

/* What every sample adds to. */
typedef struct measuring {
    tl_samples frame, cull, shade, post, processors, stages[TL_MAX_STAGES];
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

static tl_status sample(tl_lighting *lighting,
                        tl_bench_frame *frame,
                        measuring *m,
                        tl_lighting_counts *counts,
                        tl_error *err)
{
    tl_status status = TL_OK;
    tl_timings timings = {0};
    double start = tl_seconds();
    TRY(tl_lighting_run(lighting, frame->gbuffer, &frame->lights, frame->image, &timings, NULL,
                        counts, err));
    TRY(tl_samples_add(&m->frame, milliseconds_since(start), err));
    start = tl_seconds();
    tl_image_to_srgb8(frame->image, 0.0f, TL_TONE_ACES, frame->rgb);
    TRY(tl_samples_add(&m->post, milliseconds_since(start), err));
    TRY(tl_samples_add(&m->cull, counts->device_cull_ms, err));
    TRY(tl_samples_add(&m->shade, counts->device_shade_ms, err));
    if (counts->shade_wall_ms > 0.0)
        TRY(tl_samples_add(&m->processors, counts->shade_processor_ms / counts->shade_wall_ms,
                           err));
    for (int i = 0; i < timings.count; i++)
        TRY(tl_samples_add(stage_of(m, timings.stages[i].name), timings.stages[i].ms, err));
done:
    return status;
}

static void clear(measuring *m)
{
    tl_samples_clear(&m->frame);
    tl_samples_clear(&m->cull);
    tl_samples_clear(&m->shade);
    tl_samples_clear(&m->post);
    tl_samples_clear(&m->processors);
    for (int i = 0; i < TL_MAX_STAGES; i++)
        tl_samples_clear(&m->stages[i]);
}

/* The first frame is apart: it builds, and makes buffers. */
static tl_status warm_up(tl_lighting *lighting,
                         tl_bench_frame *frame,
                         tl_bench_record *out,
                         tl_error *err)
{
    tl_timings timings = {0};
    const double start = tl_seconds();
    const tl_status status = tl_lighting_run(lighting, frame->gbuffer, &frame->lights,
                                             frame->image, &timings, NULL, NULL, err);
    out->first_ms = milliseconds_since(start);
    for (int i = 0; i < timings.count; i++)
        if (strcmp(timings.stages[i].name, "compile") == 0)
            out->build_ms = timings.stages[i].ms;
    return status;
}

static void summarize(const measuring *m, tl_bench_record *out)
{
    out->frame_ms = tl_samples_summarize(&m->frame);
    out->kernel_cull_ms = tl_samples_summarize(&m->cull);
    out->kernel_shade_ms = tl_samples_summarize(&m->shade);
    out->post_ms = tl_samples_summarize(&m->post);
    out->shade_processors = tl_samples_summarize(&m->processors);
    out->stage_count = m->stage_count;
    for (int i = 0; i < m->stage_count; i++) {
        out->stage_names[i] = m->stage_names[i];
        out->stage_ms[i] = tl_samples_summarize(&m->stages[i]);
    }
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
    tl_lighting *lighting = NULL;
    measuring m = {0};
    tl_bench_record record = {.of = *of};

    TRY(tl_bench_frame_make(frame, of, err));
    record.pairs = frame->pairs;
    record.range = (double)frame->lights.lights[0].range;
    record.plane_count = (uint32_t)__builtin_popcount(frame->gbuffer->present);
    record.pitch = frame->gbuffer->pitch;
    record.rows = frame->gbuffer->rows;
    if (peaks)
        record.peaks = *peaks;
    if (device)
        record.device = tl_device_describe(device);
    TRY(tl_lighting_create(device, &of->lighting, &lighting, err));
    TRY(warm_up(lighting, frame, &record, err));
    const double start = tl_seconds();
    do {
        TRY(sample(lighting, frame, &m, &record.counts, err));
    } while (!tl_sampling_done(rule, &m.frame, start));
    summarize(&m, &record);
    tl_lighting_build_options(lighting, record.build_options, sizeof record.build_options);
    *out = record;
done:
    tl_lighting_destroy(lighting);
    clear(&m);
    return status;
}
