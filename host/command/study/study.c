/* tilelight study: what accuracy costs in time. */
#define _GNU_SOURCE
#include "study.h"

#include "commands.h"
#include "console.h"
#include "job_light.h"
#include "study_claims.h"
#include "study_options.h"
#include "study_page.h"
#include "study_table.h"
#include "try.h"
#ifdef TILELIGHT_RASTER
#    include "job_capture.h"
#endif

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const double usual_seconds = 1.0, quick_seconds = 0.5;

static volatile sig_atomic_t is_interrupted;

static void interrupt(int signal)
{
    (void)signal;
    is_interrupted = 1;
}

/* The first Ctrl-C ends the study, a second one the program. */
static void listen_for_interrupts(void)
{
    struct sigaction action = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
}

static int stops(void *context)
{
    (void)context;
    return is_interrupted != 0;
}

/* Since when rounds of the frame take as long as those that are left. */
typedef struct progress {
    double start_s;
    size_t done; /* steps since then */
} progress;

/* After the first round, which takes longer than the others. */
static void say_left(const progress *p, const tl_study_step *step, char *out, size_t size)
{
    const size_t left =
        step->count * (size_t)(TL_STUDY_BLOCK_COUNT - step->round) - step->index;
    const double each = (tl_seconds() - p->start_s) / (double)p->done;
    snprintf(out, size, "; some %.0f min left of this frame", ceil(each * (double)left / 60.0));
}

static void tell(void *context, const tl_study_step *step)
{
    progress *p = context;
    char title[1024], left[64] = "", text[1400];
    tl_study_config_title(step->config, title, sizeof title);
    if (step->round == 0 || p->start_s == 0.0)
        *p = (progress){.start_s = step->round == 0 ? 0.0 : tl_seconds()};
    if (p->done > 2)
        say_left(p, step, left, sizeof left);
    p->done += step->round > 0;
    snprintf(text, sizeof text, "%s: round %d of %d, %zu of %zu: %s%s", step->frame,
             step->round + 1, TL_STUDY_BLOCK_COUNT, step->index + 1, step->count, title, left);
    console_stage(text);
}

/* A word for files: letters, digits and dashes of the path's last name without its ending. */
static void name_frame(const char *path, int number, char *out, size_t size)
{
    const char *slash = strrchr(path, '/'), *from = slash ? slash + 1 : path;
    const char *dot = strrchr(from, '.');
    size_t length = 0;
    for (const char *c = from; *c && c != dot && length < size - 8; c++)
        out[length++] = isalnum((unsigned char)*c) ? *c : '-';
    out[length] = '\0';
    if (number > 1)
        snprintf(out + length, size - length, "-%d", number);
}

static bool is_scene(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0);
}

static tl_status capture(const study_command *options, const char *path, job *j, tl_error *err)
{
#ifdef TILELIGHT_RASTER
    const tl_capture_options how = {
        .width = options->width, .height = options->height, .camera = options->camera};
    return job_capture(j, path, &how, false, err);
#else
    (void)options, (void)j;
    return tl_fail(
        err, TL_ERR_UNSUPPORTED,
        "%s: this build captures no scenes; configure it with -DTILELIGHT_RASTER=ON, "
        "or give a capture",
        path);
#endif
}

/* The frame of a scene or a capture, in full float. */
static tl_status load(const study_command *options,
                      const char *path,
                      tl_study_frame *out,
                      tl_error *err)
{
    job j = {0};
    tl_status status = TL_OK;
    TRY(job_read_lights(&j, options->lights, err));
    if (is_scene(path))
        TRY(capture(options, path, &j, err));
    else
        TRY(job_read(&j, path, &options->import, false, err));
    TRY(job_unpack(&j, err));
    TRY(job_default_lights(&j, err));
    out->source = path;
    out->gbuffer = j.gbuffer;
    out->lights = j.lights;
    j.gbuffer = NULL;
    j.lights = (tl_light_set){0};
done:
    job_release(&j);
    return status;
}

/* Frames of one name are told apart by a number. */
static int count_same(const study_command *options, int index)
{
    char name[64], other[64];
    int same = 1;
    name_frame(options->scenes[index], 1, name, sizeof name);
    for (int i = 0; i < index; i++) {
        name_frame(options->scenes[i], 1, other, sizeof other);
        same += strcmp(name, other) == 0;
    }
    return same;
}

static tl_status make_frame(const study_command *options,
                            int index,
                            tl_study_frame *out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    if (options->scene_count == 0)
        return tl_study_built_in_make(&tl_study_built_ins[index], options->width,
                                      options->height, out, err);
    TRY(load(options, options->scenes[index], out, err));
    name_frame(options->scenes[index], count_same(options, index), out->name, sizeof out->name);
done:
    return status;
}

static int count_frames(const study_command *options)
{
    if (options->scene_count > 0)
        return options->scene_count;
    return options->quick ? 1 : tl_study_built_in_count;
}

static void complete(study_command *options)
{
    if (options->width == 0) {
        options->width = options->quick ? 640 : 960;
        options->height = options->quick ? 360 : 540;
    }
    if (options->seconds == 0.0)
        options->seconds = options->quick ? quick_seconds : usual_seconds;
}

static tl_status make_folder(const char *path, tl_error *err)
{
    struct stat seen;
    if (mkdir(path, 0777) == 0 || (stat(path, &seen) == 0 && S_ISDIR(seen.st_mode)))
        return TL_OK;
    return tl_fail(err, TL_ERR_WRITE, "%s: the folder cannot be made: %s", path,
                   strerror(errno));
}

static tl_status say_interrupted(const study_command *options, size_t measured, tl_error *err)
{
    if (options->again)
        return tl_fail(err, TL_ERR_DIFFERENT,
                       "interrupted; of this second run nothing is kept, and the same command "
                       "begins anew");
    return tl_fail(err, TL_ERR_DIFFERENT,
                   "interrupted at %zu configurations, which are in %s as far as they are "
                   "measured; the same command goes on from there",
                   measured, options->folder);
}

static tl_status study_frames(const study_command *options,
                              tl_study *study,
                              tl_device *device,
                              const tl_study_plan *plan,
                              tl_error *err)
{
    progress p = {.start_s = 0.0};
    tl_study_options how = tl_study_options_default();
    tl_status status = TL_OK;
    how.folder = options->folder;
    how.seconds = options->seconds;
    how.again = options->again;
    how.watch = (tl_study_watch){tell, stops, &p};
    for (int i = 0; i < count_frames(options); i++) {
        tl_study_frame frame = {0};
        size_t measured = 0;
        int was_stopped = 0;
        console_stage("making the frame");
        status = make_frame(options, i, &frame, err);
        if (status == TL_OK)
            status =
                tl_study_run(study, device, &frame, plan, &how, &measured, &was_stopped, err);
        tl_study_frame_clear(&frame);
        TRY(status);
        if (was_stopped)
            TRY(say_interrupted(options, measured, err));
    }
done:
    return status;
}

static tl_status find_claims(const study_command *options,
                             tl_study *study,
                             tl_device *device,
                             tl_error *err)
{
    const tl_claim_options how = {device, options->width, options->height, options->seconds};
    console_stage("measuring what the sources claim");
    return tl_study_claims_find(study, &how, err);
}

static tl_status make_plan(const study_command *options, tl_study_plan *plan, tl_error *err)
{
    return options->knobs_given ? tl_study_plan_add(plan, &options->lists, err)
                                : tl_study_plan_usual(plan, options->quick, err);
}

static tl_status run(study_command *options, tl_study *study, tl_error *err)
{
    tl_study_plan plan = {0};
    tl_device *device = NULL;
    tl_status status = TL_OK;
    complete(options);
    TRY(make_plan(options, &plan, err));
    TRY(make_folder(options->folder, err));
    TRY(tl_device_open(options->device, &device, err));
    study->machine = tl_machine_ask();
    study->device = tl_device_describe(device);
    if (!options->anew)
        TRY(tl_study_resume(study, options->folder, err));
    listen_for_interrupts();
    TRY(study_frames(options, study, device, &plan, err));
    if (options->claims)
        TRY(find_claims(options, study, device, err));
    tl_study_drop_maps(study, options->folder);
    TRY(tl_study_write(study, options->folder, err));
    TRY(tl_study_page_write(options->folder, err));
    console_stage(NULL);
    if (options->quiet)
        goto done;
    for (size_t i = 0; i < study->count && !options->again; i++)
        study_print(stdout, &study->results[i]);
    if (options->again)
        study_print_again(stdout, study);
    if (options->claims)
        study_print_claims(stdout, study);
done:
    tl_study_plan_clear(&plan);
    tl_device_close(device);
    return status;
}

/* As it was called, in words that a shell takes apart again. */
static void note_command(int argc, char **argv, char *out, size_t size)
{
    size_t used = (size_t)snprintf(out, size, "%s", argv[0]);
    for (int i = 1; i < argc && used < size; i++) {
        const bool is_plain = argv[i][strcspn(argv[i], " \t\n'\"\\$&|;<>()*?")] == '\0';
        used += (size_t)snprintf(out + used, size - used, is_plain ? " %s" : " '%s'", argv[i]);
    }
}

int command_study(int argc, char **argv)
{
    study_command options = {0};
    tl_study study = {0};
    tl_status status = TL_OK;
    tl_error err;
    study_parse(argc, argv, &options);
    if (!options.again)
        note_command(argc, argv, study.command, sizeof study.command);
    if (options.list)
        study_print_list(stdout);
    else if (options.page)
        status = tl_study_page_write(options.folder, &err);
    else
        status = run(&options, &study, &err);
    tl_study_clear(&study);
    study_command_release(&options);
    return console_finish(status, &err);
}
