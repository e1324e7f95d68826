#include "baselines.h"

#include "baseline_tables.h"

#include <string.h>

static const tl_baseline hand = {
    .name = "hand",
    .meaning = "vector C by hand on threads, to the kernels' contract and their bits",
    .source = "the method of the kernels",
    .rms_tolerance = 2e-6,
    .max_tolerance = 0.1, /* a light at N.L = 0 may be taken or left by rounding */
    .create = hand_create_exact,
    .run = hand_run,
    .destroy = hand_destroy,
};

static const tl_baseline hand_relaxed = {
    .name = "hand_relaxed",
    .meaning = "the same with everything relaxed: estimates, short polynomials, -ffast-math",
    .source = "the method of the kernels",
    .rms_tolerance = 2e-3,
    .max_tolerance = 0.1,
    .create = hand_create_relaxed,
    .run = hand_run,
    .destroy = hand_destroy,
};

#ifdef TL_HAS_MULTIPASS
static const tl_baseline quads = {
    .name = "quads",
    .meaning = "OpenGL, light by light: the rectangle of its sphere, added up by blending",
    .source = "Policarpo and Fonseca, \"Deferred Shading Tutorial\" (2005), section 3.4.2",
    .rms_tolerance = 3e-5,
    .max_tolerance = 0.1,
    .create = multipass_create_quads,
    .run = multipass_run,
    .destroy = multipass_destroy,
};

static const tl_baseline volumes = {
    .name = "volumes",
    .meaning = "OpenGL, light by light: back faces of its sphere behind what is seen",
    .source = "Thibieroz, \"Deferred Shading with Multiple Render Targets\" (ShaderX2, 2003)",
    .rms_tolerance = 3e-5,
    .max_tolerance = 0.1,
    .create = multipass_create_volumes,
    .run = multipass_run,
    .destroy = multipass_destroy,
};
#endif

static const tl_baseline classic = {
    .name = "classic",
    .meaning =
        "OpenCL as on GPUs: a work-group per tile, local atomics, pow; 256 lights a tile",
    .source = "Andersson, \"Parallel Graphics in Frostbite\" (SIGGRAPH 2009)",
    .needs_device = 1,
    .rms_tolerance = 3e-5,
    .max_tolerance = 0.1,
    .create = classic_create,
    .run = classic_run,
    .destroy = classic_destroy,
};

static const tl_baseline brute = {
    .name = "brute",
    .meaning = "the project's kernels without culling: every light on every pixel",
    .source = "the method of the kernels",
    .needs_device = 1,
    .rms_tolerance = 2e-6,
    .max_tolerance = 0.1,
    .create = brute_create,
    .run = brute_run,
    .destroy = brute_destroy,
};

const tl_baseline *const tl_baselines[] = {
    &hand,    &hand_relaxed,
#ifdef TL_HAS_MULTIPASS
    &quads,   &volumes,
#endif
    &classic, &brute,
};
const int tl_baseline_count = sizeof tl_baselines / sizeof tl_baselines[0];

tl_status tl_baseline_check(const tl_needs *needs,
                            uint32_t models,
                            uint32_t falloffs,
                            tl_error *err)
{
    if (!(models >> needs->model & 1u))
        return tl_fail(err, TL_ERR_UNSUPPORTED, "knows the shading model phong alone");
    if (reads_planes(*needs, TL_GROUP_BRDF))
        return tl_fail(err, TL_ERR_UNSUPPORTED, "knows no rows of materials");
    if (needs->fixed_exponent)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "knows no exponent for all surfaces");
    if (needs->spots)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "knows no spot lights");
    if (needs->shapes)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "knows no falloff tables, textures and ambient lobes of lights");
    if (needs->sky)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "knows no sky of more than one colour");
    if (needs->falloffs & ~falloffs)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "knows no linear falloff that begins later");
    return TL_OK;
}

const tl_baseline *tl_baseline_find(const char *name)
{
    for (int i = 0; i < tl_baseline_count; i++)
        if (strcmp(tl_baselines[i]->name, name) == 0)
            return tl_baselines[i];
    return NULL;
}
