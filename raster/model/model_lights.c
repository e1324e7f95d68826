#include "model.h"

#include "lookup.h"
#include "try.h"

#include <string.h>

static const struct {
    const char *word;
    tl_light_type type;
} types[] = {
    {"point", TL_LIGHT_POINT},
    {"directional", TL_LIGHT_DIRECTIONAL},
    {"spot", TL_LIGHT_SPOT},
};

/* KHR_lights_punctual: a light shines along its node's -z; scale does not change it. */
static tl_status place_light(const tl_gltf *gltf,
                             const tl_gltf_light *from,
                             const tl_placed *at,
                             tl_light *to,
                             tl_error *err)
{
    const tl_label label = tl_label_of("light", (size_t)at->what, from->name);
    double direction[3];

    tl_affine_column(&at->world, 2, direction);
    if (!tl_normalize(direction))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: its node is scaled to nothing, so that it "
                       "shines nowhere",
                       gltf->path, label.text);
    for (int i = 0; i < 3; i++) {
        to->position[i] = (float)at->world.m[i][3];
        to->direction[i] = (float)-direction[i];
    }
    return TL_OK;
}

static tl_status read_light(const tl_gltf *gltf,
                            const tl_placed *at,
                            tl_light *out,
                            tl_error *err)
{
    const tl_gltf_light *const from = &gltf->lights[at->what];
    const tl_gltf_node *const node = &gltf->nodes[at->node];
    const tl_label label = tl_label_of("light", (size_t)at->what, from->name);
    size_t type = 0;

    while (type < sizeof types / sizeof types[0] && strcmp(types[type].word, from->type) != 0)
        type++;
    if (type == sizeof types / sizeof types[0])
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has the type \"%.32s\", which lights have not", gltf->path,
                       label.text, from->type);
    if (from->color_count != 0 && from->color_count != 3)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has a color of %zu values instead of 3",
                       gltf->path, label.text, from->color_count);
    *out = tl_light_default();
    out->type = types[type].type;
    for (size_t i = 0; i < from->color_count; i++)
        out->color[i] = (float)from->color[i];
    out->intensity = (float)from->intensity;
    out->range = from->range == 0.0 ? INFINITY : (float)from->range;
    if (out->type == TL_LIGHT_SPOT) {
        out->inner_cone = (float)from->inner_cone;
        out->outer_cone = (float)from->outer_cone;
    }
    tl_light_text(node->name[0] ? node->name : from->name, out->name);
    tl_light_text(node->group[0] ? node->group : from->group, out->group);
    return place_light(gltf, from, at, out, err);
}

tl_status tl_model_lights(const tl_model *model, tl_light_set *lights, tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < model->light_count; i++) {
        tl_light light;
        TRY(read_light(model->gltf, &model->lights[i], &light, err));
        TRY(tl_light_set_add(lights, &light, err));
    }
    TRY(tl_light_set_check(lights, model->gltf->path, err));
done:
    return status;
}
