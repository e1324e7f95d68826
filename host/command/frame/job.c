#include "job.h"

#include "capture_read.h"
#include "console.h"
#include "json_values.h"
#include "pass_bytes.h"
#include "ranges.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

tl_status job_begin(job *j, const report_options *options, tl_error *err)
{
    j->start_s = tl_process_start();
    tl_timings_end(&j->timings, "start", j->start_s);
    if (options->json && !(j->report = json_object()))
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the report");
    return TL_OK;
}

void job_report(job *j, const char *key, json_t *value)
{
    if (j->report)
        json_object_set_new(j->report, key, value);
    else
        json_decref(value);
}

tl_status job_read_lights(job *j, const char *path, tl_error *err)
{
    tl_status status = TL_OK;
    if (!path)
        return status;
    const double start = tl_seconds();
    console_stage("reading lights");
    TRY(tl_lights_read(path, &j->lights, err));
    j->lights_given = true;
    tl_timings_end(&j->timings, "read lights", start);
done:
    return status;
}

bool job_has_lights(const job *j)
{
    bool any = j->lights.count > 0 || tl_light_set_has_sky(&j->lights);
    for (int i = 0; i < 3; i++)
        any = any || j->lights.ambient[i] > 0.0f;
    return any;
}

/* Bytes of a pixel that culling reads. */
static uint32_t position_bytes(const tl_gbuffer *gbuffer)
{
    const tl_pass_words words = tl_pass_words_of(gbuffer->layout, gbuffer->present, false);
    return tl_words_size(gbuffer->layout, words.positions);
}

/* How many there are, and what more of them would change. */
static void report_layers(job *j)
{
    const tl_gbuffer *g = j->gbuffer;
    job_report(j, "layers",
               json_pack("{sI sI sf}", "count", (json_int_t)g->layers.count, "left",
                         (json_int_t)g->layers.left, "left_share", tl_layers_left_share(g)));
}

tl_status job_repair(job *j, const char *name, bool strict, tl_error *err)
{
    const double start = tl_seconds();
    const tl_status status = tl_gbuffer_repair(j->gbuffer, name, strict, &j->repairs, err);
    const tl_repairs *r = &j->repairs;
    if (status != TL_OK)
        return status;
    tl_timings_end(&j->timings, "repair", start);
    if (r->depth + r->normal + r->value > 0)
        tl_notice(&console_notices,
                  "%s: repaired pixels: %" PRIu64 " of depth, %" PRIu64
                  " of the normal, %" PRIu64
                  " of other channels; --strict refuses such a frame",
                  name, r->depth, r->normal, r->value);
    job_report(
        j, "size",
        json_pack("[ii]", (int)j->gbuffer->camera.width, (int)j->gbuffer->camera.height));
    job_report(j, "samples", json_integer((json_int_t)j->gbuffer->samples));
    job_report(j, "layout", json_string(tl_layout_word(j->gbuffer->layout)));
    job_report(j, "pixel_bytes",
               json_pack("{sI sI}", "all", (json_int_t)tl_gbuffer_pixel_size(j->gbuffer),
                         "position", (json_int_t)position_bytes(j->gbuffer)));
    report_layers(j);
    job_report(j, "repairs",
               json_pack("{sI sI sI}", "depth", (json_int_t)r->depth, "normal",
                         (json_int_t)r->normal, "value", (json_int_t)r->value));
    return TL_OK;
}

tl_status job_read(
    job *j, const char *path, const tl_import_options *import, bool strict, tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    const tl_capture_request request = {
        .path = path,
        .notices = &console_notices,
        .import = import,
        .without_lights = j->lights_given,
    };
    tl_captured captured = {0};
    console_stage("reading the G-buffer");
    TRY(tl_capture_read(&request, &captured, err));
    j->gbuffer = captured.gbuffer;
    j->lights_inside = captured.has_lights;
    j->has_look = captured.has_look;
    j->look = captured.look;
    captured.gbuffer = NULL;
    if (!j->lights_given) {
        j->lights = captured.lights;
        captured.lights = (tl_light_set){0};
    }
    if (captured.is_imported)
        job_report(j, "import",
                   json_pack("{sI sI sI}", "sky", (json_int_t)captured.counts.sky, "partial",
                             (json_int_t)captured.counts.partial, "outside",
                             (json_int_t)captured.counts.outside));
    tl_timings_end(&j->timings, "read", start);
    TRY(job_repair(j, path ? path : "the capture", strict, err));
done:
    tl_captured_clear(&captured);
    return status;
}

tl_status job_unpack(job *j, tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    tl_gbuffer *unpacked = NULL;
    if (j->gbuffer->layout == TL_LAYOUT_FLOAT)
        return TL_OK;
    console_stage("unpacking");
    TRY(tl_gbuffer_unpack(j->gbuffer, &unpacked, err));
    tl_gbuffer_destroy(j->gbuffer);
    j->gbuffer = unpacked;
    /* Its faults were repaired, and counted, as words; sky and lost normals read as full float has them. */
    TRY(tl_gbuffer_repair(j->gbuffer, "unpacked", false, NULL, err));
    tl_timings_end(&j->timings, "unpack", start);
done:
    return status;
}

static void print_timings(const job *j)
{
    const tl_timings *timings = &j->timings;
    double sum = 0.0;
    for (int i = 0; i < timings->count; i++) {
        fprintf(stderr, "%-12s %10.2f ms\n", timings->stages[i].name, timings->stages[i].ms);
        sum += timings->stages[i].ms;
    }
    fprintf(stderr, "%-12s %10.2f ms\n", "sum", sum);
    if (j->first_kernel_ms > 0.0)
        fprintf(stderr, "%-12s %10.2f ms after the process began\n", "first kernel",
                j->first_kernel_ms);
    if (j->shade_processors > 0.0)
        fprintf(stderr, "%-12s %10.2f processors busy in shading\n", "", j->shade_processors);
    if (j->image)
        fprintf(stderr,
                "%-12s %10" PRIu32 " bytes a pixel, %" PRIu32 " of them its position; %s\n",
                "layout", tl_gbuffer_pixel_size(j->gbuffer), position_bytes(j->gbuffer),
                tl_layout_word(j->gbuffer->layout));
}

static json_t *timings_as_json(const tl_timings *timings)
{
    json_t *object = json_object();
    for (int i = 0; i < timings->count; i++)
        json_object_set_new(object, timings->stages[i].name, json_real(timings->stages[i].ms));
    return object;
}

tl_status job_finish(job *j, const report_options *options, tl_error *err)
{
    console_stage(NULL);
    if (options->timings && !j->report)
        print_timings(j);
    if (!j->report)
        return TL_OK;
    if (options->timings) {
        job_report(j, "timings_ms", timings_as_json(&j->timings));
        if (j->first_kernel_ms > 0.0)
            job_report(j, "first_kernel_ms", json_real(j->first_kernel_ms));
        if (j->shade_processors > 0.0)
            job_report(j, "shade_processors", json_real(j->shade_processors));
    }
    return tl_json_write("-", json_incref(j->report), err);
}

void job_drop_pictures(job *j)
{
    tl_image_destroy(j->image);
    j->image = NULL;
    free(j->codes);
    j->codes = NULL;
    for (size_t i = 0; i < j->aovs.count; i++)
        tl_image_destroy(j->aovs.images[i]);
    free(j->aovs.images);
    free(j->aovs.layers);
    j->aovs = (job_aovs){.count = 0};
}

void job_release(job *j)
{
    json_decref(j->report);
    job_drop_pictures(j);
    if (!j->lights_are_lent)
        tl_light_set_clear(&j->lights);
    tl_gbuffer_destroy(j->gbuffer);
    *j = (job){0};
}
