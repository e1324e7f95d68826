#include "job_pictures.h"

#include "console.h"
#include "output.h"
#include "ranges.h"
#include "try.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

/* Beyond this many stops from where `auto` would be, a PNG shows next to nothing. */
static const float far_off_stops = 6.0f;

static float choose_exposure(job *j, const picture_options *options)
{
    const float automatic = tl_image_auto_exposure(j->image);
    const float chosen = options->automatic ? automatic : options->exposure;
    if (fabsf(automatic - chosen) > far_off_stops)
        tl_notice(&console_notices,
                  "the picture is very %s at %+.1f stops; --exposure auto would choose %+.1f",
                  automatic > chosen ? "dark" : "bright", (double)chosen, (double)automatic);
    job_report(j, "exposure", json_real((double)chosen));
    return chosen;
}

/* What of a capture's own look is not ours, and how to have ours. */
static void tell_look(const job *j, const picture_options *options, tl_look look)
{
    static const tl_look ours = {0};
    const bool tone = !options->tone_given && look.tone != ours.tone;
    const bool curve = !options->curve_given && look.curve != ours.curve;
    if (!j->has_look || (!tone && !curve))
        return;
    tl_notice(
        &console_notices,
        "the picture is shown as the capture's own program does, with tone %s and curve %s; "
        "%s%s%s%s brings ours",
        picture_tone_word(look.tone), picture_curve_word(look.curve), tone ? "--tone " : "",
        tone ? picture_tone_word(ours.tone) : "",
        tone && curve ? " --curve "
        : curve       ? "--curve "
                      : "",
        curve ? picture_curve_word(ours.curve) : "");
}

/* What a picture loses in halves. */
static void tell_cut(const tl_image *image, const char *path)
{
    const uint64_t count = tl_image_count_above(image, TL_MOST_HALF);
    if (count > 0)
        tl_notice(&console_notices,
                  "%s: %" PRIu64 " pixels are brighter than half floats can say, and have the "
                  "largest, 65504; --exr float keeps them",
                  path, count);
}

/* A job's pictures as they are written. */
typedef struct writing {
    const job *j;
    const picture_options *options;
    tl_look look;
} writing;

static writing writing_of(const job *j, const picture_options *options)
{
    return (writing){.j = j,
                     .options = options,
                     .look = picture_look(options, j->has_look ? &j->look : NULL)};
}

static tl_status show_on_device(job *j,
                                const tl_lighting_options *lighting,
                                lighter *with,
                                float exposure,
                                tl_look look,
                                tl_error *err)
{
    static const tl_post_options nothing = {.mend = 0};
    tl_status status = TL_OK;
    TRY(lighter_post(with, lighting, &nothing, err));
    TRY(tl_post_codes(with->post, j->image, exposure, look, j->codes, &j->timings, NULL, err));
done:
    return status;
}

static tl_status write_png(const writing *w, const char *path, tl_error *err)
{
    const tl_png_picture picture = {.codes = w->j->codes,
                                    .width = w->j->image->width,
                                    .height = w->j->image->height,
                                    .depth = w->options->depth == 16 ? 16 : 8,
                                    .curve = w->look.curve,
                                    .record = w->options->record};
    return tl_png_write_picture(path, &picture, err);
}

static tl_status write_exr(const writing *w, const char *path, tl_error *err)
{
    const job_aovs *aovs = &w->j->aovs;
    tl_exr_form form = w->options->exr;
    form.record = w->options->record;
    if (form.half)
        tell_cut(w->j->image, path);
    return tl_image_write_layers(path, w->j->image, aovs->layers, aovs->count, form, err);
}

static tl_status write_pfm(const writing *w, const char *path, tl_error *err)
{
    return tl_image_write_pfm(path, w->j->image, err);
}

static json_t *png_numbers(const writing *w)
{
    return json_pack("{si ss ss ss}", "bits", w->options->depth == 16 ? 16 : 8, "tone",
                     picture_tone_word(w->look.tone), "curve",
                     picture_curve_word(w->look.curve), "dither",
                     picture_dither_word(w->look.dither));
}

static json_t *exr_numbers(const writing *w)
{
    return json_pack("{ss ss}", "numbers", w->options->exr.half ? "half" : "float",
                     "compression", picture_exr_word(w->options->exr));
}

static json_t *pfm_numbers(const writing *w)
{
    (void)w;
    return json_pack("{ss}", "numbers", "float");
}

static const struct {
    int kinds; /* of output.h */
    const char *name;
    bool has_codes;
    tl_status (*write)(const writing *w, const char *path, tl_error *err);
    json_t *(*numbers)(const writing *w); /* for the report: what stands in it */
} formats[] = {
    {OUTPUT_PNG | OUTPUT_STANDARD, "PNG", true, write_png, png_numbers},
    {OUTPUT_EXR, "OpenEXR", false, write_exr, exr_numbers},
    {OUTPUT_PFM | OUTPUT_STANDARD_PFM, "PFM", false, write_pfm, pfm_numbers},
};

/* What the report says of one. */
static json_t *describe(const writing *w, const char *path, size_t format)
{
    json_t *said = json_pack("{ss ss s[ii]}", "file", path, "format", formats[format].name,
                             "size", (int)w->j->image->width, (int)w->j->image->height);
    json_t *numbers = formats[format].numbers(w);
    json_object_update(said, numbers);
    json_decref(numbers);
    return said;
}

static size_t format_of(int kind)
{
    size_t format = 0;
    while (!(formats[format].kinds & kind))
        format++;
    return format;
}

static bool any_has_codes(const picture_options *options)
{
    for (int i = 0; i < options->count; i++)
        if (formats[format_of(options->kinds[i])].has_codes)
            return true;
    return false;
}

tl_status job_show_pictures(job *j,
                            const picture_options *options,
                            const tl_lighting_options *lighting,
                            lighter *with,
                            tl_error *err)
{
    const tl_image *image = j->image;
    const bool is_deep = options->depth == 16;
    const writing w = writing_of(j, options);
    tl_status status = TL_OK;
    if (!any_has_codes(options))
        return TL_OK;
    const double start = tl_seconds();
    j->codes = malloc((is_deep ? 6 : 3) * (size_t)image->width * image->height);
    if (!j->codes)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                       image->width, image->height);
    tell_look(j, options, w.look);
    const float exposure = choose_exposure(j, options);
    if (is_deep)
        tl_image_to_rgb16(image, exposure, w.look, j->codes);
    else if (with->device && !tl_look_has_thresholds(w.look))
        status = show_on_device(j, lighting, with, exposure, w.look, err);
    else
        tl_image_to_rgb8(image, exposure, w.look, j->codes);
    tl_timings_end(&j->timings, "tone", start);
    return status;
}

tl_status job_write_pictures(job *j, const picture_options *options, tl_error *err)
{
    const writing w = writing_of(j, options);
    tl_status status = TL_OK;
    json_t *list = json_array();
    console_stage("writing");
    for (int i = 0; i < options->count; i++) {
        const size_t format = format_of(options->kinds[i]);
        const double start = tl_seconds();
        TRY(formats[format].write(&w, options->paths[i], err));
        tl_timings_end(&j->timings, "write", start);
        json_array_append_new(list, describe(&w, options->paths[i], format));
    }
    job_report(j, "outputs", json_incref(list));
done:
    json_decref(list);
    return status;
}
