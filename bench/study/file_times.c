#include "file_times.h"

#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 4200 };

static tl_status read_gbuffer(const void *context, tl_error *err)
{
    tl_gbuffer *read = NULL;
    const tl_status status = tl_gbuffer_read(context, &read, NULL, NULL, err);
    tl_gbuffer_destroy(read);
    return status;
}

typedef struct writing_job {
    const tl_image *image;
    tl_study_output output;
    float exposure;
    uint8_t *rgb; /* [height][width][3] */
    char path[PATH_SIZE];
} writing_job;

static tl_status make_codes(const void *context, tl_error *err)
{
    const writing_job *job = context;
    (void)err;
    tl_image_to_rgb8(job->image, job->exposure, (tl_look){0}, job->rgb);
    return TL_OK;
}

static tl_status write_picture(const void *context, tl_error *err)
{
    const writing_job *job = context;
    if (job->output != TL_STUDY_PNG)
        return tl_image_write_exr(job->path, job->image,
                                  (tl_exr_form){.half = job->output == TL_STUDY_HALF}, err);
    make_codes(job, err);
    return tl_png_write(job->path, job->rgb, job->image->width, job->image->height,
                        TL_CURVE_SRGB, err);
}

/* Bytes of a file per pixel of the frame. */
static double file_size(const char *path, const tl_study_pictures *p)
{
    const tl_camera *camera = &p->frame->gbuffer->camera;
    struct stat seen;
    return stat(path, &seen) == 0
               ? (double)seen.st_size / ((double)camera->width * camera->height)
               : (double)NAN;
}

static tl_status write_gbuffer(tl_study_pictures *p,
                               const tl_study_config *config,
                               const char *path,
                               tl_error *err)
{
    const tl_gbuffer *gbuffer = NULL;
    tl_status status = TL_OK;
    TRY(tl_study_gbuffer(p, config, &gbuffer, err));
    TRY(tl_gbuffer_write_compressed(path, gbuffer, NULL, config->compression, err));
done:
    return status;
}

static tl_status time_reading(tl_study_pictures *p,
                              const tl_study_config *config,
                              const char *folder,
                              const tl_sampling_rule *rule,
                              tl_study_reading *out,
                              tl_error *err)
{
    const tl_study_config usual = tl_study_config_default();
    char usual_path[PATH_SIZE], path[PATH_SIZE];
    tl_study_time usual_ms;
    tl_status status = TL_OK;
    snprintf(usual_path, sizeof usual_path, "%s/.study-%ld-usual.exr", folder, (long)getpid());
    snprintf(path, sizeof path, "%s/.study-%ld-other.exr", folder, (long)getpid());
    *out = (tl_study_reading){.layout = config->of.layout, .compression = config->compression};
    TRY(write_gbuffer(p, &usual, usual_path, err));
    TRY(write_gbuffer(p, config, path, err));
    out->file_bytes = file_size(path, p);
    const tl_turn turns[2] = {{read_gbuffer, usual_path}, {read_gbuffer, path}};
    TRY(tl_study_turns_take(&turns[0], &turns[1], rule, &usual_ms, &out->ms, &out->ratio, err));
done:
    unlink(usual_path);
    unlink(path);
    return status;
}

static tl_status find_reading(tl_study_file_times *files,
                              tl_study_pictures *p,
                              const tl_study_config *config,
                              const char *folder,
                              const tl_sampling_rule *rule,
                              const tl_study_reading **out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    tl_study_reading made;
    for (size_t i = 0; i < files->count; i++)
        if (files->readings[i].layout == config->of.layout &&
            files->readings[i].compression == config->compression) {
            *out = &files->readings[i];
            return TL_OK;
        }
    TRY(time_reading(p, config, folder, rule, &made, err));
    tl_study_reading *grown =
        realloc(files->readings, (files->count + 1) * sizeof *files->readings);
    if (!grown)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a study"));
    files->readings = grown;
    files->readings[files->count] = made;
    *out = &files->readings[files->count++];
done:
    return status;
}

static tl_status time_writing(tl_study_pictures *p,
                              tl_study_output output,
                              const char *folder,
                              const tl_sampling_rule *rule,
                              tl_study_writing *out,
                              tl_error *err)
{
    const tl_image *image = p->reference;
    writing_job usual = {.image = image}, job = {image, output, p->exposure, NULL, ""};
    tl_study_time usual_ms, none;
    tl_status status = TL_OK;
    *out = (tl_study_writing){.tone_ms = tl_study_time_known((double)NAN)};
    snprintf(usual.path, PATH_SIZE, "%s/.study-%ld-usual.out", folder, (long)getpid());
    snprintf(job.path, PATH_SIZE, "%s/.study-%ld-other.out", folder, (long)getpid());
    job.rgb = malloc(3 * (size_t)image->width * image->height);
    if (!job.rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                    image->width, image->height));
    const tl_turn turns[2] = {{write_picture, &usual}, {write_picture, &job}},
                  tone = {make_codes, &job};
    TRY(tl_study_turns_take(&turns[0], &turns[1], rule, &usual_ms, &out->ms, &out->ratio, err));
    out->file_bytes = file_size(job.path, p);
    if (output == TL_STUDY_PNG)
        TRY(tl_study_turns_take(&tone, &tone, rule, &usual_ms, &out->tone_ms, &none, err));
    out->is_known = 1;
done:
    unlink(usual.path);
    unlink(job.path);
    free(job.rgb);
    return status;
}

tl_status tl_study_time_files(tl_study_file_times *files,
                              tl_study_pictures *p,
                              const char *folder,
                              const tl_sampling_rule *rule,
                              tl_study_record *record,
                              tl_error *err)
{
    const tl_study_config *config = &record->config;
    tl_study_writing *writing = &files->writings[config->output];
    const tl_study_reading *reading = NULL;
    const tl_gbuffer *gbuffer = NULL;
    tl_status status = TL_OK;
    TRY(find_reading(files, p, config, folder, rule, &reading, err));
    if (!writing->is_known)
        TRY(time_writing(p, config->output, folder, rule, writing, err));
    TRY(tl_study_gbuffer(p, config, &gbuffer, err));
    record->times[TL_TIME_READ] = reading->ms;
    record->times[TL_TIME_READ_RATIO] = reading->ratio;
    record->times[TL_TIME_WRITE] = writing->ms;
    record->times[TL_TIME_WRITE_RATIO] = writing->ratio;
    record->times[TL_TIME_TONE] = writing->tone_ms;
    record->values[TL_VALUE_FILE] = reading->file_bytes;
    record->values[TL_VALUE_PICTURE] = writing->file_bytes;
    record->values[TL_VALUE_STORED] = tl_gbuffer_pixel_size(gbuffer);
done:
    return status;
}

void tl_study_file_times_clear(tl_study_file_times *files)
{
    free(files->readings);
    *files = (tl_study_file_times){0};
}
