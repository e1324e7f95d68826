#define _GNU_SOURCE /* asprintf */
#include "memory.h"

#include "json_values.h"
#include "program_cache.h"

#include "tilelight/layouts.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

/* Changes with what a file holds. */
enum { FORMAT = 1 };

static json_int_t nearest_power(double count)
{
    return count < 1.0 ? 0 : (json_int_t)1 << (int)lround(log2(count));
}

static json_t *effects_json(uint64_t effects)
{
    json_t *array = json_array();
    for (int e = 0; e < TL_EFFECT_COUNT; e++)
        if (effects >> e & 1u)
            json_array_append_new(array, json_string(tl_effect_rows[e].word));
    return array;
}

/* What a number of the goal means beside its limit. */
static json_t *goal_json(const tl_goal *goal)
{
    json_t *object = json_pack("{ss}", "of", tl_goal_rows[goal->kind].word);
    if (goal->kind == TL_GOAL_CODES || goal->kind == TL_GOAL_FLIP) {
        json_object_set_new(object, "exposure",
                            goal->is_automatic ? json_string("auto")
                                               : json_real((double)goal->exposure));
        json_object_set_new(object, "tone", json_integer((json_int_t)goal->look.tone));
        json_object_set_new(object, "curve", json_integer((json_int_t)goal->look.curve));
    }
    return object;
}

json_t *tl_memory_kind(const tl_device_info *device,
                       const tl_lighting_options *base,
                       const tl_goal *goal,
                       const tl_gbuffer *gbuffer,
                       const tl_prepared *prepared)
{
    const tl_frame *frame = &prepared->frame;
    const double pixels = (double)gbuffer->camera.width * gbuffer->camera.height;
    return json_pack(
        "{ss ss ss s{sI sI sI sI sI} ss sI sI so s{sI sI} sI sI so}", "device", device->name,
        "platform", device->platform, "driver", device->driver, "lighting", "cull",
        (json_int_t)base->cull, "path", (json_int_t)base->path, "tile",
        (json_int_t)base->tile_size, "width", (json_int_t)base->vector_width, "effects",
        (json_int_t)base->effects, "layout", tl_layout_word(gbuffer->layout), "planes",
        (json_int_t)gbuffer->present, "models", (json_int_t)prepared->needs.models, "effects",
        effects_json(prepared->explanation.effects), "lights", "ranged",
        nearest_power((double)(frame->light_count - frame->global_count)), "global",
        nearest_power((double)frame->global_count), "pixels", nearest_power(pixels), "samples",
        (json_int_t)gbuffer->samples, "goal", goal_json(goal));
}

/* The caller frees it; NULL if memory ran out. */
static char *path_of(const char *folder, const json_t *kind)
{
    char *path = NULL, *text = json_dumps(kind, JSON_COMPACT | JSON_SORT_KEYS);
    if (!text)
        return NULL;
    const XXH64_hash_t hash = XXH3_64bits(text, strlen(text));
    if (asprintf(&path, "%s/%016llx%s", folder, (unsigned long long)hash, TL_PROMISE_SUFFIX) <
        0)
        path = NULL;
    free(text);
    return path;
}

/* JSON has no infinity: null. Returns whether it is a number as is expected here. */
static int number_of(const json_t *of, double *out)
{
    *out = json_is_null(of) ? (double)INFINITY : json_number_value(of);
    return json_is_null(of) || (json_is_number(of) && *out >= 0.0);
}

/* Why a file is of no use; NULL: it is, and candidates are what it says. */
static const char *take(const json_t *root, const json_t *kind, tl_expectation *candidates)
{
    char name[128];
    const json_t *written = json_object_get(root, "candidates");
    const char *program = json_string_value(json_object_get(root, "program"));
    if (json_integer_value(json_object_get(root, "format")) != FORMAT || !program ||
        strcmp(program, TILELIGHT_VERSION) != 0)
        return "another version of tilelight wrote it";
    if (!json_equal(json_object_get(root, "kind"), kind))
        return "it is of frames of another kind";
    for (uint32_t i = 0; i < tl_candidate_count; i++) {
        tl_candidate_name(i, name, sizeof name);
        const json_t *of = json_object_get(written, name);
        if (json_is_object(written) && !of)
            return "another version of tilelight wrote it";
        if (!number_of(json_object_get(of, "ms"), &candidates[i].ms) ||
            !number_of(json_object_get(of, "error"), &candidates[i].error))
            return "it is damaged";
    }
    return NULL;
}

int tl_memory_read(const char *folder,
                   const json_t *kind,
                   tl_expectation *candidates,
                   const tl_notices *notices)
{
    tl_error err;
    json_t *root = NULL;
    char *path = folder && kind ? path_of(folder, kind) : NULL;
    const int is_there = path && access(path, F_OK) == 0;
    const char *reason = NULL;
    if (is_there && tl_json_read(path, &root, &err) != TL_OK)
        tl_notice(notices, "what was remembered of such frames is not used: %s", err.message);
    else if (is_there)
        reason = take(root, kind, candidates);
    if (reason)
        tl_notice(notices, "%s: what was remembered of such frames is not used: %s", path,
                  reason);
    const int found = root && !reason;
    json_decref(root);
    free(path);
    return found;
}

int tl_memory_write(const char *folder, const json_t *kind, const tl_expectation *candidates)
{
    char name[128];
    char *path = folder && kind ? path_of(folder, kind) : NULL;
    json_t *of = json_object();
    if (!path) {
        json_decref(of);
        return 0;
    }
    for (uint32_t i = 0; i < tl_candidate_count; i++) {
        tl_candidate_name(i, name, sizeof name);
        json_object_set_new(of, name,
                            json_pack("{so so}", "ms", tl_json_number(candidates[i].ms),
                                      "error", tl_json_number(candidates[i].error)));
    }
    tl_program_cache_make_folder(folder);
    json_t *root = json_pack("{sI ss sO so}", "format", (json_int_t)FORMAT, "program",
                             TILELIGHT_VERSION, "kind", kind, "candidates", of);
    const int written = tl_json_write(path, root, NULL) == TL_OK;
    free(path);
    return written;
}
