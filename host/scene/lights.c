#include "tilelight/lights.h"

#include "largest.h"
#include "light_resources.h"
#include "light_words.h"
#include "material_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float pi = 3.14159274f; /* rounded up, so that a cone of pi itself is accepted */

tl_light tl_light_default(void)
{
    return (tl_light){.type = TL_LIGHT_POINT,
                      .falloff = TL_FALLOFF_INVERSE_SQUARE,
                      .direction = {0.0f, 0.0f, -1.0f},
                      .color = {1.0f, 1.0f, 1.0f},
                      .intensity = 1.0f,
                      .range = INFINITY,
                      .diffuse = 1.0f,
                      .specular = 1.0f,
                      .outer_cone = 0.785398163f};
}

void tl_light_text(const char *text, char out[64])
{
    size_t length = strlen(text);
    if (length > sizeof(tl_light){0}.name - 1)
        length = sizeof(tl_light){0}.name - 1;
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80)
        length--;
    memcpy(out, text, length);
    out[length] = '\0';
}

tl_status tl_light_set_add(tl_light_set *set, const tl_light *light, tl_error *err)
{
    if (set->count == set->capacity) {
        const size_t capacity = set->capacity ? 2 * set->capacity : 16;
        tl_light *grown = capacity <= SIZE_MAX / sizeof *grown
                              ? realloc(set->lights, capacity * sizeof *grown)
                              : NULL;
        if (!grown)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu lights", capacity);
        set->lights = grown;
        set->capacity = capacity;
    }
    set->lights[set->count++] = *light;
    return TL_OK;
}

void tl_light_set_clear(tl_light_set *set)
{
    tl_light_resources_clear(set);
    free(set->lights);
    free(set->materials);
    *set = (tl_light_set){0};
}

/* One number of a light and the closed range it must lie in. */
typedef struct rule {
    const char *field;
    float value, least, most;
} rule;

static tl_status check_rule(
    const rule *r, size_t index, const tl_light *light, const char *source, tl_error *err)
{
    if (r->value >= r->least && r->value <= r->most)
        return TL_OK;
    return tl_light_refuse(light, index, source, err, "%s is %g, it must be from %g to %g",
                           r->field, (double)r->value, (double)r->least, (double)r->most);
}

static tl_status check_numbers(const tl_light *light,
                               size_t index,
                               const char *source,
                               tl_error *err)
{
    const int placed = light->type != TL_LIGHT_DIRECTIONAL;
    const int aimed = light->type != TL_LIGHT_POINT || light->profile > 0;
    const float *p = light->position, *d = light->direction, *c = light->color;
    const float reach = placed ? TL_FARTHEST : INFINITY;
    const float turn = aimed ? 1.0001f : INFINITY;
    const rule rules[] = {
        {"position[0]", p[0], -reach, reach},
        {"position[1]", p[1], -reach, reach},
        {"position[2]", p[2], -reach, reach},
        {"direction[0]", d[0], -turn, turn},
        {"direction[1]", d[1], -turn, turn},
        {"direction[2]", d[2], -turn, turn},
        {"color[0]", c[0], 0.0f, TL_BRIGHTEST},
        {"color[1]", c[1], 0.0f, TL_BRIGHTEST},
        {"color[2]", c[2], 0.0f, TL_BRIGHTEST},
        {"intensity", light->intensity, 0.0f, TL_BRIGHTEST},
        {"diffuse", light->diffuse, 0.0f, TL_BRIGHTEST},
        {"specular", light->specular, 0.0f, TL_BRIGHTEST},
        {"ambient", light->ambient, 0.0f, TL_BRIGHTEST},
        {"outerConeAngle", light->outer_cone, 0.0f, pi},
        {"innerConeAngle", light->inner_cone, 0.0f, light->outer_cone},
    };
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        const tl_status status = check_rule(&rules[i], index, light, source, err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

static tl_status check_range(const tl_light *light,
                             size_t index,
                             const char *source,
                             tl_error *err)
{
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return TL_OK;
    if (!(light->range > 0.0f))
        return tl_light_refuse(light, index, source, err, "range is %g m, it must be above 0",
                               (double)light->range);
    if (!(light->begin >= 0.0f && light->begin <= light->range))
        return tl_light_refuse(light, index, source, err,
                               "begin is %g m, it must be from 0 to the range, %g",
                               (double)light->begin, (double)light->range);
    if (light->falloff != TL_FALLOFF_LINEAR && light->begin > 0.0f)
        return tl_light_refuse(light, index, source, err,
                               "begin is for a linear falloff; remove it, or say "
                               "\"falloff\": \"linear\"");
    if (light->falloff != TL_FALLOFF_INVERSE_SQUARE && isinf(light->range))
        return tl_light_refuse(light, index, source, err, "a %s needs a range",
                               light->falloff == TL_FALLOFF_LINEAR ? "linear falloff"
                                                                   : "falloff table");
    return TL_OK;
}

static tl_status check_direction(const tl_light *light,
                                 size_t index,
                                 const char *source,
                                 tl_error *err)
{
    const float *d = light->direction;
    const float length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const int is_aimed = light->type != TL_LIGHT_POINT || light->profile > 0;
    if (!is_aimed || fabsf(length2 - 1.0f) <= 1e-3f)
        return TL_OK;
    return tl_light_refuse(light, index, source, err,
                           "direction (%g, %g, %g) of a %s light is not of "
                           "length 1",
                           (double)d[0], (double)d[1], (double)d[2],
                           tl_light_type_words[light->type]);
}

tl_status tl_light_set_check(const tl_light_set *set, const char *source, tl_error *err)
{
    const struct {
        const char *name;
        const float *values;
    } colors[] = {
        {"ambient", set->ambient},
        {set->sky_type == TL_SKY_GRADIENT ? "sky: horizon" : "sky: color", set->sky},
        {"sky: zenith", set->zenith},
        {"sky: ground", set->ground},
    };
    for (size_t c = 0; c < sizeof colors / sizeof colors[0]; c++)
        for (int i = 0; i < 3; i++)
            if (!(colors[c].values[i] >= 0.0f && colors[c].values[i] <= TL_BRIGHTEST))
                return tl_fail(err, TL_ERR_FORMAT, "%s: %s[%d] is %g, it must be from 0 to %g",
                               source, colors[c].name, i, (double)colors[c].values[i],
                               (double)TL_BRIGHTEST);
    if (!(set->occlusion_radius >= 0.0f && set->occlusion_radius <= TL_FARTHEST))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: ambientOcclusion: radius is %g m, it must be from 0 to %g", source,
                       (double)set->occlusion_radius, (double)TL_FARTHEST);
    const tl_status sky = tl_light_sky_check(set, source, err);
    if (sky != TL_OK)
        return sky;
    if (set->has_shininess && !(set->shininess >= 0.0f && set->shininess <= 10000.0f))
        return tl_fail(err, TL_ERR_FORMAT, "%s: shininess %g must be from 0 to 10000", source,
                       (double)set->shininess);
    if ((unsigned)set->model >= TL_MODEL_COUNT)
        return tl_fail(err, TL_ERR_FORMAT, "%s: there is no shading model %u", source,
                       (unsigned)set->model);
    const tl_status rows = tl_material_rows_check(set, source, err);
    if (rows != TL_OK)
        return rows;
    for (size_t i = 0; i < set->count; i++) {
        tl_status status = check_numbers(&set->lights[i], i, source, err);
        if (status == TL_OK)
            status = check_range(&set->lights[i], i, source, err);
        if (status == TL_OK)
            status = check_direction(&set->lights[i], i, source, err);
        if (status == TL_OK)
            status = tl_light_resources_check(set, i, source, err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

tl_status tl_light_set_add_rig(tl_light_set *set, const tl_camera *camera, tl_error *err)
{
    /* Directions in view space: over the left shoulder, and from the right at eye height. */
    static const struct {
        const char *name;
        double direction[3];
        float color[3], intensity;
    } rig[] = {
        {"key", {0.5, -0.7, -0.6}, {1.0f, 0.96f, 0.9f}, 1.0f},
        {"fill", {-0.8, -0.1, -0.6}, {0.85f, 0.92f, 1.0f}, 0.35f},
    };
    for (size_t i = 0; i < sizeof rig / sizeof rig[0]; i++) {
        tl_light light = tl_light_default();
        double world[3];
        light.type = TL_LIGHT_DIRECTIONAL;
        light.intensity = rig[i].intensity;
        strcpy(light.name, rig[i].name);
        memcpy(light.color, rig[i].color, sizeof light.color);
        tl_camera_world_direction(camera, rig[i].direction, world);
        const double length =
            sqrt(world[0] * world[0] + world[1] * world[1] + world[2] * world[2]);
        for (int axis = 0; axis < 3; axis++)
            light.direction[axis] = (float)(world[axis] / length);
        const tl_status status = tl_light_set_add(set, &light, err);
        if (status != TL_OK)
            return status;
    }
    for (int i = 0; i < 3; i++)
        set->ambient[i] += 0.08f;
    return TL_OK;
}
