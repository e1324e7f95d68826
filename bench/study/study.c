#include "study.h"

#include "file_times.h"
#include "maps.h"
#include "pictures.h"
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
    return (tl_study_options){
        .rule = {.least_samples = 6, .deviation = 0.0025, .seconds = 1.0}};
}

void tl_study_clear(tl_study *study)
{
    for (size_t i = 0; i < study->count; i++)
        free(study->results[i].records);
    free(study->results);
    *study = (tl_study){0};
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
    for (r->result = 0; r->result < study->count; r->result++) {
        tl_study_result *had = &study->results[r->result];
        if (strcmp(had->name, made.name) != 0)
            continue;
        if (strcmp(had->identity, made.identity) == 0)
            return TL_OK;
        free(had->records);
        *had = made;
        return TL_OK;
    }
    tl_study_result *grown =
        realloc(study->results, (study->count + 1) * sizeof *study->results);
    if (!grown)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a study"));
    study->results = grown;
    study->results[study->count++] = made;
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
    return record && fabs(record->seconds - r->options->rule.seconds) < 1e-6;
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

/* Lighting that is the default's by definition, and was measured for that. */
static void take_lighting(tl_study_record *record, const tl_study_record *usual)
{
    record->times[TL_TIME_LIGHT] = usual->times[TL_TIME_LIGHT];
    record->times[TL_TIME_CULL] = usual->times[TL_TIME_CULL];
    record->times[TL_TIME_SHADE] = usual->times[TL_TIME_SHADE];
    record->times[TL_TIME_LIGHT_RATIO] = tl_study_time_known(1.0);
    record->values[TL_VALUE_MOVED] = usual->values[TL_VALUE_MOVED];
}

static const struct {
    tl_study_time_name ms, ratio;
} stages[] = {{TL_TIME_READ, TL_TIME_READ_RATIO},
              {TL_TIME_LIGHT, TL_TIME_LIGHT_RATIO},
              {TL_TIME_WRITE, TL_TIME_WRITE_RATIO}};
enum { STAGE_COUNT = sizeof stages / sizeof stages[0] };

static void sum_job(tl_study_record *record, const tl_study_record *usual)
{
    tl_study_time ms = {0}, ratio = {0};
    double whole = 0.0;
    for (int i = 0; i < STAGE_COUNT; i++)
        whole += usual->times[stages[i].ms].median;
    for (int i = 0; i < STAGE_COUNT; i++) {
        const tl_study_time *stage = &record->times[stages[i].ms],
                            *of_usual = &record->times[stages[i].ratio];
        const double share = usual->times[stages[i].ms].median / whole;
        ms.median += stage->median;
        ms.low += stage->low;
        ms.high += stage->high;
        ratio.median += share * of_usual->median;
        ratio.low += share * of_usual->low;
        ratio.high += share * of_usual->high;
        ms.samples += stage->samples;
        ratio.samples += of_usual->samples;
        ms.is_unstable |= stage->is_unstable;
        ratio.is_unstable |= of_usual->is_unstable;
    }
    record->times[TL_TIME_JOB] = ms;
    record->times[TL_TIME_JOB_RATIO] = ratio;
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
    const tl_study_record *of_usual = find_record(r, &usual);
    const int is_usual = tl_study_config_is_same(config, &usual);
    tl_study_record record = tl_study_record_empty(config, options->rule.seconds);
    tl_status status = TL_OK;
    TRY(tl_study_steps_find(&r->pictures, &record, r->map, err));
    if (!is_usual && of_usual && tl_study_config_is_usual(config, 0))
        take_lighting(&record, of_usual);
    else
        TRY(tl_study_time_lighting(&r->pictures, &options->rule, &record, err));
    if (options->folder) {
        TRY(tl_study_time_files(&r->files, &r->pictures, options->folder, &options->rule,
                                &record, err));
        sum_job(&record, is_usual ? &record : of_usual);
        TRY(write_map(r, &record, err));
    }
    TRY(keep(r, &record, err));
    if (options->folder)
        TRY(tl_study_write(r->study, options->folder, err));
done:
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

/* Those of the plan that fit and are not measured, the default one first: *out, [*count]. */
static tl_status list_missing(const run *r,
                              const tl_study_plan *plan,
                              const tl_study_needs *needs,
                              tl_study_config **out,
                              size_t *count,
                              tl_error *err)
{
    const tl_study_config usual = tl_study_config_default();
    tl_study_config *list = malloc((plan->count + 1) * sizeof *list);
    *count = 0;
    if (!list)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for configurations");
    if (!is_measured(r, &usual))
        list[(*count)++] = usual;
    for (size_t i = 0; i < plan->count; i++)
        if (!tl_study_config_is_same(&plan->configs[i], &usual) &&
            tl_study_config_fits(&plan->configs[i], needs) &&
            !is_measured(r, &plan->configs[i]))
            list[(*count)++] = plan->configs[i];
    *out = list;
    return TL_OK;
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
    const tl_study_needs needs = tl_study_needs_of(frame, device);
    run r = {.study = study, .device = device, .frame = frame, .options = options};
    tl_study_config *missing = NULL;
    size_t count = 0;
    tl_status status = TL_OK;
    *measured = 0;
    *was_stopped = 0;
    TRY(find_result(&r, err));
    TRY(list_missing(&r, plan, &needs, &missing, &count, err));
    if (count == 0)
        goto done;
    TRY(begin(&r, err));
    while (*measured < count && !*was_stopped) {
        if (watch->begins)
            watch->begins(watch->context, frame->name, *measured, count, &missing[*measured]);
        TRY(measure(&r, &missing[*measured], err));
        ++*measured;
        *was_stopped = watch->stops && watch->stops(watch->context);
    }
done:
    tl_study_pictures_end(&r.pictures);
    tl_study_file_times_clear(&r.files);
    free(r.map);
    free(missing);
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
                   "folder, or measure all anew with --again",
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

const char *tl_study_main_cause(const tl_study_record *record)
{
    const double *rms = &record->values[TL_VALUE_RMS_STORAGE];
    int most = -1;
    for (int cause = 0; cause < TL_STUDY_CAUSE_COUNT; cause++)
        if (rms[cause] > 0.0 && (most < 0 || rms[cause] > rms[most]))
            most = cause;
    return most < 0 ? "none" : tl_study_cause_words[most];
}
