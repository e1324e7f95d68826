/* Does a pixel of a capture hold what glTF says its material is?
 *
 * The square fills the picture under an orthographic camera, so that pixel (x, y) looks at texture
 * coordinate ((x + 0.5) / SIZE, (y + 0.5) / SIZE). */
#include "gltf_textures.h"

enum { SIZE = 64, CENTER = SIZE / 2 };

static const tl_capture_options options = {.width = SIZE, .height = SIZE};

/* The scene with an orthographic camera that fits it, and other JSON before its materials. */
static char *flat_scene(const square_data *data, const char *extra)
{
    char *text = square_scene(data);
    text = edited(
        text, "\"perspective\",\n \"perspective\":{\"yfov\":1.0,\"znear\":0.1,\"zfar\":100}",
        "\"orthographic\",\n \"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0,"
        "\"zfar\":10}");
    char *const before = malloc(strlen(extra) + 32);
    assert_non_null(before);
    sprintf(before, "%s\"materials\"", extra);
    text = edited(text, "\"materials\"", before);
    free(before);
    return text;
}

static void assert_near(const char *what, float got, double want, double tolerance)
{
    if (!(fabs((double)got - want) <= tolerance))
        fail_msg("%s: got %.9g, want %.9g within %.3g", what, (double)got, want, tolerance);
}

static void capture_ok(const char *text, shot *taken)
{
    ASSERT_OK(shoot_text("materials", text, &options, taken), taken->err);
}

/* --- factors ----------------------------------------------------------------------------------- */

static const struct {
    const char *name, *edits[2][2];
    uint32_t present;
    enum tl_plane plane;
    double want;
} factors[] = {
    {"red", {{0}}, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH, TL_ALBEDO_R, 0.25},
    {"blue", {{0}}, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH, TL_ALBEDO_B, 0.75},
    {"metallic", {{0}}, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH, TL_METALLIC, 0.125},
    {"roughness", {{0}}, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH, TL_ROUGHNESS, 0.625},
    {"default material",
     {{"\"material\":0,", ""}},
     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
     TL_ROUGHNESS,
     1.0},
    {"factor above 1",
     {{"\"metallicFactor\":0.125", "\"metallicFactor\":7"}},
     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
     TL_METALLIC,
     1.0},
    {"emission",
     {{"\"name\":\"paint\"", "\"emissiveFactor\":[0.5,0,1],\"name\":\"paint\""}},
     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE,
     TL_EMISSIVE_R,
     0.5},
    {"emission with strength",
     {{"\"name\":\"paint\"",
       "\"emissiveFactor\":[0.5,0,1],\"extensions\":{\"KHR_materials_emissive_strength\":{"
       "\"emissiveStrength\":8}},\"name\":\"paint\""}},
     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE,
     TL_EMISSIVE_B,
     8.0},
};

static void factors_come_exactly(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(factors); i++) {
        char *text = flat_scene(&square, "");
        shot taken;
        for (int k = 0; k < 2 && factors[i].edits[k][0]; k++)
            text = edited(text, factors[i].edits[k][0], factors[i].edits[k][1]);
        capture_ok(text, &taken);
        if (taken.gbuffer->present != factors[i].present)
            fail_msg("%s: planes %x, want %x", factors[i].name, taken.gbuffer->present,
                     factors[i].present);
        assert_near(factors[i].name, shown_at(&taken, factors[i].plane, CENTER, CENTER),
                    factors[i].want, 0.0);
        shot_clear(&taken);
        free(text);
    }
}

/* --- textures ---------------------------------------------------------------------------------- */

/* IEC 61966-2-1. */
static double srgb_to_linear(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* Half a step of 65535, and the roundings of a product of floats. */
static const double texture_bound = 0.5 / 65535 + 4 * 0x1p-24;

static void textures_are_decoded(void **state)
{
    uint8_t ramp[4 * SIZE];
    shot taken;
    (void)state;
    for (int x = 0; x < SIZE; x++) {
        const uint8_t pixel[4] = {(uint8_t)(4 * x), (uint8_t)(3 * x), (uint8_t)(2 * x), 255};
        memcpy(ramp + 4 * x, pixel, 4);
    }
    char *const json = texture_json(ramp, SIZE, 1);
    char *text = flat_scene(&square, json);
    text =
        edited(text, "\"metallicFactor\":0.125,\"roughnessFactor\":0.625",
               "\"baseColorTexture\":{\"index\":0},\"metallicRoughnessTexture\":{\"index\":0},"
               "\"metallicFactor\":0.5,\"roughnessFactor\":1");
    text = edited(text, "\"name\":\"paint\"",
                  "\"occlusionTexture\":{\"index\":0,\"strength\":0.5},"
                  "\"emissiveTexture\":{\"index\":0},\"emissiveFactor\":[1,1,0.5]");
    capture_ok(text, &taken);
    for (uint32_t x = 0; x < SIZE; x++) {
        const double r = 4.0 * x / 255, g = 3.0 * x / 255, b = 2.0 * x / 255;
        const struct {
            const char *name;
            enum tl_plane plane;
            double want;
        } wanted[] = {
            {"base red", TL_ALBEDO_R, 0.25 * srgb_to_linear(r)},
            {"base green", TL_ALBEDO_G, 0.5 * srgb_to_linear(g)},
            {"base blue", TL_ALBEDO_B, 0.75 * srgb_to_linear(b)},
            {"metallic is blue", TL_METALLIC, 0.5 * b},
            {"roughness is green", TL_ROUGHNESS, g},
            {"occlusion is red", TL_OCCLUSION, 1 + 0.5 * (r - 1)},
            {"emission", TL_EMISSIVE_B, 0.5 * srgb_to_linear(b)},
        };
        for (size_t i = 0; i < COUNT_OF(wanted); i++)
            assert_near(wanted[i].name, shown_at(&taken, wanted[i].plane, x, 5), wanted[i].want,
                        texture_bound);
    }
    shot_clear(&taken);
    free(json);
    free(text);
}

/* Between two texels a filter has as many steps as there are pixels: not those of 8 bits. */
static void filters_are_fine(void **state)
{
    static const uint8_t pair[8] = {0, 100, 0, 255, 0, 110, 0, 255};
    shot taken;
    (void)state;
    char *const json = texture_json(pair, 2, 1);
    char *text = flat_scene(&square, json);
    text = edited(text, "\"magFilter\":9728", "\"magFilter\":9729");
    text = edited(text, "\"roughnessFactor\":0.625",
                  "\"roughnessFactor\":1,\"metallicRoughnessTexture\":{\"index\":0}");
    capture_ok(text, &taken);
    for (uint32_t x = 0; x < SIZE; x++) {
        const double u = fmin(fmax(2 * (x + 0.5) / SIZE - 0.5, 0), 1);
        assert_near("filtered roughness", shown_at(&taken, TL_ROUGHNESS, x, 5),
                    (100 + 10 * u) / 255, texture_bound);
    }
    shot_clear(&taken);
    free(json);
    free(text);
}

/* Which texel each quarter of the picture shows: 0 1 over 2 3, in red. */
static const struct {
    const char *name, *texture; /* JSON behind "index":0 */
    double quarters[4];
} lookups[] = {
    {"top row first", "", {0, 1, 2, 3}},
    {"second set", ",\"texCoord\":1", {1, 0, 3, 2}},
    {"offset",
     ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0,-0.5]}}",
     {2, 3, 0, 1}},
    {"scale",
     ",\"extensions\":{\"KHR_texture_transform\":{\"scale\":[-1,1],\"offset\":[1,0]}}",
     {1, 0, 3, 2}},
    /* A quarter turn: counter-clockwise for the coordinates is clockwise for the picture. */
    {"rotation",
     ",\"extensions\":{\"KHR_texture_transform\":{\"rotation\":1.5707963267948966,"
     "\"offset\":[0,1]}}",
     {2, 0, 3, 1}},
    {"last set", ",\"texCoord\":7", {1, 0, 3, 2}},
    {"set of the transform",
     ",\"extensions\":{\"KHR_texture_transform\":{\"texCoord\":1}}",
     {1, 0, 3, 2}},
};

static void lookups_find_their_texels(void **state)
{
    uint8_t texels[16];
    (void)state;
    for (int i = 0; i < 4; i++) {
        const uint8_t pixel[4] = {0, (uint8_t)(60 * i), 0, 255};
        memcpy(texels + 4 * i, pixel, 4);
    }
    char *const json = texture_json(texels, 2, 2);
    for (size_t i = 0; i < COUNT_OF(lookups); i++) {
        square_data data = square;
        char use[512];
        shot taken;
        char *text = flat_scene(&data, json);
        /* TEXCOORD_1 is the square's positions: u and v from -1 to 1, mirrored by the wrap. */
        text = edited(text, "\"TEXCOORD_0\":2",
                      "\"TEXCOORD_0\":2,\"TEXCOORD_1\":4,\"TEXCOORD_7\":4");
        text = edited(text, "\"type\":\"SCALAR\"}",
                      "\"type\":\"SCALAR\"},\n {\"bufferView\":4,\"componentType\":5126,"
                      "\"count\":4,\"type\":\"VEC2\"}");
        text =
            edited(text, "\"byteOffset\":128,\"byteLength\":12}",
                   "\"byteOffset\":128,\"byteLength\":12},\n {\"buffer\":1,\"byteLength\":32}");
        const float mirrored[4][2] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
        char *const second = base64(mirrored, sizeof mirrored), buffer[256];
        snprintf(buffer, sizeof buffer,
                 "\"byteLength\":140},{\"byteLength\":32,"
                 "\"uri\":\"data:application/octet-stream;base64,%s\"}]",
                 second);
        text = edited(text, "\"byteLength\":140}]", buffer);
        text = edited(text, "\"wrapS\":33071", "\"wrapS\":10497");
        /* Masked, so that the depth pass looks up too. */
        text = edited(text, "\"name\":\"paint\"", "\"alphaMode\":\"MASK\",\"name\":\"paint\"");
        snprintf(use, sizeof use,
                 "\"roughnessFactor\":1,\"metallicRoughnessTexture\":{\"index\":0%s},"
                 "\"baseColorTexture\":{\"index\":0%s}",
                 lookups[i].texture, lookups[i].texture);
        text = edited(text, "\"roughnessFactor\":0.625", use);
        capture_ok(text, &taken);
        for (uint32_t k = 0; k < 4; k++)
            assert_near(lookups[i].name,
                        shown_at(&taken, TL_ROUGHNESS, SIZE / 4 + k % 2 * SIZE / 2,
                                 SIZE / 4 + k / 2 * SIZE / 2),
                        60 * lookups[i].quarters[k] / 255, texture_bound);
        shot_clear(&taken);
        free(second);
        free(text);
    }
    free(json);
}

static void a_missing_image_is_told(void **state)
{
    shot taken;
    (void)state;
    char *text = flat_scene(
        &square, "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"absent.png\"}],");
    text = edited(text, "\"metallicFactor\"",
                  "\"baseColorTexture\":{\"index\":0},\"metallicFactor\"");
    capture_ok(text, &taken);
    assert_non_null(strstr(taken.notices.text, "absent.png"));
    assert_near("factor alone", shown_at(&taken, TL_ALBEDO_R, CENTER, CENTER), 0.25, 0.0);
    shot_clear(&taken);
    free(text);
}

/* --- holes and sides --------------------------------------------------------------------------- */

static const struct {
    const char *name, *mode;
    int least; /* alpha of 255 from which on something is there */
    int notices;
} holes[] = {
    {"opaque", "\"alphaMode\":\"OPAQUE\",", 0, 0},
    {"mask", "\"alphaMode\":\"MASK\",", 128, 0},
    {"mask at a level", "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.8,", 204, 0},
    {"mask above all", "\"alphaMode\":\"MASK\",\"alphaCutoff\":1.5,", 256, 0},
    {"blend, without layers", "\"alphaMode\":\"BLEND\",", 128, 1},
};

static void alpha_makes_holes(void **state)
{
    uint8_t ramp[4 * SIZE];
    tl_capture_options opaque = options;
    (void)state;
    opaque.without_layers = true;
    for (int x = 0; x < SIZE; x++) {
        const uint8_t pixel[4] = {255, 255, 255, (uint8_t)(4 * x)};
        memcpy(ramp + 4 * x, pixel, 4);
    }
    char *const json = texture_json(ramp, SIZE, 1);
    for (size_t i = 0; i < COUNT_OF(holes); i++) {
        char *text = flat_scene(&square, json), before[128];
        shot taken;
        snprintf(before, sizeof before, "%s\"name\":\"paint\"", holes[i].mode);
        text = edited(text, "\"name\":\"paint\"", before);
        text = edited(text, "\"metallicFactor\"",
                      "\"baseColorTexture\":{\"index\":0},\"metallicFactor\"");
        ASSERT_OK(shoot_text("holes", text, &opaque, &taken), taken.err);
        for (uint32_t x = 0; x < SIZE; x++)
            if (isfinite(shown_at(&taken, TL_DEPTH, x, 9)) != ((int)(4 * x) >= holes[i].least))
                fail_msg("%s: alpha %u is %s", holes[i].name, 4 * x,
                         (int)(4 * x) >= holes[i].least ? "a hole" : "there");
        assert_int_equal(taken.notices.count, holes[i].notices);
        shot_clear(&taken);
        free(text);
    }
    free(json);
}

/* From behind: rotation by half a turn around y. */
static const struct {
    const char *name, *node, *material;
    double normal_z; /* 0: nothing there */
} sides[] = {
    {"front", "", "", 1},
    {"back", "\"rotation\":[0,1,0,0],", "", 0},
    {"back of two sides", "\"rotation\":[0,1,0,0],", "\"doubleSided\":true,", 1},
    {"mirrored front", "\"scale\":[-1,1,1],", "", 1},
    {"mirrored back", "\"scale\":[1,1,-1],", "", 0},
    {"mirrored back of two sides", "\"scale\":[1,1,-1],", "\"doubleSided\":true,", 1},
};

static void sides_are_told_apart(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(sides); i++) {
        char *text = flat_scene(&square, ""), part[128];
        shot taken;
        snprintf(part, sizeof part, "%s\"mesh\":0", sides[i].node);
        text = edited(text, "\"mesh\":0", part);
        snprintf(part, sizeof part, "%s\"name\":\"paint\"", sides[i].material);
        text = edited(text, "\"name\":\"paint\"", part);
        capture_ok(text, &taken);
        assert_near(sides[i].name, shown_at(&taken, TL_NORMAL_Z, CENTER, CENTER),
                    sides[i].normal_z, 4 * 0x1p-24);
        assert_int_equal(isfinite(shown_at(&taken, TL_DEPTH, CENTER, CENTER)) != 0,
                         sides[i].normal_z != 0);
        shot_clear(&taken);
        free(text);
    }
}

/* --- normal maps ------------------------------------------------------------------------------- */

/* A map that leans to its right and a little less up: where that is in the world depends on how the
 * texture lies. The tangents are those that the coordinates imply, in the node's space. */
static const struct {
    const char *name, *node;
    float coordinates[4][2];
    float tangent_x, tangent_w;
    double right, up; /* of the map, as signs of world x and y */
    double scale;
} leans[] = {
    {"upright", "", {{0, 1}, {1, 1}, {1, 0}, {0, 0}}, 1, 1, 1, 1, 1},
    {"u mirrored", "", {{1, 1}, {0, 1}, {0, 0}, {1, 0}}, -1, -1, -1, 1, 1},
    {"v mirrored", "", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1, 1, -1, 1},
    {"node mirrored", "\"scale\":[-1,1,1],", {{0, 1}, {1, 1}, {1, 0}, {0, 0}}, 1, 1, -1, 1, 1},
    {"stretched", "\"scale\":[3,1,1],", {{0, 1}, {1, 1}, {1, 0}, {0, 0}}, 1, 1, 1, 1, 1},
    {"scaled", "", {{0, 1}, {1, 1}, {1, 0}, {0, 0}}, 1, 1, 1, 1, 0.25},
};

/* The lean of one case, with the file's tangents or with those that are made where it has none. */
static void check_lean(size_t i, const char *texture, int has_tangents)
{
    square_data data = square;
    char part[128];
    shot taken;
    memcpy(data.coordinates, leans[i].coordinates, sizeof data.coordinates);
    char *text = flat_scene(&data, texture);
    snprintf(part, sizeof part,
             "\"normalTexture\":{\"index\":0,\"scale\":%g},\"name\":\"paint\"", leans[i].scale);
    text = edited(text, "\"name\":\"paint\"", part);
    snprintf(part, sizeof part, "%s\"mesh\":0", leans[i].node);
    text = edited(text, "\"mesh\":0", part);
    if (has_tangents)
        text = with_tangents(text, leans[i].tangent_x, leans[i].tangent_w);
    capture_ok(text, &taken);
    const double x = leans[i].scale * (2 * 220 / 255.0 - 1);
    const double y = leans[i].scale * (2 * 190 / 255.0 - 1), z = 2 * 230 / 255.0 - 1;
    const double length = sqrt(x * x + y * y + z * z);
    const double want[3] = {leans[i].right * x / length, leans[i].up * y / length, z / length};
    const double tolerance = 16 * 0x1p-24;
    for (int k = 0; k < 3; k++)
        assert_near(leans[i].name,
                    shown_at(&taken, (enum tl_plane)(TL_NORMAL_X + k), CENTER, CENTER), want[k],
                    tolerance);
    shot_clear(&taken);
    free(text);
}

static void normal_maps_lean_their_way(void **state)
{
    static const uint8_t texel[4] = {220, 190, 230, 255};
    char *const json = texture_json(texel, 1, 1);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(leans); i++)
        for (int has_tangents = 0; has_tangents < 2; has_tangents++)
            check_lean(i, json, has_tangents);
    free(json);
}

/* --- vertices ---------------------------------------------------------------------------------- */

static const struct {
    const char *name, *accessor;
    uint8_t bytes[4][16]; /* a colour per vertex, in the accessor's type */
    size_t stride;
    double red, green;
} colors[] = {
    {"float RGB", "\"componentType\":5126,\"type\":\"VEC3\"", {{0}}, 12, 0.5, 1.0},
    {"float RGBA", "\"componentType\":5126,\"type\":\"VEC4\"", {{0}}, 16, 0.5, 1.0},
    {"8-bit RGBA",
     "\"componentType\":5121,\"normalized\":true,\"type\":\"VEC4\"",
     {{51, 255, 0, 255}, {51, 255, 0, 255}, {51, 255, 0, 255}, {51, 255, 0, 255}},
     4,
     0.2,
     1.0},
    {"8-bit RGB, padded",
     "\"componentType\":5121,\"normalized\":true,\"type\":\"VEC3\"",
     {{51, 102, 0, 9}, {51, 102, 0, 9}, {51, 102, 0, 9}, {51, 102, 0, 9}},
     4,
     0.2,
     0.4},
    {"16-bit RGBA",
     "\"componentType\":5123,\"normalized\":true,\"type\":\"VEC4\"",
     {{0x33, 0x33, 0xff, 0xff, 0, 0, 0xff, 0xff},
      {0x33, 0x33, 0xff, 0xff, 0, 0, 0xff, 0xff},
      {0x33, 0x33, 0xff, 0xff, 0, 0, 0xff, 0xff},
      {0x33, 0x33, 0xff, 0xff, 0, 0, 0xff, 0xff}},
     8,
     0.2,
     1.0},
};

static void vertex_colors_tint(void **state)
{
    static const float as_float[4] = {0.5f, 1.0f, 0.0f, 1.0f};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(colors); i++) {
        uint8_t bytes[64];
        char part[512];
        shot taken;
        for (size_t k = 0; k < 4; k++)
            memcpy(bytes + k * colors[i].stride,
                   colors[i].stride >= 12 ? (const void *)as_float : colors[i].bytes[k],
                   colors[i].stride);
        char *const encoded = base64(bytes, 4 * colors[i].stride);
        char *text = flat_scene(&square, "");
        text = edited(text, "\"TEXCOORD_0\":2", "\"COLOR_0\":4");
        snprintf(part, sizeof part, "\"type\":\"SCALAR\"},\n {\"bufferView\":4,\"count\":4,%s}",
                 colors[i].accessor);
        text = edited(text, "\"type\":\"SCALAR\"}", part);
        snprintf(part, sizeof part,
                 "\"byteOffset\":128,\"byteLength\":12},\n {\"buffer\":1,\"byteLength\":%zu,"
                 "\"byteStride\":%zu}",
                 4 * colors[i].stride, colors[i].stride);
        text = edited(text, "\"byteOffset\":128,\"byteLength\":12}", part);
        snprintf(part, sizeof part,
                 "\"byteLength\":140},{\"byteLength\":%zu,"
                 "\"uri\":\"data:application/octet-stream;base64,%s\"}]",
                 4 * colors[i].stride, encoded);
        text = edited(text, "\"byteLength\":140}]", part);
        capture_ok(text, &taken);
        assert_near(colors[i].name, shown_at(&taken, TL_ALBEDO_R, CENTER, CENTER),
                    0.25 * colors[i].red, 4 * 0x1p-24);
        assert_near(colors[i].name, shown_at(&taken, TL_ALBEDO_G, CENTER, CENTER),
                    0.5 * colors[i].green, 4 * 0x1p-24);
        shot_clear(&taken);
        free(encoded);
        free(text);
    }
}

/* Sparse values replace those of the view; the four positions move 1 m nearer by the last. */
static void sparse_accessors_apply(void **state)
{
    static const struct {
        float values[4][3];
        uint16_t indices[4];
    } changed = {{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, {0, 1, 2, 3}};
    char part[512];
    shot taken;
    (void)state;
    char *const encoded = base64(&changed, sizeof changed);
    char *text = flat_scene(&square, "");
    text = edited(text, "{\"bufferView\":0,",
                  "{\"sparse\":{\"count\":4,\"indices\":{\"bufferView\":4,\"byteOffset\":48,"
                  "\"componentType\":5123},\"values\":{\"bufferView\":4}},\"bufferView\":0,");
    text = edited(text, "\"byteOffset\":128,\"byteLength\":12}",
                  "\"byteOffset\":128,\"byteLength\":12},\n {\"buffer\":1,\"byteLength\":56}");
    snprintf(part, sizeof part,
             "\"byteLength\":140},{\"byteLength\":56,"
             "\"uri\":\"data:application/octet-stream;base64,%s\"}]",
             encoded);
    text = edited(text, "\"byteLength\":140}]", part);
    capture_ok(text, &taken);
    assert_near("sparse depth", shown_at(&taken, TL_DEPTH, CENTER, CENTER), 3.0, 4 * 0x1p-24);
    shot_clear(&taken);
    free(encoded);
    free(text);
}

static void missing_normals_are_flat(void **state)
{
    square_data data = square;
    shot taken;
    (void)state;
    for (int k = 0; k < 4; k++) /* the plane z = x / 2 */
        data.positions[k][2] = 0.5f * data.positions[k][0];
    char *const text = edited(flat_scene(&data, ""), "\"NORMAL\":1,", "");
    capture_ok(text, &taken);
    assert_near("x", shown_at(&taken, TL_NORMAL_X, 20, 40), -1 / sqrt(5), 4 * 0x1p-24);
    assert_near("y", shown_at(&taken, TL_NORMAL_Y, 20, 40), 0, 4 * 0x1p-24);
    assert_near("z", shown_at(&taken, TL_NORMAL_Z, 20, 40), 2 / sqrt(5), 4 * 0x1p-24);
    shot_clear(&taken);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_come_exactly),
        cmocka_unit_test(textures_are_decoded),
        cmocka_unit_test(filters_are_fine),
        cmocka_unit_test(lookups_find_their_texels),
        cmocka_unit_test(a_missing_image_is_told),
        cmocka_unit_test(alpha_makes_holes),
        cmocka_unit_test(sides_are_told_apart),
        cmocka_unit_test(normal_maps_lean_their_way),
        cmocka_unit_test(vertex_colors_tint),
        cmocka_unit_test(sparse_accessors_apply),
        cmocka_unit_test(missing_normals_are_flat),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
