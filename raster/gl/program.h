/* The shaders of the geometry and shadow passes, compiled for what a material has. */
#ifndef TL_PROGRAM_H
#define TL_PROGRAM_H

#include "gl.h"
#include "output_stage.h"

#include <stdbool.h>

/* X(bit, macro in the shaders) */
#define TL_FEATURES(X)                                     \
    X(TL_HAS_BASE_COLOR, "HAS_BASE_COLOR")                 \
    X(TL_HAS_METALLIC_ROUGHNESS, "HAS_METALLIC_ROUGHNESS") \
    X(TL_HAS_NORMAL_MAP, "HAS_NORMAL_MAP")                 \
    X(TL_HAS_OCCLUSION, "HAS_OCCLUSION")                   \
    X(TL_HAS_EMISSIVE, "HAS_EMISSIVE")                     \
    X(TL_ALPHA_TEST, "ALPHA_TEST")                         \
    X(TL_UNLIT, "UNLIT")                                   \
    X(TL_MANY_SETS, "MANY_SETS")

/* Bit numbers; the first ones are those of the texture slots. */
enum tl_feature {
#define TL_FEATURE_NAME(name, macro) name,
    TL_FEATURES(TL_FEATURE_NAME)
#undef TL_FEATURE_NAME
        TL_FEATURE_COUNT
};

/* Those of layers behind those of surfaces: peeling.h. */
typedef enum tl_pass {
    TL_DEPTH_PASS,
    TL_SURFACE_PASS,
    TL_SHADOW_PASS,
    TL_BACK_PASS,
    TL_FRONT_PASS,
    TL_CHOICE_PASS,
    TL_LAYER_PASS,
    TL_PASS_COUNT
} tl_pass;

/* Programs made so far, by pass and features; 0: not made. They go with the context. */
typedef struct tl_programs {
    /* the end of the surface and layer passes (tl_output_stage) */
    char output[TL_OUTPUT_STAGE_SIZE];
    bool forward_layers; /* the layer pass turns its depth around: 0 on the near plane */
    GLuint made[TL_PASS_COUNT][1 << TL_FEATURE_COUNT];
} tl_programs;

/* The program of a pass for a set of features, compiled when it is first asked for; features that
 * do not matter to the pass are dropped. Fails with TL_ERR_DEVICE, with the compiler's log. */
tl_status tl_program_for(const tl_gl *gl,
                         tl_programs *programs,
                         tl_pass pass,
                         unsigned features,
                         GLuint *out,
                         tl_error *err);

#endif
