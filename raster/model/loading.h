/* The steps of tl_model_load, in their order. Each fills its part of the model, which is released
 * with it whether the step succeeds or not. */
#ifndef TL_LOADING_H
#define TL_LOADING_H

#include "accessor.h"
#include "model.h"

/* Where things stand. */
typedef struct tl_placements {
    size_t count;
    tl_placed *meshes; /* [count]: what becomes draws, instances apart */
    tl_affine *worlds; /* [node_count]: world_from_node, of what is in the scene */
    bool *in_scene;    /* [node_count] */
} tl_placements;

/* Accepts an all-zero one. */
void tl_placements_clear(tl_placements *placements);

/* Walks the default scene: sets cameras, lights and *out, which the caller clears. Fails with
 * TL_ERR_FORMAT, naming the node, for what is no tree of nodes with finite transforms, or
 * TL_ERR_MEMORY. */
tl_status tl_load_nodes(tl_model *model,
                        const tl_pose *pose,
                        const tl_notices *notices,
                        tl_placements *out,
                        tl_error *err);

/* Whether a node has instances (EXT_mesh_gpu_instancing). */
bool tl_is_instanced(const tl_gltf_node *node);

/* Places meshes once for each instance of their node. Fails as
 * tl_accessor_read does, naming the node, and with TL_ERR_UNSUPPORTED beyond TL_MAX_DRAW_COUNT or for a
 * node with a skin. */
tl_status tl_load_instances(const tl_model *model, tl_placements *placements, tl_error *err);

/* Reads and morphs the meshes that are placed: sets vertices, parts and draws. A mesh is read once for
 * all nodes that show it alike, and for each one with a skin. Fails as tl_accessor_read and
 * tl_pose_weights do, and with TL_ERR_UNSUPPORTED beyond TL_MAX_DRAW_COUNT. */
tl_status tl_load_geometry(tl_model *model,
                           const tl_pose *pose,
                           const tl_placements *placements,
                           const tl_notices *notices,
                           tl_error *err);

/* Reads the morph targets of a primitive and adds them to its vertices, weighted; weights:
 * [target_count], NULL: all 0; *work: bytes of displacements that may still be read. Fails as
 * tl_accessor_read does, with TL_ERR_FORMAT where targets do not fit the primitive or the sum
 * is not finite, and with TL_ERR_UNSUPPORTED beyond *work. */
tl_status tl_morph(const tl_gltf *gltf,
                   const char *user,
                   const tl_gltf_primitive *primitive,
                   const double *weights,
                   tl_budget *work,
                   tl_vertices *vertices,
                   tl_error *err);

/* Gives every triangle of a part vertices of its own, with its normal, where there are none; given
 * tangents go, as glTF demands. Fails as tl_budget_take does. */
tl_status tl_make_flat(const tl_gltf *gltf,
                       const char *user,
                       tl_budget *budget,
                       tl_vertices *vertices,
                       tl_part *part,
                       tl_error *err);

/* Sets the normals of a flat part from where its vertices are. */
void tl_set_flat_normals(const tl_part *part, tl_vertices *vertices);

/* Checks the materials that parts use: sets materials, textures and pixels. Textures whose image is
 * missing are left out, which is told. Fails with TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or
 * TL_ERR_MEMORY, naming the material or image. */
tl_status tl_load_materials(tl_model *model, const tl_notices *notices, tl_error *err);

/* Gives tangents to what has a normal map and none in the file: vertices of its own, for those of the
 * file may need several. Parts without the map's coordinates stay without. Fails with TL_ERR_MEMORY. */
tl_status tl_load_tangents(tl_model *model, tl_error *err);

/* Moves the vertices of skinned meshes to where their joints are. Fails as tl_accessor_read
 * does, and with TL_ERR_FORMAT, naming skin or primitive, for joints outside the scene, and
 * joints or weights that no skinning can be done with. */
tl_status tl_load_skins(tl_model *model, const tl_placements *placements, tl_error *err);

/* "mesh 2 ("door"), primitive 0", for messages. */
typedef struct tl_primitive_label {
    char text[128];
} tl_primitive_label;

tl_primitive_label tl_label_primitive(const tl_gltf *gltf, size_t mesh, size_t primitive);

/* Frees what it owns. Accepts an all-zero one. */
void tl_vertices_clear(tl_vertices *vertices);

/* Which of the model's pixels show `image` this way: ones that are there already, or new ones, for
 * which there is room. *out is PIXELS_MISSING where the file's bytes are: that is told. Format and
 * size are checked, nothing is decoded. Fails with TL_ERR_FORMAT or TL_ERR_UNSUPPORTED (neither PNG
 * nor JPEG, or too large), naming the image. */
tl_status tl_find_pixels(tl_model *model,
                         int image,
                         bool srgb,
                         bool mipmaps,
                         const tl_notices *notices,
                         size_t *out,
                         tl_error *err);

static const size_t PIXELS_MISSING = (size_t)-1;

#endif
