/* Captures of other programs, as G-buffers in full float: which channels are which planes, what their
 * numbers mean, and where the camera stands. docs/file-formats.md has a section on them. */
#ifndef TL_IMPORT_H
#define TL_IMPORT_H

#include "gbuffer.h"
#include "report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a capture may bring.
 * X(name, word, numbers per pixel, first plane of TL_PLANES or TL_PLANE_COUNT, meaning) */
#define TL_IMPORTS(X)                                                                     \
    X(TL_IMPORT_DEPTH, "depth", 1, TL_DEPTH, "how far")                                   \
    X(TL_IMPORT_POSITION, "position", 3, TL_PLANE_COUNT, "where; depth is taken from it") \
    X(TL_IMPORT_NORMAL, "normal", 3, TL_NORMAL_X, "which way the surface faces")          \
    X(TL_IMPORT_ALBEDO, "albedo", 3, TL_ALBEDO_R, "diffuse colour, or base colour")       \
    X(TL_IMPORT_SPECULAR, "specular", 3, TL_SPECULAR_R, "specular colour")                \
    X(TL_IMPORT_SHININESS, "shininess", 1, TL_SHININESS, "exponent of Blinn and Phong")   \
    X(TL_IMPORT_METALLIC, "metallic", 1, TL_METALLIC, "0 to 1")                           \
    X(TL_IMPORT_ROUGHNESS, "roughness", 1, TL_ROUGHNESS, "as artists see it, 0 to 1")     \
    X(TL_IMPORT_OCCLUSION, "ao", 1, TL_OCCLUSION, "share of the ambient light")           \
    X(TL_IMPORT_EMISSIVE, "emissive", 3, TL_EMISSIVE_R, "radiance the surface sends out") \
    X(TL_IMPORT_BRDF, "brdf", 1, TL_BRDF, "row of the lights file's materials")           \
    X(TL_IMPORT_TANGENT, "tangent", 3, TL_TANGENT_X, "along the grain, in world space")   \
    X(TL_IMPORT_ALPHA, "alpha", 1, TL_PLANE_COUNT, "share of the pixel that is covered")

typedef enum tl_import_plane {
#define TL_IMPORT_NAME(name, word, numbers, plane, meaning) name,
    TL_IMPORTS(TL_IMPORT_NAME)
#undef TL_IMPORT_NAME
        TL_IMPORT_COUNT
} tl_import_plane;

/* What the numbers of depth are. X(name, word, meaning) */
#define TL_DEPTH_KINDS(X)                                                               \
    X(TL_DEPTH_KIND_PLANAR, "planar", "along the view axis, positive in front")         \
    X(TL_DEPTH_KIND_VIEW_Z, "view-z", "the same, negative in front")                    \
    X(TL_DEPTH_KIND_RAY, "ray", "along the ray of the pixel, from the eye")             \
    X(TL_DEPTH_KIND_INVERSE, "inverse", "1 over planar; 0 is sky")                      \
    X(TL_DEPTH_KIND_NDC, "ndc", "of a depth buffer, 0 at --near, 1 at --far")           \
    X(TL_DEPTH_KIND_NDC_REVERSED, "ndc-reversed", "of one that is 1 at near, 0 at far") \
    X(TL_DEPTH_KIND_NDC_GL, "ndc-gl", "as OpenGL clips, -1 at near, 1 at far")

typedef enum tl_depth_kind {
#define TL_DEPTH_KIND_NAME(name, word, meaning) name,
    TL_DEPTH_KINDS(TL_DEPTH_KIND_NAME)
#undef TL_DEPTH_KIND_NAME
        TL_DEPTH_KIND_COUNT
} tl_depth_kind;

/* What normals and positions are relative to. X(name, word, meaning) */
#define TL_IMPORT_SPACES(X)                                                          \
    X(TL_SPACE_AUTO, "auto", "what the program writes, unless depths say otherwise") \
    X(TL_SPACE_WORLD, "world", "the scene")                                          \
    X(TL_SPACE_VIEW, "view", "the camera: x right, y up, z towards the viewer")      \
    X(TL_SPACE_VIEW_FORWARD, "view-forward",                                         \
      "the camera: x right, y up, z away from the viewer")

typedef enum tl_import_space {
#define TL_SPACE_NAME(name, word, meaning) name,
    TL_IMPORT_SPACES(TL_SPACE_NAME)
#undef TL_SPACE_NAME
        TL_SPACE_COUNT
} tl_import_space;

extern const char *const tl_depth_kind_words[TL_DEPTH_KIND_COUNT];
extern const char *const tl_import_space_words[TL_SPACE_COUNT];

/* Pixels that something covers in part. X(name, word, meaning) */
#define TL_EDGE_RULES(X)                          \
    X(TL_EDGES_KEEP, "keep", "taken as they are") \
    X(TL_EDGES_DROP, "drop", "made sky")

typedef enum tl_edge_rule {
#define TL_EDGE_RULE_NAME(name, word, meaning) name,
    TL_EDGE_RULES(TL_EDGE_RULE_NAME)
#undef TL_EDGE_RULE_NAME
        TL_EDGE_RULE_COUNT
} tl_edge_rule;

/* One --map: PLANE=[FILE:][PART/]CHANNELS. */
typedef struct tl_import_map {
    tl_import_plane plane;
    char file[1024];    /* "": the capture itself */
    char part[256];     /* "": any */
    char channels[512]; /* as written; "": what the file has for such a plane */
} tl_import_map;

enum { TL_MAX_MAPS = 32 };

/* A camera as options say it; what was not given is taken from the file. */
typedef struct tl_import_camera {
    const char *file; /* JSON; NULL: none. It says everything but for near and far */
    double vertical_fov, horizontal_fov; /* degrees, the full angle; 0: not given */
    bool is_placed;                      /* eye and target were given */
    double eye[3], target[3], up[3];     /* m */
    double near, far;                    /* m; 0: not given */
} tl_import_camera;

typedef struct tl_import_options {
    bool is_given; /* any of them by the user: a capture that needs none refuses them */
    tl_import_map maps[TL_MAX_MAPS];
    size_t map_count;
    tl_depth_kind depth_kind;
    double unit;     /* m, of depths, positions and of a camera in the file */
    double sky_from; /* units: depths from here on are sky */
    tl_import_space normal_space, position_space;
    bool normals_are_encoded; /* 0 to 1 in place of -1 to 1 */
    tl_edge_rule edges;
    tl_import_camera camera;
} tl_import_options;

/* Planar depth in metres, sky from 1e9 on, spaces found, edges kept, up is +y. */
tl_import_options tl_import_options_default(void);

/* Reads "PLANE=[FILE:][PART/]CHANNELS" into *out. Fails with TL_ERR_ARGUMENT and a sentence without the
 * option's name. */
tl_status tl_import_map_parse(const char *text, tl_import_map *out, tl_error *err);

/* Whether a file's first bytes are of a kind that captures of others come in: OpenEXR, PFM, PNG. */
bool tl_import_recognises(const unsigned char *bytes, size_t size);

/* What was found in the pixels, in numbers of them. */
typedef struct tl_import_counts {
    uint64_t sky;     /* no depth, or covered nowhere */
    uint64_t partial; /* covered in part */
    uint64_t outside; /* of the data window; sky */
} tl_import_counts;

/* Imports the capture `path`; NULL where maps name a file for every plane. Says by notices what was
 * found, assumed and missing. The caller releases *out with tl_gbuffer_destroy; *counts may be NULL.
 * Pixels are as the files have them but for what options say: see tl_gbuffer_repair. Fails with
 * TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED, TL_ERR_MEMORY, or TL_ERR_ARGUMENT where options do
 * not go together. */
tl_status tl_import_read(const char *path,
                         const tl_import_options *options,
                         const tl_notices *notices,
                         tl_gbuffer **out,
                         tl_import_counts *counts,
                         tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
