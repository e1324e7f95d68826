#include "job_light.h"

#include "approximation_options.h"
#include "console.h"
#include "job_aovs.h"
#include "job_promise.h"
#include "light_words.h"
#include "try.h"

/* Of a precision: whether it runs on an OpenCL device. */
static const bool needs_device[TL_PRECISION_COUNT] = {
    [TL_PRECISION_FLOAT] = true,
    [TL_PRECISION_DOUBLE] = true,
};

tl_status job_take_lights(job *j,
                          const lighting_choice *choice,
                          const char *path,
                          tl_error *err)
{
    tl_status status = TL_OK;
    TRY(job_read_lights(j, path, err));
    /* Before a capture makes shadow maps of them. */
    if (j->lights_given)
        TRY(tl_light_set_control(&j->lights, choice->controls.of, choice->controls.count, err));
done:
    return status;
}

tl_status job_open_device(job *j,
                          const lighting_choice *choice,
                          tl_device **device,
                          tl_error *err)
{
    tl_status status = TL_OK;
    if (!needs_device[choice->options.precision])
        goto done;
    const double start = tl_seconds();
    console_stage("opening the device");
    TRY(tl_device_open(choice->device, device, err));
    tl_timings_end(&j->timings, "device", start);
    job_report(j, "device", json_string(tl_device_describe(*device).name));
done:
    return status;
}

tl_status job_prepare_light(job *j,
                            const lighting_choice *choice,
                            tl_device **device,
                            tl_error *err)
{
    const tl_status status = job_take_lights(j, choice, choice->lights, err);
    return status == TL_OK ? job_open_device(j, choice, device, err) : status;
}

tl_status job_control_lights(job *j, const lighting_choice *choice, tl_error *err)
{
    if (j->lights_given || j->lights_controlled)
        return TL_OK;
    return tl_light_set_control(&j->lights, choice->controls.of, choice->controls.count, err);
}

static tl_status add_rig(job *j, tl_error *err)
{
    tl_notice(&console_notices,
              "no lights anywhere: a key light, a fill light and ambient light "
              "stand in; --lights FILE brings others");
    return tl_light_set_add_rig(&j->lights, &j->gbuffer->camera, err);
}

tl_status job_default_lights(job *j, tl_error *err)
{
    return j->lights_given || job_has_lights(j) ? TL_OK : add_rig(j, err);
}

tl_status job_choose_lights(job *j, const sky_choice *sky, tl_error *err)
{
    const bool had_lights = j->lights_given || job_has_lights(j);
    const tl_status status = sky_choose(sky, &j->lights, err);
    if (status != TL_OK || had_lights || tl_light_set_is_lit_by_sky(&j->lights))
        return status;
    return add_rig(j, err);
}

tl_status job_settle_lights(job *j, const lighting_choice *choice, tl_error *err)
{
    const tl_status status = sky_choose(&choice->sky, &j->lights, err);
    if (status == TL_OK)
        job_choose_occlusion(j, choice);
    return status;
}

void job_lend_lights(const job *from, job *to)
{
    to->lights = from->lights;
    to->lights_given = to->lights_are_lent = true;
}

void job_choose_occlusion(job *j, const lighting_choice *choice)
{
    if (choice->occlusion_radius >= 0.0)
        j->lights.occlusion_radius = (float)choice->occlusion_radius;
}

/* Where fewer layers are asked for, and there are none. */
static void tell_layers(const job *j, const tl_lighting_options *options)
{
    if (options->layers < TL_MOST_LAYERS && j->gbuffer->layers.count == 0)
        tl_notice(
            &console_notices,
            "--layers %u is for nothing: the capture has no layers of surfaces that blend",
            options->layers);
}

static void report_counts(job *j, const tl_lighting_counts *c)
{
    job_report(j, "lit_layers", json_integer((json_int_t)c->layer_count));
    job_report(j, "lights",
               json_pack("{sI sI}", "ranged", (json_int_t)c->ranged_light_count, "global",
                         (json_int_t)c->global_light_count));
    job_report(j, "lists",
               json_pack("{sI sI sI}", "tiles", (json_int_t)c->tile_count, "entries",
                         (json_int_t)c->list_length, "pixel_light_pairs",
                         (json_int_t)c->pair_count));
    job_report(j, "cut_pixels", json_integer((json_int_t)c->cut_count));
}

/* Of lights that a file brought, not the user: which shading model came with them, where it is not ours. */
static void tell_model(const job *j)
{
    if (!j->lights_given && j->lights.model != TL_MODEL_PHONG)
        tl_notice(
            &console_notices,
            "lit by the shading model that came with the lights, %s; --lights FILE brings "
            "others",
            tl_model_words[j->lights.model]);
}

static void tell_approximations(job *j, const tl_approximations *of)
{
    approximations_tell(of);
    if (!tl_approximations_are_default(of))
        job_report(j, "approximations", approximations_json(of));
}

static tl_status light_as_chosen(job *j,
                                 lighter *with,
                                 const tl_lighting_options *options,
                                 tl_lighting_counts *counts,
                                 tl_error *err)
{
    tl_status status = TL_OK;
    TRY(lighter_lighting(with, &with->lighting, options, err));
    TRY(tl_lighting_run(with->lighting, j->gbuffer, &j->lights, j->image, &j->timings,
                        &console_notices, counts, err));
done:
    return status;
}

tl_status job_ready_lights(job *j, const lighting_choice *choice, tl_error *err)
{
    tl_status status = TL_OK;
    if (j->lights_are_lent || j->lights_are_chosen)
        return TL_OK;
    TRY(job_choose_lights(j, &choice->sky, err));
    TRY(job_control_lights(j, choice, err));
    job_choose_occlusion(j, choice);
    j->lights_are_chosen = true;
done:
    return status;
}

tl_status job_light(job *j,
                    const lighting_choice *choice,
                    const tl_goal *goal,
                    lighter *with,
                    explained *told,
                    tl_error *err)
{
    tl_status status = TL_OK;
    const tl_camera *camera = &j->gbuffer->camera;
    tl_lighting_counts counts = {0};
    tl_lighting_options options = choice->options;
    tl_lighting *chosen = NULL; /* by the goal, for this frame */
    options.keeps_tile_lights = told != NULL;
    options.memory_limit = lighter_memory(with, &options);

    console_stage("lighting");
    TRY(job_ready_lights(j, choice, err));
    tell_model(j);
    tell_layers(j, &options);
    TRY(tl_image_create_parts(camera->width, camera->height, TL_AOVS_IN(options.split),
                              &j->image, err));
    if (goal)
        TRY(job_promise_light(j, goal, with->device, &options, &counts, &chosen, err));
    else
        TRY(light_as_chosen(j, with, &options, &counts, err));
    tell_approximations(j, &options.approximations);
    if (told)
        TRY(explain_take(j, goal ? chosen : with->lighting, &options, &counts, told, err));
    lighter_let_go(with);
    TRY(job_take_aovs(j, choice, with, err));
    report_counts(j, &counts);
    if (counts.first_kernel_s > 0.0)
        j->first_kernel_ms = 1e3 * (counts.first_kernel_s - j->start_s);
    if (counts.shade_wall_ms > 0.0)
        j->shade_processors = counts.shade_processor_ms / counts.shade_wall_ms;
done:
    tl_lighting_destroy(chosen);
    return status;
}
