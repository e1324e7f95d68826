/* What the geometry pass renders to, and the way back into a G-buffer's planes. */
#ifndef TL_TARGETS_H
#define TL_TARGETS_H

#include "gl.h"

#include "tilelight/gbuffer.h"

typedef struct tl_targets {
    GLuint framebuffer;
    uint32_t width, rows; /* a band of the picture: it is rendered band by band */
    uint32_t present;     /* the G-buffer's planes */
    uint32_t chunk_rows;  /* read back at a time */
    float *scratch;       /* [chunk_rows][width][4], owned */
} tl_targets;

/* Makes targets for the planes of `gbuffer`, as high as a bounded amount of memory allows. Release
 * with tl_targets_clear; the GL objects go with the context. Fails with TL_ERR_DEVICE or
 * TL_ERR_MEMORY. */
tl_status tl_targets_create(const tl_gl *gl,
                            const tl_gbuffer *gbuffer,
                            tl_targets *out,
                            tl_error *err);

/* Accepts an all-zero one. */
void tl_targets_clear(tl_targets *targets);

/* Every pixel becomes sky, at the far end of reversed depth. */
void tl_targets_wipe(const tl_gl *gl, const tl_targets *targets);

/* Copies the first `rows` rows of the targets to the planes, from row `first` on. */
void tl_targets_read(const tl_gl *gl,
                     const tl_targets *targets,
                     tl_gbuffer *gbuffer,
                     uint32_t first,
                     uint32_t rows);

#endif
