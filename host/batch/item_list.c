#include "item_list.h"

#include "frame_set.h"
#include "item_inputs.h"
#include "item_outputs.h"
#include "manifest.h"
#include "try.h"

/* What excludes each other, or is missing. */
static tl_status check_request(const tl_batch_request *request, tl_error *err)
{
    const char *wrong = NULL;
    if (request->manifest && request->input_count > 0)
        wrong = "a manifest says what the inputs are: leave others out";
    else if (!request->manifest && request->input_count == 0)
        wrong = "no inputs: name files, a pattern such as f.####.exr, or a manifest";
    else if (request->manifest && request->frames)
        wrong = "a manifest says what the frames are: leave a set of them out";
    else if (!request->manifest && request->output_count == 0)
        wrong = "no output: name a pattern such as lit.####.exr or {name}.png";
    else if (request->shard > request->shard_count ||
             (request->shard == 0 && request->shard_count > 0))
        return tl_fail(err, TL_ERR_ARGUMENT, "there is no shard %u of %u", request->shard,
                       request->shard_count);
    return wrong ? tl_fail(err, TL_ERR_ARGUMENT, "%s", wrong) : TL_OK;
}

static tl_status add_inputs(const tl_batch_request *request, tl_item_list *list, tl_error *err)
{
    tl_status status = TL_OK;
    tl_frames frames = {NULL, 0};
    if (request->manifest)
        return tl_manifest_read(request->manifest, request->output_count > 0, list, err);
    if (request->frames)
        TRY(tl_frames_parse(request->frames, &frames, err));
    for (size_t i = 0; i < request->input_count; i++)
        TRY(tl_item_inputs_add(list, request->inputs[i], request->frames ? &frames : NULL,
                               err));
done:
    tl_frames_clear(&frames);
    return status;
}

/* Leaves every shard_count-th. */
static void keep_shard(tl_item_list *list, unsigned shard, unsigned shard_count)
{
    size_t kept = 0;
    for (size_t i = 0; i < list->count; i++)
        if (i % shard_count == shard - 1)
            list->of[kept++] = list->of[i];
        else
            tl_item_clear(&list->of[i]);
    list->count = kept;
}

tl_status tl_items_list(const tl_batch_request *request, tl_item_list *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_item_list made = {.of = NULL};
    TRY(check_request(request, err));
    TRY(add_inputs(request, &made, err));
    if (made.count == 0)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%s: there are no frames in it",
                    request->manifest ? request->manifest : request->inputs[0]));
    if (request->output_count > 0)
        TRY(tl_item_outputs_fill(&made, request->outputs, request->output_count, err));
    if (request->lights)
        TRY(tl_item_lights_fill(&made, request->lights, err));
    TRY(tl_item_outputs_check(&made, err));
    made.all_count = made.count;
    if (request->shard_count > 0)
        keep_shard(&made, request->shard, request->shard_count);
    tl_items_clear(out);
    *out = made;
    made = (tl_item_list){.of = NULL};
done:
    tl_items_clear(&made);
    return status;
}
