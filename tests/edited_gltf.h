/* glTF files taken apart, changed and put together again: .gltf with its buffer inside, and .glb. */
#ifndef TL_EDITED_GLTF_H
#define TL_EDITED_GLTF_H

#include "testing.h"

#include <jansson.h>

typedef struct edited_gltf {
    json_t *json;  /* owned */
    char *file;    /* all of it, owned */
    size_t size;   /* bytes */
    size_t binary; /* where in the file the second chunk's header is; 0: a .gltf */
} edited_gltf;

static inline uint32_t word_of_file(const char *from)
{
    uint32_t word;
    memcpy(&word, from, sizeof word);
    return word;
}

/* 0: there is no such file. Released with release_gltf. */
static inline int read_gltf(const char *path, edited_gltf *out)
{
    enum { HEADER = 12, CHUNK = 8 };
    FILE *stream = fopen(path, "rb");
    json_error_t reason;
    *out = (edited_gltf){.json = NULL};
    if (!stream)
        return 0;
    fseek(stream, 0, SEEK_END);
    out->size = (size_t)ftell(stream);
    rewind(stream);
    out->file = malloc(out->size + 1);
    assert_non_null(out->file);
    assert_int_equal(fread(out->file, 1, out->size, stream), out->size);
    fclose(stream);
    const char *text = out->file;
    size_t length = out->size;
    if (memcmp(text, "glTF", 4) == 0) {
        length = word_of_file(text + HEADER);
        text += HEADER + CHUNK;
        out->binary = HEADER + CHUNK + length;
    }
    out->json = json_loadb(text, length, 0, &reason);
    if (!out->json)
        fail_msg("%s: %s", path, reason.text);
    return 1;
}

static inline void release_gltf(edited_gltf *of)
{
    json_decref(of->json);
    free(of->file);
    *of = (edited_gltf){.json = NULL};
}

/* To a file of the scratch folder: `path` of 512 bytes gets where it is. */
static inline void write_gltf(const edited_gltf *of, const char *name, char path[512])
{
    char *text = json_dumps(of->json, JSON_COMPACT);
    assert_non_null(text);
    const size_t length = strlen(text), padded = (length + 3) / 4 * 4;
    scratch_path(path, 512, name);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    if (of->binary) {
        const uint32_t header[] = {2, (uint32_t)(20 + padded + of->size - of->binary),
                                   (uint32_t)padded};
        fwrite("glTF", 1, 4, stream);
        fwrite(header, 1, sizeof header, stream);
        fwrite("JSON", 1, 4, stream);
    }
    fwrite(text, 1, length, stream);
    if (of->binary) {
        fwrite("   ", 1, padded - length, stream);
        fwrite(of->file + of->binary, 1, of->size - of->binary, stream);
    }
    assert_int_equal(fclose(stream), 0);
    free(text);
}

/* The item that the field of an item leads to: a node's mesh, a primitive's material. */
static inline json_t *gltf_item(const edited_gltf *of,
                                const char *list,
                                const json_t *from,
                                const char *field)
{
    return json_array_get(json_object_get(of->json, list),
                          (size_t)json_integer_value(json_object_get(from, field)));
}

/* Of the first primitive of a node's mesh; NULL where it has none. */
static inline json_t *gltf_material_of(const edited_gltf *of, const json_t *node)
{
    if (!json_object_get(node, "mesh"))
        return NULL;
    const json_t *mesh = gltf_item(of, "meshes", node, "mesh");
    return gltf_item(of, "materials", json_array_get(json_object_get(mesh, "primitives"), 0),
                     "material");
}

static inline int gltf_blends(const json_t *material)
{
    const char *mode = json_string_value(json_object_get(material, "alphaMode"));
    return material && mode && strcmp(mode, "BLEND") == 0;
}

#endif
