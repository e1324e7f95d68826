/* A glTF scene as the geometry pass wants it: checked, flattened, in floats; plain C, no OpenGL. */
#ifndef TL_MODEL_H
#define TL_MODEL_H

#include "animation.h"
#include "gltf.h"
#include "matrix.h"

#include "tilelight/lights.h"

/* Vertices that parts share. */
typedef struct tl_vertices {
    size_t count;
    /* [count][tl_accessor_width], owned; NULL: absent. Position and normal are always there. */
    float *attributes[TL_GLTF_ATTRIBUTE_COUNT];
    uint32_t *sources; /* [count], owned: which of the file's each was; NULL: the same */
} tl_vertices;

/* One primitive of a mesh, morphed: a triangle list. */
typedef struct tl_part {
    size_t mesh, primitive; /* of the file */
    size_t vertices;        /* index into the model's vertices */
    size_t index_count;     /* a multiple of 3; 0: nothing to draw */
    uint32_t *indices;      /* [index_count], owned */
    size_t material;        /* index into the model's materials */
    bool flat;              /* normals are those of triangles, which share no vertices */
} tl_part;

/* One part at one place. */
typedef struct tl_draw {
    size_t part, node;
    tl_affine world;
} tl_draw;

/* A mesh, camera or light of the file at one place. */
typedef struct tl_placed {
    int what; /* index into the file's meshes, cameras or lights */
    size_t node;
    tl_affine world;
} tl_placed;

/* An image as something looks at it: as colours or as data. */
typedef struct tl_pixels {
    size_t image;        /* of the file */
    tl_gltf_bytes bytes; /* of its file, PNG or JPEG; the file's own */
    bool srgb, mipmaps;
    uint32_t width, height;
} tl_pixels;

/* Pixels once they are decoded, in a buffer that serves one image after another: touching new memory
 * costs more than decoding. All zero is a valid empty one; the owner frees rgba. */
typedef struct tl_texels {
    uint16_t *rgba;  /* [height][width][4], top row first, linear: 65535 is 1 */
    size_t capacity; /* in values */
} tl_texels;

/* Pixels with the way to look them up. */
typedef struct tl_texture {
    size_t pixels;           /* index into the model's pixels */
    tl_gltf_sampler sampler; /* every field is a value that OpenGL knows */
} tl_texture;

typedef struct tl_texture_slot {
    int texture;     /* index into the model's textures, -1: none */
    int coordinates; /* the set: TEXCOORD_<coordinates>, below TL_GLTF_TEXCOORD_COUNT */
    float uv_from_coordinates[2][3];
} tl_texture_slot;

typedef struct tl_material {
    float base_color[4], emissive[3]; /* strength included */
    float metallic, roughness, normal_scale, occlusion_strength;
    float alpha_cutoff; /* below it there is nothing; 0: opaque */
    bool double_sided, emits;
    bool blends; /* with what is behind it, by its alpha; all the same it has a cutoff */
    bool unlit;  /* its base colour is what it emits; it reflects nothing */
    tl_texture_slot slots[TL_GLTF_SLOT_COUNT];
} tl_material;

typedef struct tl_model {
    const tl_gltf *gltf; /* owned; for names in messages */
    int variant;         /* of the materials (variants.h) */
    size_t vertices_count, part_count, draw_count, camera_count, light_count;
    size_t material_count, texture_count, pixels_count;
    tl_vertices *vertices;
    tl_part *parts;
    tl_draw *draws;
    tl_placed *cameras, *lights; /* in the order of the scene's nodes, parents first */
    tl_material *materials;      /* those of the file, then the default one */
    tl_texture *textures;        /* the ones that materials in use need */
    tl_pixels *pixels;           /* what those look at */
} tl_model;

/* Loads a scene as it is at that moment, in a variant of its materials by name or index, NULL: none;
 * its images undecoded. The caller releases *out with tl_model_destroy. Fails as tl_capture does,
 * without TL_ERR_DEVICE. */
tl_status tl_model_load(const char *path,
                        const tl_moment *moment,
                        const char *variant,
                        const tl_notices *notices,
                        tl_model **out,
                        tl_error *err);

/* Accepts NULL. */
void tl_model_destroy(tl_model *model);

/* Decodes pixels [first, first + count) into out[count], on all threads. Fails with TL_ERR_FORMAT,
 * naming a damaged image, or TL_ERR_MEMORY. */
tl_status tl_model_decode(
    const tl_model *model, size_t first, size_t count, tl_texels *out, tl_error *err);

/* Adds the lights of the scene. Fails with TL_ERR_FORMAT, naming the light, or TL_ERR_MEMORY. */
tl_status tl_model_lights(const tl_model *model, tl_light_set *lights, tl_error *err);

/* The camera to capture with: `wanted` by the name of its node or its own, or by its index in the
 * file; NULL: the first of the scene, else one that shows all of it from the front, which is told.
 * Fails with TL_ERR_ARGUMENT (no such camera), saying which there are, or TL_ERR_FORMAT. */
tl_status tl_model_camera(const tl_model *model,
                          const char *wanted,
                          uint32_t width,
                          uint32_t height,
                          const tl_notices *notices,
                          tl_camera *out,
                          tl_error *err);

/* The one that stands there, one of the model's cameras. Fails with TL_ERR_FORMAT. */
tl_status tl_model_camera_at(const tl_model *model,
                             const tl_placed *placed,
                             uint32_t width,
                             uint32_t height,
                             tl_camera *out,
                             tl_error *err);

/* The box around all that is drawn, m, in world space. False: nothing is, and the box is left alone. */
bool tl_model_bounds(const tl_model *model, double low[3], double high[3]);

#endif
