/* A model as a camera sees it, drawn with the shaders of one pass or another. */
#ifndef TL_DRAWING_H
#define TL_DRAWING_H

#include "program.h"
#include "upload.h"

#include <stdbool.h>

/* All zero is valid to clear. */
typedef struct tl_drawing {
    const tl_gl *gl;
    const tl_model *model;
    const tl_scene_objects *objects;
    const tl_camera *camera;
    bool is_reversed; /* 1 on the near plane, 0 on the far plane; else 0 and 1 */
    bool
        is_layered; /* surfaces that blend are drawn by the passes of layers, not among the others */
    bool has_ids; /* the surface and layer passes write which object is drawn */
    float anisotropy;
    tl_programs *programs; /* owned */
    float clip_from_view[4][4], world_from_view[3][3];
    float eye[3];                 /* in world space, m */
    float depth_range[3];         /* near, far in m; 1: parallel rays */
    struct tl_placed_draw *draws; /* [model->draw_count], owned */
} tl_drawing;

/* What is pointed to outlives *out, which is released with tl_drawing_clear. Textures that have mipmaps are
 * looked up with an anisotropy of 1 (as samplers alone do) to 16. Fails with TL_ERR_MEMORY. */
tl_status tl_drawing_begin(tl_drawing *out,
                           const tl_gl *gl,
                           const tl_model *model,
                           const tl_scene_objects *objects,
                           uint32_t anisotropy,
                           tl_error *err);

/* From here on surfaces that blend are drawn by the passes of layers, not among the others. Fails as
 * tl_blending_ranks does. */
tl_status tl_drawing_part_layers(tl_drawing *drawing, tl_error *err);

void tl_drawing_clear(tl_drawing *drawing);

/* From here on it is what this camera, which outlives that, sees. */
void tl_drawing_look(tl_drawing *drawing, const tl_camera *camera, bool is_reversed);

/* The state that all passes are drawn with: row 0 on top, depth in [0, 1]. */
void tl_drawing_set_state(const tl_gl *gl);

/* Draws all of it that the pass is of to the bound framebuffer, whose viewport is set. The depth pass writes
 * depth alone, the surface pass colours alone, where depth is equal; others both. Fails with
 * TL_ERR_DEVICE. */
tl_status tl_drawing_run(const tl_drawing *drawing, tl_pass which, tl_error *err);

#endif
