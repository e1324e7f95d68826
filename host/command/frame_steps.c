#include "frame_steps.h"

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
done:
    return status;
}

tl_status frame_light(
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
