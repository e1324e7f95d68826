/* How pixels are packed: every layout is a row of one table, and one text reads them all.
 *
 * A frame in memory is word planes, [rows][pitch] numbers of 8, 16 or 32 bits each, one after another;
 * a plane is there where the frame has one of the attributes it holds. An attribute is a code (of
 * normal_code.h, depth_code.h, color_code.h) over up to three channels, a channel some bits of a word and
 * their number format (number.h). On the device the row is a constant of the build, so that reading a
 * pixel is the few shifts its layout needs.
 *
 * Sources and render targets of each layout: host/gbuffer/layout_info.c. */
#ifndef TL_LAYOUT_H
#define TL_LAYOUT_H

#include "color_code.h"
#include "depth_code.h"
#include "layout_names.h"
#include "normal_code.h"
#include "number.h"
#include "planes.h"

#define TL_MAX_WORDS 23 /* full float with positions */

typedef struct tl_channel {
    tl_u32 word, shift, bits, number; /* bits of word `word`, enum tl_number */
} tl_channel;

typedef struct tl_attribute {
    tl_u32 code; /* of the attribute's own codes; 0: not stored */
    tl_channel channels[3];
} tl_attribute;

enum tl_normal_space { TL_NORMALS_IN_WORLD, TL_NORMALS_IN_VIEW };

typedef struct tl_layout {
    tl_u32 word_count;
    struct {
        tl_u32 bytes;  /* 1, 2 or 4 */
        tl_u32 planes; /* stored where the frame has one of these, bits 1 << plane */
    } words[TL_MAX_WORDS];
    tl_u32 normal_space; /* enum tl_normal_space */
    tl_attribute depth, normal, albedo, specular, shininess, metallic, roughness, occlusion,
        emissive, brdf, tangent; /* tangents: in world space, by a code of normals */
} tl_layout;

#define CHANNEL(word, shift, bits, number)    \
    {                                         \
        word, shift, bits, TL_NUMBER_##number \
    }
#define FLOAT_AT(word) CHANNEL(word, 0, 32, FLOAT)
#define HALF_AT(word, shift) CHANNEL(word, shift, 16, HALF)
#define BYTE_AT(word, shift) CHANNEL(word, shift, 8, UNORM)
#define ATTRIBUTE(code, ...) \
    {                        \
        code,                \
        {                    \
            __VA_ARGS__      \
        }                    \
    }
#define THREE_FLOATS(code, word) \
    ATTRIBUTE(code, FLOAT_AT(word), FLOAT_AT((word) + 1), FLOAT_AT((word) + 2))
#define THREE_BYTES(code, word, shift)                                \
    ATTRIBUTE(code, BYTE_AT(word, shift), BYTE_AT(word, (shift) + 8), \
              BYTE_AT(word, (shift) + 16))

#define ALWAYS TL_GROUP_BASE
#define FLOAT_WORD(plane) \
    {                     \
        4, TL_HAS(plane)  \
    }

/* Full float: word w is plane w of planes.h. The others differ from it in depth alone. */
#define FLOAT_WORDS_AFTER_DEPTH                                                          \
    FLOAT_WORD(TL_NORMAL_X), FLOAT_WORD(TL_NORMAL_Y), FLOAT_WORD(TL_NORMAL_Z),           \
        FLOAT_WORD(TL_ALBEDO_R), FLOAT_WORD(TL_ALBEDO_G), FLOAT_WORD(TL_ALBEDO_B),       \
        FLOAT_WORD(TL_SPECULAR_R), FLOAT_WORD(TL_SPECULAR_G), FLOAT_WORD(TL_SPECULAR_B), \
        FLOAT_WORD(TL_SHININESS), FLOAT_WORD(TL_METALLIC), FLOAT_WORD(TL_ROUGHNESS),     \
        FLOAT_WORD(TL_OCCLUSION), FLOAT_WORD(TL_EMISSIVE_R), FLOAT_WORD(TL_EMISSIVE_G),  \
        FLOAT_WORD(TL_EMISSIVE_B), FLOAT_WORD(TL_BRDF), FLOAT_WORD(TL_TANGENT_X),        \
        FLOAT_WORD(TL_TANGENT_Y), FLOAT_WORD(TL_TANGENT_Z)
/* `before`: words of depth in front of the one where it is one word. */
#define FLOAT_ATTRIBUTES(before)                                               \
    .normal = THREE_FLOATS(TL_NORMAL_XYZ, TL_NORMAL_X + (before)),             \
    .albedo = THREE_FLOATS(TL_COLOR_RGB, TL_ALBEDO_R + (before)),              \
    .specular = THREE_FLOATS(TL_COLOR_RGB, TL_SPECULAR_R + (before)),          \
    .shininess = ATTRIBUTE(TL_VALUE_PLAIN, FLOAT_AT(TL_SHININESS + (before))), \
    .metallic = ATTRIBUTE(TL_VALUE_PLAIN, FLOAT_AT(TL_METALLIC + (before))),   \
    .roughness = ATTRIBUTE(TL_VALUE_PLAIN, FLOAT_AT(TL_ROUGHNESS + (before))), \
    .occlusion = ATTRIBUTE(TL_VALUE_PLAIN, FLOAT_AT(TL_OCCLUSION + (before))), \
    .emissive = THREE_FLOATS(TL_COLOR_RGB, TL_EMISSIVE_R + (before)),          \
    .brdf = ATTRIBUTE(TL_VALUE_PLAIN, FLOAT_AT(TL_BRDF + (before))),           \
    .tangent = THREE_FLOATS(TL_NORMAL_XYZ, TL_TANGENT_X + (before))
#define FLOAT_LAYOUT(depth_code)                                                    \
    {                                                                               \
        .word_count = 21, .words = {FLOAT_WORD(TL_DEPTH), FLOAT_WORDS_AFTER_DEPTH}, \
        .depth = ATTRIBUTE(depth_code, FLOAT_AT(0)), FLOAT_ATTRIBUTES(0)            \
    }

#define ROW_FLOAT FLOAT_LAYOUT(TL_DEPTH_METRES)
#define ROW_FLOAT_FORWARD FLOAT_LAYOUT(TL_DEPTH_FORWARD)
#define ROW_FLOAT_NDC FLOAT_LAYOUT(TL_DEPTH_NDC)
#define ROW_FLOAT_REVERSED FLOAT_LAYOUT(TL_DEPTH_REVERSED)
#define ROW_FLOAT_FRACTION FLOAT_LAYOUT(TL_DEPTH_FRACTION)
#define ROW_FLOAT_POSITION                                                          \
    {                                                                               \
        .word_count = 23,                                                           \
        .words = {FLOAT_WORD(TL_DEPTH), FLOAT_WORD(TL_DEPTH), FLOAT_WORD(TL_DEPTH), \
                  FLOAT_WORDS_AFTER_DEPTH},                                         \
        .depth = THREE_FLOATS(TL_DEPTH_VIEW_POSITION, 0), FLOAT_ATTRIBUTES(2)       \
    }

#define FOUR_BYTES \
    {              \
        4, ALWAYS  \
    }
#define TWO_BYTES \
    {             \
        2, ALWAYS \
    }
#define ONE_BYTE  \
    {             \
        1, ALWAYS \
    }

/* Words 0 and 1: RGBA16F, position; 2: the normal; 3: RGBA8, diffuse. */
#define SHADERX2_128(...)                                                                     \
    {                                                                                         \
        .word_count = 4, .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES},           \
        .depth =                                                                              \
            ATTRIBUTE(TL_DEPTH_WORLD_POSITION, HALF_AT(0, 0), HALF_AT(0, 16), HALF_AT(1, 0)), \
        .normal = __VA_ARGS__, .albedo = THREE_BYTES(TL_COLOR_RGB, 3, 0)                      \
    }
#define ROW_SHADERX2_128                                                                       \
    SHADERX2_128(ATTRIBUTE(TL_NORMAL_XYZ, CHANNEL(2, 0, 10, UNORM), CHANNEL(2, 10, 10, UNORM), \
                           CHANNEL(2, 20, 10, UNORM)))
#define ROW_SHADERX2_128_S10                                                                   \
    SHADERX2_128(ATTRIBUTE(TL_NORMAL_XYZ, CHANNEL(2, 0, 10, SNORM), CHANNEL(2, 10, 10, SNORM), \
                           CHANNEL(2, 20, 10, SNORM)))
#define ROW_SHADERX2_128_U8 SHADERX2_128(THREE_BYTES(TL_NORMAL_XYZ, 2, 0))
#define ROW_SHADERX2_128_S8                                                                 \
    SHADERX2_128(ATTRIBUTE(TL_NORMAL_XYZ, CHANNEL(2, 0, 8, SNORM), CHANNEL(2, 8, 8, SNORM), \
                           CHANNEL(2, 16, 8, SNORM)))
/* Words 2 and 3: RGBA16F, the normal; 4: RGBA8, diffuse. */
#define ROW_SHADERX2_160                                                                      \
    {                                                                                         \
        .word_count = 5,                                                                      \
        .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES},                \
        .depth =                                                                              \
            ATTRIBUTE(TL_DEPTH_WORLD_POSITION, HALF_AT(0, 0), HALF_AT(0, 16), HALF_AT(1, 0)), \
        .normal = ATTRIBUTE(TL_NORMAL_XYZ, HALF_AT(2, 0), HALF_AT(2, 16), HALF_AT(3, 0)),     \
        .albedo = THREE_BYTES(TL_COLOR_RGB, 4, 0)                                             \
    }
/* RG16F and R16F, position; RGBA8, diffuse and the normal's z; RG8, its x and y. */
#define ROW_SHADERX2_96                                                                       \
    {                                                                                         \
        .word_count = 4, .words = {FOUR_BYTES, TWO_BYTES, FOUR_BYTES, TWO_BYTES},             \
        .depth =                                                                              \
            ATTRIBUTE(TL_DEPTH_WORLD_POSITION, HALF_AT(0, 0), HALF_AT(0, 16), HALF_AT(1, 0)), \
        .normal = ATTRIBUTE(TL_NORMAL_XYZ, BYTE_AT(3, 0), BYTE_AT(3, 8), BYTE_AT(2, 24)),     \
        .albedo = THREE_BYTES(TL_COLOR_RGB, 2, 0)                                             \
    }

/* RGBA8 each: the normal; diffuse; specular and shininess. Word 3: depth. */
#define TUTORIAL(...)                                                                          \
    {                                                                                          \
        .word_count = 4, .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES},            \
        .normal_space = TL_NORMALS_IN_VIEW, .depth = ATTRIBUTE(TL_DEPTH_FORWARD, __VA_ARGS__), \
        .normal = THREE_BYTES(TL_NORMAL_XYZ, 0, 0), .albedo = THREE_BYTES(TL_COLOR_RGB, 1, 0), \
        .specular = THREE_BYTES(TL_COLOR_RGB, 2, 0),                                           \
        .shininess = ATTRIBUTE(TL_VALUE_LOGARITHM, BYTE_AT(2, 24))                             \
    }
#define ROW_TUTORIAL TUTORIAL(FLOAT_AT(3))
#define ROW_TUTORIAL_U24 TUTORIAL(CHANNEL(3, 0, 24, UNORM))
#define ROW_TUTORIAL_3X8 TUTORIAL(CHANNEL(3, 0, 24, BYTES24))

/* RGBA8: diffuse and exponent; RGBA8: the normal and the index of a BRDF. A frame without indices of its
 * own has rows of which row i is a lobe of reflectance i/255: there the same bits are a specular colour. */
#define MERLIN_ATTRIBUTES                                                          \
    .normal_space = TL_NORMALS_IN_VIEW, .albedo = THREE_BYTES(TL_COLOR_RGB, 0, 0), \
    .shininess = ATTRIBUTE(TL_VALUE_LOGARITHM, BYTE_AT(0, 24)),                    \
    .normal = THREE_BYTES(TL_NORMAL_XYZ, 1, 0),                                    \
    .specular = ATTRIBUTE(TL_COLOR_GRAY, BYTE_AT(1, 24)),                          \
    .brdf = ATTRIBUTE(TL_VALUE_PLAIN, CHANNEL(1, 24, 8, WHOLE))
#define ROW_MERLIN                                                                        \
    {                                                                                     \
        .word_count = 3, .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES},                   \
        .depth = ATTRIBUTE(TL_DEPTH_FORWARD, CHANNEL(2, 0, 24, UNORM)), MERLIN_ATTRIBUTES \
    }
/* What it was before its author dropped the position buffer: RGBA16F in place of depth. */
#define ROW_MERLIN_POSITION                                                                  \
    {                                                                                        \
        .word_count = 4, .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES},          \
        .depth =                                                                             \
            ATTRIBUTE(TL_DEPTH_VIEW_POSITION, HALF_AT(2, 0), HALF_AT(2, 16), HALF_AT(3, 0)), \
        MERLIN_ATTRIBUTES                                                                    \
    }

/* RGBA8: albedo; RGBA16F: position and emissive red; RGBA16F: the normal and emissive green; RGBA8:
 * occlusion, metallic, roughness and emissive blue. */
#define ROW_DXR                                                                              \
    {                                                                                        \
        .word_count = 6,                                                                     \
        .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, FOUR_BYTES},   \
        .normal_space = TL_NORMALS_IN_VIEW, .albedo = THREE_BYTES(TL_COLOR_RGB, 0, 0),       \
        .depth =                                                                             \
            ATTRIBUTE(TL_DEPTH_VIEW_POSITION, HALF_AT(1, 0), HALF_AT(1, 16), HALF_AT(2, 0)), \
        .normal = ATTRIBUTE(TL_NORMAL_XYZ, HALF_AT(3, 0), HALF_AT(3, 16), HALF_AT(4, 0)),    \
        .occlusion = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(5, 0)),                               \
        .metallic = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(5, 8)),                                \
        .roughness = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(5, 16)),                              \
        .emissive = ATTRIBUTE(TL_COLOR_RGB, HALF_AT(2, 16), HALF_AT(4, 16), BYTE_AT(5, 24))  \
    }

/* Eight planes: depth f32; normal x, y, specular amount and power f16; albedo 3 x 8 bits. Depth as the
 * camera's matrix has it, which may be reversed. */
#define ISPC_LAYOUT(depth_code)                                                          \
    {                                                                                    \
        .word_count = 8, .words = {FOUR_BYTES, TWO_BYTES, TWO_BYTES, TWO_BYTES,          \
                                   TWO_BYTES,  ONE_BYTE,  ONE_BYTE,  ONE_BYTE},          \
        .normal_space = TL_NORMALS_IN_VIEW, .depth = ATTRIBUTE(depth_code, FLOAT_AT(0)), \
        .normal = {TL_NORMAL_SPHEREMAP, {HALF_AT(1, 0), HALF_AT(2, 0)}},                 \
        .specular = ATTRIBUTE(TL_COLOR_GRAY, HALF_AT(3, 0)),                             \
        .shininess = ATTRIBUTE(TL_VALUE_PLAIN, HALF_AT(4, 0)),                           \
        .albedo = ATTRIBUTE(TL_COLOR_RGB, BYTE_AT(5, 0), BYTE_AT(6, 0), BYTE_AT(7, 0))   \
    }
#define ROW_ISPC ISPC_LAYOUT(TL_DEPTH_FORWARD)
#define ROW_ISPC_REVERSED ISPC_LAYOUT(TL_DEPTH_REVERSED)

/* Ours. Emission is a word of its own, where a scene has any, and so are an index and a tangent together.
 * What lies in the same bits is of the two kinds of material, of which a frame has one. */
#define EMISSIVE_WORD        \
    {                        \
        4, TL_GROUP_EMISSIVE \
    }
#define BRDF_WORD                           \
    {                                       \
        4, TL_GROUP_BRDF | TL_GROUP_TANGENT \
    }
#define BRDF_ATTRIBUTES(word)                                       \
    .brdf = ATTRIBUTE(TL_VALUE_PLAIN, CHANNEL(word, 24, 8, WHOLE)), \
    .tangent = {TL_NORMAL_OCTAHEDRON,                               \
                {CHANNEL(word, 0, 12, SNORM), CHANNEL(word, 12, 12, SNORM)}}
#define ROW_COMPACT_16                                                                        \
    {                                                                                         \
        .word_count = 6, .words = {FOUR_BYTES,    FOUR_BYTES,                                 \
                                   FOUR_BYTES,    {4, TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH}, \
                                   EMISSIVE_WORD, BRDF_WORD},                                 \
        .depth = ATTRIBUTE(TL_DEPTH_METRES, FLOAT_AT(0)),                                     \
        .normal = {TL_NORMAL_OCTAHEDRON,                                                      \
                   {CHANNEL(1, 0, 16, SNORM), CHANNEL(1, 16, 16, SNORM)}},                    \
        .albedo = THREE_BYTES(TL_COLOR_SQUARED, 2, 0),                                        \
        .occlusion = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(2, 24)),                               \
        .specular = THREE_BYTES(TL_COLOR_SQUARED, 3, 0),                                      \
        .shininess = ATTRIBUTE(TL_VALUE_LOGARITHM, BYTE_AT(3, 24)),                           \
        .roughness = ATTRIBUTE(TL_VALUE_PLAIN, CHANNEL(3, 0, 16, UNORM)),                     \
        .metallic = ATTRIBUTE(TL_VALUE_PLAIN, CHANNEL(3, 16, 16, UNORM)),                     \
        .emissive = ATTRIBUTE(TL_COLOR_SHARED, CHANNEL(4, 0, 32, UNORM)), BRDF_ATTRIBUTES(5)  \
    }
#define ROW_COMPACT_12                                                                       \
    {                                                                                        \
        .word_count = 5,                                                                     \
        .words = {FOUR_BYTES, FOUR_BYTES, FOUR_BYTES, EMISSIVE_WORD, BRDF_WORD},             \
        .depth = ATTRIBUTE(TL_DEPTH_METRES, CHANNEL(0, 8, 24, FLOAT24)),                     \
        .occlusion = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(0, 0)),                               \
        .normal = {TL_NORMAL_OCTAHEDRON,                                                     \
                   {CHANNEL(1, 0, 12, SNORM), CHANNEL(1, 12, 12, SNORM)}},                   \
        .roughness = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(1, 24)),                              \
        .shininess = ATTRIBUTE(TL_VALUE_LOGARITHM, BYTE_AT(1, 24)),                          \
        .albedo = THREE_BYTES(TL_COLOR_SQUARED, 2, 0),                                       \
        .metallic = ATTRIBUTE(TL_VALUE_PLAIN, BYTE_AT(2, 24)),                               \
        .specular = ATTRIBUTE(TL_COLOR_GRAY, BYTE_AT(2, 24)),                                \
        .emissive = ATTRIBUTE(TL_COLOR_SHARED, CHANNEL(3, 0, 32, UNORM)), BRDF_ATTRIBUTES(4) \
    }

#ifdef __OPENCL_C_VERSION__
__constant
#else
static
#endif
    const tl_layout tl_layouts[TL_LAYOUT_COUNT] = {
#define TL_LAYOUT_ROW(name, row, word) [name] = row,
        TL_LAYOUTS(TL_LAYOUT_ROW)
#undef TL_LAYOUT_ROW
};

/* Bytes of word `index` per pixel in a frame that has the planes `present`; 0 where it is not stored. */
TL_INLINE tl_u32 word_bytes(const tl_layout *layout, tl_u32 present, tl_u32 index)
{
    return (layout->words[index].planes & present) ? layout->words[index].bytes : 0u;
}

#endif
