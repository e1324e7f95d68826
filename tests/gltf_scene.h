/* A small good glTF scene as text, edits to it, and capturing it.
 *
 * A square of side 2 in the plane z = 0 that faces +z, and a camera at (0, 0, 4). */
#ifndef TL_GLTF_SCENE_H
#define TL_GLTF_SCENE_H

#include "testing.h"

#include "tilelight/capture.h"

/* 4 positions, 4 normals, 4 texture coordinates, 6 indices. */
typedef struct square_data {
    float positions[4][3], normals[4][3], coordinates[4][2];
    uint16_t indices[6];
} square_data;

static const square_data square = {
    {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
    {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
    {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
    {0, 1, 2, 0, 2, 3},
};
enum { SQUARE_BYTES = 140 };

/* %s is the buffer's uri, with a comma behind. */
static const char square_text[] =
    "{\"asset\":{\"version\":\"2.0\"},\n"
    "\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],\n"
    "\"nodes\":[{\"name\":\"quad\",\"mesh\":0},\n"
    " {\"name\":\"eye\",\"camera\":0,\"translation\":[0,0,4]}],\n"
    "\"cameras\":[{\"name\":\"wide\",\"type\":\"perspective\",\n"
    " \"perspective\":{\"yfov\":1.0,\"znear\":0.1,\"zfar\":100}}],\n"
    "\"meshes\":[{\"name\":\"square\",\"primitives\":[{\"material\":0,\"indices\":3,\n"
    " \"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2}}]}],\n"
    "\"materials\":[{\"name\":\"paint\",\"pbrMetallicRoughness\":{\n"
    " \"baseColorFactor\":[0.25,0.5,0.75,1],\"metallicFactor\":0.125,"
    "\"roughnessFactor\":0.625}}],\n"
    "\"accessors\":[\n"
    " {\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},\n"
    " {\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},\n"
    " {\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},\n"
    " {\"bufferView\":3,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],\n"
    "\"bufferViews\":[\n"
    " {\"buffer\":0,\"byteOffset\":0,\"byteLength\":48},\n"
    " {\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},\n"
    " {\"buffer\":0,\"byteOffset\":96,\"byteLength\":32},\n"
    " {\"buffer\":0,\"byteOffset\":128,\"byteLength\":12}],\n"
    "\"buffers\":[{%s\"byteLength\":140}]}\n";

/* The caller frees it. */
static inline char *base64(const void *data, size_t size)
{
    static const char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint8_t *const bytes = data;
    char *const text = malloc(4 * ((size + 2) / 3) + 1), *end = text;
    assert_non_null(text);
    for (size_t i = 0; i < size; i += 3) {
        const uint32_t second = i + 1 < size ? bytes[i + 1] : 0;
        const uint32_t third = i + 2 < size ? bytes[i + 2] : 0;
        const uint32_t word = (uint32_t)bytes[i] << 16 | second << 8 | third;
        *end++ = digits[word >> 18];
        *end++ = digits[word >> 12 & 63];
        *end++ = i + 1 < size ? digits[word >> 6 & 63] : '=';
        *end++ = i + 2 < size ? digits[word & 63] : '=';
    }
    *end = '\0';
    return text;
}

/* The scene around these bytes, embedded. The caller frees it. */
static inline char *square_scene(const square_data *data)
{
    char *const bytes = base64(data, SQUARE_BYTES);
    const size_t size = sizeof square_text + strlen(bytes) + 100;
    char *const uri = malloc(size), *const text = malloc(size);
    assert_non_null(uri);
    assert_non_null(text);
    snprintf(uri, size, "\"uri\":\"data:application/octet-stream;base64,%s\",", bytes);
    snprintf(text, size, square_text, uri);
    free(uri);
    free(bytes);
    return text;
}

/* Replaces the first `old`, which must be there, in a text on the heap; frees it and returns the new
 * one. An empty `old` changes nothing. */
static inline char *edited(char *text, const char *old, const char *new)
{
    const char *const found = strstr(text, old);
    if (!found)
        fail_msg("the scene has no %s", old);
    const size_t size = strlen(text) + strlen(new) + 1;
    char *const made = malloc(size);
    assert_non_null(made);
    snprintf(made, size, "%.*s%s%s", (int)(found - text), text, new, found + strlen(old));
    free(text);
    return made;
}

static inline void write_file(const char *path, const void *data, size_t size)
{
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Keeps what was said. */
typedef struct heard {
    int count;
    char text[4096]; /* sentences, a line each */
} heard;

static inline void hear(void *context, const char *sentence)
{
    heard *const to = context;
    const size_t length = strlen(to->text);
    snprintf(to->text + length, sizeof to->text - length, "%s\n", sentence);
    to->count++;
}

/* What a capture gives; release with shot_clear. */
typedef struct shot {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    heard notices;
    tl_error err;
} shot;

static inline tl_status shoot(const char *path, const tl_capture_options *options, shot *out)
{
    memset(out, 0, sizeof *out);
    const tl_notices notices = {hear, &out->notices};
    return tl_capture(path, options, &out->gbuffer, &out->lights, NULL, &notices, &out->err);
}

static inline void shot_clear(shot *taken)
{
    tl_gbuffer_destroy(taken->gbuffer);
    tl_light_set_clear(&taken->lights);
}

/* Writes the text as <name>.gltf to the scratch folder and captures it. */
static inline tl_status shoot_text(const char *name,
                                   const char *text,
                                   const tl_capture_options *options,
                                   shot *out)
{
    char file[64], path[512];
    snprintf(file, sizeof file, "%s.gltf", name);
    scratch_path(path, sizeof path, file);
    write_file(path, text, strlen(text));
    return shoot(path, options, out);
}

static inline float shown_at(const shot *taken, enum tl_plane plane, uint32_t x, uint32_t y)
{
    const float *const values = tl_gbuffer_plane(taken->gbuffer, plane);
    assert_non_null(values);
    return values[(size_t)y * taken->gbuffer->pitch + x];
}

/* main's, before anything else: OpenGL is there. */
static inline int can_capture(void)
{
    char text[256];
    tl_error err;
    if (tl_capture_describe(text, sizeof text, &err) == TL_OK)
        return 1;
    printf("skipped: %s\n", err.message);
    return 0;
}

#endif
