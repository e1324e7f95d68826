#include "frame_steps.h"

#include "console.h"
#include "job_light.h"
#include "job_pictures.h"
#include "job_post.h"
#include "job_region.h"
#include "try.h"

tl_status frame_read(
    job *j, const frame_options *options, const char *input, const lighter *with, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(job_read(j, input, &options->import, options->lighting.strict, err));
    TRY(job_cut_region(j, &options->region, &options->lighting, &options->post, with->device,
                       err));
    TRY(job_ready_lights(j, &options->lighting, err));
done:
    return status;
}

static tl_status light(
    job *j, const frame_options *options, lighter *with, explained *told, tl_error *err)
{
    const lighting_choice *lighting = &options->lighting;
    tl_status status = TL_OK;
    tl_goal goal;
    TRY(job_light(j, lighting,
                  promise_goal(&options->promise, &options->pictures,
                               j->has_look ? &j->look : NULL, &goal),
                  with, told, err));
    TRY(job_post(j, &options->post, &options->pictures, &lighting->options, with, err));
    TRY(job_crop_pictures(j, &options->region, err));
    TRY(job_show_pictures(j, &options->pictures, &lighting->options, with, err));
done:
    lighter_let_go(with);
    return status;
}

/* Bytes of the G-buffer's planes and the picture's: more than a device without them needs beside. */
static uint64_t frame_bytes(const tl_gbuffer *gbuffer)
{
    return ((uint64_t)tl_gbuffer_pixel_size(gbuffer) + 3 * sizeof(float)) * gbuffer->pitch *
           gbuffer->rows;
}

static void drop_pictures(job *j, explained *told)
{
    job_drop_pictures(j);
    if (!told)
        return;
    const explain_options *asked = told->asked;
    explained_clear(told);
    told->asked = asked;
}

tl_status frame_light(
    job *j, const frame_options *options, lighter *with, explained *told, tl_error *err)
{
    const tl_lighting_options *lighting = &options->lighting.options;
    tl_error smaller;
    tl_status status = light(j, options, with, told, err), tried = status;
    while (tried == TL_ERR_DEVICE_MEMORY &&
           lighter_shrink(with, lighting, frame_bytes(j->gbuffer))) {
        drop_pictures(j, told);
        tried = light(j, options, with, told, &smaller);
        if (tried == TL_OK)
            tl_notice(&console_notices,
                      "the device ran out of memory: the frame was lit in bands that take at "
                      "most %.3g MB of it; --memory says so beforehand",
                      1e-6 * (double)with->memory_limit);
    }
    return tried == TL_OK ? TL_OK : status;
}
