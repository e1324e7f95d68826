#include "job_post.h"

#include "console.h"
#include "tilelight/post.h"
#include "try.h"

#include <math.h>
#include <stdio.h>

/* In radiance. Where the exposure is automatic, it is that of the picture before anything is done to it. */
static float exposed_threshold(const job *j,
                               const tl_bloom_options *bloom,
                               const picture_options *pictures)
{
    if (!(bloom->strength > 0.0f))
        return bloom->threshold;
    const float exposure =
        pictures->automatic ? tl_image_auto_exposure(j->image) : pictures->exposure;
    return fminf(bloom->threshold * exp2f(-exposure), TL_MOST_BLOOM_THRESHOLD);
}

static void tell(const post_choice *choice,
                 const tl_post_options *options,
                 const tl_post_counts *counts)
{
    if (counts->stages >> TL_POST_BLOOM & 1u && !counts->is_bright)
        tl_notice(&console_notices,
                  "--bloom is for nothing: no pixel has a radiance above %g, which is %g once "
                  "exposed and where "
                  "brightness begins; --bloom-threshold or --exposure moves that",
                  (double)(options->bloom.threshold * (1.0f - options->bloom.knee)),
                  (double)(choice->options.bloom.threshold * (1.0f - options->bloom.knee)));
}

static void report(job *j, const tl_post_counts *counts)
{
    json_t *stages = json_array();
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        if (counts->stages >> i & 1u)
            json_array_append_new(stages, json_string(tl_post_stage_rows[i].word));
    job_report(j, "post",
               json_pack("{so sI sb sI}", "stages", stages, "mended_pixels",
                         (json_int_t)counts->mended_count, "bloomed", counts->is_bright,
                         "bands", (json_int_t)counts->band_count));
}

/* A picture that is not of the size's shape is stretched, which is said. */
static void tell_stretched(const job *j, const picture_options *pictures)
{
    const tl_camera *camera = &j->gbuffer->camera;
    const double stretch =
        (double)pictures->width * camera->height / ((double)pictures->height * camera->width);
    const double pixel =
        1.0 / (pictures->width < pictures->height ? pictures->width : pictures->height);
    if (pictures->width > 0 && fabs(stretch - 1.0) > pixel)
        tl_notice(&console_notices,
                  "the picture is stretched: %u x %u is not of the shape of %u x %u",
                  pictures->width, pictures->height, camera->width, camera->height);
}

tl_status job_post(job *j,
                   const post_choice *choice,
                   const picture_options *pictures,
                   const tl_lighting_options *lighting,
                   lighter *with,
                   tl_error *err)
{
    tl_post_options options = choice->options;
    tl_post_counts counts;
    tl_status status = TL_OK;
    options.bloom.threshold = exposed_threshold(j, &choice->options.bloom, pictures);
    options.mend = lighting->kernel.text != NULL;
    options.width = pictures->width;
    options.height = pictures->height;
    options.filter = pictures->filter;
    TRY(lighter_post(with, lighting, &options, err));
    TRY(tl_post_run(with->post, j->gbuffer, &j->image, &j->timings, &console_notices, &counts,
                    err));
    tell(choice, &options, &counts);
    tell_stretched(j, pictures);
    report(j, &counts);
    j->post = counts;
done:
    return status;
}

static const char *of_edges(const tl_edge_options *edges)
{
    return edges->normals && edges->depth ? "--antialias, in normals and depth"
           : edges->normals               ? "--antialias, in normals"
           : edges->depth                 ? "--antialias, in depth"
                                          : "no --antialias";
}

static const char *of_bloom(const tl_bloom_options *bloom, const tl_post_counts *counts)
{
    return !(bloom->strength > 0.0f) ? "no --bloom"
           : counts->is_bright       ? "--bloom, and something is bright"
                                     : "--bloom, but nothing is bright: nothing was blurred";
}

void job_post_explain(const job *j,
                      const post_choice *choice,
                      const tl_lighting_options *lighting)
{
    const char *const why[TL_POST_STAGE_COUNT] = {
        [TL_POST_MEND] = lighting->kernel.text ? "a kernel of yours, which may give no numbers"
                                               : "tilelight's own kernels, which give numbers",
        [TL_POST_EDGES] = of_edges(&choice->options.edges),
        [TL_POST_RESOLVE] = j->gbuffer->samples > 1 ? "several samples a pixel" : "one sample",
        [TL_POST_BLOOM] = of_bloom(&choice->options.bloom, &j->post),
        [TL_POST_SCALE] = j->post.stages >> TL_POST_SCALE & 1u
                              ? "--output-size, which is not the size that is lit"
                              : "no --output-size, or the size that is lit",
    };
    fprintf(stderr, "after lighting\n");
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        fprintf(stderr, "  %-17s  %-3s  %s\n", tl_post_stage_rows[i].word,
                j->post.stages >> i & 1u ? "on" : "off", why[i] ? why[i] : "");
}
