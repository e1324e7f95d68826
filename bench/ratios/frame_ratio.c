#include "frame_ratio.h"

#include "tilelight/report.h"
#include "try.h"

#include <string.h>

/* One of the two at work. */
typedef struct worker {
    const tl_frame_side *side;
    tl_lighting *lighting;
    tl_image *image;
    double frame_now, processor_now; /* ms, of the last frame */
    tl_lighting_counts counts;
    tl_samples frame_ms, processor_ms, cull_ms, shade_ms;
} worker;

static tl_status begin(worker *w, tl_device *device, const tl_frame_side *side, tl_error *err)
{
    const tl_camera *camera = &side->gbuffer->camera;
    tl_status status = TL_OK;
    w->side = side;
    TRY(tl_image_create(camera->width, camera->height, &w->image, err));
    TRY(tl_lighting_create(device, &side->options, &w->lighting, err));
done:
    return status;
}

static tl_status light(worker *w, tl_error *err)
{
    const double start = tl_seconds(), busy = tl_processor_seconds();
    const tl_status status = tl_lighting_run(w->lighting, w->side->gbuffer, w->side->lights,
                                             w->image, NULL, NULL, &w->counts, err);
    w->frame_now = 1e3 * (tl_seconds() - start);
    w->processor_now = 1e3 * (tl_processor_seconds() - busy);
    return status;
}

static tl_status sample(worker *w, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(light(w, err));
    TRY(tl_samples_add(&w->frame_ms, w->frame_now, err));
    TRY(tl_samples_add(&w->processor_ms, w->processor_now, err));
    TRY(tl_samples_add(&w->cull_ms, w->counts.device_cull_ms, err));
    TRY(tl_samples_add(&w->shade_ms, w->counts.device_shade_ms, err));
done:
    return status;
}

static int have_same_bits(const tl_image *a, const tl_image *b)
{
    for (unsigned c = 0; c < 3; c++)
        for (size_t row = 0; row < a->height; row++)
            if (memcmp(tl_image_plane(a, c) + row * a->pitch,
                       tl_image_plane(b, c) + row * b->pitch, a->width * sizeof(float)) != 0)
                return 0;
    return 1;
}

static tl_status take_pairs(worker workers[2],
                            const tl_sampling_rule *rule,
                            tl_samples *ratio,
                            tl_samples *processor,
                            tl_error *err)
{
    const double start = tl_seconds();
    tl_status status = TL_OK;
    int first = 0;
    do {
        TRY(sample(&workers[first], err));
        TRY(sample(&workers[1 - first], err));
        TRY(tl_samples_add(ratio, workers[1].frame_now / workers[0].frame_now, err));
        TRY(tl_samples_add(processor, workers[1].processor_now / workers[0].processor_now,
                           err));
        first = 1 - first;
    } while (!tl_sampling_done(rule, ratio, start));
done:
    return status;
}

static void end(worker *w)
{
    tl_lighting_destroy(w->lighting);
    tl_image_destroy(w->image);
    tl_samples_clear(&w->frame_ms);
    tl_samples_clear(&w->processor_ms);
    tl_samples_clear(&w->cull_ms);
    tl_samples_clear(&w->shade_ms);
}

tl_status tl_frame_ratio_measure(tl_device *device,
                                 const tl_frame_side sides[2],
                                 const tl_sampling_rule *rule,
                                 tl_frame_ratio *out,
                                 tl_error *err)
{
    worker workers[2] = {0};
    tl_samples ratio = {0}, processor = {0};
    tl_frame_ratio made = {0};
    tl_status status = TL_OK;
    for (int i = 0; i < 2; i++) {
        TRY(begin(&workers[i], device, &sides[i], err));
        TRY(light(&workers[i], err));
    }
    made.same_bits = have_same_bits(workers[0].image, workers[1].image);
    TRY(take_pairs(workers, rule, &ratio, &processor, err));
    made.ratio = tl_samples_summarize(&ratio);
    made.processor_ratio = tl_samples_summarize(&processor);
    for (int i = 0; i < 2; i++) {
        made.frame_ms[i] = tl_samples_summarize(&workers[i].frame_ms);
        made.processor_ms[i] = tl_samples_summarize(&workers[i].processor_ms);
        made.cull_ms[i] = tl_samples_summarize(&workers[i].cull_ms);
        made.shade_ms[i] = tl_samples_summarize(&workers[i].shade_ms);
        made.counts[i] = workers[i].counts;
    }
    *out = made;
done:
    for (int i = 0; i < 2; i++)
        end(&workers[i]);
    tl_samples_clear(&ratio);
    tl_samples_clear(&processor);
    return status;
}
