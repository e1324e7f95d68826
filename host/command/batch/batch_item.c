#include "batch_item.h"

#include "batch_record.h"
#include "frame_claim.h"
#include "frame_steps.h"
#include "job_light.h"
#include "job_pictures.h"
#include "output.h"
#include "try.h"

/* What an output may be. */
enum { KINDS = OUTPUT_PNG | OUTPUT_EXR };

tl_status batch_items_check(const tl_item_list *items, tl_error *err)
{
    for (size_t i = 0; i < items->count; i++) {
        const tl_item *item = &items->of[i];
        if (item->output_count > MOST_OUTPUTS)
            return tl_fail(err, TL_ERR_ARGUMENT, "%s: %zu outputs: at most %d at a time",
                           item->input, item->output_count, MOST_OUTPUTS);
        for (size_t k = 0; k < item->output_count; k++)
            if (!output_kind_of(item->outputs[k], KINDS))
                return tl_fail(err, TL_ERR_ARGUMENT,
                               "%s: outputs of a batch end in .exr or .png, which hold what "
                               "they were made from",
                               item->outputs[k]);
    }
    return TL_OK;
}

static void name_outputs(const tl_item *item, picture_options *pictures)
{
    pictures->count = (int)item->output_count;
    for (int i = 0; i < pictures->count; i++) {
        pictures->paths[i] = item->outputs[i];
        pictures->kinds[i] = output_kind_of(item->outputs[i], KINDS);
    }
}

/* Of a G-buffer with its layers. */
static uint64_t gbuffer_bytes(const tl_gbuffer *gbuffer)
{
    uint64_t bytes = (uint64_t)tl_gbuffer_pixel_size(gbuffer) * gbuffer->pitch * gbuffer->rows;
    for (uint32_t i = 0; i < gbuffer->layers.count; i++)
        bytes += gbuffer_bytes(gbuffer->layers.of[i]);
    return bytes;
}

static uint64_t picture_bytes(const tl_image *image)
{
    return (uint64_t)tl_image_plane_count(image) * image->pitch * image->rows * sizeof(float);
}

/* Of the picture that a frame becomes, with its parts. */
static uint64_t lit_bytes(const job *j, const frame_options *frame)
{
    return 3 * (1 + (uint64_t)TL_AOVS_IN(frame->lighting.options.split)) * sizeof(float) *
           j->gbuffer->pitch * j->gbuffer->rows;
}

static tl_status read_frame(
    batch *b, const tl_item *item, const frame_options *frame, job *j, tl_error *err)
{
    tl_status status = TL_OK;
    if (b->common.lights_given)
        job_lend_lights(&b->common, j);
    else
        TRY(job_take_lights(j, &frame->lighting, item->lights, err));
    TRY(frame_read(j, frame, item->input, &b->with, err));
done:
    return status;
}

static tl_status light_frame(
    batch *b, const frame_options *frame, job *j, batch_clock *clock, tl_error *err)
{
    pthread_mutex_lock(&b->lighting);
    *clock = batch_cost_end_stage(&b->cost, BATCH_WAIT, *clock);
    const tl_status status = frame_light(j, frame, &b->with, NULL, err);
    pthread_mutex_unlock(&b->lighting);
    *clock = batch_cost_end_stage(&b->cost, BATCH_LIGHT, *clock);
    return status;
}

/* From the memory that a frame has as it is lit to that which it has as it is written. */
static uint64_t leave_gbuffer(batch *b, job *j, uint64_t bytes)
{
    const uint64_t left = picture_bytes(j->image);
    tl_gbuffer_destroy(j->gbuffer);
    j->gbuffer = NULL;
    batch_cost_take(&b->cost, left);
    batch_cost_give_back(&b->cost, bytes);
    return left;
}

static tl_status make(batch *b, const tl_item *item, const char *record, job *j, tl_error *err)
{
    frame_options frame = b->options->frame;
    batch_clock clock = batch_clock_now();
    uint64_t bytes = 0;
    tl_status status = TL_OK;
    name_outputs(item, &frame.pictures);
    frame.pictures.record = record;
    status = read_frame(b, item, &frame, j, err);
    clock = batch_cost_end_stage(&b->cost, BATCH_READ, clock);
    TRY(status);
    bytes = gbuffer_bytes(j->gbuffer) + lit_bytes(j, &frame);
    batch_cost_take(&b->cost, bytes);
    TRY(light_frame(b, &frame, j, &clock, err));
    bytes = leave_gbuffer(b, j, bytes);
    status = job_write_pictures(j, &frame.pictures, err);
    batch_cost_end_stage(&b->cost, BATCH_WRITE, clock);
done:
    batch_cost_give_back(&b->cost, bytes);
    return status;
}

static bool stands(const batch *b, const tl_item *item, const char *record)
{
    const char *output;
    return batch_reason_of(b, item, record, &output) == BATCH_UP_TO_DATE_IS;
}

/* Unless another process is at it, or has made it until it could be taken. */
static tl_status make_alone(
    batch *b, const tl_item *item, const char *record, batch_outcome *outcome, tl_error *err)
{
    tl_frame_claim *claim = NULL;
    job j = {0};
    tl_status status = TL_OK;
    TRY(tl_frame_claim_take(item->outputs, item->output_count, &claim, err));
    *outcome = !claim ? BATCH_LEFT : stands(b, item, record) ? BATCH_UP_TO_DATE : BATCH_DONE;
    if (*outcome == BATCH_DONE)
        TRY(make(b, item, record, &j, err));
done:
    batch_cost_add_timings(&b->cost, &j.timings);
    job_release(&j);
    tl_frame_claim_end(claim);
    return status;
}

tl_status batch_item_make(batch *b, const tl_item *item, batch_outcome *outcome, tl_error *err)
{
    const batch_clock clock = batch_clock_now();
    char record[TL_RECORD_SIZE];
    const tl_status status = batch_record_of(b, item, record, err);
    const bool is_made = status == TL_OK && stands(b, item, record);
    batch_cost_end_stage(&b->cost, BATCH_CHECK, clock);
    if (status != TL_OK)
        return status;
    if (!is_made)
        return make_alone(b, item, record, outcome, err);
    tl_frame_claim_sweep(item->outputs, item->output_count);
    *outcome = BATCH_UP_TO_DATE;
    return TL_OK;
}
