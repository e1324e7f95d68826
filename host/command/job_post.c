#include "job_post.h"

#include "console.h"
#include "tilelight/post.h"
#include "try.h"

static void report(job *j, const tl_post_counts *counts)
{
    json_t *stages = json_array();
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        if (counts->stages >> i & 1u)
            json_array_append_new(stages, json_string(tl_post_stage_rows[i].word));
    job_report(j, "post",
               json_pack("{so sI}", "stages", stages, "mended_pixels",
                         (json_int_t)counts->mended_count));
}

tl_status job_post(job *j,
                   const post_choice *choice,
                   const tl_lighting_options *lighting,
                   tl_device *device,
                   tl_error *err)
{
    tl_post_options options = choice->options;
    tl_post_counts counts;
    tl_post *post = NULL;
    tl_status status = TL_OK;
    options.mend = lighting->kernel.text != NULL;
    TRY(tl_post_create(device, lighting, &options, &post, err));
    TRY(tl_post_run(post, j->gbuffer, &j->image, &j->timings, &console_notices, &counts, err));
    report(j, &counts);
done:
    tl_post_destroy(post);
    return status;
}
