/* Layers of surfaces that blend, peeled by depth: Everitt, "Interactive Order-Independent Transparency",
 * 2001; here with ranks, so that surfaces at one place become layers one after the other.
 *
 * For each layer all that blends is drawn three times: for the depth of what is nearest of all that is left,
 * for the surface that is it, and for what that is made of. */
#ifndef TL_PEELING_H
#define TL_PEELING_H

#include "drawing.h"
#include "targets.h"

/* Buffers for a band of the picture. All zero is valid to clear. */
typedef struct tl_peeling {
    uint32_t width, rows;               /* px, of a band */
    uint32_t most;                      /* layers */
    uint32_t chunk_rows;                /* read back at a time */
    float *scratch;                     /* [chunk_rows][width][2], owned */
    GLuint back, fronts[2], choices[2]; /* textures: peel.glsl; layers take turns */
    GLuint back_framebuffer, front_framebuffers[2], choice_framebuffers[2];
} tl_peeling;

/* For bands as large as those of `targets`. Release with tl_peeling_clear; the GL objects go with the
 * context. Fails with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_peeling_create(
    const tl_gl *gl, const tl_targets *targets, uint32_t most, tl_peeling *out, tl_error *err);

void tl_peeling_clear(tl_peeling *peeling);

/* Peels `rows` rows of the picture from row `first` on, and reads them into layers of `gbuffer`, which are
 * added where there are too few. drawing: in layers and reversed, its programs for the layout; the viewport
 * is that of the band; targets are drawn to anew. Fails with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_peel_band(const tl_peeling *peeling,
                       const tl_drawing *drawing,
                       const tl_targets *targets,
                       tl_gbuffer *gbuffer,
                       uint32_t first,
                       uint32_t rows,
                       tl_error *err);

#endif
