/* What programs call the channels of a capture: one table. */
#ifndef TL_IMPORT_ALIASES_H
#define TL_IMPORT_ALIASES_H

#include "source.h"
#include "tilelight/import.h"

/* X(plane, name, program, space of normals and positions, attribute)
 *
 * A channel is called NAME, or NAME and a component behind a dot; letter case is ignored, and
 * layers may stand in front ("ViewLayer.Normal.X") of names of more than one letter. A part's
 * name counts as a layer. Earlier rows win. A row with an attribute holds in files alone that
 * have one which begins so: its name means something else to other programs (Arnold's `diffuse`
 * is light, not colour). */
#define TL_ALIASES(X)                                                                  \
    X(TL_IMPORT_DEPTH, "Z", "Arnold, V-Ray, Redshift, tilelight", TL_SPACE_AUTO, NULL) \
    X(TL_IMPORT_DEPTH, "Depth", "Blender", TL_SPACE_AUTO, NULL)                        \
    X(TL_IMPORT_DEPTH, "Pz", "Mantra", TL_SPACE_AUTO, NULL)                            \
    X(TL_IMPORT_POSITION, "Position", "Blender", TL_SPACE_WORLD, NULL)                 \
    X(TL_IMPORT_POSITION, "P", "Arnold, pbrt", TL_SPACE_AUTO, NULL)                    \
    X(TL_IMPORT_NORMAL, "Normal", "Blender", TL_SPACE_WORLD, NULL)                     \
    X(TL_IMPORT_NORMAL, "Ns", "pbrt", TL_SPACE_AUTO, NULL)                             \
    X(TL_IMPORT_NORMAL, "N", "Arnold, Redshift, tilelight", TL_SPACE_WORLD, NULL)      \
    X(TL_IMPORT_NORMAL, "bumpNormals", "V-Ray", TL_SPACE_VIEW, NULL)                   \
    X(TL_IMPORT_NORMAL, "VRayBumpNormals", "V-Ray", TL_SPACE_VIEW, NULL)               \
    X(TL_IMPORT_NORMAL, "normals", "V-Ray", TL_SPACE_VIEW, NULL)                       \
    X(TL_IMPORT_NORMAL, "VRayNormals", "V-Ray", TL_SPACE_VIEW, NULL)                   \
    X(TL_IMPORT_ALBEDO, "DiffCol", "Blender", TL_SPACE_AUTO, NULL)                     \
    X(TL_IMPORT_ALBEDO, "diffuse_albedo", "Arnold", TL_SPACE_AUTO, NULL)               \
    X(TL_IMPORT_ALBEDO, "albedo", "Arnold, pbrt, tilelight", TL_SPACE_AUTO, NULL)      \
    X(TL_IMPORT_ALBEDO, "diffuse", "V-Ray", TL_SPACE_AUTO, "vray")                     \
    X(TL_IMPORT_ALBEDO, "VRayDiffuseFilter", "V-Ray", TL_SPACE_AUTO, NULL)             \
    X(TL_IMPORT_ALBEDO, "DiffuseFilter", "Redshift", TL_SPACE_AUTO, NULL)              \
    X(TL_IMPORT_SPECULAR, "GlossCol", "Blender", TL_SPACE_AUTO, NULL)                  \
    X(TL_IMPORT_SPECULAR, "specular_albedo", "Arnold", TL_SPACE_AUTO, NULL)            \
    X(TL_IMPORT_SPECULAR, "specular", "tilelight", TL_SPACE_AUTO, "tilelight:")        \
    X(TL_IMPORT_SHININESS, "shininess", "tilelight", TL_SPACE_AUTO, NULL)              \
    X(TL_IMPORT_METALLIC, "metallic", "tilelight", TL_SPACE_AUTO, NULL)                \
    X(TL_IMPORT_METALLIC, "metalness", "Arnold", TL_SPACE_AUTO, NULL)                  \
    X(TL_IMPORT_ROUGHNESS, "roughness", "tilelight", TL_SPACE_AUTO, NULL)              \
    X(TL_IMPORT_ROUGHNESS, "specular_roughness", "Arnold", TL_SPACE_AUTO, NULL)        \
    X(TL_IMPORT_OCCLUSION, "AO", "Blender, tilelight", TL_SPACE_AUTO, NULL)            \
    X(TL_IMPORT_EMISSIVE, "Emit", "Blender", TL_SPACE_AUTO, NULL)                      \
    X(TL_IMPORT_EMISSIVE, "emission", "Arnold", TL_SPACE_AUTO, NULL)                   \
    X(TL_IMPORT_EMISSIVE, "VRaySelfIllumination", "V-Ray", TL_SPACE_AUTO, NULL)        \
    X(TL_IMPORT_EMISSIVE, "emissive", "tilelight", TL_SPACE_AUTO, NULL)                \
    X(TL_IMPORT_BRDF, "brdf", "tilelight", TL_SPACE_AUTO, NULL)                        \
    X(TL_IMPORT_TANGENT, "T", "tilelight", TL_SPACE_WORLD, "tilelight:")               \
    X(TL_IMPORT_ALPHA, "A", "all", TL_SPACE_AUTO, NULL)                                \
    X(TL_IMPORT_ALPHA, "Combined", "Blender", TL_SPACE_AUTO, NULL)

typedef struct tl_alias {
    tl_import_plane plane;
    const char *name, *program;
    tl_import_space space; /* TL_SPACE_AUTO: not known, or of no meaning */
    const char *attribute; /* NULL: holds in every file */
} tl_alias;

extern const tl_alias tl_aliases[];
extern const size_t tl_alias_count;

typedef struct tl_import_kind {
    const char *word;
    unsigned numbers;    /* 1 or 3 */
    enum tl_plane plane; /* the first; TL_PLANE_COUNT: none of its own */
} tl_import_kind;

extern const tl_import_kind tl_import_kinds[TL_IMPORT_COUNT];

/* Where a plane comes from. */
typedef struct tl_binding {
    bool is_bound;
    uint32_t source;       /* among those of a plan */
    uint32_t channels[3];  /* of the source */
    const tl_alias *alias; /* NULL: by --map */
} tl_binding;

/* Finds the plane in a source by the table. False where it is not there. `out->source` is kept. */
bool tl_alias_find(const tl_source *source, tl_import_plane plane, tl_binding *out);

/* Finds what a map names. Fails with TL_ERR_FORMAT, naming the channel and one like it. */
tl_status tl_map_find(const tl_source *source,
                      const tl_import_map *map,
                      tl_binding *out,
                      tl_error *err);

#endif
