#include "frame_ratio.h"

#include "aovs.h"
#include "tilelight/report.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* One of the two at work. */
typedef struct worker {
    const tl_frame_side *side;
    tl_lighting *lighting;
    tl_image *image;
    tl_lighting *of_groups; /* and what they are lit into; NULL: there are none */
    tl_image *group;
    uint8_t *lit;                    /* [lights] */
    double frame_now, processor_now; /* ms, of the last frame */
    tl_lighting_counts counts;
    tl_samples frame_ms, processor_ms, cull_ms, shade_ms;
} worker;

static tl_status begin(worker *w, tl_device *device, const tl_frame_side *side, tl_error *err)
{
    const tl_camera *camera = &side->gbuffer->camera;
    tl_status status = TL_OK;
    w->side = side;
    TRY(tl_image_create_parts(camera->width, camera->height, TL_AOVS_IN(side->options.split),
                              &w->image, err));
    TRY(tl_lighting_create(device, &side->options, &w->lighting, err));
    if (side->group_count == 0)
        goto done;
    w->lit = malloc(side->lights->count + 1);
    if (!w->lit)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for groups of lights"));
    TRY(tl_image_create(camera->width, camera->height, &w->group, err));
    TRY(tl_lighting_create(device, &side->options, &w->of_groups, err));
done:
    return status;
}

static tl_status light_groups(worker *w, tl_error *err)
{
    const tl_frame_side *side = w->side;
    tl_status status = TL_OK;
    for (uint32_t k = 0; k < side->group_count && status == TL_OK; k++) {
        const tl_light_part part = {.lit = w->lit, .alone = k > 0};
        for (size_t i = 0; i < side->lights->count; i++)
            w->lit[i] = i % side->group_count == k;
        status = tl_lighting_run_part(w->of_groups, side->gbuffer, side->lights, &part,
                                      w->group, NULL, NULL, NULL, err);
    }
    return status;
}

static tl_status light(worker *w, tl_error *err)
{
    const double start = tl_seconds(), busy = tl_processor_seconds();
    tl_status status = TL_OK;
    TRY(tl_lighting_run(w->lighting, w->side->gbuffer, w->side->lights, w->image, NULL, NULL,
                        &w->counts, err));
    TRY(light_groups(w, err));
done:
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

/* part: from (x, y) of the whole on. */
static int has_bits_of(const tl_image *part, const tl_image *whole, uint32_t x, uint32_t y)
{
    for (unsigned c = 0; c < 3; c++)
        for (size_t row = 0; row < part->height; row++)
            if (memcmp(tl_image_plane(whole, c) + (y + row) * whole->pitch + x,
                       tl_image_plane(part, c) + row * part->pitch,
                       part->width * sizeof(float)) != 0)
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
    tl_lighting_destroy(w->of_groups);
    tl_image_destroy(w->group);
    free(w->lit);
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
    const tl_camera *second = &sides[1].gbuffer->camera;
    made.same_bits =
        has_bits_of(workers[1].image, workers[0].image, second->window_x, second->window_y);
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
