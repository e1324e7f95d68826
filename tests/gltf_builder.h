/* glTF scenes whose accessors are numbers of a test: appended one by one, then written out around the
 * rest of the JSON. */
#ifndef TL_GLTF_BUILDER_H
#define TL_GLTF_BUILDER_H

#include "gltf_scene.h"

enum { GL_BYTE = 5120, GL_UBYTE = 5121, GL_SHORT = 5122, GL_USHORT = 5123, GL_REAL = 5126 };
enum { BUILDER_BYTES = 1 << 16, BUILDER_TEXT = 1 << 14 };

/* All zero is an empty one. */
typedef struct builder {
    uint8_t bytes[BUILDER_BYTES];
    size_t size;
    char views[BUILDER_TEXT], accessors[BUILDER_TEXT];
    int count, stride; /* bytes from element to element of what is added; 0: no gaps */
} builder;

static inline void append_text(char *to, const char *format, ...)
{
    const size_t length = strlen(to);
    va_list arguments;
    va_start(arguments, format);
    const int made = vsnprintf(to + length, BUILDER_TEXT - length, format, arguments);
    va_end(arguments);
    assert_in_range(made, 0, BUILDER_TEXT - length - 1);
}

/* Appends bytes and an accessor for them; `more` are further members of it, such as
 * ",\"normalized\":true". Its index. */
static inline int add_accessor(builder *to,
                               const void *data,
                               size_t size,
                               int component_type,
                               size_t count,
                               const char *type,
                               const char *more)
{
    assert_in_range(size, 1, BUILDER_BYTES - to->size - 4);
    memcpy(to->bytes + to->size, data, size);
    append_text(to->views, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu",
                to->count ? ",\n" : "", to->size, size);
    append_text(to->views, to->stride ? ",\"byteStride\":%d}" : "}", to->stride);
    append_text(to->accessors,
                "%s{\"bufferView\":%d,\"componentType\":%d,\"count\":%zu,\"type\":\"%s\"%s}",
                to->count ? ",\n" : "", to->count, component_type, count, type, more);
    to->size = (to->size + size + 3) / 4 * 4;
    return to->count++;
}

/* Floats: an array of the test's, of vectors of `width`. */
#define ADD_REALS(to, values, type, width)            \
    add_accessor(to, values, sizeof(values), GL_REAL, \
                 sizeof(values) / (sizeof(float) * (width)), type, "")

/* The whole file; `rest` is its other members, without braces. The caller frees it. */
static inline char *built_scene(const builder *from, const char *rest)
{
    char *const data = base64(from->bytes, from->size);
    const size_t size = strlen(data) + strlen(rest) + 2 * BUILDER_TEXT + 256;
    char *const text = malloc(size);
    assert_non_null(text);
    snprintf(
        text, size,
        "{\"asset\":{\"version\":\"2.0\"},\n%s,\n\"accessors\":[\n%s],\n\"bufferViews\":[\n%s],"
        "\n\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,%s"
        "\"}]}\n",
        rest, from->accessors, from->views, from->size, data);
    free(data);
    return text;
}

/* The square of gltf_scene.h: accessors 0 to 3 are positions, normals, coordinates, indices. */
static inline void add_square(builder *to)
{
    ADD_REALS(to, square.positions, "VEC3", 3);
    ADD_REALS(to, square.normals, "VEC3", 3);
    ADD_REALS(to, square.coordinates, "VEC2", 2);
    add_accessor(to, square.indices, sizeof square.indices, GL_USHORT, 6, "SCALAR", "");
}

/* A camera at the node it is given to that sees 2 m at 2 m: x and y at depth d are within d/2. */
#define SQUARE_CAMERA                                                                      \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.9272952180016122," \
    "\"znear\":0.1,\"zfar\":1000}}]"

/* What is seen in the middle, m: of pictures with an odd number of pixels. */
static inline double depth_at_center(const shot *taken)
{
    const tl_camera *const camera = &taken->gbuffer->camera;
    return (double)shown_at(taken, TL_DEPTH, camera->width / 2, camera->height / 2);
}

static inline void normal_at(const shot *taken, uint32_t x, uint32_t y, double out[3])
{
    out[0] = (double)shown_at(taken, TL_NORMAL_X, x, y);
    out[1] = (double)shown_at(taken, TL_NORMAL_Y, x, y);
    out[2] = (double)shown_at(taken, TL_NORMAL_Z, x, y);
}

static inline void assert_near(const char *what, double value, double expected, double within)
{
    if (!(fabs(value - expected) <= within) && value != expected)
        fail_msg("%s: %.9g, want %.9g within %g", what, value, expected, within);
}

#endif
