#include "study.h"

#include "study_csv.h"
#include "study_json.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 4400 };

tl_study_options tl_study_options_default(void)
{
    return (tl_study_options){.seconds = 1.0};
}

void tl_study_clear(tl_study *study)
{
    for (size_t i = 0; i < study->count; i++)
        free(study->results[i].records);
    free(study->results);
    *study = (tl_study){0};
}

tl_status tl_study_claims_find(tl_study *study, const tl_claim_options *options, tl_error *err)
{
    tl_status status = TL_OK;
    for (int i = 0; i < TL_CLAIM_COUNT; i++)
        if (study->claims[i].count == 0)
            TRY(tl_claims[i].find(options, &study->claims[i], err));
done:
    return status;
}

tl_status tl_study_write(tl_study *study, const char *folder, tl_error *err)
{
    char path[PATH_SIZE];
    tl_status status = TL_OK;
    for (size_t i = 0; i < study->count; i++)
        tl_study_front_find(study->results[i].records, study->results[i].count);
    snprintf(path, sizeof path, "%s/study.json", folder);
    TRY(tl_study_json_write(study, path, err));
    snprintf(path, sizeof path, "%s/study.csv", folder);
    TRY(tl_study_csv_write(study, path, err));
done:
    return status;
}

static tl_status check_machine(const tl_study *now,
                               const tl_study *before,
                               const char *path,
                               tl_error *err)
{
    if (strcmp(now->machine.processor, before->machine.processor) == 0 &&
        now->machine.threads == before->machine.threads &&
        strcmp(now->device.name, before->device.name) == 0 &&
        strcmp(now->device.driver, before->device.driver) == 0)
        return TL_OK;
    return tl_fail(err, TL_ERR_ARGUMENT,
                   "%s: a study on another machine or device (%s, %u threads, %s %s; this is "
                   "%s, %u threads, %s %s), whose times are not to be mixed: write to another "
                   "folder, or measure all anew with --anew",
                   path, before->machine.processor, before->machine.threads,
                   before->device.name, before->device.driver, now->machine.processor,
                   now->machine.threads, now->device.name, now->device.driver);
}

tl_status tl_study_resume(tl_study *study, const char *folder, tl_error *err)
{
    char path[PATH_SIZE];
    tl_study before = {0};
    tl_status status = TL_OK;
    snprintf(path, sizeof path, "%s/study.json", folder);
    if (access(path, F_OK) != 0)
        return TL_OK;
    TRY(tl_study_json_read(path, &before, err));
    TRY(check_machine(study, &before, path, err));
    study->machine = before.machine;
    if (!study->command[0])
        memcpy(study->command, before.command, sizeof study->command);
    memcpy(study->claims, before.claims, sizeof study->claims);
    study->results = before.results;
    study->count = before.count;
    before.results = NULL;
    before.count = 0;
done:
    tl_study_clear(&before);
    return status;
}

void tl_study_drop_maps(tl_study *study, const char *folder)
{
    char path[PATH_SIZE];
    for (size_t i = 0; i < study->count; i++)
        for (size_t k = 0; k < study->results[i].count; k++) {
            tl_study_record *record = &study->results[i].records[k];
            if (record->map[0] == '\0' || record->values[TL_VALUE_FRONT_LIGHT] > 0.0 ||
                record->values[TL_VALUE_FRONT_JOB] > 0.0)
                continue;
            snprintf(path, sizeof path, "%s/%s", folder, record->map);
            unlink(path);
            record->map[0] = '\0';
        }
}

void tl_study_count_again(const tl_study *study, size_t *twice, size_t *stay)
{
    *twice = *stay = 0;
    for (size_t i = 0; i < study->count; i++)
        for (size_t k = 0; k < study->results[i].count; k++) {
            const int stays = tl_study_stays(&study->results[i].records[k]);
            *twice += stays >= 0;
            *stay += stays > 0;
        }
}

const char *tl_study_main_cause(const tl_study_record *record)
{
    const double *rms = &record->values[TL_VALUE_RMS_STORAGE];
    int most = -1;
    for (int cause = 0; cause < TL_STUDY_CAUSE_COUNT; cause++)
        if (rms[cause] > 0.0 && (most < 0 || rms[cause] > rms[most]))
            most = cause;
    return most < 0 ? "none" : tl_study_cause_words[most];
}
