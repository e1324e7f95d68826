#include "shadow_pass.h"

#include "drawing.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* A view of one size: slopes, and the depth buffer. */
typedef struct shadow_target {
    uint32_t size; /* texels each way; 0: none was made */
    GLuint framebuffer, slopes;
    float
        *depths; /* [size][size] as they are read back, and behind them as many slopes; owned */
} shadow_target;

static void make_objects(const tl_gl *gl, shadow_target *t)
{
    const GLsizei size = (GLsizei)t->size;
    const GLenum draw = GL_COLOR_ATTACHMENT0;
    GLuint depth = 0;
    gl->CreateFramebuffers(1, &t->framebuffer);
    gl->CreateTextures(GL_TEXTURE_2D, 1, &t->slopes);
    gl->TextureStorage2D(t->slopes, 1, GL_R32UI, size, size);
    gl->NamedFramebufferTexture(t->framebuffer, GL_COLOR_ATTACHMENT0, t->slopes, 0);
    gl->CreateRenderbuffers(1, &depth);
    gl->NamedRenderbufferStorage(depth, GL_DEPTH_COMPONENT32F, size, size);
    gl->NamedFramebufferRenderbuffer(t->framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                     depth);
    gl->NamedFramebufferDrawBuffers(t->framebuffer, 1, &draw);
}

/* Maps mostly follow one of their own size; objects of the one before go with the context. */
static tl_status make_target(const tl_gl *gl, uint32_t size, shadow_target *t, tl_error *err)
{
    if (t->size == size)
        return TL_OK;
    free(t->depths);
    *t = (shadow_target){.size = size};
    t->depths = malloc((size_t)size * size * 2 * sizeof *t->depths);
    if (!t->depths)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for reading back %u x %u texels",
                       size, size);
    make_objects(gl, t);
    const tl_status status = tl_gl_check(gl, "making a shadow map's targets", err);
    if (status != TL_OK)
        return status;
    if (gl->CheckNamedFramebufferStatus(t->framebuffer, GL_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE)
        return tl_fail(err, TL_ERR_DEVICE, "OpenGL cannot render to a shadow map of %u x %u",
                       size, size);
    return TL_OK;
}

static void wipe(const tl_gl *gl, const shadow_target *t)
{
    static const GLuint none = 0;
    static const GLfloat farthest = 0.0f;
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->ClearTexImage(t->slopes, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    gl->ClearNamedFramebufferfv(t->framebuffer, GL_DEPTH, 0, &farthest);
}

/* to: [size][size][2]. */
static void read_back(const tl_gl *gl, const shadow_target *t, uint32_t *to)
{
    const size_t count = (size_t)t->size * t->size;
    const GLsizei size = (GLsizei)t->size;
    void *const slopes = t->depths + count;
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->NamedFramebufferReadBuffer(t->framebuffer, GL_COLOR_ATTACHMENT0);
    gl->ReadPixels(0, 0, size, size, GL_DEPTH_COMPONENT, GL_FLOAT, t->depths);
    gl->ReadPixels(0, 0, size, size, GL_RED_INTEGER, GL_UNSIGNED_INT, slopes);
    for (size_t i = 0; i < count; i++) {
        memcpy(&to[2 * i], &t->depths[i], sizeof to[0]);
        memcpy(&to[2 * i + 1], (const uint32_t *)slopes + i, sizeof to[0]);
    }
}

static tl_status draw_view(tl_drawing *drawing,
                           const tl_camera *view,
                           const shadow_target *t,
                           uint32_t *texels,
                           tl_error *err)
{
    tl_status status = TL_OK;
    const tl_gl *const gl = drawing->gl;
    tl_drawing_look(drawing, view, true);
    gl->BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    gl->Viewport(0, 0, (GLsizei)t->size, (GLsizei)t->size);
    wipe(gl, t);
    TRY(tl_drawing_run(drawing, TL_SHADOW_PASS, err));
    read_back(gl, t, texels);
    TRY(tl_gl_check(gl, "rendering a shadow map", err));
done:
    return status;
}

tl_status tl_shadow_pass(const tl_gl *gl,
                         const tl_model *model,
                         const tl_scene_objects *objects,
                         uint32_t anisotropy,
                         tl_gbuffer *gbuffer,
                         tl_timings *timings,
                         tl_error *err)
{
    tl_status status = TL_OK;
    tl_drawing drawing = {0};
    shadow_target target = {0};
    const double clock = tl_seconds();
    if (gbuffer->shadows.count == 0)
        return TL_OK;
    TRY(tl_drawing_begin(&drawing, gl, model, objects, anisotropy, err));
    tl_drawing_set_state(gl);
    for (uint32_t i = 0; i < gbuffer->shadows.count; i++) {
        tl_shadow_map *map = &gbuffer->shadows.of[i];
        const size_t view_size = (size_t)map->size * map->size * 2;
        TRY(make_target(gl, map->size, &target, err));
        for (uint32_t v = 0; v < tl_shadow_view_count(map); v++)
            TRY(draw_view(&drawing, &map->views[v], &target, map->texels + v * view_size, err));
    }
    tl_timings_end(timings, "shadows", clock);
done:
    tl_drawing_clear(&drawing);
    free(target.depths);
    return status;
}
