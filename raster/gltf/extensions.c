#include "extensions.h"

#include "lookup.h"

#include <stdbool.h>
#include <string.h>

static const struct {
    const char *name, *effect;
} supported[] = {
    {"EXT_mesh_gpu_instancing", "a mesh at many places"},
    {"KHR_lights_punctual", "point, directional and spot lights"},
    {"KHR_materials_emissive_strength", "a factor on the emitted light"},
    {"KHR_materials_unlit", "surfaces that show their base colour without lighting"},
    {"KHR_materials_variants", "materials by the name of a variant"},
    {"KHR_mesh_quantization", "integer positions, normals, tangents and texture coordinates"},
    {"KHR_texture_transform", "offset, rotation and scale of texture coordinates"},
};

/* Those that are not, and what a picture lacks where a file has them without requiring them.
 * NULL: nothing that a picture could show, so they may be required too. */
static const struct {
    const char *name, *lack;
    const char *advice; /* where it is required; NULL: none */
} others[] = {
    {"EXT_lights_ies", "lights shine alike in all directions of their cone", NULL},
    {"EXT_lights_image_based", "there is no light from its picture of the surroundings", NULL},
    {"EXT_mesh_features", NULL, NULL},
    {"EXT_mesh_manifold", NULL, NULL},
    {"EXT_meshopt_compression", "geometry is read from its uncompressed stand-in",
     "save the scene without meshopt compression"},
    {"EXT_structural_metadata", NULL, NULL},
    {"EXT_texture_avif", "images are the PNG or JPEG ones that stand in for AVIF",
     "save its images as PNG or JPEG instead of AVIF"},
    {"EXT_texture_webp", "images are the PNG or JPEG ones that stand in for WebP",
     "save its images as PNG or JPEG instead of WebP"},
    {"FB_ngon_encoding", NULL, NULL},
    {"KHR_animation_pointer", "animations move nodes alone, not materials, lights or cameras",
     NULL},
    {"KHR_draco_mesh_compression", "geometry is read from its uncompressed stand-in",
     "save the scene without Draco compression"},
    {"KHR_materials_anisotropy", "highlights are round where they should be drawn out", NULL},
    {"KHR_materials_clearcoat", "the highlight of the coat is not there", NULL},
    {"KHR_materials_diffuse_transmission", "no light comes through from behind", NULL},
    {"KHR_materials_dispersion", "glass does not part light into colours", NULL},
    {"KHR_materials_ior", "what is no metal reflects as glass of index 1.5 does", NULL},
    {"KHR_materials_iridescence", "highlights have no colours of thin films", NULL},
    {"KHR_materials_pbrSpecularGlossiness",
     "materials are the metal-rough ones that stand in for it, white unless the file says "
     "otherwise",
     "save the scene with metal-rough materials"},
    {"KHR_materials_sheen", "cloth has no sheen", NULL},
    {"KHR_materials_specular",
     "highlights of what is no metal have the strength and colour of glass", NULL},
    {"KHR_materials_transmission", "glass and the like are opaque, in their base colour", NULL},
    {"KHR_materials_volume", "bodies neither bend nor absorb light that comes through", NULL},
    {"KHR_node_hoverability", NULL, NULL},
    {"KHR_node_selectability", NULL, NULL},
    {"KHR_node_visibility", "nodes that it hides are shown", NULL},
    {"KHR_texture_basisu", "images are the PNG or JPEG ones that stand in for KTX2",
     "save its images as PNG or JPEG instead of KTX2"},
    {"KHR_xmp_json_ld", NULL, NULL},
    {"MSFT_lod", "what has several levels of detail is shown in the finest", NULL},
    {"MSFT_texture_dds", "images are the PNG or JPEG ones that stand in for DDS",
     "save its images as PNG or JPEG instead of DDS"},
};
enum { OTHER_COUNT = sizeof others / sizeof others[0] };

/* What a supported extension brings; NULL: it is not supported. */
static const char *brought_by(const char *name)
{
    for (size_t i = 0; i < sizeof supported / sizeof supported[0]; i++)
        if (strcmp(supported[i].name, name) == 0)
            return supported[i].effect;
    return NULL;
}

/* Its row; OTHER_COUNT: nothing is known of it. */
static size_t find_other(const char *name)
{
    size_t i = 0;
    while (i < OTHER_COUNT && strcmp(others[i].name, name) != 0)
        i++;
    return i;
}

/* What the picture lacks for want of one that is not supported; NULL: nothing. */
static const char *lack_of(const char *name)
{
    const size_t row = find_other(name);
    return row == OTHER_COUNT ? "nothing is known of it" : others[row].lack;
}

/* Whether a picture lacks something where a file uses it. */
static bool shows(const char *name)
{
    return !brought_by(name) && lack_of(name);
}

static tl_status refuse(const char *path, const char *name, tl_error *err)
{
    const size_t row = find_other(name);
    const char *const advice = row == OTHER_COUNT ? NULL : others[row].advice;
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "%s: requires the extension %.64s, which is not supported%s%s", path, name,
                   advice ? "; " : "", advice ? advice : "");
}

static void tell(const char *path, const char *name, const tl_notices *notices)
{
    tl_notice(notices, "%s: the extension %.64s is left out: %s", path, name, lack_of(name));
}

static bool is_among(const char *name, size_t count, const char *const *names)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0)
            return true;
    return false;
}

tl_status tl_gltf_check_extensions(const char *path,
                                   size_t required_count,
                                   const char *const *required,
                                   size_t used_count,
                                   const char *const *used,
                                   const tl_notices *notices,
                                   tl_error *err)
{
    enum { TOLD_AT_MOST = 32 }; /* a hostile list is no reason to talk for ever */
    size_t told = 0;
    for (size_t i = 0; i < required_count; i++)
        if (shows(required[i]))
            return refuse(path, required[i], err);
    for (size_t i = 0; i < used_count && told < TOLD_AT_MOST; i++)
        if (shows(used[i]) && !is_among(used[i], i, used)) {
            tell(path, used[i], notices);
            told++;
        }
    return TL_OK;
}

tl_extension_fate tl_gltf_extension_fate(const char *name, const char **effect)
{
    const char *const brought = brought_by(name), *const lack = lack_of(name);
    *effect = brought ? brought : lack ? lack : "it changes nothing that a picture shows";
    return brought ? TL_EXTENSION_SUPPORTED
           : lack  ? TL_EXTENSION_LEFT_OUT
                   : TL_EXTENSION_HARMLESS;
}
