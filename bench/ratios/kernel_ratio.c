#include "kernel_ratio.h"

#include "tilelight/compare.h"
#include "try.h"

#include <string.h>

/* One of the two, and its samples. */
typedef struct side {
    tl_lighting *lighting;
    tl_image *image;
    double kernel_now; /* ms, of the last frame */
    tl_samples kernel_ms, frame_ms;
} side;

static tl_status light_once(side *s,
                            const tl_bench_frame *frame,
                            tl_timings *timings,
                            tl_lighting_counts *counts,
                            tl_error *err)
{
    return tl_lighting_run(s->lighting, frame->gbuffer, &frame->lights, s->image, timings, NULL,
                           counts, err);
}

static tl_status sample(side *s, const tl_bench_frame *frame, tl_error *err)
{
    tl_lighting_counts counts;
    tl_status status = TL_OK;
    const double start = tl_seconds();
    TRY(light_once(s, frame, NULL, &counts, err));
    TRY(tl_samples_add(&s->frame_ms, 1e3 * (tl_seconds() - start), err));
    s->kernel_now = counts.device_shade_ms;
    TRY(tl_samples_add(&s->kernel_ms, s->kernel_now, err));
done:
    return status;
}

static double stage_ms(const tl_timings *timings, const char *name)
{
    for (int i = 0; i < timings->count; i++)
        if (strcmp(timings->stages[i].name, name) == 0)
            return timings->stages[i].ms;
    return 0.0;
}

/* Once each, and how far their pictures are apart. */
static tl_status warm_up(
    side *ours, side *theirs, const tl_bench_frame *frame, tl_kernel_ratio *out, tl_error *err)
{
    tl_timings timings = {0};
    tl_difference difference;
    tl_status status = TL_OK;
    TRY(light_once(ours, frame, NULL, &out->counts, err));
    TRY(light_once(theirs, frame, &timings, NULL, err));
    TRY(tl_compare(theirs->image, ours->image, &difference, err));
    out->build_ms = stage_ms(&timings, "compile");
    out->rms_difference = difference.relative_rms;
    out->max_difference = difference.relative_max;
done:
    return status;
}

static void release(side *s)
{
    tl_lighting_destroy(s->lighting);
    tl_samples_clear(&s->kernel_ms);
    tl_samples_clear(&s->frame_ms);
}

tl_status tl_kernel_ratio_measure(tl_device *device,
                                  const tl_bench_case *of,
                                  const tl_user_kernel *kernel,
                                  tl_bench_frame *frame,
                                  const tl_sampling_rule *rule,
                                  tl_kernel_ratio *out,
                                  tl_error *err)
{
    tl_lighting_options with_kernel = of->lighting;
    tl_image *image = NULL;
    tl_samples ratio = {0};
    side ours = {0}, theirs = {0};
    tl_kernel_ratio made = {0};
    tl_status status = TL_OK;

    if (of->lighting.precision != TL_PRECISION_FLOAT &&
        of->lighting.precision != TL_PRECISION_DOUBLE)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "--kernel runs on a device: with --precision float or double"));
    TRY(tl_bench_frame_make(frame, of, err));
    TRY(tl_image_create(frame->image->width, frame->image->height, &image, err));
    with_kernel.kernel = *kernel;
    ours.image = frame->image;
    theirs.image = image;
    TRY(tl_lighting_create(device, &of->lighting, &ours.lighting, err));
    TRY(tl_lighting_create(device, &with_kernel, &theirs.lighting, err));
    TRY(warm_up(&ours, &theirs, frame, &made, err));
    const double start = tl_seconds();
    do {
        TRY(sample(&ours, frame, err));
        TRY(sample(&theirs, frame, err));
        TRY(tl_samples_add(&ratio, theirs.kernel_now / ours.kernel_now, err));
    } while (!tl_sampling_done(rule, &ratio, start));
    made.ratio = tl_samples_summarize(&ratio);
    made.ours_ms = tl_samples_summarize(&ours.kernel_ms);
    made.theirs_ms = tl_samples_summarize(&theirs.kernel_ms);
    made.ours_frame_ms = tl_samples_summarize(&ours.frame_ms);
    made.theirs_frame_ms = tl_samples_summarize(&theirs.frame_ms);
    *out = made;
done:
    tl_samples_clear(&ratio);
    release(&theirs);
    release(&ours);
    tl_image_destroy(image);
    return status;
}
