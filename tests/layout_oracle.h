/* What the bytes of every layout mean, for tests: from the definitions of the formats, in long double,
 * sharing nothing with kernels/.
 *
 * A row spells the word planes of a layout, one after another, "|" between them; in each the fields from
 * the lowest bit of its little-endian bytes upwards, which is the order in which OpenGL lays out red, green,
 * blue, alpha (RGBA8 and RGBA16F by bytes, RGB10_A2 as GL_UNSIGNED_INT_2_10_10_10_REV). A field is NAME:FORMAT,
 * "-:BITS" is unused; "?" before a word: it is there where the frame has what its first field says. */
#ifndef TL_LAYOUT_ORACLE_H
#define TL_LAYOUT_ORACLE_H

#include "testing.h"

#include "tilelight/layouts.h"

typedef long double wide;

/* X(name in the rows, the first plane of what it says) */
#define ORACLE_FIELDS(X)                                                                  \
    X(px, TL_DEPTH)                                                                       \
    X(py, TL_DEPTH)                                                                       \
    X(pz, TL_DEPTH)                                                                       \
    X(nx, TL_NORMAL_X)                                                                    \
    X(ny, TL_NORMAL_X) X(nz, TL_NORMAL_X) X(ar, TL_ALBEDO_R) X(ag, TL_ALBEDO_R)           \
        X(ab, TL_ALBEDO_R) X(sr, TL_SPECULAR_R) X(sg, TL_SPECULAR_R) X(sb, TL_SPECULAR_R) \
            X(exponent, TL_SHININESS) X(metal, TL_METALLIC) X(rough, TL_ROUGHNESS)        \
                X(ao, TL_OCCLUSION) X(er, TL_EMISSIVE_R) X(eg, TL_EMISSIVE_R)             \
                    X(eb, TL_EMISSIVE_R) X(bi, TL_BRDF) X(tx, TL_TANGENT_X)               \
                        X(ty, TL_TANGENT_X) X(tz, TL_TANGENT_X)
enum oracle_field {
#define FIELD_NAME(name, plane) F_##name,
    ORACLE_FIELDS(FIELD_NAME) F_COUNT
#undef FIELD_NAME
};

enum oracle_depth { METRES, FORWARD, NDC, REVERSED, FRACTION, IN_VIEW, IN_WORLD };
enum oracle_normal { XYZ, OCTAHEDRON, SPHEREMAP };
enum oracle_color { RGB, SQUARED, GRAY, SHARED };
enum oracle_exponent { PLAIN, LOGARITHM };

typedef struct oracle_row {
    enum oracle_depth depth;
    enum oracle_normal normal;
    int normals_in_view;
    enum oracle_color albedo, specular, emissive;
    enum oracle_exponent exponent;
    const char *words,
        *metal_words, /* NULL: the same with metallic and roughness, or it has none */
        *index_words; /* NULL: the same with indices of materials */
} oracle_row;

#define FLOATS_AFTER_DEPTH                                                              \
    "|nx:f32|ny:f32|nz:f32|ar:f32|ag:f32|ab:f32|?sr:f32|?sg:f32|?sb:f32|?exponent:f32|" \
    "?metal:f32|?rough:f32|?ao:f32|?er:f32|?eg:f32|?eb:f32|?bi:f32|?tx:f32|?ty:f32|?tz:f32"
#define RGBA16F_POSITION "px:f16 py:f16|pz:f16 "
#define RGBA8_ALBEDO "ar:u8 ag:u8 ab:u8 "
#define MERLIN_SURFACE(last) RGBA8_ALBEDO "exponent:u8|nx:u8 ny:u8 nz:u8 " last "|"
#define ISPC_ROW(convention)                                                              \
    {                                                                                     \
        .depth = convention, .normal = SPHEREMAP, .normals_in_view = 1, .specular = GRAY, \
        .words = "px:f32|nx:f16|ny:f16|sr:f16|exponent:f16|ar:u8|ag:u8|ab:u8"             \
    }
#define COMPACT_EXTRAS "|?er:rgb9e5|?tx:s12 ty:s12 bi:i8"
#define COMPACT_16(material) \
    "px:f32|nx:s16 ny:s16|" RGBA8_ALBEDO "ao:u8|?" material COMPACT_EXTRAS
#define COMPACT_12(width, shine) \
    "ao:u8 px:f24|nx:s12 ny:s12 " width "|" RGBA8_ALBEDO shine COMPACT_EXTRAS

static const oracle_row oracle_rows[TL_LAYOUT_COUNT] = {
    [TL_LAYOUT_FLOAT] = {.depth = METRES, .words = "px:f32" FLOATS_AFTER_DEPTH},
    [TL_LAYOUT_FLOAT_FORWARD] = {.depth = FORWARD, .words = "px:f32" FLOATS_AFTER_DEPTH},
    [TL_LAYOUT_FLOAT_NDC] = {.depth = NDC, .words = "px:f32" FLOATS_AFTER_DEPTH},
    [TL_LAYOUT_FLOAT_REVERSED] = {.depth = REVERSED, .words = "px:f32" FLOATS_AFTER_DEPTH},
    [TL_LAYOUT_FLOAT_FRACTION] = {.depth = FRACTION, .words = "px:f32" FLOATS_AFTER_DEPTH},
    [TL_LAYOUT_FLOAT_POSITION] = {.depth = IN_VIEW,
                                  .words = "px:f32|py:f32|pz:f32" FLOATS_AFTER_DEPTH},
    [TL_LAYOUT_SHADERX2_128] = {.depth = IN_WORLD,
                                .words = RGBA16F_POSITION
                                "-:16|nx:u10 ny:u10 nz:u10 -:2|" RGBA8_ALBEDO "-:8"},
    [TL_LAYOUT_SHADERX2_128_S10] = {.depth = IN_WORLD,
                                    .words = RGBA16F_POSITION
                                    "-:16|nx:s10 ny:s10 nz:s10 -:2|" RGBA8_ALBEDO "-:8"},
    [TL_LAYOUT_SHADERX2_128_U8] = {.depth = IN_WORLD,
                                   .words = RGBA16F_POSITION
                                   "-:16|nx:u8 ny:u8 nz:u8 -:8|" RGBA8_ALBEDO "-:8"},
    [TL_LAYOUT_SHADERX2_128_S8] = {.depth = IN_WORLD,
                                   .words = RGBA16F_POSITION
                                   "-:16|nx:s8 ny:s8 nz:s8 -:8|" RGBA8_ALBEDO "-:8"},
    [TL_LAYOUT_SHADERX2_160] = {.depth = IN_WORLD,
                                .words = RGBA16F_POSITION
                                "-:16|nx:f16 ny:f16|nz:f16 -:16|" RGBA8_ALBEDO "-:8"},
    [TL_LAYOUT_SHADERX2_96] = {.depth = IN_WORLD,
                               .words =
                                   "px:f16 py:f16|pz:f16|" RGBA8_ALBEDO "nz:u8|nx:u8 ny:u8"},
    [TL_LAYOUT_TUTORIAL] = {.depth = FORWARD,
                            .normals_in_view = 1,
                            .exponent = LOGARITHM,
                            .words = "nx:u8 ny:u8 nz:u8 -:8|" RGBA8_ALBEDO
                                     "-:8|sr:u8 sg:u8 sb:u8 exponent:u8|px:f32"},
    [TL_LAYOUT_TUTORIAL_U24] = {.depth = FORWARD,
                                .normals_in_view = 1,
                                .exponent = LOGARITHM,
                                .words = "nx:u8 ny:u8 nz:u8 -:8|" RGBA8_ALBEDO
                                         "-:8|sr:u8 sg:u8 sb:u8 exponent:u8|px:u24 -:8"},
    [TL_LAYOUT_TUTORIAL_3X8] = {.depth = FORWARD,
                                .normals_in_view = 1,
                                .exponent = LOGARITHM,
                                .words = "nx:u8 ny:u8 nz:u8 -:8|" RGBA8_ALBEDO
                                         "-:8|sr:u8 sg:u8 sb:u8 exponent:u8|px:rgb24 -:8"},
    [TL_LAYOUT_MERLIN] = {.depth = FORWARD,
                          .normals_in_view = 1,
                          .specular = GRAY,
                          .exponent = LOGARITHM,
                          .words = MERLIN_SURFACE("sr:u8") "px:u24 -:8",
                          .index_words = MERLIN_SURFACE("bi:i8") "px:u24 -:8"},
    [TL_LAYOUT_MERLIN_POSITION] = {.depth = IN_VIEW,
                                   .normals_in_view = 1,
                                   .specular = GRAY,
                                   .exponent = LOGARITHM,
                                   .words = MERLIN_SURFACE("sr:u8") RGBA16F_POSITION "-:16",
                                   .index_words =
                                       MERLIN_SURFACE("bi:i8") RGBA16F_POSITION "-:16"},
    [TL_LAYOUT_DXR] = {.depth = IN_VIEW,
                       .normals_in_view = 1,
                       .words = RGBA8_ALBEDO
                       "-:8|" RGBA16F_POSITION
                       "er:f16|nx:f16 ny:f16|nz:f16 eg:f16|ao:u8 metal:u8 rough:u8 eb:u8"},
    [TL_LAYOUT_ISPC] = ISPC_ROW(FORWARD),
    [TL_LAYOUT_ISPC_REVERSED] = ISPC_ROW(REVERSED),
    [TL_LAYOUT_COMPACT_16] = {.depth = METRES,
                              .normal = OCTAHEDRON,
                              .albedo = SQUARED,
                              .specular = SQUARED,
                              .emissive = SHARED,
                              .exponent = LOGARITHM,
                              .words = COMPACT_16("sr:u8 sg:u8 sb:u8 exponent:u8"),
                              .metal_words = COMPACT_16("rough:u16 metal:u16")},
    [TL_LAYOUT_COMPACT_12] = {.depth = METRES,
                              .normal = OCTAHEDRON,
                              .albedo = SQUARED,
                              .specular = GRAY,
                              .emissive = SHARED,
                              .exponent = LOGARITHM,
                              .words = COMPACT_12("exponent:u8", "sr:u8"),
                              .metal_words = COMPACT_12("rough:u8", "metal:u8")},
};

/* --- numbers --------------------------------------------------------------------------------------- */

/* A binary float with a sign bit (or none), an exponent and a mantissa; all ones in the exponent is no
 * finite number. */
static inline wide oracle_float(uint32_t bits, int exponent_bits, int mantissa_bits)
{
    const uint32_t ones = (1u << exponent_bits) - 1u;
    const uint32_t mantissa = bits & ((1u << mantissa_bits) - 1u);
    const uint32_t exponent = bits >> mantissa_bits & ones;
    const int bias = (int)(ones >> 1);
    const wide sign = bits >> mantissa_bits >> exponent_bits & 1u ? -1 : 1;
    if (exponent == ones)
        return mantissa ? (wide)NAN : sign * (wide)INFINITY;
    if (exponent == 0)
        return sign * ldexpl((wide)mantissa, 1 - bias - mantissa_bits);
    return sign * (1 + ldexpl((wide)mantissa, -mantissa_bits)) *
           ldexpl(1, (int)exponent - bias);
}

static inline wide oracle_number(const char *format, uint32_t bits, int count)
{
    const wide most = (wide)(count == 32 ? 0xffffffffu : (1u << count) - 1u);
    if (format[0] == 'f')
        return count == 16 ? oracle_float(bits, 5, 10)
                           : oracle_float(bits, 8, count - (count == 24 ? 8 : 9));
    if (strncmp(format, "rgb24", 5) == 0) /* red is the first byte, and the highest */
        return (wide)((bits & 0xffu) * 65536u + (bits >> 8 & 0xffu) * 256u + (bits >> 16)) /
               most;
    if (format[0] == 's') {
        const wide signed_value = bits >> (count - 1) ? (wide)bits - (most + 1) : (wide)bits;
        return signed_value / ((most - 1) / 2);
    }
    if (format[0] == 'i')
        return (wide)bits;
    return (wide)bits / most;
}

static inline int oracle_bits(const char *format)
{
    return strncmp(format, "rgb9e5", 6) == 0      ? 32
           : strncmp(format, "rgb24", 5) == 0     ? 24
           : format[0] >= '0' && format[0] <= '9' ? atoi(format)
                                                  : atoi(format + 1);
}

static inline const char *oracle_words(enum tl_layout_name layout, uint32_t present)
{
    const oracle_row *row = &oracle_rows[layout];
    if ((present & TL_GROUP_BRDF) && row->index_words)
        return row->index_words;
    return (present & TL_GROUP_METAL_ROUGH) && row->metal_words ? row->metal_words : row->words;
}

static inline int oracle_field_of(const char *name, uint32_t *plane)
{
    static const struct {
        const char *name;
        uint32_t plane;
    } fields[F_COUNT] = {
#define FIELD_ROW(name, plane) {#name, plane},
        ORACLE_FIELDS(FIELD_ROW)
#undef FIELD_ROW
    };
    const size_t length = strcspn(name, ":");
    for (int i = 0; i < F_COUNT; i++)
        if (strlen(fields[i].name) == length && strncmp(fields[i].name, name, length) == 0) {
            *plane = fields[i].plane;
            return i;
        }
    return -1;
}

/* RGB9E5: three mantissas of 9 bits, red lowest, times 2^(exponent - 15 - 9). */
static inline void oracle_shared(uint32_t bits, wide out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = ldexpl((wide)(bits >> 9 * i & 511u), (int)(bits >> 27) - 24);
}

/* Of the pixel at `at`, what its words say, before any code. Returns the bits of a pixel. */
static inline uint32_t oracle_read(const tl_gbuffer *g, size_t at, wide fields[F_COUNT])
{
    const unsigned char *plane = g->planes;
    const char *text = oracle_words(g->layout, g->present);
    const size_t pixels = (size_t)g->pitch * g->rows;
    uint32_t pixel_bits = 0;
    memset(fields, 0, F_COUNT * sizeof *fields);
    while (*text) {
        struct {
            int field, first, bits;
            const char *format;
        } parts[5];
        int count = 0, bits = 0, is_there = *text != '?';
        text += *text == '?';
        for (; *text && *text != '|'; text += *text == ' ') {
            uint32_t says = 0;
            parts[count].field = oracle_field_of(text, &says);
            if (!is_there && count == 0 && !(g->present >> says & 1u))
                is_there = -1;
            parts[count].format = text + strcspn(text, ":") + 1;
            parts[count].first = bits;
            parts[count].bits = oracle_bits(parts[count].format);
            bits += parts[count].bits;
            count++;
            text += strcspn(text, " |");
        }
        text += *text == '|';
        if (is_there == -1)
            continue;
        uint32_t word = 0;
        const unsigned char *bytes = plane + at * (size_t)(bits / 8);
        for (int i = bits / 8; i-- > 0;)
            word = word << 8 | bytes[i];
        for (int i = 0; i < count; i++) {
            const uint32_t value = parts[i].bits == 32
                                       ? word
                                       : word >> parts[i].first & ((1u << parts[i].bits) - 1u);
            if (parts[i].field < 0)
                continue;
            if (strncmp(parts[i].format, "rgb9e5", 6) == 0)
                oracle_shared(value, &fields[parts[i].field]);
            else
                fields[parts[i].field] = oracle_number(parts[i].format, value, parts[i].bits);
        }
        plane += pixels * (size_t)(bits / 8);
        pixel_bits += (uint32_t)bits;
    }
    return pixel_bits;
}

/* --- codes ----------------------------------------------------------------------------------------- */

/* m; +infinity is sky. */
static inline wide oracle_depth_of(const tl_camera *c, enum oracle_depth code, wide stored)
{
    const wide near = c->near, far = c->far;
    if (code == METRES)
        return stored;
    if (code == FRACTION)
        return isinf(stored) ? (wide)INFINITY : near + stored * (far - near);
    const wide from_near = code == FORWARD ? stored
                           : code == NDC   ? (stored + 1) / 2
                                           : 1 - stored;
    if (code == REVERSED ? stored == 0 : from_near == 1)
        return (wide)INFINITY;
    if (c->projection == TL_ORTHOGRAPHIC)
        return near + from_near * (far - near);
    if (code == REVERSED)
        return isinf(far) ? near / stored : near * far / (near + stored * (far - near));
    return isinf(far) ? near / (1 - from_near) : near * far / (far - from_near * (far - near));
}

static inline void oracle_turn(const tl_camera *c, const wide world[3], wide view[3])
{
    for (int i = 0; i < 3; i++)
        view[i] = c->view_from_world[i][0] * world[0] + c->view_from_world[i][1] * world[1] +
                  c->view_from_world[i][2] * world[2];
}

/* Where the surface is, view space, m; view[2] is -infinity where nothing was hit. What stores depth is on
 * `ray`: x/depth and y/depth, or x and y. */
static inline void oracle_position(const tl_camera *c,
                                   enum oracle_depth code,
                                   const wide fields[F_COUNT],
                                   const wide ray[2],
                                   wide view[3])
{
    if (code == IN_VIEW || code == IN_WORLD) {
        if (code == IN_WORLD)
            oracle_turn(c, &fields[F_px], view);
        for (int i = 0; i < 3; i++)
            view[i] = code == IN_WORLD ? view[i] + c->view_from_world[i][3] : fields[F_px + i];
        if (isinf(fields[F_px]))
            view[2] = -(wide)INFINITY;
        return;
    }
    const wide depth = oracle_depth_of(c, code, fields[F_px]);
    const wide scale = c->projection == TL_ORTHOGRAPHIC ? 1 : depth;
    view[0] = ray[0] * scale;
    view[1] = ray[1] * scale;
    view[2] = -depth;
}

/* Not unit; 0 is no normal. `is_short`: of few bits, where below 1/2 is none. */
static inline void oracle_xyz(const char *format, const wide f[3], wide n[3])
{
    for (int i = 0; i < 3; i++)
        n[i] = format[0] == 'u' ? 2 * f[i] - 1 : f[i];
    if (format[0] != 'f' && n[0] * n[0] + n[1] * n[1] + n[2] * n[2] <= 0.25L)
        n[0] = n[1] = n[2] = 0;
}

/* Meyer et al. 2010: back from the square; beyond its inner diamond the lower half is folded out. */
static inline void oracle_octahedron(const wide f[3], wide n[3])
{
    const wide x = f[0], y = f[1], height = 1 - fabsl(x) - fabsl(y);
    n[0] = n[1] = n[2] = 0;
    if (x < -1)
        return;
    n[0] = height < 0 ? copysignl(1 - fabsl(y), x) : x;
    n[1] = height < 0 ? copysignl(1 - fabsl(x), y) : y;
    n[2] = height;
}

/* Lambert: the distance from the disk's middle is 2 sin(t/2), t the angle from the view axis. */
static inline void oracle_spheremap(const wide f[3], wide n[3])
{
    const wide x = 4 * f[0] - 2, y = 4 * f[1] - 2, r = hypotl(x, y);
    const wide t = 2 * asinl(fminl(r / 2, 1));
    n[0] = n[1] = n[2] = 0;
    if (f[0] == 0 && f[1] == 0)
        return;
    n[0] = r > 0 ? sinl(t) * x / r : 0;
    n[1] = r > 0 ? sinl(t) * y / r : 0;
    n[2] = cosl(t);
}

static inline void oracle_normal(enum tl_layout_name layout,
                                 const wide fields[F_COUNT],
                                 wide n[3])
{
    const oracle_row *row = &oracle_rows[layout];
    if (row->normal == XYZ)
        oracle_xyz(strstr(row->words, "nx:") + 3, &fields[F_nx], n);
    else if (row->normal == OCTAHEDRON)
        oracle_octahedron(&fields[F_nx], n);
    else
        oracle_spheremap(&fields[F_nx], n);
}

static inline void oracle_color(enum oracle_color code, const wide f[3], wide c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = code == SQUARED ? f[i] * f[i] : code == GRAY ? f[0] : f[i];
}

static inline wide oracle_exponent(enum oracle_exponent code, wide stored)
{
    return code == LOGARITHM ? powl(10001, stored) - 1 : stored;
}

#endif
