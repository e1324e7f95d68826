#include "pictures.h"

#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double most_pairs = 2e10; /* of a pixel and a light */
static const size_t kept_bytes = (size_t)512 << 20;

static const struct {
    int is_exact;
} compressions[TL_COMPRESSION_COUNT] = {
#define IS_EXACT(name, word, exact, meaning) [name] = {exact},
    TL_COMPRESSIONS(IS_EXACT)
#undef IS_EXACT
};

/* Points to the exact words that this frame and this device allow. */
static void choose_exact(tl_study_pictures *p)
{
    const tl_camera *c = &p->frame->gbuffer->camera;
    const double pairs = (double)c->width * c->height * (double)p->frame->lights.count;
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        p->exact[knob] = tl_study_knobs[knob].exact;
    if (!p->needs.has_occlusion)
        p->exact[TL_STUDY_KNOB_OCCLUSION] = tl_study_knobs[TL_STUDY_KNOB_OCCLUSION].usual;
    if (pairs > most_pairs)
        p->exact[TL_STUDY_KNOB_CULL] = "rect";
    if (pairs > most_pairs && p->needs.has_double)
        p->exact[TL_STUDY_KNOB_PRECISION] = "double";
}

tl_study_needs tl_study_needs_of(const tl_study_frame *frame, const tl_device *device)
{
    tl_study_needs needs = {.present = frame->gbuffer->present,
                            .has_double = tl_device_describe(device).has_double};
    const uint32_t gloss = TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH;
    for (int i = 0; i < 3; i++)
        needs.has_occlusion |=
            frame->lights.occlusion_radius > 0.0f && frame->lights.ambient[i] > 0.0f;
    needs.has_layers = frame->gbuffer->layers.count > 0;
    for (size_t i = 0; i < frame->lights.count; i++)
        needs.has_shadows |=
            frame->lights.lights[i].casts_shadow &&
            tl_shadow_map_of(&frame->gbuffer->shadows, &frame->lights.lights[i]) != NULL;
    for (size_t i = 0; i < frame->lights.count; i++)
        needs.has_highlights |=
            (needs.present & gloss) && frame->lights.lights[i].specular > 0.0f;
    for (size_t i = 0; i < frame->lights.count; i++)
        needs.has_endless |= frame->lights.lights[i].type != TL_LIGHT_DIRECTIONAL &&
                             isinf(frame->lights.lights[i].range);
    return needs;
}

static double mean_of(const tl_image *image)
{
    double sum = 0.0;
    for (unsigned c = 0; c < 3; c++)
        for (size_t y = 0; y < image->height; y++)
            for (size_t x = 0; x < image->width; x++)
                sum += (double)tl_image_plane(image, c)[y * image->pitch + x];
    return sum / (3.0 * image->width * image->height);
}

static tl_status light(tl_study_pictures *p,
                       const tl_study_config *config,
                       tl_image **out,
                       tl_error *err)
{
    const tl_lighting_options options = tl_study_lighting(p, config);
    const tl_gbuffer *gbuffer = NULL;
    tl_image *made = NULL;
    tl_lighting *lighting = NULL;
    tl_status status = TL_OK;
    TRY(tl_study_gbuffer(p, config, &gbuffer, err));
    TRY(tl_image_create(gbuffer->camera.width, gbuffer->camera.height, &made, err));
    TRY(tl_lighting_create(p->device, &options, &lighting, err));
    TRY(tl_lighting_run(lighting, gbuffer, &p->frame->lights, made, NULL, NULL, NULL, err));
    *out = made;
    made = NULL;
done:
    tl_lighting_destroy(lighting);
    tl_image_destroy(made);
    return status;
}

tl_status tl_study_pictures_begin(tl_study_pictures *p,
                                  tl_device *device,
                                  const tl_study_frame *frame,
                                  const char *folder,
                                  tl_error *err)
{
    const tl_study_config usual = tl_study_config_default();
    tl_status status = TL_OK;
    *p = (tl_study_pictures){
        .device = device, .frame = frame, .needs = tl_study_needs_of(frame, device)};
    snprintf(p->file, sizeof p->file, "%s/.study-%ld.exr", folder, (long)getpid());
    choose_exact(p);
    const tl_study_config exact = tl_study_config_up_to(p, &usual, -1);
    TRY(light(p, &exact, &p->reference, err));
    p->mean = mean_of(p->reference);
    if (!(p->mean > 0.0 && isfinite(p->mean)))
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "%s: the frame has a mean radiance of %g, so no error can be told relative "
                    "to it; light it with other --lights",
                    frame->name, p->mean));
    p->exposure = tl_image_auto_exposure(p->reference);
    const size_t bytes = 3 * sizeof(float) * p->reference->pitch * p->reference->rows;
    p->room = kept_bytes / bytes;
    p->room = p->room > TL_STUDY_MOST_KEPT    ? TL_STUDY_MOST_KEPT
              : p->room < TL_STUDY_LEAST_KEPT ? TL_STUDY_LEAST_KEPT
                                              : p->room;
done:
    if (status != TL_OK)
        tl_study_pictures_end(p);
    return status;
}

void tl_study_pictures_end(tl_study_pictures *p)
{
    for (int i = 0; i < TL_STUDY_GBUFFERS_KEPT; i++)
        tl_gbuffer_destroy(p->gbuffers[i].gbuffer);
    for (int i = 0; i < TL_STUDY_MOST_KEPT; i++)
        tl_image_destroy(p->kept[i].image);
    tl_image_destroy(p->reference);
    *p = (tl_study_pictures){0};
}

tl_study_config tl_study_config_up_to(const tl_study_pictures *p,
                                      const tl_study_config *config,
                                      int cause)
{
    tl_study_config made = *config;
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        if ((int)tl_study_knobs[knob].cause > cause)
            tl_study_config_set(&made, (tl_study_knob_name)knob, p->exact[knob], NULL);
    return made;
}

tl_lighting_options tl_study_lighting(const tl_study_pictures *p, const tl_study_config *config)
{
    tl_lighting_options options = config->of.lighting;
    /* A white surface that faces 1 lx has the value 1. */
    options.light_cutoff = (float)(config->cutoff * p->mean);
    return options;
}

/* As another program reads it from its file. */
static tl_status write_and_read(const tl_study_pictures *p,
                                tl_compression compression,
                                tl_gbuffer **gbuffer,
                                tl_error *err)
{
    tl_gbuffer *read = NULL;
    tl_status status = TL_OK;
    TRY(tl_gbuffer_write_compressed(p->file, *gbuffer, NULL, compression, err));
    TRY(tl_gbuffer_read(p->file, &read, NULL, NULL, err));
    TRY(tl_gbuffer_repair(read, p->frame->name, false, NULL, err));
    tl_gbuffer_destroy(*gbuffer);
    *gbuffer = read;
    read = NULL;
done:
    tl_gbuffer_destroy(read);
    unlink(p->file);
    return status;
}

static tl_status make_gbuffer(const tl_study_pictures *p,
                              const tl_study_config *config,
                              tl_gbuffer **out,
                              tl_error *err)
{
    tl_gbuffer *made = NULL;
    tl_status status = TL_OK;
    TRY(tl_gbuffer_pack(p->frame->gbuffer, config->of.layout, &made, NULL, err));
    if (!compressions[config->compression].is_exact)
        TRY(write_and_read(p, config->compression, &made, err));
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}

static int is_same_gbuffer(const tl_study_config *a, const tl_study_config *b)
{
    return a->of.layout == b->of.layout &&
           (a->compression == b->compression ||
            (compressions[a->compression].is_exact && compressions[b->compression].is_exact));
}

tl_status tl_study_gbuffer(tl_study_pictures *p,
                           const tl_study_config *config,
                           const tl_gbuffer **out,
                           tl_error *err)
{
    tl_study_kept_gbuffer *oldest = &p->gbuffers[0];
    tl_gbuffer *made = NULL;
    tl_status status = TL_OK;
    if (config->of.layout == p->frame->gbuffer->layout &&
        compressions[config->compression].is_exact) {
        *out = p->frame->gbuffer;
        return TL_OK;
    }
    for (int i = 0; i < TL_STUDY_GBUFFERS_KEPT; i++) {
        tl_study_kept_gbuffer *kept = &p->gbuffers[i];
        if (kept->gbuffer && is_same_gbuffer(&kept->of, config)) {
            kept->used = ++p->uses;
            *out = kept->gbuffer;
            return TL_OK;
        }
        oldest = kept->used < oldest->used ? kept : oldest;
    }
    TRY(make_gbuffer(p, config, &made, err));
    tl_gbuffer_destroy(oldest->gbuffer);
    *oldest = (tl_study_kept_gbuffer){.of = *config, .gbuffer = made, .used = ++p->uses};
    *out = made;
done:
    return status;
}

/* The output is not part of the radiance. */
static int is_same_picture(const tl_study_config *a, const tl_study_config *b)
{
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        if (tl_study_knobs[knob].cause != TL_STUDY_OUTPUT &&
            knob != TL_STUDY_KNOB_COMPRESSION && strcmp(a->words[knob], b->words[knob]) != 0)
            return 0;
    return is_same_gbuffer(a, b);
}

tl_status tl_study_picture(tl_study_pictures *p,
                           const tl_study_config *config,
                           const tl_image **out,
                           tl_error *err)
{
    const tl_study_config exact = tl_study_config_up_to(p, config, -1);
    tl_study_kept_picture *oldest = &p->kept[0];
    tl_image *made = NULL;
    tl_status status = TL_OK;
    if (is_same_picture(&exact, config)) {
        *out = p->reference;
        return TL_OK;
    }
    for (size_t i = 0; i < p->room; i++) {
        tl_study_kept_picture *kept = &p->kept[i];
        if (kept->image && is_same_picture(&kept->of, config)) {
            kept->used = ++p->uses;
            *out = kept->image;
            return TL_OK;
        }
        oldest = kept->used < oldest->used ? kept : oldest;
    }
    TRY(light(p, config, &made, err));
    tl_image_destroy(oldest->image);
    *oldest = (tl_study_kept_picture){.of = *config, .image = made, .used = ++p->uses};
    *out = made;
done:
    return status;
}
