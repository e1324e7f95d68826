/* How much a file may make the program hold. A file that asks for more is refused before anything
 * of that size is allocated; real scenes stay far below. */
#ifndef TL_LOAD_LIMITS_H
#define TL_LOAD_LIMITS_H

#include <stdint.h>

/* A scene file: tinygltf counts its bytes in 32 bits, and base64 is held twice while decoding. */
static const uint64_t tl_max_scene_bytes = (uint64_t)1 << 31;
/* All files that a scene names, together; also what its embedded buffers come to. */
static const uint64_t tl_max_buffer_bytes = (uint64_t)1 << 32;
/* Vertices and indices as they go to GL, together. */
static const uint64_t tl_max_geometry_bytes = (uint64_t)1 << 32;
/* Displacements of morph targets, all that are read; they go again, so it is time that this bounds. */
static const uint64_t tl_max_displacement_bytes = (uint64_t)1 << 36;
/* Decoded images, together, in OpenGL's memory; mipmaps add a third. */
static const uint64_t tl_max_texel_bytes = (uint64_t)1 << 32;

enum {
    TL_MAX_JSON_DEPTH = 64,      /* nesting; parsers recurse. Real files stay below 20 */
    TL_MAX_DRAW_COUNT = 1 << 20, /* primitives, counted per node that shows them */
    TL_MAX_IMAGE_EXTENT = 16384  /* px per side: what OpenGL takes here */
};

#endif
