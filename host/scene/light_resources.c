#include "light_resources.h"

#include "largest.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const float quarter_turn = 1.57079637f; /* as files have pi/2 */
static const float most_rotation = 1e6f;       /* rad; beyond, a float's steps are coarse */

tl_status tl_light_refuse(const tl_light *light,
                          size_t index,
                          const char *source,
                          tl_error *err,
                          const char *format,
                          ...)
{
    const char *before = light->name[0] ? " \"" : "", *behind = light->name[0] ? "\"" : "";
    char reason[512];
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    return tl_fail(err, TL_ERR_FORMAT, "%s: lights[%zu]%s%s%s: %s", source, index, before,
                   light->name, behind, reason);
}

/* Room for one more of `size` bytes. */
static tl_status grow(void **array, size_t count, size_t size, tl_error *err)
{
    void *const grown = realloc(*array, (count + 1) * size);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for what belongs to lights");
    *array = grown;
    return TL_OK;
}

/* Room for one more that has a path, and a copy of that, which the caller frees. */
static tl_status grow_named(
    void **array, size_t count, size_t size, const char *path, char **copy, tl_error *err)
{
    const size_t length = strlen(path) + 1;
    char *const made = malloc(length);
    const tl_status status = made ? grow(array, count, size, err)
                                  : tl_fail(err, TL_ERR_MEMORY, "out of memory for a path");
    if (status != TL_OK) {
        free(made);
        return status;
    }
    memcpy(made, path, length);
    *copy = made;
    return TL_OK;
}

tl_status tl_light_set_add_table(
    tl_light_set *set, const float *values, uint32_t count, uint32_t *out, tl_error *err)
{
    float *const copy = malloc(count * sizeof *copy);
    tl_status status = copy ? TL_OK : tl_fail(err, TL_ERR_MEMORY, "out of memory for a table");
    if (status == TL_OK)
        status = grow((void **)&set->tables, set->table_count, sizeof *set->tables, err);
    if (status != TL_OK) {
        free(copy);
        return status;
    }
    memcpy(copy, values, count * sizeof *copy);
    set->tables[set->table_count++] = (tl_light_table){.count = count, .values = copy};
    *out = (uint32_t)set->table_count;
    return TL_OK;
}

tl_status tl_light_set_add_image(tl_light_set *set,
                                 const char *path,
                                 uint32_t width,
                                 uint32_t height,
                                 float *pixels,
                                 uint32_t *out,
                                 tl_error *err)
{
    char *copy = NULL;
    const tl_status status = grow_named((void **)&set->images, set->image_count,
                                        sizeof *set->images, path, &copy, err);
    if (status != TL_OK) {
        free(pixels);
        return status;
    }
    set->images[set->image_count++] =
        (tl_light_image){.path = copy, .width = width, .height = height, .pixels = pixels};
    *out = (uint32_t)set->image_count;
    return TL_OK;
}

tl_status tl_light_set_add_profile(tl_light_set *set,
                                   const char *path,
                                   const tl_light_profile *profile,
                                   uint32_t *out,
                                   tl_error *err)
{
    char *copy = NULL;
    const tl_status status = grow_named((void **)&set->profiles, set->profile_count,
                                        sizeof *set->profiles, path, &copy, err);
    if (status != TL_OK) {
        free(profile->shares);
        return status;
    }
    set->profiles[set->profile_count] = *profile;
    set->profiles[set->profile_count++].path = copy;
    *out = (uint32_t)set->profile_count;
    return TL_OK;
}

double tl_light_candela(const tl_light_set *set, const tl_light *light)
{
    const double intensity = (double)light->intensity;
    if (light->profile == 0 || light->profile_scale == TL_PROFILE_PEAK)
        return intensity;
    return intensity * set->profiles[light->profile - 1].peak;
}

static int is_same_link(const tl_light_link *a, const tl_light_link *b)
{
    if (a->except != b->except || a->count != b->count)
        return 0;
    for (size_t i = 0; i < a->count; i++)
        if (a->of[i].id != b->of[i].id || strcmp(a->of[i].name, b->of[i].name) != 0)
            return 0;
    return 1;
}

tl_status tl_light_set_add_link(tl_light_set *set,
                                const tl_light_link *link,
                                uint32_t *out,
                                tl_error *err)
{
    for (size_t i = 0; i < set->link_count; i++)
        if (is_same_link(&set->links[i], link)) {
            *out = (uint32_t)i + 1;
            return TL_OK;
        }
    tl_link_object *const copy = calloc(link->count + 1, sizeof *copy);
    tl_status status = copy ? TL_OK : tl_fail(err, TL_ERR_MEMORY, "out of memory for a link");
    if (status == TL_OK)
        status = grow((void **)&set->links, set->link_count, sizeof *set->links, err);
    if (status != TL_OK) {
        free(copy);
        return status;
    }
    memcpy(copy, link->of, link->count * sizeof *copy);
    set->links[set->link_count++] =
        (tl_light_link){.except = link->except, .count = link->count, .of = copy};
    *out = (uint32_t)set->link_count;
    return TL_OK;
}

int tl_light_set_has_sky(const tl_light_set *set)
{
    if (set->sky_type == TL_SKY_IMAGE)
        return set->sky_intensity > 0.0f;
    for (int i = 0; i < 3; i++)
        if (set->sky[i] > 0.0f || set->zenith[i] > 0.0f || set->ground[i] > 0.0f)
            return 1;
    return 0;
}

int tl_light_set_is_lit_by_sky(const tl_light_set *set)
{
    return set->sky_light > 0.0f && tl_light_set_has_sky(set);
}

void tl_light_resources_clear(tl_light_set *set)
{
    for (size_t i = 0; i < set->table_count; i++)
        free(set->tables[i].values);
    for (size_t i = 0; i < set->image_count; i++) {
        free(set->images[i].path);
        free(set->images[i].pixels);
    }
    for (size_t i = 0; i < set->profile_count; i++) {
        free(set->profiles[i].path);
        free(set->profiles[i].shares);
    }
    for (size_t i = 0; i < set->link_count; i++)
        free(set->links[i].of);
    free(set->links);
    free(set->tables);
    free(set->images);
    free(set->profiles);
    free(set->folder);
}

static tl_status check_table(const tl_light_set *set,
                             size_t index,
                             const char *source,
                             tl_error *err)
{
    const tl_light *light = &set->lights[index];
    const int has_table = light->table > 0 && light->table <= set->table_count;
    if (light->falloff != TL_FALLOFF_TABLE && light->table > 0)
        return tl_light_refuse(light, index, source, err,
                               "\"lut\" is for a falloff table; remove it, or say "
                               "\"falloff\": \"lut\"");
    if (light->falloff != TL_FALLOFF_TABLE)
        return TL_OK;
    if (!has_table)
        return tl_light_refuse(light, index, source, err,
                               "the falloff \"lut\" needs its table: \"lut\": "
                               "[numbers, from distance 0 to the range]");
    const tl_light_table *table = &set->tables[light->table - 1];
    if (table->count < TL_LEAST_SAMPLES || table->count > TL_MOST_SAMPLES)
        return tl_light_refuse(light, index, source, err,
                               "lut has %u numbers, it must have %d to %d", table->count,
                               TL_LEAST_SAMPLES, TL_MOST_SAMPLES);
    for (uint32_t i = 0; i < table->count; i++)
        if (!(table->values[i] >= 0.0f && table->values[i] <= TL_MOST_WEIGHT))
            return tl_light_refuse(light, index, source, err,
                                   "lut[%u] is %g, it must be from 0 to %g", i,
                                   (double)table->values[i], (double)TL_MOST_WEIGHT);
    return TL_OK;
}

/* Up may be left to us; given, it must not be along the axis of a spot or a profile. */
static tl_status check_up(const tl_light *light,
                          size_t index,
                          const char *source,
                          tl_error *err)
{
    static const double least_sine2 = 1e-8;
    const float *u = light->up, *d = light->direction;
    double length2 = 0.0, along = 0.0;
    for (int i = 0; i < 3; i++) {
        length2 += (double)u[i] * (double)u[i];
        along += (double)u[i] * (double)d[i];
    }
    if (!(length2 > 0.0))
        return isnan(length2) ? tl_light_refuse(light, index, source, err, "up is no number")
                              : TL_OK;
    if (light->texture == 0 && light->profile == 0)
        return tl_light_refuse(light, index, source, err,
                               "up says where the top of a texture is, or C0 of a profile, and "
                               "there is neither; remove it");
    if (!(fabs(length2 - 1.0) <= 1e-3))
        return tl_light_refuse(light, index, source, err, "up (%g, %g, %g) is not of length 1",
                               (double)u[0], (double)u[1], (double)u[2]);
    if ((light->type == TL_LIGHT_SPOT || light->profile > 0) &&
        !(length2 - along * along > least_sine2))
        return tl_light_refuse(light, index, source, err,
                               "up is along the direction of the light: the "
                               "%s; choose another",
                               light->profile > 0 ? "profile would have no plane C0"
                                                  : "texture would have no top");
    return TL_OK;
}

static tl_status check_texture(const tl_light_set *set,
                               size_t index,
                               const char *source,
                               tl_error *err)
{
    const tl_light *light = &set->lights[index];
    if (light->texture == 0)
        return TL_OK;
    if (light->texture > set->image_count)
        return tl_light_refuse(light, index, source, err, "there is no image %u",
                               light->texture);
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return tl_light_refuse(light, index, source, err,
                               "a directional light has no \"texture\"; remove it");
    if (light->type == TL_LIGHT_SPOT && !(light->outer_cone < quarter_turn))
        return tl_light_refuse(
            light, index, source, err,
            "outerConeAngle is %g; a texture is projected over "
            "a cone, which must then be below pi/2: narrow it, or make it a point light",
            (double)light->outer_cone);
    return TL_OK;
}

static tl_status check_profile(const tl_light_set *set,
                               size_t index,
                               const char *source,
                               tl_error *err)
{
    const tl_light *light = &set->lights[index];
    if ((unsigned)light->profile_scale >= TL_PROFILE_SCALE_COUNT)
        return tl_light_refuse(light, index, source, err, "there is no profileScale %u",
                               (unsigned)light->profile_scale);
    if (light->profile == 0 && light->profile_scale != TL_PROFILE_CANDELA)
        return tl_light_refuse(light, index, source, err,
                               "profileScale says what a profile is scaled by, and there is "
                               "none; remove it");
    if (light->profile == 0)
        return TL_OK;
    if (light->profile > set->profile_count)
        return tl_light_refuse(light, index, source, err, "there is no profile %u",
                               light->profile);
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return tl_light_refuse(light, index, source, err,
                               "a directional light has no \"profile\"; remove it");
    return TL_OK;
}

tl_status tl_light_resources_check(const tl_light_set *set,
                                   size_t index,
                                   const char *source,
                                   tl_error *err)
{
    tl_status status = check_table(set, index, source, err);
    if (status == TL_OK)
        status = check_texture(set, index, source, err);
    if (status == TL_OK)
        status = check_profile(set, index, source, err);
    if (status == TL_OK)
        status = check_up(&set->lights[index], index, source, err);
    return status;
}

tl_status tl_light_sky_check(const tl_light_set *set, const char *source, tl_error *err)
{
    if ((unsigned)set->sky_type >= TL_SKY_COUNT)
        return tl_fail(err, TL_ERR_FORMAT, "%s: there is no kind of sky %u", source,
                       (unsigned)set->sky_type);
    if (!(set->sky_light >= 0.0f && set->sky_light <= TL_BRIGHTEST))
        return tl_fail(err, TL_ERR_FORMAT, "%s: sky: light is %g, it must be from 0 to %g",
                       source, (double)set->sky_light, (double)TL_BRIGHTEST);
    if (set->sky_type != TL_SKY_IMAGE)
        return TL_OK;
    if (set->sky_image == 0 || set->sky_image > set->image_count)
        return tl_fail(err, TL_ERR_FORMAT, "%s: sky: there is no image %u", source,
                       set->sky_image);
    if (!(set->sky_intensity >= 0.0f && set->sky_intensity <= TL_BRIGHTEST))
        return tl_fail(err, TL_ERR_FORMAT, "%s: sky: intensity is %g, it must be from 0 to %g",
                       source, (double)set->sky_intensity, (double)TL_BRIGHTEST);
    if (!(fabsf(set->sky_rotation) <= most_rotation))
        return tl_fail(err, TL_ERR_FORMAT, "%s: sky: rotation is %g, it must be from %g to %g",
                       source, (double)set->sky_rotation, -(double)most_rotation,
                       (double)most_rotation);
    return TL_OK;
}
