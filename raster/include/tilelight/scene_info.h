/* What a glTF scene holds, and what a capture of it can choose from: said without rendering,
 * and without OpenGL. */
#ifndef TL_SCENE_INFO_H
#define TL_SCENE_INFO_H

#include "tilelight/camera.h"
#include "tilelight/lights.h"
#include "tilelight/report.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of the meshes that the default scene shows. Points and lines are not shown. */
typedef struct tl_scene_meshes {
    size_t count, shown_count; /* meshes: of the file; of the scene */
    /* Each mesh once, as the file has it: vertices are elements of the accessors of positions. */
    size_t primitive_count;
    uint64_t triangle_count, vertex_count;
    /* As often as they are drawn. */
    size_t place_count; /* nodes with meshes, and instances */
    uint64_t drawn_triangle_count;
    size_t instanced_node_count, instance_count; /* EXT_mesh_gpu_instancing; among the places */
    size_t morphed_count, target_count;          /* meshes with morph targets; their targets */
    size_t skin_count, joint_count;              /* skins in use; their joints */
} tl_scene_meshes;

/* What a material can be; it may be several. X(name, word, key of JSON) */
#define TL_MATERIAL_TRAITS(X)                                   \
    X(TL_MATERIAL_UNLIT, "unlit", "unlit")                      \
    X(TL_MATERIAL_MASKED, "masked", "masked")                   \
    X(TL_MATERIAL_BLENDED, "blended", "blended")                \
    X(TL_MATERIAL_DOUBLE_SIDED, "double-sided", "double_sided") \
    X(TL_MATERIAL_EMISSIVE, "emissive", "emissive")             \
    X(TL_MATERIAL_NORMAL_MAPPED, "normal-mapped", "normal_mapped")

typedef enum tl_material_trait {
#define TL_MATERIAL_TRAIT_NAME(name, word, key) name,
    TL_MATERIAL_TRAITS(TL_MATERIAL_TRAIT_NAME)
#undef TL_MATERIAL_TRAIT_NAME
        TL_MATERIAL_TRAIT_COUNT
} tl_material_trait;

typedef struct tl_scene_materials {
    size_t count, shown_count; /* of the file; of what is shown, glTF's default one apart */
    bool shows_default;        /* for what names no material */
    size_t trait_counts[TL_MATERIAL_TRAIT_COUNT]; /* of those that are shown */
} tl_scene_materials;

/* Images that materials in use look at. Those that are missing are not counted, which is told. */
typedef struct tl_scene_images {
    size_t count, shown_count;              /* of the file; of what is shown */
    uint32_t largest_width, largest_height; /* px, of the one with most pixels */
    uint64_t pixel_count;                   /* of all that are shown */
} tl_scene_images;

/* A camera at a node of the scene: what --camera chooses, by either name or by the index. */
typedef struct tl_scene_camera {
    size_t index, node;           /* of the file */
    const char *name, *node_name; /* "": it has none */
    tl_projection projection;
    double extent; /* perspective: the vertical field of view, rad; orthographic: height, m */
    double near, far; /* m; far may be INFINITY */
    char *refusal;    /* why a capture with it fails; NULL: it does not */
} tl_scene_camera;

/* What --animation chooses, by name or index. */
typedef struct tl_scene_animation {
    const char *name; /* "": it has none */
    double seconds;   /* when it ends */
    size_t curve_count;
    char *refusal; /* why a capture of it fails; NULL: it does not */
} tl_scene_animation;

/* What becomes of an extension that a file uses. X(name, word) */
#define TL_EXTENSION_FATES(X)              \
    X(TL_EXTENSION_SUPPORTED, "supported") \
    X(TL_EXTENSION_LEFT_OUT, "left out")   \
    X(TL_EXTENSION_HARMLESS, "harmless")

typedef enum tl_extension_fate {
#define TL_EXTENSION_FATE_NAME(name, word) name,
    TL_EXTENSION_FATES(TL_EXTENSION_FATE_NAME)
#undef TL_EXTENSION_FATE_NAME
        TL_EXTENSION_FATE_COUNT
} tl_extension_fate;

typedef struct tl_scene_extension {
    const char *name;
    tl_extension_fate fate;
    const char *effect; /* what it brings, or what the picture lacks for want of it */
    bool is_required;
} tl_scene_extension;

/* Names are the file's, as it has them: in UTF-8, of any characters. */
typedef struct tl_scene_info {
    size_t scene_index, scene_count; /* the default one; count 0: all nodes are shown */
    const char *scene_name;          /* "": it has none */
    bool has_bounds;                 /* false: nothing is drawn */
    double low[3], high[3];          /* m, in world space, of what is drawn, at rest */
    tl_scene_meshes meshes;
    tl_scene_materials materials;
    tl_scene_images images;
    size_t camera_count,
        unplaced_camera_count; /* unplaced: of the file, at no node of the scene */
    tl_scene_camera
        *cameras; /* [camera_count], owned; the first is the default. None: a view of all */
    size_t animation_count, variant_count, extension_count;
    tl_scene_animation *animations; /* [animation_count], owned; the first is the default */
    const char *const *variants; /* [variant_count]: names, of materials; none is the default */
    tl_scene_extension
        *extensions;     /* [extension_count], owned: in the file's order, each once */
    tl_light_set lights; /* of the scene, owned */
    void *source;        /* what names belong to, owned */
} tl_scene_info;

/* Reads `path` (.gltf, .glb) as tl_capture does, checks all that it checks, and describes the
 * default scene at rest, in the file's own materials. The caller releases *out with
 * tl_scene_info_clear. notices may be NULL. Fails as tl_capture with default options does, in
 * the same words, but for OpenGL. */
tl_status tl_scene_describe(const char *path,
                            const tl_notices *notices,
                            tl_scene_info *out,
                            tl_error *err);

/* Accepts an all-zero one. */
void tl_scene_info_clear(tl_scene_info *info);

#ifdef __cplusplus
}
#endif

#endif
