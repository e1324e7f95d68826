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

/* What a pass looks at. */
static const unsigned features_of_pass[TL_PASS_COUNT] = {
    [TL_DEPTH_PASS] = 1u << TL_HAS_BASE_COLOR | 1u << TL_ALPHA_TEST | 1u << TL_MANY_SETS,
    [TL_SURFACE_PASS] = (1u << TL_FEATURE_COUNT) - 1u,
    [TL_SHADOW_PASS] = 1u << TL_HAS_BASE_COLOR | 1u << TL_ALPHA_TEST | 1u << TL_MANY_SETS,
};

enum { MOST_TEXTS = 14 };

static void list_fragment_texts(const tl_programs *programs,
                                tl_pass pass,
                                const char *prefix,
                                const char *texts[MOST_TEXTS])
{
    /* Formulas of kernels/, each behind those that it needs. */
    static const char *const surface[] = {tl_dialect_glsl,  tl_ranges_h,   tl_vec3_h,
                                          tl_normal_code_h, tl_encode_h,   tl_material_h,
                                          tl_surface_glsl,  tl_layout_glsl};
    int count = 0;
    texts[count++] = prefix;
    texts[count++] = tl_interface_h;
    texts[count++] = "\n#line 1\n";
    texts[count++] = tl_lookup_glsl;
    if (pass == TL_DEPTH_PASS)
        texts[count++] = tl_depth_frag;
    if (pass == TL_SHADOW_PASS) {
        texts[count++] = tl_shadow_code_h;
        texts[count++] = tl_shadow_frag;
    }
    for (size_t i = 0; pass == TL_SURFACE_PASS && i < sizeof surface / sizeof surface[0]; i++)
        texts[count++] = surface[i];
    if (pass == TL_SURFACE_PASS)
        texts[count++] = programs->output;
    texts[count] = NULL;
}

tl_status tl_program_for(const tl_gl *gl,
                         tl_programs *programs,
                         tl_pass pass,
                         unsigned features,
                         GLuint *out,
                         tl_error *err)
{
    char prefix[512];
    const char *fragment[MOST_TEXTS];

    if (!(features & 1u << TL_ALPHA_TEST) && pass != TL_SURFACE_PASS)
        features = 0;
    features &= features_of_pass[pass];
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
    list_fragment_texts(programs, pass, prefix, fragment);
    const tl_status status = tl_shaders_link(gl, vertex, fragment, made, err);
    if (status == TL_OK)
        *out = *made;
    return status;
}
