#include "peeling.h"

#include "interface.h"
#include "try.h"

#include <stdlib.h>

/* Pixels that are read back at a time. */
static const uint32_t chunk_pixels = 1u << 18;

/* What is no depth and no rank. */
static const GLfloat none[2] = {-1.0f, 0.0f};

/* --- buffers --------------------------------------------------------------------------------------- */

static GLuint make_texture(const tl_gl *gl, const tl_peeling *p, GLenum format)
{
    GLuint texture = 0;
    gl->CreateTextures(GL_TEXTURE_2D, 1, &texture);
    gl->TextureStorage2D(texture, 1, format, (GLsizei)p->width, (GLsizei)p->rows);
    return texture;
}

static GLuint make_framebuffer(const tl_gl *gl, GLuint color, GLuint depth)
{
    const GLenum draw = GL_COLOR_ATTACHMENT0;
    GLuint framebuffer = 0;
    gl->CreateFramebuffers(1, &framebuffer);
    gl->NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
    gl->NamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    gl->NamedFramebufferDrawBuffers(framebuffer, 1, &draw);
    return framebuffer;
}

/* All share a depth buffer, which each pass begins with anew. */
static void make_objects(const tl_gl *gl, tl_peeling *p)
{
    GLuint depth = 0;
    gl->CreateRenderbuffers(1, &depth);
    gl->NamedRenderbufferStorage(depth, GL_DEPTH_COMPONENT32F, (GLsizei)p->width,
                                 (GLsizei)p->rows);
    p->back = make_texture(gl, p, GL_R32F);
    p->back_framebuffer = make_framebuffer(gl, p->back, depth);
    for (int i = 0; i < 2; i++) {
        p->fronts[i] = make_texture(gl, p, GL_R32F);
        p->choices[i] = make_texture(gl, p, GL_RG32F);
        p->front_framebuffers[i] = make_framebuffer(gl, p->fronts[i], depth);
        p->choice_framebuffers[i] = make_framebuffer(gl, p->choices[i], depth);
    }
}

tl_status tl_peeling_create(
    const tl_gl *gl, const tl_targets *targets, uint32_t most, tl_peeling *out, tl_error *err)
{
    tl_peeling made = {.width = targets->width, .rows = targets->rows, .most = most};
    make_objects(gl, &made);
    const tl_status status = tl_gl_check(gl, "making the buffers of layers", err);
    if (status != TL_OK)
        return status;
    if (gl->CheckNamedFramebufferStatus(made.choice_framebuffers[0], GL_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE)
        return tl_fail(err, TL_ERR_DEVICE, "OpenGL cannot peel layers of %u x %u", made.width,
                       made.rows);
    made.chunk_rows = chunk_pixels / made.width; /* at least 16 */
    made.scratch = malloc((size_t)made.width * made.chunk_rows * 2 * sizeof *made.scratch);
    if (!made.scratch)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for reading back %u x %u pixels",
                       made.width, made.chunk_rows);
    *out = made;
    return TL_OK;
}

void tl_peeling_clear(tl_peeling *peeling)
{
    free(peeling->scratch);
    *peeling = (tl_peeling){0};
}

/* --- passes ---------------------------------------------------------------------------------------- */

/* Which of the two buffers a layer has; the layer before it has the other. */
static uint32_t turn_of(uint32_t layer)
{
    return layer % 2;
}

static void look_at(const tl_gl *gl, GLuint unit, GLuint texture)
{
    gl->BindSampler(unit, 0);
    gl->BindTextureUnit(unit, texture);
}

/* Before layer 0 nothing is taken: something nearer than all is. */
static void begin_band(const tl_gl *gl, const tl_peeling *p)
{
    static const GLfloat before_all = 2.0f;
    const uint32_t before = 1 - turn_of(0);
    gl->ClearTexImage(p->fronts[before], 0, GL_RED, GL_FLOAT, &before_all);
    gl->ClearTexImage(p->choices[before], 0, GL_RG, GL_FLOAT, none);
}

static tl_status draw(
    const tl_drawing *drawing, tl_pass which, GLuint framebuffer, GLfloat depth, tl_error *err)
{
    const tl_gl *gl = drawing->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (GLfloat[4]){none[0], none[1]});
    gl->ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &depth);
    return tl_drawing_run(drawing, which, err);
}

/* Which surface each pixel of the layer is. */
static tl_status choose(const tl_peeling *p,
                        const tl_drawing *drawing,
                        uint32_t layer,
                        tl_error *err)
{
    const tl_gl *gl = drawing->gl;
    const uint32_t now = turn_of(layer), before = 1 - now;
    tl_status status = TL_OK;
    look_at(gl, SLOT_BACK, p->back);
    look_at(gl, SLOT_TAKEN_FRONT, p->fronts[before]);
    look_at(gl, SLOT_TAKEN_CHOICE, p->choices[before]);
    TRY(draw(drawing, TL_FRONT_PASS, p->front_framebuffers[now], 0.0f, err));
    look_at(gl, SLOT_FRONT, p->fronts[now]);
    TRY(draw(drawing, TL_CHOICE_PASS, p->choice_framebuffers[now], 1.0f, err));
    TRY(tl_gl_check(gl, "peeling a layer", err));
done:
    return status;
}

/* What those surfaces are made of. */
static tl_status draw_layer(const tl_peeling *p,
                            const tl_drawing *drawing,
                            const tl_targets *targets,
                            uint32_t layer,
                            tl_gbuffer *into,
                            uint32_t first,
                            uint32_t rows,
                            tl_error *err)
{
    const tl_gl *gl = drawing->gl;
    tl_status status = TL_OK;
    look_at(gl, SLOT_CHOICE, p->choices[turn_of(layer)]);
    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->framebuffer);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    tl_targets_wipe(gl, targets, into->layout);
    TRY(tl_drawing_run(drawing, TL_LAYER_PASS, err));
    tl_targets_read(gl, targets, into, first, rows);
    TRY(tl_gl_check(gl, "drawing a layer", err));
done:
    return status;
}

/* Of the layer that was chosen last: in how many pixels it has a surface. to: where their opacity goes, at
 * the band's first row; NULL: nowhere. */
static uint64_t read_choice(const tl_peeling *p,
                            const tl_gl *gl,
                            uint32_t layer,
                            uint32_t rows,
                            float *to,
                            size_t pitch)
{
    uint64_t count = 0;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, p->choice_framebuffers[turn_of(layer)]);
    gl->NamedFramebufferReadBuffer(p->choice_framebuffers[turn_of(layer)],
                                   GL_COLOR_ATTACHMENT0);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
    for (uint32_t y = 0; y < rows; y += p->chunk_rows) {
        const uint32_t some = rows - y < p->chunk_rows ? rows - y : p->chunk_rows;
        gl->ReadPixels(0, (GLint)y, (GLsizei)p->width, (GLsizei)some, GL_RG, GL_FLOAT,
                       p->scratch);
        for (uint32_t row = 0; row < some; row++)
            for (uint32_t x = 0; x < p->width; x++) {
                const float *choice = &p->scratch[2 * ((size_t)row * p->width + x)];
                count += choice[0] >= 0.0f;
                if (to)
                    to[(y + row) * pitch + x] = choice[1];
            }
    }
    return count;
}

/* The one that layer `index` is read into. */
static tl_status layer_at(tl_gbuffer *gbuffer, uint32_t index, tl_gbuffer **out, tl_error *err)
{
    tl_status status = TL_OK;
    *out = NULL;
    if (index == gbuffer->layers.count)
        TRY(tl_layers_add(gbuffer, out, err));
    else
        *out = gbuffer->layers.of[index];
    if (gbuffer->ids)
        TRY(tl_ids_add(*out, err));
done:
    return status;
}

tl_status tl_peel_band(const tl_peeling *p,
                       const tl_drawing *drawing,
                       const tl_targets *targets,
                       tl_gbuffer *gbuffer,
                       uint32_t first,
                       uint32_t rows,
                       tl_error *err)
{
    const tl_gl *gl = drawing->gl;
    const size_t start = (size_t)first * gbuffer->pitch;
    tl_status status = TL_OK;
    begin_band(gl, p);
    TRY(draw(drawing, TL_BACK_PASS, p->back_framebuffer, 0.0f, err));
    for (uint32_t layer = 0;; layer++) {
        tl_gbuffer *into = NULL;
        TRY(choose(p, drawing, layer, err));
        const uint64_t count = read_choice(p, gl, layer, rows, NULL, 0);
        if (count == 0)
            break;
        if (layer == p->most) {
            gbuffer->layers.left += count;
            break;
        }
        TRY(layer_at(gbuffer, layer, &into, err));
        read_choice(p, gl, layer, rows, into->opacity + start, gbuffer->pitch);
        TRY(draw_layer(p, drawing, targets, layer, into, first, rows, err));
    }
done:
    return status;
}
