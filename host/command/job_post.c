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

tl_status job_post(job *j, const lighting_choice *choice, tl_device *device, tl_error *err)
{
    const tl_post_options options = {.mend = choice->options.kernel.text != NULL};
    tl_post_counts counts;
    tl_post *post = NULL;
    tl_status status = TL_OK;
    TRY(tl_post_create(device, &choice->options, &options, &post, err));
    TRY(tl_post_run(post, j->gbuffer, &j->image, &j->timings, &console_notices, &counts, err));
    report(j, &counts);
done:
    tl_post_destroy(post);
    return status;
}
