#include "tilelight/layouts.h"

static const tl_format_row formats[TL_FORMAT_COUNT] = {
#define FORMAT_ROW(name, word, bytes, channels) [name] = {word, bytes, channels},
    TL_FORMATS(FORMAT_ROW)
#undef FORMAT_ROW
};

const tl_format_row *tl_format_describe(enum tl_format format)
{
    return &formats[format];
}

#define TILELIGHT "tilelight"
#define TRICKS "\"Deferred Shading Tricks\", section \"Shrinking the G-Buffer\""
#define THIBIEROZ \
    "Thibieroz, \"Deferred Shading with Multiple Render Targets\", ShaderX2, 2003, "
#define POLICARPO "Policarpo and Fonseca, \"Deferred Shading Tutorial\", 2005, "
#define MERLIN "Merlin3D, \"Faster Deferred Shading\", 2011"
#define DXR "\"Deferred Shading\", 2022, section \"Packing the GBuffer Efficiently\""
#define ISPC "Intel ISPC, examples/deferred"

#define TARGET(format, first, count, holds)         \
    {                                               \
        TL_FORMAT_##format, (first), (count), holds \
    }

/* The attributes of full float from word `first` on. What a scene lacks of them is not stored. */
#define FLOAT_MATERIAL(first)                                                       \
    TARGET(RGBA32F, first, 3, "albedo"),                                            \
        TARGET(RGBA32F, (first) + 3, 4, "specular, shininess of a Phong material"), \
        TARGET(RGBA32F, (first) + 7, 3, "metallic, roughness, occlusion"),          \
        TARGET(RGBA32F, (first) + 10, 3, "emission"),                               \
        TARGET(RGBA32F, (first) + 13, 4, "index of the BRDF, tangent in world space")
#define FLOAT_WITH_DEPTH(what)                                                   \
    6,                                                                           \
    {                                                                            \
        TARGET(RGBA32F, 0, 4, what ", normal in world space"), FLOAT_MATERIAL(4) \
    }
#define FLOAT_BESIDE_DEPTH(what)                                                  \
    7,                                                                            \
    {                                                                             \
        TARGET(D32F, 0, 1, what), TARGET(RGBA32F, 1, 3, "normal in world space"), \
            FLOAT_MATERIAL(4)                                                     \
    }

#define SHADERX2_POSITION TARGET(RGBA16F, 0, 2, "position in world space")
#define SHADERX2_128(normal)                                      \
    3,                                                            \
    {                                                             \
        SHADERX2_POSITION, normal, TARGET(RGBA8, 3, 1, "diffuse") \
    }

#define TUTORIAL(depth)                                                              \
    4,                                                                               \
    {                                                                                \
        TARGET(RGBA8, 0, 1, "normal in view space"), TARGET(RGBA8, 1, 1, "diffuse"), \
            TARGET(RGBA8, 2, 1, "specular, logarithm of the exponent"), depth        \
    }

#define MERLIN_SURFACE                                         \
    TARGET(RGBA8, 0, 1, "diffuse, logarithm of the exponent"), \
        TARGET(RGBA8, 1, 1,                                    \
               "normal in view space, index of the BRDF or specular as one number")

#define ISPC_TARGETS(depth)                                               \
    4,                                                                    \
    {                                                                     \
        TARGET(D32F, 0, 1, depth),                                        \
            TARGET(RG16F, 1, 2, "spheremap of the normal in view space"), \
            TARGET(RG16F, 3, 2, "specular as one number, exponent"),      \
            TARGET(RGBA8, 5, 3, "albedo")                                 \
    }

static const tl_layout_info infos[TL_LAYOUT_COUNT] = {
    [TL_LAYOUT_FLOAT] = {TILELIGHT, "every attribute in full float, depth in metres",
                         FLOAT_WITH_DEPTH("depth in m")},
    [TL_LAYOUT_FLOAT_FORWARD] = {TRICKS " (Direct3D's clip space)",
                                 "full float, depth as a depth buffer holds it",
                                 FLOAT_BESIDE_DEPTH("depth, 0 to 1")},
    [TL_LAYOUT_FLOAT_NDC] = {TRICKS ", in OpenGL's clip space",
                             "full float, depth as OpenGL's device coordinate",
                             FLOAT_WITH_DEPTH("depth, -1 to 1")},
    [TL_LAYOUT_FLOAT_REVERSED] = {TILELIGHT, "full float, depth as a reversed depth buffer",
                                  FLOAT_BESIDE_DEPTH("depth, 1 to 0")},
    [TL_LAYOUT_FLOAT_FRACTION] = {TILELIGHT, "full float, depth as a share of near to far",
                                  FLOAT_WITH_DEPTH("depth, share of near to far")},
    [TL_LAYOUT_FLOAT_POSITION] = {TILELIGHT,
                                  "full float, positions in place of depth",
                                  7,
                                  {TARGET(RGBA32F, 0, 3, "position in view space"),
                                   TARGET(RGBA32F, 3, 3, "normal in world space"),
                                   FLOAT_MATERIAL(6)}},
    [TL_LAYOUT_SHADERX2_128] = {THIBIEROZ "section \"Attribute Buffer\" (A2B10G10R10)",
                                "64 + 32 + 32 bits, normals in 10 unsigned bits each",
                                SHADERX2_128(TARGET(RGB10_A2, 2, 1, "normal in world space"))},
    [TL_LAYOUT_SHADERX2_128_S10] =
        {THIBIEROZ "section \"Attribute Buffer\" (A2W10V10U10)",
         "the same, normals in 10 signed bits each, which the shader packs",
         SHADERX2_128(TARGET(R32UI, 2, 1, "normal in world space"))},
    [TL_LAYOUT_SHADERX2_128_U8] = {THIBIEROZ "section \"Attribute Buffer\" (A8R8G8B8)",
                                   "the same, normals in 8 unsigned bits each",
                                   SHADERX2_128(TARGET(RGBA8, 2, 1, "normal in world space"))},
    [TL_LAYOUT_SHADERX2_128_S8] = {THIBIEROZ "section \"Attribute Buffer\" (Q8W8V8U8)",
                                   "the same, normals in 8 signed bits each",
                                   SHADERX2_128(
                                       TARGET(RGBA8_SNORM, 2, 1, "normal in world space"))},
    [TL_LAYOUT_SHADERX2_160] = {THIBIEROZ "section \"Attribute Buffer\" (float format)",
                                "64 + 64 + 32 bits, normals in half float",
                                3,
                                {SHADERX2_POSITION,
                                 TARGET(RGBA16F, 2, 2, "normal in world space"),
                                 TARGET(RGBA8, 4, 1, "diffuse")}},
    [TL_LAYOUT_SHADERX2_96] = {THIBIEROZ "section \"Optimized MRT Configuration\"",
                               "96 bits in four targets without a gap",
                               4,
                               {TARGET(RG16F, 0, 1, "x, y of the position in world space"),
                                TARGET(R16F, 1, 1, "z of the position"),
                                TARGET(RGBA8, 2, 1, "diffuse, z of the normal in world space"),
                                TARGET(RG8, 3, 1, "x, y of the normal")}},
    [TL_LAYOUT_TUTORIAL] = {POLICARPO "section 3.3.2",
                            "normal, diffuse, specular, and a float depth buffer",
                            TUTORIAL(TARGET(D32F, 3, 1, "depth, 0 to 1"))},
    [TL_LAYOUT_TUTORIAL_U24] = {POLICARPO "section 3.3.2",
                                "normal, diffuse, specular, and a depth buffer of 24 bits",
                                TUTORIAL(TARGET(D24, 3, 1, "depth, 0 to 1"))},
    [TL_LAYOUT_TUTORIAL_3X8] = {POLICARPO
                                "section 3.3.2, listing 11, with weights that fit the format",
                                "normal, diffuse, specular, and depth packed in 3 x 8 bits",
                                TUTORIAL(TARGET(
                                    RGBA8, 3, 1, "depth, 0 to 1, packed by the shader"))},
    [TL_LAYOUT_MERLIN] = {MERLIN,
                          "two targets and the depth buffer, and the index of a BRDF",
                          3,
                          {MERLIN_SURFACE, TARGET(D24, 2, 1, "depth, 0 to 1")}},
    [TL_LAYOUT_MERLIN_POSITION] = {MERLIN ", before the position buffer went",
                                   "the same with positions in place of depth",
                                   3,
                                   {MERLIN_SURFACE,
                                    TARGET(RGBA16F, 2, 2, "position in view space")}},
    [TL_LAYOUT_DXR] = {DXR,
                       "metal-rough with positions, emission spread over what is left",
                       4,
                       {TARGET(RGBA8, 0, 1, "albedo"),
                        TARGET(RGBA16F, 1, 2, "position in view space, red of emission"),
                        TARGET(RGBA16F, 3, 2, "normal in view space, green of emission"),
                        TARGET(
                            RGBA8, 5, 1, "occlusion, metallic, roughness, blue of emission")}},
    [TL_LAYOUT_ISPC] = {ISPC, "planes of 15 bytes, spheremap normals",
                        ISPC_TARGETS("depth, 0 to 1")},
    [TL_LAYOUT_ISPC_REVERSED] = {ISPC, "the same under a reversed projection",
                                 ISPC_TARGETS("depth, 1 to 0")},
    [TL_LAYOUT_COMPACT_16] =
        {TILELIGHT,
         "16 bytes, 20 with emission: octahedral normals, roots of colours",
         6,
         {TARGET(R32F, 0, 1, "depth in m"),
          TARGET(R32UI, 1, 1, "octahedron of the normal in world space"),
          TARGET(RGBA8, 2, 1, "roots of albedo, occlusion"),
          TARGET(R32UI,
                 3,
                 1,
                 "roughness, metallic; or roots of specular, logarithm of the exponent"),
          TARGET(R32UI, 4, 1, "emission, RGB9E5"),
          TARGET(R32UI, 5, 1, "octahedron of the tangent in world space, index of the BRDF")}},
    [TL_LAYOUT_COMPACT_12] =
        {TILELIGHT,
         "12 bytes, 16 with emission: the same in fewer bits",
         5,
         {TARGET(R32UI, 0, 1, "occlusion, depth in m in 24 bits"),
          TARGET(R32UI,
                 1,
                 1,
                 "octahedron of the normal in world space, roughness or logarithm of the "
                 "exponent"),
          TARGET(RGBA8, 2, 1, "roots of albedo, metallic or specular as one number"),
          TARGET(R32UI, 3, 1, "emission, RGB9E5"),
          TARGET(R32UI, 4, 1, "octahedron of the tangent in world space, index of the BRDF")}},
};

const tl_layout_info *tl_layout_describe(enum tl_layout_name layout)
{
    return &infos[layout];
}
