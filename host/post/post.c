#include "stage.h"

#include "lighting_state.h"
#include "try.h"

#include <inttypes.h>
#include <stdlib.h>

static const tl_stage *const stages[TL_POST_STAGE_COUNT] = {
    [TL_POST_MEND] = &tl_stage_mend,
    [TL_POST_EDGES] = &tl_stage_edges,
    [TL_POST_RESOLVE] = &tl_stage_resolve,
    [TL_POST_BLOOM] = &tl_stage_bloom,
    [TL_POST_SCALE] = &tl_stage_scale,
};

static tl_status check_edges(const tl_edge_options *edges, tl_error *err)
{
    if (!(edges->angle >= 0.0f && edges->angle <= TL_MOST_EDGE_ANGLE))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "edges from an angle of %g rad on: it must be above 0, and pi at most",
                       (double)edges->angle);
    if (!(edges->step >= 0.0f && edges->step <= 1.0f))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "edges from a step of %g of the depth on: it must be above 0, and 1 at "
                       "most",
                       (double)edges->step);
    return TL_OK;
}

static tl_status check_bloom(const tl_bloom_options *bloom, tl_error *err)
{
    const uint32_t side = bloom->side ? bloom->side : TL_DEFAULT_BLOOM_SIDE;
    const double width = (double)(bloom->width > 0.0f ? bloom->width : TL_DEFAULT_BLOOM_WIDTH);
    if (side != 2 && side != 4)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "bloom in a picture of 1/%u of the size: it must be 1/2 or 1/4", side);
    if (!(bloom->strength >= 0.0f && bloom->strength <= TL_MOST_BLOOM_STRENGTH))
        return tl_fail(err, TL_ERR_ARGUMENT, "a bloom of strength %g: it must be 0 to %g",
                       (double)bloom->strength, (double)TL_MOST_BLOOM_STRENGTH);
    if (!(bloom->threshold >= 0.0f && bloom->threshold <= TL_MOST_BLOOM_THRESHOLD))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "a bloom of what is above a radiance of %g: it must be 0 to %g",
                       (double)bloom->threshold, (double)TL_MOST_BLOOM_THRESHOLD);
    if (!(bloom->knee >= 0.0f && bloom->knee <= 1.0f))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "a knee of %g of the threshold of bloom: it must be 0 to 1",
                       (double)bloom->knee);
    if (!(width >= tl_least_bloom_width(side) && width <= tl_most_bloom_width(side)))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "a bloom %g px wide in a picture of 1/%u of the size: it must be %g to "
                       "%g there",
                       width, side, tl_least_bloom_width(side), tl_most_bloom_width(side));
    return TL_OK;
}

static tl_status check_options(const tl_post_options *options, tl_error *err)
{
    const tl_status status = check_edges(&options->edges, err);
    return status == TL_OK ? check_bloom(&options->bloom, err) : status;
}

tl_status tl_post_create(tl_device *device,
                         const tl_lighting_options *lighting,
                         const tl_post_options *options,
                         tl_post **out,
                         tl_error *err)
{
    if (!device && !tl_precision_is_on_host(lighting->precision))
        return tl_fail(err, TL_ERR_ARGUMENT, "this precision needs a device");
    const tl_status status = check_options(options, err);
    if (status != TL_OK)
        return status;
    tl_post *made = calloc(1, sizeof *made);
    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for what is done after lighting");
    made->device = device;
    made->lighting = *lighting;
    made->options = *options;
    *out = made;
    return TL_OK;
}

tl_status tl_post_choose(tl_post *post, const tl_post_options *options, tl_error *err)
{
    const tl_status status = check_options(options, err);
    if (status == TL_OK)
        post->options = *options;
    return status;
}

void tl_post_destroy(tl_post *post)
{
    if (!post)
        return;
    tl_buffers_release(&post->buffers);
    tl_image_destroy(post->spare);
    free(post->numbers);
    free(post);
}

tl_status tl_post_reserve_numbers(tl_post *post, size_t count, tl_error *err)
{
    if (count <= post->number_capacity)
        return TL_OK;
    free(post->numbers);
    post->numbers = malloc(count * sizeof(float));
    post->number_capacity = post->numbers ? count : 0;
    return post->numbers
               ? TL_OK
               : tl_fail(err, TL_ERR_MEMORY, "out of memory for what is done after lighting");
}

tl_status tl_post_reserve_to(tl_post_work *work, tl_error *err)
{
    const tl_image *from = work->from;
    if (work->to && work->to->width == from->width && work->to->height == from->height)
        return TL_OK;
    tl_image_destroy(work->to);
    work->to = NULL;
    return tl_image_create(from->width, from->height, &work->to, err);
}

void tl_post_swap(tl_post_work *work)
{
    tl_image *const written = work->to;
    work->to = work->from;
    work->from = written;
}

/* The whole picture, as it stands in the host's memory. */
static tl_view_picture view_of(const tl_image *image)
{
    return (tl_view_picture){.width = image->width,
                             .height = image->height,
                             .pitch = image->pitch,
                             .plane_rows = image->rows,
                             .end_row = image->height};
}

static tl_status run_on_host(tl_post_work *work, const tl_stage *stage, tl_error *err)
{
    int wrote = 0;
    tl_status status = TL_OK;
    work->view = view_of(work->from);
    TRY(tl_post_bring_back(work, err));
    work->is_on_device = 0;
    TRY(stage->on_host(work, &wrote, err));
    if (wrote)
        tl_post_swap(work);
done:
    return status;
}

static tl_status run_stage(tl_post_work *work, const tl_stage *stage, tl_error *err)
{
    const double clock = tl_seconds(), compiled = work->compile_ms;
    const int on_host =
        !stage->on_device || tl_precision_is_on_host(work->post->lighting.precision);
    const tl_status status =
        on_host ? run_on_host(work, stage, err) : tl_post_run_on_device(work, stage, err);
    tl_timings_add(work->timings, tl_post_stage_rows[stage->name].word,
                   1e3 * (tl_seconds() - clock) - (work->compile_ms - compiled));
    work->counts.stages |= 1u << stage->name;
    return status;
}

void tl_post_let_go(tl_post_work *work)
{
    tl_post *post = work->post;
    const double clock = tl_seconds();
    int kept = 0;
    for (int part = 0; part < TL_PART_COUNT; part++)
        if (work->context.programs[part])
            kept |= tl_program_keep(post->device, work->context.programs[part]);
    if (kept)
        tl_timings_end(work->timings, "keep", clock);
    work->counts.device_bytes = tl_buffers_size(&post->buffers);
    if (post->device && post->device->shares_memory)
        tl_buffers_let_go(&post->buffers);
}

static void tell(const tl_post_work *work)
{
    const uint64_t mended = work->counts.mended_count;
    if (mended > 0)
        tl_notice(work->notices,
                  "%" PRIu64 " pixel%s no colour, NaN or infinite, and the mean of what is "
                  "around stands in: lighting leaves none, so look at the kernel that lit them",
                  mended, mended == 1 ? " was" : "s were");
}

static int is_any_on(const tl_post *post, const tl_gbuffer *gbuffer)
{
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        if (stages[i]->is_on(post, gbuffer))
            return 1;
    return 0;
}

/* What stages read behind `resolve` are pixels, of as many samples each way. */
uint32_t tl_post_halo(const tl_post *post, const tl_gbuffer *gbuffer)
{
    const uint32_t side = tl_samples_side(gbuffer->samples);
    uint32_t halo = 0;
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        if (stages[i]->halo && stages[i]->is_on(post, gbuffer))
            halo += stages[i]->halo(post) * (i > TL_POST_RESOLVE ? side : 1);
    return halo;
}

tl_status tl_post_run(tl_post *post,
                      const tl_gbuffer *gbuffer,
                      tl_image **image,
                      tl_timings *timings,
                      const tl_notices *notices,
                      tl_post_counts *counts,
                      tl_error *err)
{
    tl_status status = TL_OK;
    tl_post_work work = {.post = post,
                         .gbuffer = gbuffer,
                         .from = *image,
                         .to = post->spare,
                         .context = {.device = post->device, .buffers = &post->buffers},
                         .timings = timings,
                         .notices = notices};
    if (counts)
        *counts = work.counts;
    if (!is_any_on(post, gbuffer))
        return TL_OK;
    post->spare = NULL;
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        if (stages[i]->is_on(post, gbuffer))
            TRY(run_stage(&work, stages[i], err));
    TRY(tl_post_bring_back(&work, err));
    tell(&work);
done:
    tl_post_let_go(&work);
    post->spare = work.to;
    *image = work.from;
    if (counts)
        *counts = work.counts;
    return status;
}
