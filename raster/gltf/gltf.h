/* What a glTF file says, as plain C: its own arrays, indices and strings, nothing judged.
 *
 * tinygltf parses and accepts much; nothing here has been checked but the JSON types. Indices may
 * point anywhere and -1 means absent; whoever follows one checks it first (gltf/lookup.h). */
#ifndef TL_GLTF_H
#define TL_GLTF_H

#include "tilelight/report.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_gltf_bytes {
    const uint8_t *data; /* NULL: there are none */
    size_t size;
} tl_gltf_bytes;

typedef struct tl_gltf_view {
    int buffer;
    size_t offset, size, stride; /* bytes; stride 0: tightly packed */
} tl_gltf_view;

typedef struct tl_gltf_accessor {
    int view;
    size_t offset, count;
    int component_type;  /* as in the file: 5120 (BYTE) to 5130 (DOUBLE) */
    int component_count; /* 1 to 16 */
    bool normalized, sparse;
    int sparse_count, sparse_index_view, sparse_index_offset, sparse_index_type;
    int sparse_value_view, sparse_value_offset;
} tl_gltf_accessor;

/* X(name, attribute in the file, components at least, at most) */
#define TL_GLTF_TEXCOORDS(X)                  \
    X(TL_GLTF_TEXCOORD_0, "TEXCOORD_0", 2, 2) \
    X(TL_GLTF_TEXCOORD_1, "TEXCOORD_1", 2, 2) \
    X(TL_GLTF_TEXCOORD_2, "TEXCOORD_2", 2, 2) \
    X(TL_GLTF_TEXCOORD_3, "TEXCOORD_3", 2, 2) \
    X(TL_GLTF_TEXCOORD_4, "TEXCOORD_4", 2, 2) \
    X(TL_GLTF_TEXCOORD_5, "TEXCOORD_5", 2, 2) \
    X(TL_GLTF_TEXCOORD_6, "TEXCOORD_6", 2, 2) \
    X(TL_GLTF_TEXCOORD_7, "TEXCOORD_7", 2, 2)

#define TL_GLTF_ATTRIBUTES(X)             \
    X(TL_GLTF_POSITION, "POSITION", 3, 3) \
    X(TL_GLTF_NORMAL, "NORMAL", 3, 3)     \
    X(TL_GLTF_TANGENT, "TANGENT", 4, 4)   \
    TL_GLTF_TEXCOORDS(X)                  \
    X(TL_GLTF_COLOR, "COLOR_0", 3, 4)

enum tl_gltf_attribute {
#define TL_GLTF_ATTRIBUTE_NAME(name, attribute, least, most) name,
    TL_GLTF_ATTRIBUTES(TL_GLTF_ATTRIBUTE_NAME)
#undef TL_GLTF_ATTRIBUTE_NAME
        TL_GLTF_ATTRIBUTE_COUNT
};

/* Sets of texture coordinates, TEXCOORD_0 and on. */
enum { TL_GLTF_TEXCOORD_COUNT = TL_GLTF_COLOR - TL_GLTF_TEXCOORD_0 };

/* What morph targets displace: the attributes before these. */
enum { TL_GLTF_MORPHED_COUNT = TL_GLTF_TANGENT + 1 };

typedef struct tl_gltf_target {
    int attributes[TL_GLTF_MORPHED_COUNT]; /* accessors of displacements */
} tl_gltf_target;

/* JOINTS_n and WEIGHTS_n. */
typedef struct tl_gltf_influences {
    int joints, weights; /* accessors */
} tl_gltf_influences;

/* KHR_materials_variants: the material that a primitive has in some of the variants. */
typedef struct tl_gltf_mapping {
    int material;
    size_t variant_count;
    const int *variants; /* indices into the file's */
} tl_gltf_mapping;

typedef struct tl_gltf_primitive {
    int mode; /* 0 to 6 in a valid file */
    int indices, material;
    int attributes[TL_GLTF_ATTRIBUTE_COUNT]; /* accessors */
    size_t target_count, influences_count, mapping_count;
    const tl_gltf_mapping *mappings;
    const tl_gltf_target *targets;
    const tl_gltf_influences *influences;
} tl_gltf_primitive;

typedef struct tl_gltf_mesh {
    const char *name; /* names are never NULL */
    size_t primitive_count, weight_count;
    const tl_gltf_primitive *primitives;
    const double *weights; /* of morph targets */
} tl_gltf_mesh;

typedef struct tl_gltf_node {
    const char *name;
    const char *group; /* a string of that name in its extras, or "" */
    int mesh, camera, light, skin;
    size_t child_count;
    const int *children;
    /* Numbers as found; a count of 0 means absent. */
    size_t matrix_count, translation_count, rotation_count, scale_count, weight_count;
    const double *matrix, *translation, *rotation, *scale, *weights;
    /* EXT_mesh_gpu_instancing: accessors. */
    int instance_translation, instance_rotation, instance_scale;
} tl_gltf_node;

typedef struct tl_gltf_skin {
    const char *name;
    int inverse_bind, skeleton; /* an accessor, a node */
    size_t joint_count;
    const int *joints; /* nodes */
} tl_gltf_skin;

/* A sampler of an animation. */
typedef struct tl_gltf_keys {
    int times, values; /* accessors */
    const char *interpolation;
} tl_gltf_keys;

typedef struct tl_gltf_channel {
    int keys, node;
    const char *path; /* what of the node: "rotation" */
} tl_gltf_channel;

/* Without the channels whose target is no node: extensions have those. */
typedef struct tl_gltf_animation {
    const char *name;
    size_t keys_count, channel_count;
    const tl_gltf_keys *keys;
    const tl_gltf_channel *channels;
} tl_gltf_animation;

typedef struct tl_gltf_scene {
    const char *name;
    size_t node_count;
    const int *nodes;
} tl_gltf_scene;

/* A texture as a material uses it: KHR_texture_transform included. */
typedef struct tl_gltf_texture_use {
    int texture, coordinates; /* TEXCOORD_<coordinates> */
    double offset[2], rotation, scale[2];
} tl_gltf_texture_use;

/* X(name, member of the file) */
#define TL_GLTF_SLOTS(X)                                      \
    X(TL_GLTF_BASE_COLOR, "baseColorTexture")                 \
    X(TL_GLTF_METALLIC_ROUGHNESS, "metallicRoughnessTexture") \
    X(TL_GLTF_NORMAL_MAP, "normalTexture")                    \
    X(TL_GLTF_OCCLUSION, "occlusionTexture")                  \
    X(TL_GLTF_EMISSIVE, "emissiveTexture")

enum tl_gltf_slot {
#define TL_GLTF_SLOT_NAME(name, member) name,
    TL_GLTF_SLOTS(TL_GLTF_SLOT_NAME)
#undef TL_GLTF_SLOT_NAME
        TL_GLTF_SLOT_COUNT
};

typedef struct tl_gltf_material {
    const char *name, *alpha_mode;
    double base_color[4], emissive[3], emissive_strength;
    double metallic, roughness, normal_scale, occlusion_strength, alpha_cutoff;
    bool double_sided, unlit;
    tl_gltf_texture_use textures[TL_GLTF_SLOT_COUNT];
} tl_gltf_material;

typedef struct tl_gltf_texture {
    int sampler, image;
} tl_gltf_texture;

typedef struct tl_gltf_sampler {
    int min_filter, mag_filter, wrap_s, wrap_t; /* GL's numbers; filters -1: not given */
} tl_gltf_sampler;

typedef struct tl_gltf_image {
    const char *name, *uri;
    int view;            /* where its bytes lie, else -1 */
    tl_gltf_bytes bytes; /* of a file or data URI; NULL where the file is missing */
} tl_gltf_image;

typedef struct tl_gltf_camera {
    const char *name;
    bool orthographic;
    double vertical_fov, ymag, near, far; /* far 0: not given */
} tl_gltf_camera;

typedef struct tl_gltf_light {
    const char *name, *type;
    const char *group; /* as a node's */
    size_t color_count;
    const double *color;
    double intensity, range, inner_cone, outer_cone; /* range 0: not given */
} tl_gltf_light;

typedef struct tl_gltf {
    const char *path; /* of the file, for messages */
    int default_scene;
    size_t buffer_count, view_count, accessor_count, mesh_count, node_count, scene_count;
    size_t material_count, texture_count, sampler_count, image_count, camera_count, light_count;
    size_t skin_count, animation_count, variant_count, used_count, required_count;
    const tl_gltf_bytes *buffers;
    const tl_gltf_view *views;
    const tl_gltf_accessor *accessors;
    const tl_gltf_mesh *meshes;
    const tl_gltf_node *nodes;
    const tl_gltf_scene *scenes;
    const tl_gltf_material *materials;
    const tl_gltf_texture *textures;
    const tl_gltf_sampler *samplers;
    const tl_gltf_image *images;
    const tl_gltf_camera *cameras;
    const tl_gltf_light *lights;
    const tl_gltf_skin *skins;
    const tl_gltf_animation *animations;
    const char *const *variants; /* names */
    const char *const *extensions_used, *const *extensions_required;
} tl_gltf;

/* Reads a .gltf or .glb and the files it names. The caller releases *out with tl_gltf_close.
 * Missing images are left without bytes. Fails with TL_ERR_READ, TL_ERR_FORMAT,
 * TL_ERR_UNSUPPORTED (a required extension) or TL_ERR_MEMORY. */
tl_status tl_gltf_open(const char *path,
                       const tl_notices *notices,
                       const tl_gltf **out,
                       tl_error *err);

/* Accepts NULL. */
void tl_gltf_close(const tl_gltf *gltf);

#ifdef __cplusplus
}
#endif

#endif
