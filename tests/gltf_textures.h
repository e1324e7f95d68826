/* Textures and tangents for the scene of gltf_scene.h. */
#ifndef TL_GLTF_TEXTURES_H
#define TL_GLTF_TEXTURES_H

#include "gltf_scene.h"
#include "png_bytes.h"

/* JSON of one texture from these pixels, looked up without a filter. The caller frees it. */
static inline char *texture_json(const uint8_t *rgba, uint32_t width, uint32_t height)
{
    const png_bytes png = png_encode(rgba, width, height);
    char *const bytes = base64(png.data, png.size);
    char *const json = malloc(strlen(bytes) + 256);
    assert_non_null(json);
    sprintf(json,
            "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{\"magFilter\":9728,"
            "\"minFilter\":9728,\"wrapS\":33071}],\"images\":[{\"uri\":\"data:image/png;base64,"
            "%s\"}],",
            bytes);
    free(bytes);
    free(png.data);
    return json;
}

/* The scene whose square has tangents (x, 0, 0, w). Frees the text and returns the new one. */
static inline char *with_tangents(char *text, float x, float w)
{
    const float tangents[4][4] = {{x, 0, 0, w}, {x, 0, 0, w}, {x, 0, 0, w}, {x, 0, 0, w}};
    char *const encoded = base64(tangents, sizeof tangents), buffer[256];
    text = edited(text, "\"TEXCOORD_0\":2", "\"TEXCOORD_0\":2,\"TANGENT\":4");
    text = edited(text, "\"type\":\"SCALAR\"}",
                  "\"type\":\"SCALAR\"},\n {\"bufferView\":4,\"componentType\":5126,"
                  "\"count\":4,\"type\":\"VEC4\"}");
    text = edited(text, "\"byteOffset\":128,\"byteLength\":12}",
                  "\"byteOffset\":128,\"byteLength\":12},\n {\"buffer\":1,\"byteLength\":64}");
    snprintf(buffer, sizeof buffer,
             "\"byteLength\":140},{\"byteLength\":64,"
             "\"uri\":\"data:application/octet-stream;base64,%s\"}]",
             encoded);
    free(encoded);
    return edited(text, "\"byteLength\":140}]", buffer);
}

#endif
