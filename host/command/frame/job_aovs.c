#include "job_aovs.h"

#include "console.h"
#include "tilelight/light_groups.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const term_words[] = {
#define WORD(name, word, meaning) [name] = word,
    TL_AOVS(WORD)
#undef WORD
};

/* Of a picture of pixels, in place of one of samples. */
static tl_status resolve(const job *j, tl_image **image, tl_error *err)
{
    const uint32_t side = tl_samples_side(j->gbuffer->samples);
    tl_image *pixels = NULL;
    if (side == 1)
        return TL_OK;
    const tl_status status = tl_image_resolve(*image, side, &pixels, err);
    if (status != TL_OK)
        return status;
    tl_image_destroy(*image);
    *image = pixels;
    return TL_OK;
}

/* Room for `more`. */
static tl_status reserve(job_aovs *aovs, size_t more, tl_error *err)
{
    const size_t count = aovs->count + more;
    tl_image_layer *layers = realloc(aovs->layers, count * sizeof *layers);
    if (layers)
        aovs->layers = layers;
    tl_image **images = realloc(aovs->images, count * sizeof(tl_image *));
    if (images)
        aovs->images = images;
    if (!layers || !images)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu layers", count);
    return TL_OK;
}

/* Takes `image`, which may be NULL. There is room. */
static void add(
    job_aovs *aovs, const char *prefix, const char *name, const float *planes, tl_image *image)
{
    tl_image_layer *layer = &aovs->layers[aovs->count];
    snprintf(layer->name, sizeof layer->name, "%s%s", prefix, name);
    /* What stands behind a point is a channel to whoever reads the file. */
    for (char *at = layer->name; (at = strchr(at, '.')) != NULL;)
        *at = '_';
    layer->planes = planes;
    aovs->images[aovs->count++] = image;
}

/* --- terms ------------------------------------------------------------------------------------------- */

/* A copy of the picture without its parts. */
static tl_status picture_alone(const tl_image *from, tl_image **out, tl_error *err)
{
    const tl_status status = tl_image_create(from->width, from->height, out, err);
    if (status == TL_OK)
        memcpy((*out)->planes, from->planes,
               3 * (size_t)from->pitch * from->rows * sizeof(float));
    return status;
}

static tl_status take_terms(job *j, uint32_t split, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *parts = NULL, *alone = NULL;
    if (split == 0)
        return TL_OK;
    TRY(picture_alone(j->image, &alone, err));
    parts = j->image;
    j->image = alone;
    TRY(resolve(j, &parts, err));
    TRY(reserve(&j->aovs, TL_AOVS_IN(split), err));
    tl_image *owned = parts;
    for (uint32_t term = 0; term < TL_AOV_COUNT; term++)
        if (split >> term & 1u) {
            add(&j->aovs, "", term_words[term],
                tl_image_plane(parts, TL_AOV_PLANE(split, term)), owned);
            owned = NULL; /* the others share it */
        }
    return TL_OK;
done:
    tl_image_destroy(parts);
    return status;
}

/* --- groups ------------------------------------------------------------------------------------------ */

/* What all groups have in common. */
typedef struct grouping {
    job *j;
    tl_lighting *lighting; /* the lighter's */
    uint8_t *lit;          /* [lights] */
} grouping;

/* group: "" of the rest, which is more than lamps. */
static tl_status light_group(const grouping *g,
                             const char *group,
                             tl_image **out,
                             tl_error *err)
{
    job *j = g->j;
    const tl_camera *camera = &j->gbuffer->camera;
    const tl_light_part part = {.lit = g->lit, .alone = group[0] != '\0'};
    tl_status status = TL_OK;
    for (size_t i = 0; i < j->lights.count; i++)
        g->lit[i] = strcmp(j->lights.lights[i].group, group) == 0;
    TRY(tl_image_create(camera->width, camera->height, out, err));
    TRY(tl_lighting_run_part(g->lighting, j->gbuffer, &j->lights, &part, *out, NULL, NULL, NULL,
                             err));
    tl_lighting_let_go(g->lighting); /* for the image may make room for one of pixels */
    TRY(resolve(j, out, err));
done:
    return status;
}

static tl_status add_group(
    const grouping *g, const char *prefix, const char *name, const char *group, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *image = NULL;
    TRY(light_group(g, group, &image, err));
    TRY(reserve(&g->j->aovs, 1, err));
    add(&g->j->aovs, prefix, name, image->planes, image);
    image = NULL;
done:
    tl_image_destroy(image);
    return status;
}

/* Names of layers are those of groups but for points. */
static tl_status check_names(const job_aovs *aovs, tl_error *err)
{
    for (size_t i = 0; i < aovs->count; i++)
        for (size_t k = 0; k < i; k++)
            if (strcmp(aovs->layers[i].name, aovs->layers[k].name) == 0)
                return tl_fail(
                    err, TL_ERR_ARGUMENT,
                    "two groups of lights would be the layer \"%s\", in which a point "
                    "cannot be: rename one",
                    aovs->layers[i].name);
    return TL_OK;
}

static tl_status take_groups(job *j,
                             const tl_lighting_options *options,
                             lighter *with,
                             tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    tl_lighting_options of_groups = *options;
    tl_light_group *groups = NULL;
    size_t count = 0;
    grouping g = {.j = j, .lit = malloc(j->lights.count + 1)};
    of_groups.split = 0;
    if (!g.lit)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu lights", j->lights.count));
    TRY(tl_light_groups_find(&j->lights, &groups, &count, err));
    if (count == 0)
        tl_notice(&console_notices,
                  "no light is in a group: the layer `rest' is the whole picture; \"group\" of "
                  "lights in a lights file names one");
    TRY(lighter_lighting(with, &with->groups, &of_groups, err));
    g.lighting = with->groups;
    for (size_t i = 0; i < count; i++)
        TRY(add_group(&g, "light_", groups[i].name, groups[i].name, err));
    TRY(add_group(&g, "", "rest", "", err));
    TRY(check_names(&j->aovs, err));
    tl_timings_end(&j->timings, "groups", start);
done:
    free(groups);
    free(g.lit);
    return status;
}

static void report(job *j)
{
    json_t *names = json_array();
    for (size_t i = 0; i < j->aovs.count; i++)
        json_array_append_new(names, json_string(j->aovs.layers[i].name));
    job_report(j, "aovs", names);
}

tl_status job_take_aovs(job *j, const lighting_choice *choice, lighter *with, tl_error *err)
{
    tl_status status = TL_OK;
    if (choice->options.split == 0 && !choice->groups)
        return TL_OK;
    TRY(take_terms(j, choice->options.split, err));
    if (choice->groups)
        TRY(take_groups(j, &choice->options, with, err));
    report(j);
done:
    return status;
}
