#include "steps.h"

#include "tilelight/compare.h"
#include "tilelight/flip.h"
#include "try.h"
#include "worst.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const tl_look our_look = {0};

/* The causes that lighting has; the last is the output's. */
enum { LIT = TL_STUDY_OUTPUT };

/* After each cause, the picture so far, in the numbers of the output. */
typedef struct chain {
    tl_image *owned[1 + TL_STUDY_CAUSE_COUNT];       /* what had to be made for it */
    const tl_image *after[1 + TL_STUDY_CAUSE_COUNT]; /* [0]: the reference */
} chain;

static void clear(chain *c)
{
    for (int i = 0; i <= TL_STUDY_CAUSE_COUNT; i++)
        tl_image_destroy(c->owned[i]);
}

static tl_status copy_of(const tl_image *image, tl_image **out, tl_error *err)
{
    const tl_status status = tl_image_create(image->width, image->height, out, err);
    if (status == TL_OK)
        memcpy((*out)->planes, image->planes, 3 * sizeof(float) * image->pitch * image->rows);
    return status;
}

/* What a file of half floats holds of it. */
static tl_status through_file(const tl_image *image,
                              const char *path,
                              tl_image **out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    TRY(tl_image_write_exr(path, image, (tl_exr_form){.half = 1}, err));
    TRY(tl_image_read(path, out, NULL, err));
done:
    unlink(path);
    return status;
}

/* 8 bits as a PNG has them, as numbers from 0 to 1. */
static tl_status codes_of(const tl_image *image, float exposure, tl_image **out, tl_error *err)
{
    const size_t count = 3 * (size_t)image->width * image->height;
    tl_status status = TL_OK;
    uint8_t *rgb = malloc(count);
    if (!rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                    image->width, image->height));
    TRY(tl_image_create(image->width, image->height, out, err));
    tl_image_to_rgb8(image, exposure, our_look, rgb);
    for (size_t i = 0; i < count; i++) {
        const size_t x = i / 3 % image->width, y = i / 3 / image->width;
        tl_image_plane(*out, (unsigned)(i % 3))[y * (*out)->pitch + x] = (float)rgb[i] / 255.0f;
    }
done:
    free(rgb);
    return status;
}

/* The last link: the file's numbers. */
static tl_status add_output(const tl_study_pictures *p,
                            const tl_study_config *config,
                            const tl_image *lit,
                            chain *c,
                            tl_error *err)
{
    tl_status status = TL_OK;
    tl_image **owned = &c->owned[1 + TL_STUDY_OUTPUT];
    if (config->output == TL_STUDY_PNG) {
        TRY(codes_of(lit, p->exposure, owned, err));
    } else if (config->output == TL_STUDY_HALF) {
        TRY(through_file(lit, p->file, owned, err));
    }
    c->after[1 + TL_STUDY_OUTPUT] = *owned ? *owned : lit;
done:
    return status;
}

/* Radiance becomes what a screen shows; where nothing changed, nothing changes. */
static tl_status show(const tl_study_pictures *p, chain *c, tl_error *err)
{
    tl_status status = TL_OK;
    const tl_image *lit[1 + LIT];
    memcpy(lit, c->after, sizeof lit);
    for (int i = 0; i <= LIT; i++) {
        if (i > 0 && lit[i] == lit[i - 1]) {
            c->after[i] = c->after[i - 1];
            continue;
        }
        TRY(copy_of(lit[i], &c->owned[i], err));
        tl_image_to_screen(c->owned[i], p->exposure, our_look);
        c->after[i] = c->owned[i];
    }
done:
    return status;
}

static tl_status make_chain(tl_study_pictures *p,
                            const tl_study_config *config,
                            chain *c,
                            tl_error *err)
{
    tl_status status = TL_OK;
    c->after[0] = p->reference;
    for (int cause = 0; cause < LIT; cause++) {
        const tl_study_config so_far = tl_study_config_up_to(p, config, cause);
        TRY(tl_study_picture(p, &so_far, &c->after[1 + cause], err));
    }
    TRY(add_output(p, config, c->after[LIT], c, err));
    if (tl_study_is_for_screen(config))
        TRY(show(p, c, err));
done:
    return status;
}

static double value_at(const tl_image *image, const tl_difference *d)
{
    return (double)tl_image_plane(image,
                                  d->worst_channel)[d->worst_y * image->pitch + d->worst_x];
}

/* What each cause changes, relative to the reference's mean. */
static tl_status find_causes(const chain *c,
                             const tl_difference *whole,
                             tl_study_record *record,
                             tl_error *err)
{
    tl_status status = TL_OK;
    double *v = record->values;
    for (int cause = 0; cause < TL_STUDY_CAUSE_COUNT; cause++) {
        const tl_image *before = c->after[cause], *after = c->after[1 + cause];
        tl_difference d = {0};
        if (before != after)
            TRY(tl_compare(after, before, &d, err));
        v[TL_VALUE_RMS_STORAGE + cause] = d.rms / whole->mean_value;
        v[TL_VALUE_MOST_STORAGE + cause] = d.max / whole->mean_value;
        v[TL_VALUE_WORST_STORAGE + cause] = value_at(after, whole) - value_at(before, whole);
        if (cause == TL_STUDY_CULLING)
            v[TL_VALUE_CULLING_DIFFERING] = (double)d.different_count;
    }
done:
    return status;
}

static void note_whole(const tl_difference *d, double *v, const tl_image *image)
{
    v[TL_VALUE_ERROR_RMS] = d->relative_rms;
    v[TL_VALUE_ERROR_MEAN] = d->relative_mean;
    v[TL_VALUE_ERROR_P999] = d->relative_p999;
    v[TL_VALUE_ERROR_MAX] = d->relative_max;
    v[TL_VALUE_PSNR] = d->psnr;
    v[TL_VALUE_DIFFERING] = (double)d->different_count / (3.0 * image->width * image->height);
    v[TL_VALUE_WORST_X] = d->worst_x;
    v[TL_VALUE_WORST_Y] = d->worst_y;
    v[TL_VALUE_WORST_CHANNEL] = d->worst_channel;
    v[TL_VALUE_WORST_GOT] = (double)d->worst_a;
    v[TL_VALUE_WORST_EXPECTED] = (double)d->worst_b;
}

/* Of 8 bits of both. */
static void note_codes(const tl_image *seen, const tl_image *expected, double *v)
{
    uint64_t beyond = 0;
    int most = 0;
    for (unsigned channel = 0; channel < 3; channel++)
        for (size_t y = 0; y < seen->height; y++)
            for (size_t x = 0; x < seen->width; x++) {
                const float a = tl_image_plane(seen, channel)[y * seen->pitch + x];
                const float b = tl_image_plane(expected, channel)[y * expected->pitch + x];
                const int off = abs((int)lrintf(255.0f * a) - (int)lrintf(255.0f * b));
                beyond += off > 1;
                most = off > most ? off : most;
            }
    v[TL_VALUE_SCREEN_MAX] = most;
    v[TL_VALUE_SCREEN_BEYOND] = (double)beyond / (3.0 * seen->width * seen->height);
}

/* What would be seen: of the screen's 8 bits, and FLIP of the output's own numbers. */
static tl_status find_visible(const tl_study_pictures *p,
                              const tl_study_config *config,
                              const chain *c,
                              const tl_image *lit,
                              tl_study_record *record,
                              tl_error *err)
{
    const int is_screen = tl_study_is_for_screen(config);
    tl_image *seen = NULL, *expected = NULL;
    tl_flip flip;
    tl_status status = TL_OK;
    TRY(codes_of(lit, p->exposure, &seen, err));
    TRY(codes_of(p->reference, p->exposure, &expected, err));
    note_codes(seen, expected, record->values);
    TRY(tl_flip_compare(c->after[TL_STUDY_CAUSE_COUNT], c->after[0],
                        is_screen ? TL_FLIP_SCREEN : TL_FLIP_RADIANCE,
                        TL_FLIP_PIXELS_PER_DEGREE, NULL, &flip, err));
    record->values[TL_VALUE_FLIP] = flip.mean;
    record->values[TL_VALUE_FLIP_MAX] = flip.max;
done:
    tl_image_destroy(seen);
    tl_image_destroy(expected);
    return status;
}

static int is_of(const tl_study_pictures *p,
                 const tl_study_config *config,
                 int knob,
                 tl_study_cause cause)
{
    return tl_study_knobs[knob].cause == cause &&
           strcmp(config->words[knob], p->exact[knob]) != 0;
}

/* How much a knob of a cause adds at the worst value alone, all earlier causes being as configured. */
static tl_status find_share(
    tl_study_pictures *p, const tl_study_record *record, int knob, double *share, tl_error *err)
{
    const tl_study_cause cause = tl_study_knobs[knob].cause;
    const size_t x = (size_t)record->values[TL_VALUE_WORST_X],
                 y = (size_t)record->values[TL_VALUE_WORST_Y];
    const unsigned channel = (unsigned)record->values[TL_VALUE_WORST_CHANNEL];
    const tl_study_config before = tl_study_config_up_to(p, &record->config, (int)cause - 1);
    tl_study_config alone = before;
    const tl_image *without = NULL, *with = NULL;
    tl_status status = TL_OK;
    TRY(tl_study_config_set(&alone, (tl_study_knob_name)knob, record->config.words[knob], err));
    TRY(tl_study_picture(p, &before, &without, err));
    TRY(tl_study_picture(p, &alone, &with, err));
    *share = fabs((double)tl_image_plane(with, channel)[y * with->pitch + x] -
                  (double)tl_image_plane(without, channel)[y * without->pitch + x]);
done:
    return status;
}

/* The knob of the cause with its word; of several the one that alone adds most there. */
static tl_status name_knob(tl_study_pictures *p,
                           tl_study_cause cause,
                           tl_study_record *record,
                           tl_error *err)
{
    const tl_study_config *config = &record->config;
    int count = 0, named = -1;
    double most = -1.0, share = 0.0;
    tl_status status = TL_OK;
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        count += is_of(p, config, knob, cause);
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++) {
        if (!is_of(p, config, knob, cause))
            continue;
        if (count > 1)
            TRY(find_share(p, record, knob, &share, err));
        if (share > most) {
            most = share;
            named = knob;
        }
    }
    if (named >= 0)
        snprintf(record->worst_detail, sizeof record->worst_detail, "%s=%.48s",
                 tl_study_knobs[named].name, config->words[named]);
done:
    return status;
}

static tl_status find_worst(tl_study_pictures *p, tl_study_record *record, tl_error *err)
{
    const double *at = &record->values[TL_VALUE_WORST_STORAGE];
    const char *attribute = "";
    int worst = 0;
    tl_status status = TL_OK;
    for (int cause = 1; cause < TL_STUDY_CAUSE_COUNT; cause++)
        worst = fabs(at[cause]) > fabs(at[worst]) ? cause : worst;
    if (at[worst] == 0.0)
        goto done;
    snprintf(record->worst_cause, sizeof record->worst_cause, "%s",
             tl_study_cause_words[worst]);
    TRY(tl_study_worst_find(p, &record->config, (uint32_t)record->values[TL_VALUE_WORST_X],
                            (uint32_t)record->values[TL_VALUE_WORST_Y],
                            (uint32_t)record->values[TL_VALUE_WORST_CHANNEL], &attribute,
                            &record->values[TL_VALUE_WORST_HIGHLIGHT], err));
    if (worst == TL_STUDY_STORAGE)
        snprintf(record->worst_detail, sizeof record->worst_detail, "%s", attribute);
    else
        TRY(name_knob(p, (tl_study_cause)worst, record, err));
done:
    return status;
}

static void fill_map(const tl_image *seen, const tl_image *expected, double mean, float *map)
{
    for (size_t y = 0; y < seen->height; y++)
        for (size_t x = 0; x < seen->width; x++) {
            double most = 0.0;
            for (unsigned c = 0; c < 3; c++)
                most = fmax(most,
                            fabs((double)tl_image_plane(seen, c)[y * seen->pitch + x] -
                                 (double)tl_image_plane(expected, c)[y * expected->pitch + x]));
            map[y * seen->width + x] = (float)(most / mean);
        }
}

tl_status tl_study_steps_find(tl_study_pictures *p,
                              tl_study_record *record,
                              float *map,
                              tl_error *err)
{
    chain c = {0};
    tl_difference whole;
    const tl_image *lit = NULL;
    tl_status status = TL_OK;
    TRY(make_chain(p, &record->config, &c, err));
    TRY(tl_study_picture(p, &record->config, &lit, err));
    TRY(tl_compare(c.after[TL_STUDY_CAUSE_COUNT], c.after[0], &whole, err));
    note_whole(&whole, record->values, c.after[0]);
    TRY(find_causes(&c, &whole, record, err));
    TRY(find_visible(p, &record->config, &c, lit, record, err));
    TRY(find_worst(p, record, err));
    if (map)
        fill_map(c.after[TL_STUDY_CAUSE_COUNT], c.after[0], whole.mean_value, map);
done:
    clear(&c);
    return status;
}
