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
    {"KHR_mesh_quantization", "integer positions, normals, tangents and texture coordinates"},
    {"KHR_texture_transform", "offset, rotation and scale of texture coordinates"},
};

/* What to do about an extension that is often required and not supported. */
static const struct {
    const char *name, *advice;
} advice[] = {
    {"KHR_draco_mesh_compression", "; save the scene without Draco compression"},
    {"EXT_meshopt_compression", "; save the scene without meshopt compression"},
    {"KHR_texture_basisu", "; save its images as PNG or JPEG instead of KTX2"},
    {"EXT_texture_webp", "; save its images as PNG or JPEG instead of WebP"},
};

static bool is_supported(const char *name)
{
    for (size_t i = 0; i < sizeof supported / sizeof supported[0]; i++)
        if (strcmp(supported[i].name, name) == 0)
            return true;
    return false;
}

static const char *advice_on(const char *name)
{
    for (size_t i = 0; i < sizeof advice / sizeof advice[0]; i++)
        if (strcmp(advice[i].name, name) == 0)
            return advice[i].advice;
    return "";
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
        if (!is_supported(required[i]))
            return tl_fail(err, TL_ERR_UNSUPPORTED,
                           "%s: requires the extension %.64s, which is not supported%s", path,
                           required[i], advice_on(required[i]));
    for (size_t i = 0; i < used_count && told < TOLD_AT_MOST; i++)
        if (!is_supported(used[i])) {
            tl_notice(notices, "%s: the extension %.64s is not supported and left out", path,
                      used[i]);
            told++;
        }
    return TL_OK;
}
