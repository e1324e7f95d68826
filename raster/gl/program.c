#include "program.h"

#include "embedded_shaders.h"
#include "shaders.h"

#include <stdio.h>
#include <string.h>

static const char *const macros[TL_FEATURE_COUNT] = {
#define FEATURE_MACRO(name, macro) [name] = macro,
    TL_FEATURES(FEATURE_MACRO)
#undef FEATURE_MACRO
};

static const struct {
    const char *name, *fragment;
    unsigned features; /* what the pass looks at */
} passes[TL_PASS_COUNT] = {
    [TL_DEPTH_PASS] = {"depth", tl_depth_frag, 1u << TL_HAS_BASE_COLOR | 1u << TL_ALPHA_TEST},
    [TL_SURFACE_PASS] = {"surface", tl_surface_frag, (1u << TL_FEATURE_COUNT) - 1u},
};

tl_status tl_program_for(const tl_gl *gl,
                         tl_programs *programs,
                         tl_pass pass,
                         unsigned features,
                         GLuint *out,
                         tl_error *err)
{
    char prefix[512];

    if (!(features & 1u << TL_ALPHA_TEST) && pass == TL_DEPTH_PASS)
        features = 0;
    features &= passes[pass].features;
    GLuint *const made = &programs->made[pass][features];
    if (*made) {
        *out = *made;
        return TL_OK;
    }
    size_t length = (size_t)snprintf(prefix, sizeof prefix, "#version 450 core\n");
    for (int i = 0; i < TL_FEATURE_COUNT; i++)
        if (features & 1u << i)
            length += (size_t)snprintf(prefix + length, sizeof prefix - length, "#define %s\n",
                                       macros[i]);
    const char *const vertex[] = {prefix, tl_interface_h, "\n#line 1\n", tl_geometry_vert,
                                  NULL};
    const char *const fragment[] = {prefix,         tl_interface_h,        "\n#line 1\n",
                                    tl_lookup_glsl, passes[pass].fragment, NULL};
    const tl_status status = tl_shaders_link(gl, vertex, fragment, made, err);
    if (status == TL_OK)
        *out = *made;
    return status;
}
