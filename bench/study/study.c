#include "study.h"

#include "maps.h"
#include "pictures.h"
#include "stages.h"
#include "steps.h"
#include "study_csv.h"
#include "study_json.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 4400 };

/* One frame being studied. */
typedef struct run {
    tl_study *study;
    tl_device *device;
    const tl_study_frame *frame;
    const tl_study_options *options;
    size_t result; /* index of the frame's */
    tl_study_pictures pictures;
    tl_study_file_times files;
    float *map; /* [height][width] */
} run;

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

/* Its index among the results that have the name; their count where none has. */
static size_t index_of(const tl_study *study, const char *name)
{
    size_t at = 0;
    while (at < study->count && strcmp(study->results[at].name, name) != 0)
        at++;
    return at;
}

static tl_status add_result(run *r, const tl_study_result *made, tl_error *err)
{
    tl_study *study = r->study;
    tl_study_result *grown =
        realloc(study->results, (study->count + 1) * sizeof *study->results);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a study");
    study->results = grown;
    study->results[study->count++] = *made;
    return TL_OK;
}

/* The result of this frame: as it was, or empty. */
static tl_status find_result(run *r, tl_error *err)
{
    tl_study *study = r->study;
    const tl_gbuffer *gbuffer = r->frame->gbuffer;
    tl_study_result made = {.width = gbuffer->camera.width,
                            .height = gbuffer->camera.height,
                            .present = gbuffer->present,
                            .light_count = r->frame->lights.count};
    tl_status status = TL_OK;
    TRY(tl_study_frame_identify(r->frame, made.identity, err));
    snprintf(made.name, sizeof made.name, "%s", r->frame->name);
    snprintf(made.source, sizeof made.source, "%s", r->frame->source ? r->frame->source : "");
    r->result = index_of(study, made.name);
    tl_study_result *had = r->result < study->count ? &study->results[r->result] : NULL;
    if (had && strcmp(had->identity, made.identity) == 0)
        return TL_OK;
    if (r->options->again)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    had ? "%s: it was another frame that was measured under this name: --again "
                          "goes with the scenes, --size, --camera and --lights of the study"
                        : "%s: nothing of it is measured yet: the same command without --again "
                          "does that",
                    made.name));
    if (!had) {
        TRY(add_result(r, &made, err));
    } else {
        free(had->records);
        *had = made;
    }
done:
    return status;
}

static tl_study_record *find_record(const run *r, const tl_study_config *config)
{
    const tl_study_result *result = &r->study->results[r->result];
    for (size_t i = 0; i < result->count; i++)
        if (tl_study_config_is_same(&result->records[i].config, config))
            return &result->records[i];
    return NULL;
}

static int is_measured(const run *r, const tl_study_config *config)
{
    const tl_study_record *record = find_record(r, config);
    return record && fabs(record->seconds - r->options->seconds) < 1e-6;
}

static tl_status keep(run *r, const tl_study_record *record, tl_error *err)
{
    tl_study_result *result = &r->study->results[r->result];
    tl_study_record *had = find_record(r, &record->config);
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

/* "maps/FRAME-NN.png", NN counting the frame's configurations. */
static tl_status write_map(run *r, tl_study_record *record, tl_error *err)
{
    const tl_study_result *result = &r->study->results[r->result];
    const tl_study_record *had = find_record(r, &record->config);
    const size_t number = had ? (size_t)(had - result->records) : result->count;
    char path[PATH_SIZE];
    snprintf(record->map, sizeof record->map, "maps/%s-%03zu.png", result->name, number);
    snprintf(path, sizeof path, "%s/%s", r->options->folder, record->map);
    return tl_study_map_write(path, r->map, result->width, result->height, err);
}

static tl_status measure(run *r, const tl_study_config *config, tl_error *err)
{
    const tl_study_options *options = r->options;
    const tl_study_config usual = tl_study_config_default();
    tl_study_record record = tl_study_record_empty(config, options->seconds);
    const tl_study_record *of_usual =
        tl_study_config_is_same(config, &usual) ? &record : find_record(r, &usual);
    tl_status status = TL_OK;
    TRY(tl_study_steps_find(&r->pictures, &record, r->map, err));
    TRY(tl_study_stages_take(&r->pictures, &r->files, options->folder, options->seconds,
                             of_usual, &record, err));
    if (options->folder)
        TRY(write_map(r, &record, err));
    TRY(keep(r, &record, err));
done:
    return status;
}

static tl_status measure_again(run *r, const tl_study_config *config, tl_error *err)
{
    const tl_study_config usual = tl_study_config_default();
    tl_study_record *record = find_record(r, config);
    tl_study_record second = tl_study_record_empty(config, r->options->seconds);
    const tl_status status =
        tl_study_stages_take(&r->pictures, &r->files, r->options->folder, r->options->seconds,
                             find_record(r, &usual), &second, err);
    if (status == TL_OK)
        tl_study_note_again(record, second.times);
    return status;
}

static tl_status write_reference(run *r, tl_error *err)
{
    tl_study_result *result = &r->study->results[r->result];
    char path[PATH_SIZE];
    tl_status status = TL_OK;
    if (!r->options->folder)
        return TL_OK;
    snprintf(path, sizeof path, "%s/maps", r->options->folder);
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        TRY(tl_fail(err, TL_ERR_WRITE, "%s: cannot be made: %s", path, strerror(errno)));
    snprintf(result->picture, sizeof result->picture, "maps/%s.png", result->name);
    snprintf(path, sizeof path, "%s/%s", r->options->folder, result->picture);
    TRY(tl_study_picture_write(path, r->pictures.reference, r->pictures.exposure, err));
done:
    return status;
}

static tl_status begin(run *r, tl_error *err)
{
    const tl_camera *camera = &r->frame->gbuffer->camera;
    tl_study_result *result = &r->study->results[r->result];
    const tl_study_config usual = tl_study_config_default();
    tl_status status = TL_OK;
    TRY(tl_study_pictures_begin(&r->pictures, r->device, r->frame,
                                r->options->folder ? r->options->folder : "/tmp", err));
    const tl_study_config exact = tl_study_config_up_to(&r->pictures, &usual, -1);
    tl_study_config_title(&exact, result->reference, sizeof result->reference);
    result->mean = r->pictures.mean;
    result->exposure = (double)r->pictures.exposure;
    r->map = malloc((size_t)camera->width * camera->height * sizeof *r->map);
    if (!r->map)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                    camera->width, camera->height));
    TRY(write_reference(r, err));
done:
    return status;
}

static int is_due(const run *r, const tl_study_needs *needs, const tl_study_config *config)
{
    return r->options->again ? is_measured(r, config)
                             : tl_study_config_fits(config, needs) && !is_measured(r, config);
}

/* Those of the plan that are to be measured, the default one first: list [plan->count + 1]; returns how many. */
static size_t list_due(const run *r, const tl_study_plan *plan, tl_study_config *list)
{
    const tl_study_needs needs = tl_study_needs_of(r->frame, r->device);
    const tl_study_config usual = tl_study_config_default();
    size_t count = 0;
    if (is_due(r, &needs, &usual))
        list[count++] = usual;
    for (size_t i = 0; i < plan->count; i++)
        if (!tl_study_config_is_same(&plan->configs[i], &usual) &&
            is_due(r, &needs, &plan->configs[i]))
            list[count++] = plan->configs[i];
    return count;
}

static tl_status find_due(const run *r,
                          const tl_study_plan *plan,
                          tl_study_config **out,
                          size_t *count,
                          tl_error *err)
{
    tl_study_config *list = malloc((plan->count + 1) * sizeof *list);
    if (!list)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for configurations");
    *count = list_due(r, plan, list);
    *out = list;
    if (*count == 0 && r->options->again)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: of what is asked for nothing is measured yet, or not for %g s "
                       "each: the same command without --again does that",
                       r->frame->name, r->options->seconds);
    return TL_OK;
}

static tl_status measure_one(run *r, const tl_study_config *config, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(r->options->again ? measure_again(r, config, err) : measure(r, config, err));
    if (r->options->folder)
        TRY(tl_study_write(r->study, r->options->folder, err));
done:
    return status;
}

tl_status tl_study_run(tl_study *study,
                       tl_device *device,
                       const tl_study_frame *frame,
                       const tl_study_plan *plan,
                       const tl_study_options *options,
                       size_t *measured,
                       int *was_stopped,
                       tl_error *err)
{
    const tl_study_watch *watch = &options->watch;
    run r = {.study = study, .device = device, .frame = frame, .options = options};
    tl_study_config *due = NULL;
    size_t count = 0;
    tl_status status = TL_OK;
    *measured = 0;
    *was_stopped = 0;
    TRY(find_result(&r, err));
    TRY(find_due(&r, plan, &due, &count, err));
    if (count == 0)
        goto done;
    TRY(begin(&r, err));
    while (*measured < count && !*was_stopped) {
        if (watch->begins)
            watch->begins(watch->context, frame->name, *measured, count, &due[*measured]);
        TRY(measure_one(&r, &due[*measured], err));
        ++*measured;
        *was_stopped = watch->stops && watch->stops(watch->context);
    }
done:
    tl_study_pictures_end(&r.pictures);
    tl_study_file_times_clear(&r.files);
    free(r.map);
    free(due);
    return status;
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
