/* A model's geometry and textures as OpenGL objects; they go with the context. */
#ifndef TL_UPLOAD_H
#define TL_UPLOAD_H

#include "gl.h"
#include "model.h"

typedef struct tl_scene_objects {
    GLuint *vertex_arrays; /* [vertices_count] */
    GLuint *index_buffers; /* [part_count]; 0: nothing to draw */
    GLuint *textures;      /* [pixels_count] */
    GLuint *samplers;      /* [texture_count] */
} tl_scene_objects;

/* Decodes the images and uploads all, with mipmaps where samplers look at them: stages "decode" and
 * "upload". The caller releases with tl_scene_objects_clear whether it succeeds or not. Fails with
 * TL_ERR_FORMAT (a damaged image), TL_ERR_MEMORY or TL_ERR_DEVICE. */
tl_status tl_upload(const tl_gl *gl,
                    const tl_model *model,
                    tl_scene_objects *out,
                    tl_timings *timings,
                    tl_error *err);

/* Frees the lists, not the objects. Accepts an all-zero one. */
void tl_scene_objects_clear(tl_scene_objects *objects);

#endif
