/* tl_study_run: round by round, a block of every configuration in each. */
#include "file_times.h"
#include "maps.h"
#include "pictures.h"
#include "results.h"
#include "stages.h"
#include "steps.h"
#include "try.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_SIZE = 4400 };

/* One frame being studied. */
typedef struct run {
    tl_study *study;
    const tl_study_frame *frame;
    const tl_study_options *options;
    tl_sampling_rule rule;   /* of a block */
    tl_study_result *result; /* the study's */
    tl_study_pictures pictures;
    tl_study_file_times files;
    float *map; /* [height][width] */
    tl_study_record *
        work; /* [count]: what is being measured, the default configuration first where it is */
    size_t count;
} run;

static int is_default(const tl_study_config *config)
{
    const tl_study_config usual = tl_study_config_default();
    return tl_study_config_is_same(config, &usual);
}

/* Of the first run: whole or begun, sampled for as long as is asked for. */
static const tl_study_record *find_begun(const run *r, const tl_study_config *config)
{
    const tl_study_record *record = tl_study_record_find(r->result, config);
    return record && fabs(record->seconds - r->options->seconds) < 1e-6 ? record : NULL;
}

static int is_whole(const tl_study_record *record)
{
    return tl_study_lighting_is_known(&record->config) ||
           record->lit.count == TL_STUDY_BLOCK_COUNT;
}

static int is_due(const run *r, const tl_study_needs *needs, const tl_study_config *config)
{
    const tl_study_config usual = tl_study_config_default();
    const tl_study_record *begun = find_begun(r, config);
    const int is_measured = begun && is_whole(begun);
    return r->options->again ? is_measured && find_begun(r, &usual)
                             : !is_measured && tl_study_config_fits(config, needs);
}

/* Behind those of its layout and compression, whose G-buffers need not be made again in between. */
static void insert(run *r, const tl_study_config *config)
{
    const tl_study_record *begun = r->options->again ? NULL : find_begun(r, config);
    size_t at = r->count++;
    while (at > 0 && (r->work[at - 1].config.of.layout != config->of.layout ||
                      r->work[at - 1].config.compression != config->compression))
        at--;
    at = at > 0 ? at : r->count - 1;
    memmove(&r->work[at + 1], &r->work[at], (r->count - 1 - at) * sizeof *r->work);
    r->work[at] = begun ? *begun : tl_study_record_empty(config, r->options->seconds);
}

static tl_status find_work(run *r,
                           const tl_device *device,
                           const tl_study_plan *plan,
                           tl_error *err)
{
    const tl_study_needs needs = tl_study_needs_of(r->frame, device);
    const tl_study_config usual = tl_study_config_default();
    r->work = malloc((plan->count + 1) * sizeof *r->work);
    if (!r->work)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for configurations");
    if (is_due(r, &needs, &usual))
        insert(r, &usual);
    for (size_t i = 0; i < plan->count; i++)
        if (!is_default(&plan->configs[i]) && is_due(r, &needs, &plan->configs[i]))
            insert(r, &plan->configs[i]);
    if (r->count == 0 && r->options->again)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: of what is asked for nothing is measured yet, or not for %g s "
                       "each: the same command without --again does that",
                       r->frame->name, r->options->seconds);
    return TL_OK;
}

static tl_status write_reference(const run *r, tl_error *err)
{
    tl_study_result *result = r->result;
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

static tl_status begin(run *r, tl_device *device, tl_error *err)
{
    const tl_camera *camera = &r->frame->gbuffer->camera;
    const tl_study_config usual = tl_study_config_default();
    tl_status status = TL_OK;
    TRY(tl_study_pictures_begin(&r->pictures, device, r->frame,
                                r->options->folder ? r->options->folder : "/tmp", err));
    const tl_study_config exact = tl_study_config_up_to(&r->pictures, &usual, -1);
    tl_study_config_title(&exact, r->result->reference, sizeof r->result->reference);
    r->result->mean = r->pictures.mean;
    r->result->exposure = (double)r->pictures.exposure;
    r->map = malloc((size_t)camera->width * camera->height * sizeof *r->map);
    if (!r->map)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                    camera->width, camera->height));
    TRY(write_reference(r, err));
done:
    return status;
}

/* "maps/FRAME-NNN.png", NNN counting the frame's configurations. */
static tl_status write_map(const run *r, tl_study_record *record, tl_error *err)
{
    const tl_study_result *result = r->result;
    const tl_study_record *had = tl_study_record_find(result, &record->config);
    const size_t number = had ? (size_t)(had - result->records) : result->count;
    char path[PATH_SIZE];
    snprintf(record->map, sizeof record->map, "maps/%s-%03zu.png", result->name, number);
    snprintf(path, sizeof path, "%s/%s", r->options->folder, record->map);
    return tl_study_map_write(path, r->map, result->width, result->height, err);
}

/* Errors, and the times of files; of a second run only the times that it is judged by. */
static tl_status begin_one(run *r, tl_study_record *record, tl_error *err)
{
    const char *folder = r->options->folder;
    const int is_first = !r->options->again;
    tl_status status = TL_OK;
    if (is_first)
        TRY(tl_study_steps_find(&r->pictures, record, r->map, err));
    if (folder && (is_first || tl_study_lighting_is_known(&record->config)))
        TRY(tl_study_time_files(&r->files, &r->pictures, folder, &r->rule, record, err));
    if (folder && is_first)
        TRY(write_map(r, record, err));
done:
    return status;
}

static int has_begun(const tl_study_record *record)
{
    return record->lit.count > 0 || !isnan(record->values[TL_VALUE_ERROR_RMS]);
}

static int needs_visit(const run *r, const tl_study_record *record, int round)
{
    if (tl_study_lighting_is_known(&record->config))
        return round == 0 && (r->options->again || !has_begun(record));
    return record->lit.count <= round;
}

static tl_status visit(run *r, tl_study_record *record, tl_error *err)
{
    tl_status status = TL_OK;
    if (!has_begun(record))
        TRY(begin_one(r, record, err));
    if (!tl_study_lighting_is_known(&record->config))
        TRY(tl_study_block_take(&r->pictures, &r->rule, record, err));
done:
    return status;
}

/* What follows from the times so far. The first run's is in the study from then on. */
static tl_status settle(run *r, tl_study_record *record, tl_error *err)
{
    const int is_own = is_default(&record->config) && !r->options->again;
    const tl_study_config usual = tl_study_config_default();
    tl_study_stages_sum(record, is_own ? record : tl_study_record_find(r->result, &usual));
    return r->options->again ? TL_OK : tl_study_record_keep(r->result, record, err);
}

static tl_status write_so_far(run *r, tl_error *err)
{
    if (!r->options->folder || r->options->again)
        return TL_OK;
    return tl_study_write(r->study, r->options->folder, err);
}

/* The first round is written after every configuration, since it is the one that takes long. */
static tl_status take_round(run *r, int round, size_t *visited, int *was_stopped, tl_error *err)
{
    const tl_study_watch *watch = &r->options->watch;
    tl_status status = TL_OK;
    for (size_t i = 0; i < r->count && !*was_stopped; i++) {
        tl_study_record *record = &r->work[i];
        const tl_study_step step = {r->frame->name, round, i, r->count, &record->config};
        const int is_visited = needs_visit(r, record, round);
        if (is_visited && watch->begins)
            watch->begins(watch->context, &step);
        if (is_visited)
            TRY(visit(r, record, err));
        TRY(settle(r, record, err));
        *visited = i + 1 > *visited ? i + 1 : *visited;
        if (is_visited && round == 0)
            TRY(write_so_far(r, err));
        *was_stopped = is_visited && watch->stops && watch->stops(watch->context);
    }
    TRY(write_so_far(r, err));
done:
    return status;
}

static tl_status end_second(run *r, tl_error *err)
{
    for (size_t i = 0; i < r->count; i++)
        tl_study_note_again(tl_study_record_find(r->result, &r->work[i].config),
                            r->work[i].times);
    return r->options->folder ? tl_study_write(r->study, r->options->folder, err) : TL_OK;
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
    run r = {.study = study,
             .frame = frame,
             .options = options,
             .rule = {.least_samples = 2, .seconds = options->seconds / TL_STUDY_BLOCK_COUNT}};
    tl_status status = TL_OK;
    *measured = 0;
    *was_stopped = 0;
    TRY(tl_study_result_find(study, frame, options->again, &r.result, err));
    TRY(find_work(&r, device, plan, err));
    if (r.count == 0)
        goto done;
    TRY(begin(&r, device, err));
    for (int round = 0; round < TL_STUDY_BLOCK_COUNT && !*was_stopped; round++)
        TRY(take_round(&r, round, measured, was_stopped, err));
    if (options->again && !*was_stopped)
        TRY(end_second(&r, err));
done:
    tl_study_pictures_end(&r.pictures);
    tl_study_file_times_clear(&r.files);
    free(r.map);
    free(r.work);
    return status;
}
