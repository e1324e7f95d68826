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

enum { MOST_TEXTS = 16, MOST_OWN_TEXTS = 10 };

#define HOLES (1u << TL_HAS_BASE_COLOR | 1u << TL_ALPHA_TEST | 1u << TL_MANY_SETS)
#define OPACITY (1u << TL_HAS_BASE_COLOR | 1u << TL_MANY_SETS)
#define ALL_FEATURES ((1u << TL_FEATURE_COUNT) - 1u)

/* Formulas of kernels/, each behind those that it needs. */
#define SURFACE_TEXTS                                                                      \
    tl_dialect_glsl, tl_ranges_h, tl_vec3_h, tl_normal_code_h, tl_encode_h, tl_material_h, \
        tl_surface_glsl, tl_layout_glsl

/* What a pass looks at; whether without holes it looks at nothing; its text, to which that of the output
 * stage may come. */
static const struct {
    unsigned features;
    bool for_holes, has_output;
    const char *texts[MOST_OWN_TEXTS];
} passes[TL_PASS_COUNT] = {
    [TL_DEPTH_PASS] = {HOLES, true, false, {tl_depth_frag}},
    [TL_SURFACE_PASS] = {ALL_FEATURES, false, true, {SURFACE_TEXTS}},
    [TL_SHADOW_PASS] = {HOLES, true, false, {tl_shadow_code_h, tl_shadow_frag}},
    [TL_BACK_PASS] = {HOLES, true, false, {tl_back_frag}},
    [TL_FRONT_PASS] = {OPACITY, false, false, {tl_peel_glsl, tl_front_frag}},
    [TL_CHOICE_PASS] = {OPACITY, false, false, {tl_peel_glsl, tl_choice_frag}},
    [TL_LAYER_PASS] = {ALL_FEATURES & ~(1u << TL_ALPHA_TEST),
                       false,
                       true,
                       {tl_peel_glsl, SURFACE_TEXTS}},
};

static void list_fragment_texts(const tl_programs *programs,
                                tl_pass pass,
                                const char *prefix,
                                const char *texts[MOST_TEXTS])
{
    int count = 0;
    texts[count++] = prefix;
    texts[count++] = tl_interface_h;
    texts[count++] = "\n#line 1\n";
    texts[count++] = tl_lookup_glsl;
    for (int i = 0; i < MOST_OWN_TEXTS && passes[pass].texts[i]; i++)
        texts[count++] = passes[pass].texts[i];
    if (passes[pass].has_output)
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

    if (!(features & 1u << TL_ALPHA_TEST) && passes[pass].for_holes)
        features = 0;
    features &= passes[pass].features;
    GLuint *const made = &programs->made[pass][features];
    if (*made) {
        *out = *made;
        return TL_OK;
    }
    size_t length = (size_t)snprintf(
        prefix, sizeof prefix, "#version 450 core\n%s%s",
        pass == TL_LAYER_PASS ? "#define LAYER\n" : "",
        pass == TL_LAYER_PASS && programs->forward_layers ? "#define FORWARD_DEPTH\n" : "");
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
