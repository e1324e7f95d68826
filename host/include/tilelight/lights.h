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
    X(TL_FALLOFF_LINEAR, "linear")                 \
    X(TL_FALLOFF_TABLE, "lut")

typedef enum tl_falloff {
#define TL_FALLOFF_NAME(name, word) name,
    TL_FALLOFFS(TL_FALLOFF_NAME)
#undef TL_FALLOFF_NAME
        TL_FALLOFF_COUNT
} tl_falloff;

/* Samples of a falloff, evenly spaced: the first at distance 0, the last at the range. */
typedef struct tl_light_table {
    uint32_t count; /* TL_LEAST_SAMPLES to TL_MOST_SAMPLES */
    float *values;  /* [count], 0 to TL_MOST_WEIGHT; owned by the set */
} tl_light_table;

#define TL_LEAST_SAMPLES 2
#define TL_MOST_SAMPLES 4096
#define TL_MOST_WEIGHT 1e4f /* what an inverse square falloff has at most */

/* A picture that lights shine through, or the sky: read once, however many name it. */
typedef struct tl_light_image {
    char *path;             /* as files name it; owned by the set */
    uint32_t width, height; /* px */
    /* [height][width][3], linear Rec. 709, from the top left; owned by the set */
    float *pixels;
} tl_light_image;

#define TL_MOST_IMAGE_EXTENT 8192u      /* px, each way */
#define TL_MOST_IMAGE_PIXELS (1u << 25) /* 8192 x 4096: half a GiB as kernels have it */

/* How much of its largest intensity a light gives by direction, from an IES file (tilelight/photometry.h):
 * read once, however many lights name it. Shares stand on an even grid of angles: columns around from C0,
 * which come round, one where all are alike; rows from the nadir, which begin at row first_row of
 * rows_of_half_turn. */
typedef struct tl_light_profile {
    char *path; /* as files name it; owned by the set */
    uint32_t columns, rows, first_row, rows_of_half_turn;
    float *shares;      /* [rows][columns], of the peak, 0 to 1; owned by the set */
    double peak;        /* cd */
    double flux;        /* lm, of the whole light */
    double lamp_lumens; /* that the file says lamps have; below 0: none */
    double off; /* cd that the grid is off between the file's own angles; 0: it has them all */
} tl_light_profile;

#define TL_MOST_PROFILE_SAMPLES (1u << 21)

/* X(name, word in files) What the intensity of a light with a profile is: a factor on the candela of the
 * file, or those of its peak. */
#define TL_PROFILE_SCALES(X)         \
    X(TL_PROFILE_CANDELA, "candela") \
    X(TL_PROFILE_PEAK, "peak")

typedef enum tl_profile_scale {
#define TL_PROFILE_SCALE_NAME(name, word) name,
    TL_PROFILE_SCALES(TL_PROFILE_SCALE_NAME)
#undef TL_PROFILE_SCALE_NAME
        TL_PROFILE_SCALE_COUNT
} tl_profile_scale;

typedef struct tl_light {
    tl_light_type type;
    tl_falloff falloff; /* point and spot */
    float position[3];  /* m; point and spot */
    /* unit, along the light's rays, and where the nadir of a profile is; directional and spot, and point
     * with a profile */
    float direction[3];
    float color[3]; /* linear Rec. 709, >= 0 */
    /* cd for point and spot, lx for directional, >= 0; with a profile what profile_scale says */
    float intensity;
    float range; /* m, > 0; INFINITY reaches everything. Linear needs a finite one */
    float begin; /* m, 0 to range: linear falls from here on; 0 for the others */
    float diffuse, specular;      /* scales of the two lobes, >= 0 */
    float ambient;                /* scale of what arrives without regard to the normal, >= 0 */
    float inner_cone, outer_cone; /* half-angles in radians, 0 <= inner <= outer <= pi; spot */
    uint32_t table; /* 1 + index of the set's tables, of TL_FALLOFF_TABLE; else 0 */
    /* 1 + index of the set's images that colours are multiplied with; point, and spot with an
     * outer cone below pi/2; 0: none */
    uint32_t texture;
    uint32_t profile; /* 1 + index of the set's profiles; point and spot; 0: none */
    tl_profile_scale profile_scale;
    /* unit, world space: which way the top of the texture and C0 of the profile are; 0 0 0: the default,
     * docs/conventions.md */
    float up[3];
    uint32_t casts_shadow; /* 1: surfaces stand in its way, where a G-buffer has a map of it */
    uint32_t link;         /* 1 + index of the set's links: which objects it lights; 0: all */
    char name[64];         /* for messages; may be empty */
    char group[64]; /* what is switched, scaled and kept apart together; empty: in none */
} tl_light;

/* One object of a link: by its id where `name` is empty, else by its name, in which * is any number of any
 * characters and ? any one, unless an object is called just so. */
typedef struct tl_link_object {
    uint32_t id;
    char name[128];
} tl_link_object;

/* Which objects a light is for. */
typedef struct tl_light_link {
    int except; /* 1: all but these; 0: these alone */
    size_t count;
    tl_link_object *of; /* [count] */
} tl_light_link;

/* How surfaces reflect that an index of the plane brdf, or a material of the capture, leads here. */
typedef struct tl_material_row {
    uint32_t index;     /* 1 to TL_MAX_MATERIALS; of no matter where `material` says it */
    char material[128]; /* one of tl_gbuffer.materials; "" where the index says it */
    enum tl_shading_model model;
    /* what of the following replaces the surface's own: bits of tl_brdf_parameter */
    uint32_t given;
    float diffuse[3], specular[3]; /* linear Rec. 709, 0 to 1 */
    float exponent;                /* 0 to 10000 */
    float roughness, across; /* 0 to 1, as artists see it; along the direction, and across it */
    float direction[3];      /* world space, of any length but 0 */
    float k;                 /* Minnaert's exponent, 0 to 100 */
} tl_material_row;

/* X(name, word in files) What is seen where nothing was hit. */
#define TL_SKIES(X)                \
    X(TL_SKY_CONSTANT, "constant") \
    X(TL_SKY_GRADIENT, "gradient") \
    X(TL_SKY_IMAGE, "image")

typedef enum tl_sky {
#define TL_SKY_NAME(name, word) name,
    TL_SKIES(TL_SKY_NAME)
#undef TL_SKY_NAME
        TL_SKY_COUNT
} tl_sky;

/* lights, materials, tables, images and profiles are owned by the set; release with tl_light_set_clear. All
 * zero is a valid empty set. */
typedef struct tl_light_set {
    float ambient[3]; /* linear Rec. 709; multiplies albedo and occlusion */
    /* m, 0 to TL_FARTHEST: what surfaces within that keep from a pixel of ambient light; 0: nothing */
    float occlusion_radius;
    tl_sky sky_type;
    float sky[3]; /* radiance: of a constant sky; of a gradient at the horizon; else 0 */
    float zenith[3], ground[3]; /* of a gradient: straight up and straight down */
    /* 1 + index of images, of TL_SKY_IMAGE; a map of latitude and longitude */
    uint32_t sky_image;
    float sky_intensity; /* that the image is multiplied with, >= 0 */
    float sky_rotation;  /* rad, of the image, anticlockwise as seen from above */
    float
        sky_light; /* what of the sky's radiance lights surfaces, >= 0; 0: it is background alone */
    enum tl_shading_model model; /* how surfaces reflect */
    int has_shininess;           /* 1: all surfaces have this exponent in place of their own */
    float shininess;             /* 0 to 10000 */
    size_t count, capacity;
    tl_light *lights; /* [count] */
    size_t material_count;
    tl_material_row *materials; /* [material_count] */
    size_t table_count, image_count, profile_count, link_count;
    tl_light_table *tables;     /* [table_count] */
    tl_light_image *images;     /* [image_count] */
    tl_light_profile *profiles; /* [profile_count] */
    tl_light_link *links;       /* [link_count] */
    char *
        folder; /* that paths of images and profiles are relative to, owned; NULL: the working directory */
} tl_light_set;

/* A white point light at the origin: inverse square, 1 cd, no range, both lobes 1; a spot's cone
 * is glTF's default (0, pi/4). */
tl_light tl_light_default(void);

/* `text` as names and groups of lights hold it: as much of it as fits, cut between characters of UTF-8. */
void tl_light_text(const char *text, char out[64]);

/* Appends a copy. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add(tl_light_set *set, const tl_light *light, tl_error *err);

/* Nothing given; the model is the first, the index 0, which is none. */
tl_material_row tl_material_row_default(void);

/* Appends a copy. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add_material(tl_light_set *set,
                                    const tl_material_row *row,
                                    tl_error *err);
/* Appends a copy of a table; *out becomes what tl_light.table is to be. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add_table(
    tl_light_set *set, const float *values, uint32_t count, uint32_t *out, tl_error *err);

/* Appends a copy of a link, unless the set has one like it; *out becomes what tl_light.link is to be. Fails
 * with TL_ERR_MEMORY. */
tl_status tl_light_set_add_link(tl_light_set *set,
                                const tl_light_link *link,
                                uint32_t *out,
                                tl_error *err);

/* Appends an image with a copy of `path`; *out becomes what texture or sky_image is to be. Takes the
 * pixels, from malloc, also where it fails, with TL_ERR_MEMORY. */
tl_status tl_light_set_add_image(tl_light_set *set,
                                 const char *path,
                                 uint32_t width,
                                 uint32_t height,
                                 float *pixels,
                                 uint32_t *out,
                                 tl_error *err);

/* Appends a profile with a copy of `path`; *out becomes what tl_light.profile is to be. Takes its shares,
 * from malloc, also where it fails, with TL_ERR_MEMORY. */
tl_status tl_light_set_add_profile(tl_light_set *set,
                                   const char *path,
                                   const tl_light_profile *profile,
                                   uint32_t *out,
                                   tl_error *err);

/* cd or lx, along the light's brightest direction: its intensity, and with a profile what that makes of
 * it. */
double tl_light_candela(const tl_light_set *set, const tl_light *light);

/* Whether it shows something where nothing was hit. */
int tl_light_set_has_sky(const tl_light_set *set);

/* Whether it shines on surfaces. */
int tl_light_set_is_lit_by_sky(const tl_light_set *set);

/* Leaves an empty set. Accepts an empty one. */
void tl_light_set_clear(tl_light_set *set);

/* Fails with TL_ERR_FORMAT, naming the light or the row of materials by index and name and the field, for a
 * value that is not finite or outside the ranges above, and for two rows of one index or material. `source`
 * (a file) stands in front of the sentence. */
tl_status tl_light_set_check(const tl_light_set *set, const char *source, tl_error *err);

/* Adds a key light from the upper left and a fill light from the right of the camera, and ambient
 * light: what makes a scene without lights visible. Fails with TL_ERR_MEMORY. */
tl_status tl_light_set_add_rig(tl_light_set *set, const tl_camera *camera, tl_error *err);

/* Lights files: JSON, described in docs/file-formats.md. `path` may be "-" for standard input. An unknown
 * field, a value of the wrong type, NaN or infinity fails with TL_ERR_FORMAT, a feature that this version
 * lacks with TL_ERR_UNSUPPORTED, each naming the light and the field; else TL_ERR_READ or TL_ERR_MEMORY.
 * Pictures and profiles that lights and sky name are read with it, relative to the folder of the file: of
 * `path`, or of `file`, NULL for the working directory. *set is replaced on success and left alone on
 * failure. */
tl_status tl_lights_read(const char *path, tl_light_set *set, tl_error *err);
tl_status tl_lights_parse(const char *text,
                          size_t size,
                          const char *source,
                          const char *file,
                          tl_light_set *set,
                          tl_error *err);

/* Makes the picture in `path`, relative to the working directory, the sky of the set, in place of what it
 * has: a map with intensity 1, not turned, whose light is left as it is. Where it is written, its path is
 * absolute. Fails with the status of what is wrong with it, in a sentence that names it, or TL_ERR_MEMORY. */
tl_status tl_light_set_read_sky(tl_light_set *set, const char *path, tl_error *err);

/* The same set as text that tl_lights_parse reads back bit for bit. Files are named as they are in the
 * set, or by absolute paths where `file` (NULL: the working directory), which the text is for, lies in
 * another folder than theirs are relative to. The caller frees *out. Fails with TL_ERR_MEMORY, or with
 * TL_ERR_WRITE where the text is larger than the 64 MiB that reading takes. */
tl_status tl_lights_format(const tl_light_set *set,
                           const char *file,
                           char **out,
                           tl_error *err);

/* Writes tl_lights_format's text atomically; "-" is standard output. Fails with TL_ERR_WRITE. */
tl_status tl_lights_write(const char *path, const tl_light_set *set, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
