/* A captured G-buffer in memory: the camera, and planes of numbers in one aligned block.
 *
 * The meeting point of the two halves: capture makes it, lighting reads it, files hold it. The
 * block is laid out as kernels read it, so a CPU device lights it without a copy. In full float a
 * plane is an attribute (planes.h); a packed one has the words of its layout (layout.h). */
#ifndef TL_GBUFFER_H
#define TL_GBUFFER_H

#include "camera.h"
#include "layers.h"
#include "layout_names.h"
#include "objects.h"
#include "planes.h"
#include "shadows.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Rows and pitch are multiples of this: the largest tile, and more than a cache line. */
enum { TL_PADDING = 64 };

/* Of a pixel of the picture, at most: 8 x 8. */
enum { TL_MAX_SAMPLES = 64 };

/* The side of the square that a pixel's samples make, 1 to 8; 0 where `samples` is none of 1, 4, 9 ...
 * TL_MAX_SAMPLES. */
uint32_t tl_samples_side(uint32_t samples);

/* Materials of the scene that a G-buffer is of: name i is that of index i + 1 of its plane brdf. Owned;
 * all zero is none. */
typedef struct tl_material_names {
    uint32_t count;
    char **of; /* [count], NUL-terminated; "" where the scene gives none */
} tl_material_names;

/* Appends a copy. Fails with TL_ERR_MEMORY. */
tl_status tl_material_names_add(tl_material_names *names, const char *name, tl_error *err);

/* *to is replaced on success and left alone on failure. Fails with TL_ERR_MEMORY. */
tl_status tl_material_names_copy(const tl_material_names *from,
                                 tl_material_names *to,
                                 tl_error *err);

/* Leaves none. */
void tl_material_names_clear(tl_material_names *names);

/* Words of a set of indices: bit i % 32 of [i / 32] for index i. */
enum { TL_INDEX_WORDS = (TL_MAX_MATERIALS + 32) / 32 };

typedef struct tl_gbuffer {
    tl_camera camera;
    /* Of each pixel of the picture that it is lit to (tl_image_resolve): every sample is a
     * pixel here, and has its own surface. The camera counts samples: its width and height are
     * multiples of their side. */
    uint32_t samples;
    enum tl_layout_name layout;
    /* bit p: plane p can be had; a union of TL_GROUP_... with TL_GROUP_BASE */
    uint32_t present;
    /* pixels from row to row: at least camera.width, a multiple of TL_PADDING */
    uint32_t pitch;
    uint32_t rows; /* camera.height up to a multiple of TL_PADDING */
    /* How far stored positions lie off the rays of their pixels at most: x/depth and y/depth,
     * or m under an orthographic camera. 0 where the layout stores depth. Of positions,
     * infinite until tl_gbuffer_repair has found it: lighting is right then too, but culls by
     * the boxes of tiles alone, without rectangles. Whoever writes positions afterwards makes
     * it infinite again, or repairs anew; a slack that is too small loses lights. */
    float slack_x, slack_y;
    /* Planes that say in every pixel what their absence would: bit p for plane p, colours
     * whole. 0 until tl_gbuffer_repair has found them; lighting does not read them. Whoever
     * writes planes afterwards makes it 0 again, or repairs anew. */
    uint32_t neutral;
    /* No surface reflects light by its planes: they are black, or metals without colour, as unlit ones
     * are stored. False until tl_gbuffer_repair has found it, and again as above. */
    bool is_dark;
    /* Those that surfaces have in the plane brdf. Not known until tl_gbuffer_repair has found them, and not
     * again as above. */
    uint32_t indices[TL_INDEX_WORDS];
    bool knows_indices;
    tl_material_names materials; /* none where nobody named them */
    tl_shadow_maps shadows; /* of lights that were to cast shadows; owned; a layer has none */
    tl_layers layers; /* of surfaces that blend, before this one; owned; a layer has none */
    /* [rows][pitch], owned, aligned as the planes: which object each pixel shows, 0: none that is told. NULL
     * where nobody asked. Of layers too */
    uint32_t *ids;
    tl_objects objects; /* names of ids; a layer has none */
    /* Of a layer: whose it is, and [rows][pitch], owned, aligned as the planes: 0 where nothing is, to 1.
     * NULL of others. */
    const struct tl_gbuffer *layer_of;
    float *opacity;
    /* Rows from .. to - 1 have all that the layer shows: all rows until tl_gbuffer_repair has found them.
     * Whoever writes opacity afterwards makes it 0 and camera.height again, or repairs anew. */
    uint32_t shown_from, shown_to;
    /* [tl_gbuffer_pixel_size][rows * pitch] bytes, plane after plane, aligned to 4096; padding is sky */
    unsigned char *planes;
} tl_gbuffer;

/* Planes that a frame has whole or not at all, and what they are called together; shininess alone beside
 * brdf is whole, too. */
typedef struct tl_plane_group {
    const char *name;
    uint32_t planes; /* bits 1 << plane */
} tl_plane_group;

enum { TL_PLANE_GROUP_COUNT = 8 };
extern const tl_plane_group tl_plane_groups[TL_PLANE_GROUP_COUNT];

/* In full float; every pixel is sky, and a sample of its own. The caller releases *out with
 * tl_gbuffer_destroy. Fails with TL_ERR_ARGUMENT (tl_camera_check; an incomplete group in
 * `present`; both the Phong and the metal-rough group) or TL_ERR_MEMORY. */
tl_status tl_gbuffer_create(const tl_camera *camera,
                            uint32_t present,
                            tl_gbuffer **out,
                            tl_error *err);

/* The same in any layout. Fails with TL_ERR_ARGUMENT too where the layout cannot hold a plane of
 * `present`, and for its depth's convention under this camera (an infinite far plane). */
tl_status tl_gbuffer_create_packed(const tl_camera *camera,
                                   enum tl_layout_name layout,
                                   uint32_t present,
                                   tl_gbuffer **out,
                                   tl_error *err);

/* Accepts NULL. */
void tl_gbuffer_destroy(tl_gbuffer *gbuffer);

/* Whose layer it is, of others themselves: who has the shadow maps and the names of materials. */
const tl_gbuffer *tl_gbuffer_owner(const tl_gbuffer *gbuffer);

/* [rows][pitch], owned by the G-buffer, which is in full float; NULL where the plane is absent. */
float *tl_gbuffer_plane(const tl_gbuffer *gbuffer, enum tl_plane plane);

/* [rows][pitch] of uint8_t, uint16_t or uint32_t, owned by the G-buffer: word `index` of its layout;
 * NULL where it is not stored. */
void *tl_gbuffer_words(const tl_gbuffer *gbuffer, uint32_t index);

/* Bytes per pixel of word `index`: 1, 2 or 4, 0 where it is not stored; and of all words. */
uint32_t tl_gbuffer_word_size(const tl_gbuffer *gbuffer, uint32_t index);
uint32_t tl_gbuffer_pixel_size(const tl_gbuffer *gbuffer);

/* A part of a picture: px, from the upper left. */
typedef struct tl_region {
    uint32_t x, y, width, height;
} tl_region;

/* *gbuffer becomes that part of it, not empty and within it, with its shadow maps; what is known of the whole
 * is taken to be so of the part. Pixels of it are lit as they are in the whole, bit for bit, but where
 * ambient occlusion would look beyond. Its camera says where it lies; no file is written of it. Fails with
 * TL_ERR_MEMORY, and leaves it alone. */
tl_status tl_gbuffer_cut(tl_gbuffer **gbuffer, const tl_region *window, tl_error *err);

/* What tl_gbuffer_repair found, in pixels. */
typedef struct tl_repairs {
    /* NaN, negative infinity, or <= 0 under a perspective camera: made sky. So is a stored position that
     * is not finite or not before such a camera */
    uint64_t depth;
    uint64_t normal; /* not finite, or of no length: made 0, which no light reaches */
    /* another plane not finite, out of its range, or no index: made 0 or cut; so is opacity */
    uint64_t value;
} tl_repairs;

/* Makes every pixel safe to light, and sky pixels hold the values of `TL_PLANES` for nothing hit; in layers,
 * too, which have no opacity where there is sky; of any layout, by what kernels read in float and in double.
 * Finds the slack of stored positions, which planes are neutral, whether the frame is dark, and its indices.
 * On all threads. *out may be NULL. With `strict`, fails with TL_ERR_FORMAT at the first pixel that would
 * need it, naming pixel and channel (of a packed one the attribute), and `name` (a file) in front. */
tl_status tl_gbuffer_repair(
    tl_gbuffer *gbuffer, const char *name, bool strict, tl_repairs *out, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
