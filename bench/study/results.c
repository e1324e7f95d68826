#include "results.h"

#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static tl_study_result *find_name(const tl_study *study, const char *name)
{
    for (size_t i = 0; i < study->count; i++)
        if (strcmp(study->results[i].name, name) == 0)
            return &study->results[i];
    return NULL;
}

static tl_status describe(const tl_study_frame *frame, tl_study_result *out, tl_error *err)
{
    const tl_gbuffer *gbuffer = frame->gbuffer;
    *out = (tl_study_result){.width = gbuffer->camera.width,
                             .height = gbuffer->camera.height,
                             .present = gbuffer->present,
                             .light_count = frame->lights.count};
    snprintf(out->name, sizeof out->name, "%s", frame->name);
    snprintf(out->source, sizeof out->source, "%s", frame->source ? frame->source : "");
    return tl_study_frame_identify(frame, out->identity, err);
}

static tl_status add(tl_study *study,
                     const tl_study_result *made,
                     tl_study_result **out,
                     tl_error *err)
{
    tl_study_result *grown =
        realloc(study->results, (study->count + 1) * sizeof *study->results);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a study");
    study->results = grown;
    grown[study->count] = *made;
    *out = &grown[study->count++];
    return TL_OK;
}

tl_status tl_study_result_find(tl_study *study,
                               const tl_study_frame *frame,
                               int has_to_be_there,
                               tl_study_result **out,
                               tl_error *err)
{
    tl_study_result made;
    tl_status status = TL_OK;
    TRY(describe(frame, &made, err));
    tl_study_result *had = find_name(study, made.name);
    if (had && strcmp(had->identity, made.identity) == 0) {
        *out = had;
        return TL_OK;
    }
    if (has_to_be_there)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    had ? "%s: it was another frame that was measured under this name: --again "
                          "goes with the scenes, --size, --camera and --lights of the study"
                        : "%s: nothing of it is measured yet: the same command without --again "
                          "does that",
                    made.name));
    if (!had) {
        TRY(add(study, &made, out, err));
    } else {
        free(had->records);
        *had = made;
        *out = had;
    }
done:
    return status;
}

tl_study_record *tl_study_record_find(const tl_study_result *result,
                                      const tl_study_config *config)
{
    for (size_t i = 0; i < result->count; i++)
        if (tl_study_config_is_same(&result->records[i].config, config))
            return &result->records[i];
    return NULL;
}

tl_status tl_study_record_keep(tl_study_result *result,
                               const tl_study_record *record,
                               tl_error *err)
{
    tl_study_record *had = tl_study_record_find(result, &record->config);
    if (had) {
        *had = *record;
        return TL_OK;
    }
    tl_study_record *grown =
        realloc(result->records, (result->count + 1) * sizeof *result->records);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a study");
    result->records = grown;
    result->records[result->count++] = *record;
    return TL_OK;
}
