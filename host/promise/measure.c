#include "measure.h"

#include "codes.h"
#include "try.h"

/* Windows have this many times the pixels that a sample has: one window says less. */
static const double windows_share = 2.0;

enum { SEED = 1 };

tl_status tl_yardstick_make(const tl_goal *goal,
                            const tl_gbuffer *gbuffer,
                            const tl_light_set *lights,
                            const tl_image *guide,
                            tl_yardstick *out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    const tl_sample_options options = tl_sample_options_default();
    tl_yardstick made = {.side = tl_samples_side(gbuffer->samples)};
    TRY(tl_sample_draw(gbuffer, lights, guide, &options, &made.sample, err));
    if (goal->kind == TL_GOAL_FLIP)
        TRY(tl_windows_draw(gbuffer, lights,
                            windows_share * options.pairs / made.sample->pixel_cost, SEED,
                            &made.windows, err));
    *out = made;
    made = (tl_yardstick){0};
done:
    tl_yardstick_clear(&made);
    return status;
}

void tl_yardstick_clear(tl_yardstick *of)
{
    tl_sample_destroy(of->sample);
    tl_windows_destroy(of->windows);
    *of = (tl_yardstick){0};
}

uint64_t tl_yardstick_pixels(const tl_yardstick *of)
{
    uint64_t count = of->windows ? 0 : of->sample->count;
    for (uint32_t i = 0; of->windows && i < of->windows->count; i++) {
        const tl_image *reference = of->windows->of[i].reference;
        count += (uint64_t)reference->width * reference->height * of->side * of->side;
    }
    return count;
}

tl_status tl_measure(const tl_goal *goal,
                     const tl_yardstick *by,
                     const tl_image *image,
                     double doubt,
                     tl_estimate *out,
                     tl_error *err)
{
    tl_status status = TL_OK;
    tl_deviation deviation;
    if (goal->kind == TL_GOAL_FLIP)
        return tl_windows_flip(by->windows, goal, image, doubt, out, err);
    TRY(tl_deviation_find(by->sample, image, &deviation, err));
    if (goal->kind == TL_GOAL_CODES)
        TRY(tl_codes_off(goal, by->sample, &deviation, image, by->side, out, err));
    else
        *out = tl_deviation_rms(by->sample, &deviation, doubt);
done:
    return status;
}
