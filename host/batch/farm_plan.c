#include "farm_plan.h"

#include "try.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An option, as one word; NULL where memory ran out. */
static char *option_of(const char *option, const char *value)
{
    const size_t size = strlen(option) + strlen(value) + 2;
    char *word = malloc(size);
    if (word)
        snprintf(word, size, "%s=%s", option, value);
    return word;
}

static tl_status no_memory(tl_error *err)
{
    return tl_fail(err, TL_ERR_MEMORY,
                   "host memory ran out while the batch was cut into chunks");
}

static tl_status begin(tl_farm_plan *plan, size_t count, size_t chunk, tl_error *err)
{
    assert(count > 0 && chunk > 0);
    plan->frame_count = count;
    plan->chunk_count = (count - 1) / chunk + 1;
    plan->chunks = calloc(plan->chunk_count, sizeof *plan->chunks);
    return plan->chunks ? TL_OK : no_memory(err);
}

static tl_status say_frames(const tl_frames *frames, char **option, tl_error *err)
{
    char *text = NULL;
    const tl_status status = tl_frames_format(frames, &text, err);
    if (status != TL_OK)
        return status;
    *option = option_of("--frames", text);
    free(text);
    return *option ? TL_OK : no_memory(err);
}

tl_status tl_farm_cut_frames(tl_farm_plan *plan,
                             const tl_frames *frames,
                             size_t chunk,
                             tl_error *err)
{
    tl_status status = TL_OK;
    TRY(begin(plan, frames->count, chunk, err));
    for (size_t i = 0; i < plan->chunk_count; i++) {
        const size_t left = frames->count - i * chunk;
        const tl_frames part = {frames->of + i * chunk, left < chunk ? left : chunk};
        TRY(say_frames(&part, &plan->chunks[i], err));
    }
    TRY(say_frames(frames, &plan->gather, err));
done:
    if (status != TL_OK)
        tl_farm_plan_release(plan);
    return status;
}

static tl_status say_shard(size_t index, size_t count, char **option, tl_error *err)
{
    char share[48];
    snprintf(share, sizeof share, "%zu/%zu", index, count);
    *option = option_of("--shard", share);
    return *option ? TL_OK : no_memory(err);
}

tl_status tl_farm_cut_shards(tl_farm_plan *plan, size_t count, size_t chunk, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(begin(plan, count, chunk, err));
    for (size_t i = 0; i < plan->chunk_count; i++)
        TRY(say_shard(i + 1, plan->chunk_count, &plan->chunks[i], err));
    TRY(say_shard(1, 1, &plan->gather, err));
done:
    if (status != TL_OK)
        tl_farm_plan_release(plan);
    return status;
}

void tl_farm_plan_release(tl_farm_plan *plan)
{
    for (size_t i = 0; plan->chunks && i < plan->chunk_count; i++)
        free(plan->chunks[i]);
    free(plan->chunks);
    free(plan->gather);
    plan->chunks = NULL;
    plan->gather = NULL;
    plan->chunk_count = plan->frame_count = 0;
}
