#include "loading.h"

#include "lookup.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

static const char *const slot_names[TL_GLTF_SLOT_COUNT] = {
#define SLOT_NAME(name, member) [name] = member,
    TL_GLTF_SLOTS(SLOT_NAME)
#undef SLOT_NAME
};

/* Colours are stored as sRGB, all else linearly: glTF 2.0, section 3.9. */
static const bool slot_is_srgb[TL_GLTF_SLOT_COUNT] = {
    [TL_GLTF_BASE_COLOR] = true,
    [TL_GLTF_EMISSIVE] = true,
};

/* What OpenGL calls the ways to look up a texture; glTF uses the same numbers. */
enum { NEAREST = 9728, LINEAR = 9729, FIRST_MIPMAPPED = 9984, LINEAR_MIPMAP_LINEAR = 9987 };
enum { REPEAT = 10497, CLAMP_TO_EDGE = 33071, MIRRORED_REPEAT = 33648 };

static bool is_wrap(int value)
{
    return value == REPEAT || value == CLAMP_TO_EDGE || value == MIRRORED_REPEAT;
}

static bool is_filter(int value)
{
    return value == NEAREST || value == LINEAR;
}

static bool is_min_filter(int value)
{
    return is_filter(value) || (value >= FIRST_MIPMAPPED && value <= LINEAR_MIPMAP_LINEAR);
}

static tl_status find_sampler(
    const tl_gltf *gltf, const char *user, int index, tl_gltf_sampler *out, tl_error *err)
{
    tl_gltf_sampler found = {LINEAR_MIPMAP_LINEAR, LINEAR, REPEAT, REPEAT};
    if (index != -1) {
        const tl_status status =
            tl_gltf_check_index(gltf, user, "sampler", index, gltf->sampler_count, err);
        if (status != TL_OK)
            return status;
        const tl_gltf_sampler *const given = &gltf->samplers[index];
        found.wrap_s = given->wrap_s;
        found.wrap_t = given->wrap_t;
        if (given->min_filter != -1)
            found.min_filter = given->min_filter;
        if (given->mag_filter != -1)
            found.mag_filter = given->mag_filter;
    }
    if (!is_wrap(found.wrap_s) || !is_wrap(found.wrap_t) || !is_filter(found.mag_filter) ||
        !is_min_filter(found.min_filter))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: sampler %d wraps (%d, %d) or filters (%d, %d) in a way that glTF "
                       "does not have",
                       gltf->path, index, found.wrap_s, found.wrap_t, found.min_filter,
                       found.mag_filter);
    *out = found;
    return TL_OK;
}

static bool uses_mipmaps(const tl_gltf_sampler *sampler)
{
    return sampler->min_filter >= FIRST_MIPMAPPED;
}

/* Materials share textures: looking one up again gives the same. The list has room for every slot
 * of every material. */
static int intern(tl_model *model, size_t pixels, const tl_gltf_sampler *sampler)
{
    for (size_t i = 0; i < model->texture_count; i++)
        if (model->textures[i].pixels == pixels &&
            memcmp(&model->textures[i].sampler, sampler, sizeof *sampler) == 0)
            return (int)i;
    model->textures[model->texture_count] = (tl_texture){pixels, *sampler};
    return (int)model->texture_count++;
}

/* uv = translation rotation scale (s, t, 1), as KHR_texture_transform defines them. */
static void transform_of(const tl_gltf_texture_use *use, float out[2][3])
{
    const double c = cos(use->rotation), s = sin(use->rotation);
    const double m[2][3] = {
        {c * use->scale[0], s * use->scale[1], use->offset[0]},
        {-s * use->scale[0], c * use->scale[1], use->offset[1]},
    };
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = (float)m[i][j];
}

static tl_status load_slot(tl_model *model,
                           const char *user,
                           int slot,
                           const tl_gltf_texture_use *use,
                           const tl_notices *notices,
                           tl_texture_slot *out,
                           tl_error *err)
{
    const tl_gltf *const gltf = model->gltf;
    tl_status status = TL_OK;
    tl_gltf_sampler sampler;
    size_t pixels;

    *out = (tl_texture_slot){.texture = -1};
    if (use->texture == -1)
        return TL_OK;
    TRY(tl_gltf_check_index(gltf, user, "texture", use->texture, gltf->texture_count, err));
    if (use->coordinates < 0 || use->coordinates >= TL_GLTF_TEXCOORD_COUNT)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: %s uses TEXCOORD_%d for its %s; TEXCOORD_0 to _%d can be read",
                       gltf->path, user, use->coordinates, slot_names[slot],
                       TL_GLTF_TEXCOORD_COUNT - 1);
    const tl_gltf_texture *const from = &gltf->textures[use->texture];
    if (from->image == -1) {
        tl_notice(notices, "%s: texture %d has no image that can be read; %s does without it",
                  gltf->path, use->texture, user);
        return TL_OK;
    }
    TRY(tl_gltf_check_index(gltf, tl_label_of("texture", (size_t)use->texture, "").text,
                            "image", from->image, gltf->image_count, err));
    TRY(find_sampler(gltf, user, from->sampler, &sampler, err));
    transform_of(use, out->uv_from_coordinates);
    for (int i = 0; i < 6; i++)
        if (!isfinite(out->uv_from_coordinates[i / 3][i % 3]))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s: the transform of its %s is not finite",
                           gltf->path, user, slot_names[slot]);
    TRY(tl_find_pixels(model, from->image, slot_is_srgb[slot], uses_mipmaps(&sampler), notices,
                       &pixels, err));
    if (pixels == PIXELS_MISSING)
        goto done;
    out->coordinates = use->coordinates;
    out->texture = intern(model, pixels, &sampler);
done:
    return status;
}

/* Factors outside the range that glTF gives them are cut to it. */
static float cut(double value, double least, double most)
{
    return (float)fmin(fmax(value, least), most);
}

/* Below this a fragment is left out; 0 keeps all. Where no layers are peeled, and for shadows, BLEND is
 * opaque where it is at least half there. */
static tl_status find_alpha_mode(const tl_gltf *gltf,
                                 const char *user,
                                 const tl_gltf_material *from,
                                 tl_material *out,
                                 tl_error *err)
{
    const struct {
        const char *mode;
        double cutoff;
        bool blends;
    } modes[] = {
        {"OPAQUE", 0.0, false}, {"MASK", from->alpha_cutoff, false}, {"BLEND", 0.5, true}};
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++)
        if (strcmp(from->alpha_mode, modes[i].mode) == 0) {
            /* above 1, as it may be, hides all */
            out->alpha_cutoff = cut(modes[i].cutoff, 0.0, 2.0);
            out->blends = modes[i].blends;
            return TL_OK;
        }
    return tl_fail(err, TL_ERR_FORMAT, "%s: %s has the alphaMode \"%.32s\", which glTF has not",
                   gltf->path, user, from->alpha_mode);
}

static tl_status load_material(
    tl_model *model, size_t index, const tl_notices *notices, tl_material *out, tl_error *err)
{
    const tl_gltf_material *const from = &model->gltf->materials[index];
    const tl_label label = tl_label_of("material", index, from->name);
    tl_status status = TL_OK;

    for (int i = 0; i < 4; i++)
        out->base_color[i] = cut(from->base_color[i], 0.0, 1.0);
    for (int i = 0; i < 3; i++) {
        out->emissive[i] = (float)fmax(from->emissive[i] * from->emissive_strength, 0.0);
        if (!isfinite(out->emissive[i]) || !isfinite((float)from->normal_scale))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s has a factor that is not finite",
                           model->gltf->path, label.text);
        out->emits |= out->emissive[i] > 0.0f;
    }
    out->metallic = cut(from->metallic, 0.0, 1.0);
    out->roughness = cut(from->roughness, 0.0, 1.0);
    out->normal_scale = (float)from->normal_scale;
    out->occlusion_strength = cut(from->occlusion_strength, 0.0, 1.0);
    out->double_sided = from->double_sided;
    out->unlit = from->unlit;
    out->emits |= from->unlit;
    TRY(find_alpha_mode(model->gltf, label.text, from, out, err));
    /* KHR_materials_unlit: all but the base colour is there for those that do not know it. */
    for (int i = 0; i < TL_GLTF_SLOT_COUNT; i++)
        if (!from->unlit || i == TL_GLTF_BASE_COLOR)
            TRY(load_slot(model, label.text, i, &from->textures[i], notices, &out->slots[i],
                          err));
    if (!out->emits) /* an emissive texture with a factor of 0, which is the default */
        out->slots[TL_GLTF_EMISSIVE].texture = -1;
done:
    return status;
}

static void make_default(tl_material *out)
{
    *out = (tl_material){.base_color = {1.0f, 1.0f, 1.0f, 1.0f},
                         .metallic = 1.0f,
                         .roughness = 1.0f,
                         .normal_scale = 1.0f,
                         .occlusion_strength = 1.0f};
    for (int i = 0; i < TL_GLTF_SLOT_COUNT; i++)
        out->slots[i].texture = -1;
}

/* OpenGL then reads 0, 0 for every vertex. */
static void tell_of_missing_coordinates(const tl_model *model, const tl_notices *notices)
{
    size_t count = 0;
    for (size_t i = 0; i < model->part_count; i++) {
        const tl_part *const part = &model->parts[i];
        bool is_missing = false;
        for (int k = 0; k < TL_GLTF_SLOT_COUNT && part->index_count > 0; k++) {
            const tl_texture_slot *const slot = &model->materials[part->material].slots[k];
            is_missing |=
                slot->texture != -1 && !model->vertices[part->vertices]
                                            .attributes[TL_GLTF_TEXCOORD_0 + slot->coordinates];
        }
        count += is_missing;
    }
    if (count)
        tl_notice(notices,
                  "%s: %zu primitives lack texture coordinates that their materials look at; "
                  "those textures show one colour there",
                  model->gltf->path, count);
}

tl_status tl_load_materials(tl_model *model, const tl_notices *notices, tl_error *err)
{
    const size_t count = model->gltf->material_count;
    bool *const used = calloc(count + 1, sizeof *used);
    tl_status status = TL_OK;

    model->materials = calloc(count + 1, sizeof *model->materials);
    model->textures = calloc(count * TL_GLTF_SLOT_COUNT + 1, sizeof *model->textures);
    model->pixels = calloc(count * TL_GLTF_SLOT_COUNT + 1, sizeof *model->pixels);
    if (!used || !model->materials || !model->textures || !model->pixels) {
        status = tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its materials",
                         model->gltf->path);
        goto done;
    }
    model->material_count = count + 1;
    for (size_t i = 0; i < model->part_count; i++)
        used[model->parts[i].material] |= model->parts[i].index_count > 0;
    for (size_t i = 0; i <= count; i++)
        make_default(&model->materials[i]);
    for (size_t i = 0; i < count; i++)
        if (used[i])
            TRY(load_material(model, i, notices, &model->materials[i], err));
    tell_of_missing_coordinates(model, notices);
done:
    free(used);
    return status;
}
