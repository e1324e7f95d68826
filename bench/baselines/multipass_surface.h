/* A G-buffer as the multi-pass baselines hold it: textures, once per frame that is lit. */
#ifndef TL_MULTIPASS_SURFACE_H
#define TL_MULTIPASS_SURFACE_H

#include "gl.h"
#include "prepared.h"

/* Depths as the depth buffer holds them, larger where nearer: (offset + slope depth) / w, where w is
 * the depth of a perspective camera and 1 of an orthographic one. Sky is 0, nearer than nothing. */
typedef struct depth_scale {
    double offset, slope;
} depth_scale;

/* What keeps every surface of the frame within (0, 1). */
depth_scale tl_multipass_depth_scale(const tl_gbuffer *gbuffer);

/* Makes the textures of the UNIT_... that surfaces have, binds them, and makes *depth_buffer a
 * texture of the depth buffer's format. Row 0 of the picture is row 0 of each. They go with the
 * context. Fails with TL_ERR_MEMORY or TL_ERR_DEVICE. */
tl_status tl_multipass_upload(const tl_gl *gl,
                              const tl_gbuffer *gbuffer,
                              const tl_prepared *prepared,
                              depth_scale scale,
                              GLuint *depth_buffer,
                              tl_error *err);

#endif
