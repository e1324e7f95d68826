/* What the geometry pass renders to, and the way back into a G-buffer's words. */
#ifndef TL_TARGETS_H
#define TL_TARGETS_H

#include "gl.h"

#include "tilelight/layouts.h"

#include <stdbool.h>

/* The depth buffer of a layout. One that is stored has a stencil buffer beside it, which tells surfaces on
 * the far plane from the sky. */
typedef struct tl_depth_buffer {
    bool is_stored;   /* it is one of the layout's targets */
    bool is_reversed; /* 1 on the near plane, 0 on the far plane; else 0 and 1 */
} tl_depth_buffer;

tl_depth_buffer tl_depth_buffer_of(enum tl_layout_name layout);

/* Whether target `index` is a colour target of a frame that has the planes `present`. Its index is its
 * location in the shader. */
bool tl_target_is_color(enum tl_layout_name layout, uint32_t present, uint32_t index);

/* Where ids of objects are drawn to, beside the layout's targets; -1: there is no place for one more. */
int tl_target_of_ids(enum tl_layout_name layout, uint32_t present);

typedef struct tl_targets {
    GLuint framebuffer;
    GLuint colors[TL_MAX_TARGETS];         /* textures, by target; 0: none */
    GLuint ids;                            /* the same, of objects; 0: not asked for */
    int id_target;                         /* its location, else -1 */
    unsigned char sky[TL_MAX_TARGETS][16]; /* their texels where nothing was hit */
    uint32_t width, rows;   /* a band of the picture: it is rendered band by band */
    uint32_t chunk_rows;    /* read back at a time */
    unsigned char *scratch; /* [chunk_rows][width] texels of any target, owned */
} tl_targets;

/* Makes the targets of the layout of `gbuffer`, which is as it was created, all sky; as high as a bounded
 * amount of memory allows. Release with tl_targets_clear; the GL objects go with the context. Fails with
 * TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_targets_create(const tl_gl *gl,
                            const tl_gbuffer *gbuffer,
                            tl_targets *out,
                            tl_error *err);

/* Accepts an all-zero one. */
void tl_targets_clear(tl_targets *targets);

/* Every pixel becomes sky, at the far end of the depth buffer. */
void tl_targets_wipe(const tl_gl *gl, const tl_targets *targets, enum tl_layout_name layout);

/* Copies the first `rows` rows of the targets to the words, from row `first` on. */
void tl_targets_read(const tl_gl *gl,
                     const tl_targets *targets,
                     tl_gbuffer *gbuffer,
                     uint32_t first,
                     uint32_t rows);

#endif
