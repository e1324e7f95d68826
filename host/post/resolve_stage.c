/* The picture of samples becomes one of pixels (tl_image_resolve): the host's on every path, for it is a mean
 * in double. */
#include "stage.h"

#include "try.h"

static int is_on(const tl_post *post, const tl_gbuffer *gbuffer)
{
    (void)post;
    return tl_samples_side(gbuffer->samples) > 1;
}

static tl_status on_host(tl_post_work *work, int *wrote, tl_error *err)
{
    tl_image *pixels = NULL;
    tl_status status = TL_OK;
    TRY(tl_image_resolve(work->from, tl_samples_side(work->gbuffer->samples), &pixels, err));
    tl_image_destroy(work->to);
    work->to = pixels;
    *wrote = 1;
done:
    return status;
}

const tl_stage tl_stage_resolve = {
    .name = TL_POST_RESOLVE,
    .is_on = is_on,
    .on_host = on_host,
};
