/* The lights of a scene, in world space, as files describe them. */
#ifndef TL_LIGHTS_H
#define TL_LIGHTS_H

#include "camera.h"
#include "models.h"
#include "planes.h"
#include "report.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* X(name, word in files) */
#define TL_LIGHT_TYPES(X)                  \
    X(TL_LIGHT_POINT, "point")             \
    X(TL_LIGHT_DIRECTIONAL, "directional") \
    X(TL_LIGHT_SPOT, "spot")

typedef enum tl_light_type {
#define TL_LIGHT_TYPE_NAME(name, word) name,
    TL_LIGHT_TYPES(TL_LIGHT_TYPE_NAME)
#undef TL_LIGHT_TYPE_NAME
        TL_LIGHT_TYPE_COUNT
} tl_light_type;

/* X(name, word in files) kernels/falloff.h has the formulas. */
#define TL_FALLOFFS(X)                             \
    X(TL_FALLOFF_INVERSE_SQUARE, "inverse-square") \
    X(TL_FALLOFF_LINEAR, "linear")

typedef enum tl_falloff {
#define TL_FALLOFF_NAME(name, word) name,
    TL_FALLOFFS(TL_FALLOFF_NAME)
#undef TL_FALLOFF_NAME
        TL_FALLOFF_COUNT
} tl_falloff;

typedef struct tl_light {
    tl_light_type type;
    tl_falloff falloff; /* point and spot */
    float position[3];  /* m; point and spot */
    float direction[3]; /* unit, along the light's rays; directional and spot */
    float color[3];     /* linear Rec. 709, >= 0 */
    float intensity;    /* cd for point and spot, lx for directional, >= 0 */
    float range;        /* m, > 0; INFINITY reaches everything. Linear needs a finite one */
    float begin;        /* m, 0 to range: linear falls from here on; 0 for the others */
    float diffuse, specular;      /* scales of the two lobes, >= 0 */
    float inner_cone, outer_cone; /* half-angles in radians, 0 <= inner <= outer <= pi; spot */
    char name[64];                /* for messages; may be empty */
} tl_light;

/* How surfaces reflect that an index of the plane brdf, or a material of the capture, leads here. */
typedef struct tl_material_row {
    uint32_t index;     /* 1 to TL_MAX_MATERIALS; of no matter where `material` says it */
    char material[128]; /* one of tl_gbuffer.materials; "" where the index says it */
    enum tl_shading_model model;
    uint32_t
        given; /* what of the following replaces the surface's own: bits of tl_brdf_parameter */
    float diffuse[3], specular[3]; /* linear Rec. 709, 0 to 1 */
    float exponent;                /* 0 to 10000 */
    float roughness, across; /* 0 to 1, as artists see it; along the direction, and across it */
    float direction[3];      /* world space, of any length but 0 */
    float k;                 /* Minnaert's exponent, 0 to 100 */
} tl_material_row;

/* lights and materials are owned by the set; release with tl_light_set_clear. All zero is a valid empty set. */
typedef struct tl_light_set {
    float ambient[3];            /* linear Rec. 709; multiplies albedo and occlusion */
    float sky[3];                /* radiance of pixels where nothing was hit */
    enum tl_shading_model model; /* how surfaces reflect */
    int has_shininess;           /* 1: all surfaces have this exponent in place of their own */
    float shininess;             /* 0 to 10000 */
    size_t count, capacity;
    tl_light *lights; /* [count] */
    size_t material_count;
    tl_material_row *materials; /* [material_count] */
} tl_light_set;

/* A white point light at the origin: inverse square, 1 cd, no range, both lobes 1; a spot's cone
 * is glTF's default (0, pi/4). */
tl_light tl_light_default(void);

/* Appends a copy. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add(tl_light_set *set, const tl_light *light, tl_error *err);

/* Nothing given; the model is the first, the index 0, which is none. */
tl_material_row tl_material_row_default(void);

/* Appends a copy. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add_material(tl_light_set *set,
                                    const tl_material_row *row,
                                    tl_error *err);

/* Leaves an empty set. Accepts an empty one. */
void tl_light_set_clear(tl_light_set *set);

/* Fails with TL_ERR_FORMAT, naming the light or the row of materials by index and name and the field, for a
 * value that is not finite or outside the ranges above, and for two rows of one index or material. `source` (a file) stands in front of the sentence. */
tl_status tl_light_set_check(const tl_light_set *set, const char *source, tl_error *err);

/* Adds a key light from the upper left and a fill light from the right of the camera, and ambient
 * light: what makes a scene without lights visible. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add_rig(tl_light_set *set, const tl_camera *camera, tl_error *err);

/* Lights files: JSON, described in docs/file-formats.md. `path` may be "-" for standard input. An
 * unknown field, a value of the wrong type, NaN or infinity fails with TL_ERR_FORMAT, a feature
 * that this version lacks with TL_ERR_UNSUPPORTED, each naming the light and the field; else
 * TL_ERR_READ or TL_ERR_MEMORY. *set is replaced on success and left alone on failure. */
tl_status tl_lights_read(const char *path, tl_light_set *set, tl_error *err);
tl_status tl_lights_parse(
    const char *text, size_t size, const char *source, tl_light_set *set, tl_error *err);

/* The same set as text that tl_lights_parse reads back bit for bit. The caller frees *out.
 * Fails with TL_ERR_MEMORY, or with TL_ERR_WRITE where the text is larger than the 64 MiB that
 * reading takes. */
tl_status tl_lights_format(const tl_light_set *set, char **out, tl_error *err);

/* Writes tl_lights_format's text atomically; "-" is standard output. Fails with TL_ERR_WRITE. */
tl_status tl_lights_write(const char *path, const tl_light_set *set, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
