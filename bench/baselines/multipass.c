/* Lights one by one, each drawn as what it may reach and added to float targets by blending:
 *
 *   quads    its rectangle on the screen. Policarpo and Fonseca, "Deferred Shading Tutorial" (2005),
 *            section 3.4.2, with the exact rectangle of tilelight/bounds.h. They set the scissor
 *            test to it and draw over the whole screen; a rectangle drawn in place of that covers
 *            the same pixels, and all lights are then one instanced draw.
 *   volumes  the back faces of a solid that holds its sphere, where they are not nearer than what
 *            is seen. Thibieroz, "Deferred Shading with Multiple Render Targets" (ShaderX2, 2003),
 *            "Projected Volumes".
 *
 * Diffuse and specular light go to two targets, so that the surface's colours are fetched once.
 * One target, with the colours fetched per light, takes some 10 % longer on llvmpipe; targets of
 * half floats, and setting the scissor light by light, take as long as this.
 *
 * Tolerance. cos2 carries some 8 roundings, and its power multiplies them by e/2: at 256, the largest
 * exponent of the bench scenes, the lobe is off by 256/2 8u = 6e-5 of itself (u = 2^-24), in
 * highlights. Half of that is allowed for the RMS of a frame. At the rim of its range a light may be
 * taken or left, and is 0 there; at N.L = 0 its highlight may, which is the largest difference. */
#include "baseline_tables.h"
#include "enclosing_solid.h"
#include "falloff.h"
#include "multipass_surface.h"
#include "shaders.h"
#include "shaders/multipass_interface.h"
#include "tilelight/bounds.h"
#include "try.h"

#include "embedded_multipass.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

_Static_assert(FADE_LINEAR == (int)TL_FADE_LINEAR &&
                   FADE_INVERSE_SQUARE == (int)TL_FADE_INVERSE_SQUARE &&
                   FADE_NONE == (int)TL_FADE_NONE,
               "the shaders number falloffs as kernels/falloff.h does");

typedef struct multipass {
    tl_gl *gl;
    tl_camera camera;
    tl_prepared prepared;
    bool draws_volumes;
    float (*rectangles)[4]; /* [light_count]: -1 to 1, as the shaders take them */
    GLuint vertex_array, light_buffer, rectangle_buffer;
    GLuint quad_program, volume_program, resolve_program;
    GLuint light_targets, radiance_targets; /* framebuffers */
} multipass;

void multipass_destroy(void *state)
{
    multipass *m = state;
    if (!m)
        return;
    tl_gl_close(m->gl);
    tl_prepared_clear(&m->prepared);
    free(m->rectangles);
    free(m);
}

/* --- made once --------------------------------------------------------------------------------- */

static tl_status link_programs(multipass *m, tl_error *err)
{
    const tl_needs *needs = &m->prepared.needs;
    tl_status status = TL_OK;
    char prefix[256];
    snprintf(prefix, sizeof prefix, "#version 450 core\n#define FALLOFFS %u\n%s%s",
             needs->falloffs, needs->specular ? "#define SPECULAR\n" : "",
             needs->orthographic ? "#define ORTHOGRAPHIC\n" : "");
    const char *const quad[] = {prefix, tl_multipass_interface_h, tl_multipass_light_vert,
                                NULL};
    const char *const volume[] = {prefix, "#define VOLUME\n", tl_multipass_interface_h,
                                  tl_multipass_light_vert, NULL};
    const char *const light[] = {prefix, tl_multipass_interface_h, tl_multipass_light_frag,
                                 NULL};
    const char *const screen[] = {prefix, tl_multipass_resolve_vert, NULL};
    const char *const resolve[] = {prefix, tl_multipass_interface_h, tl_multipass_resolve_frag,
                                   NULL};
    TRY(tl_shaders_link(m->gl, quad, light, &m->quad_program, err));
    if (m->draws_volumes)
        TRY(tl_shaders_link(m->gl, volume, light, &m->volume_program, err));
    TRY(tl_shaders_link(m->gl, screen, resolve, &m->resolve_program, err));
done:
    return status;
}

/* View space to the screen, row 0 of the picture at the bottom as OpenGL sees it. */
static void set_uniforms(const multipass *m, depth_scale scale)
{
    const tl_camera *c = &m->camera;
    const double width = (double)c->right - (double)c->left;
    const double height = (double)c->top - (double)c->bottom;
    const double across = ((double)c->right + (double)c->left) / width;
    const double up = ((double)c->top + (double)c->bottom) / height;
    const bool flat = c->projection == TL_ORTHOGRAPHIC;
    const double rows[4][4] = {
        {2.0 / width, 0.0, flat ? 0.0 : across, flat ? -across : 0.0},
        {0.0, -2.0 / height, flat ? 0.0 : -up, flat ? up : 0.0},
        {0.0, 0.0, -scale.slope, scale.offset},
        {0.0, 0.0, flat ? 0.0 : -1.0, flat ? 1.0 : 0.0},
    };
    const GLuint programs[] = {m->quad_program, m->volume_program};
    float matrix[4][4];
    for (int i = 0; i < 16; i++)
        matrix[i / 4][i % 4] = (float)rows[i / 4][i % 4];
    for (int i = 0; i < (m->draws_volumes ? 2 : 1); i++) {
        m->gl->UseProgram(programs[i]);
        m->gl->Uniform4fv(UNIFORM_RAYS, 1, &m->prepared.frame.rays.x0);
        m->gl->UniformMatrix4fv(UNIFORM_CLIP_FROM_VIEW, 1, GL_TRUE, &matrix[0][0]);
    }
}

static GLuint make_target(const multipass *m, GLuint framebuffer, GLenum storage, GLuint index)
{
    GLuint made = 0;
    m->gl->CreateTextures(GL_TEXTURE_2D, 1, &made);
    m->gl->TextureStorage2D(made, 1, storage, (GLsizei)m->camera.width,
                            (GLsizei)m->camera.height);
    m->gl->NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0 + index, made, 0);
    return made;
}

static tl_status make_targets(multipass *m, GLuint depth_buffer, tl_error *err)
{
    static const GLenum draws[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                   GL_COLOR_ATTACHMENT2};
    const tl_gl *gl = m->gl;
    const GLsizei lobes = m->prepared.needs.specular ? 2 : 1;
    gl->CreateFramebuffers(1, &m->light_targets);
    for (GLsizei i = 0; i < lobes; i++)
        gl->BindTextureUnit(UNIT_DIFFUSE_LIGHT + (GLuint)i,
                            make_target(m, m->light_targets, GL_RGBA32F, (GLuint)i));
    gl->NamedFramebufferTexture(m->light_targets, GL_DEPTH_ATTACHMENT, depth_buffer, 0);
    gl->NamedFramebufferDrawBuffers(m->light_targets, lobes, draws);

    gl->CreateFramebuffers(1, &m->radiance_targets);
    for (GLuint i = 0; i < 3; i++)
        make_target(m, m->radiance_targets, GL_R32F, i);
    gl->NamedFramebufferDrawBuffers(m->radiance_targets, 3, draws);
    if (gl->CheckNamedFramebufferStatus(m->light_targets, GL_FRAMEBUFFER) !=
            GL_FRAMEBUFFER_COMPLETE ||
        gl->CheckNamedFramebufferStatus(m->radiance_targets, GL_FRAMEBUFFER) !=
            GL_FRAMEBUFFER_COMPLETE)
        return tl_fail(err, TL_ERR_DEVICE, "OpenGL cannot render to float targets of %u x %u",
                       m->camera.width, m->camera.height);
    return tl_gl_check(gl, "making float targets", err);
}

static GLuint make_buffer(const tl_gl *gl, size_t size, const void *data, GLbitfield flags)
{
    GLuint made = 0;
    gl->CreateBuffers(1, &made);
    gl->NamedBufferStorage(made, (GLsizeiptr)size, data, flags);
    return made;
}

/* Where each attribute comes from: a binding point, and where in its element. */
enum { PER_CORNER, PER_RECTANGLE, PER_LIGHT };
static const struct {
    GLuint attribute, binding, offset;
    GLint width;
} attributes[] = {
    {ATTRIBUTE_CORNER, PER_CORNER, 0, 3},
    {ATTRIBUTE_RECTANGLE, PER_RECTANGLE, 0, 4},
    {ATTRIBUTE_POSITION_RANGE2, PER_LIGHT, offsetof(tl_view_light, position), 4},
    {ATTRIBUTE_DIFFUSE_FADE, PER_LIGHT, offsetof(tl_view_light, diffuse), 4},
    {ATTRIBUTE_SPECULAR, PER_LIGHT, offsetof(tl_view_light, specular), 3},
    {ATTRIBUTE_FALLOFF, PER_LIGHT, offsetof(tl_view_light, falloff), 1},
};

static void describe_attributes(const tl_gl *gl, GLuint array)
{
    for (size_t i = 0; i < sizeof attributes / sizeof attributes[0]; i++) {
        const GLuint attribute = attributes[i].attribute;
        if (attribute == ATTRIBUTE_FALLOFF)
            gl->VertexArrayAttribIFormat(array, attribute, attributes[i].width, GL_INT,
                                         attributes[i].offset);
        else
            gl->VertexArrayAttribFormat(array, attribute, attributes[i].width, GL_FLOAT,
                                        GL_FALSE, attributes[i].offset);
        gl->VertexArrayAttribBinding(array, attribute, attributes[i].binding);
        gl->EnableVertexArrayAttrib(array, attribute);
    }
    gl->VertexArrayBindingDivisor(array, PER_RECTANGLE, 1);
    gl->VertexArrayBindingDivisor(array, PER_LIGHT, 1);
}

static tl_status make_vertices(multipass *m, tl_error *err)
{
    const tl_gl *gl = m->gl;
    const size_t count = m->prepared.frame.light_count + 1u; /* not empty without lights */
    enclosing_solid solid;
    tl_enclosing_solid(&solid);
    m->light_buffer =
        make_buffer(gl, count * sizeof(tl_view_light), NULL, GL_DYNAMIC_STORAGE_BIT);
    m->rectangle_buffer =
        make_buffer(gl, count * sizeof *m->rectangles, NULL, GL_DYNAMIC_STORAGE_BIT);
    gl->CreateVertexArrays(1, &m->vertex_array);
    gl->VertexArrayElementBuffer(m->vertex_array,
                                 make_buffer(gl, sizeof solid.faces, solid.faces, 0));
    gl->VertexArrayVertexBuffer(m->vertex_array, PER_CORNER,
                                make_buffer(gl, sizeof solid.corners, solid.corners, 0), 0,
                                sizeof solid.corners[0]);
    gl->VertexArrayVertexBuffer(m->vertex_array, PER_RECTANGLE, m->rectangle_buffer, 0,
                                sizeof *m->rectangles);
    gl->VertexArrayVertexBuffer(m->vertex_array, PER_LIGHT, m->light_buffer, 0,
                                sizeof(tl_view_light));
    describe_attributes(gl, m->vertex_array);
    return tl_gl_check(gl, "making vertices", err);
}

/* State that stays. Depth is clamped in place of clipped, so that what stands nearer than the near
 * plane still covers its pixels. The picture is upside down, and with it the faces' turn. */
static void set_state(const multipass *m)
{
    const tl_gl *gl = m->gl;
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl->Viewport(0, 0, (GLsizei)m->camera.width, (GLsizei)m->camera.height);
    gl->BindVertexArray(m->vertex_array);
    gl->BlendFunc(GL_ONE, GL_ONE);
    gl->Enable(GL_DEPTH_CLAMP);
    gl->DepthFunc(GL_LEQUAL); /* depth is reversed: not nearer than the surface */
    gl->DepthMask(GL_FALSE);
    gl->FrontFace(GL_CW);
    gl->CullFace(GL_FRONT);
}

static tl_status create(const tl_baseline_input *input,
                        bool draws_volumes,
                        void **out,
                        tl_error *err)
{
    tl_status status = TL_OK;
    const depth_scale scale = tl_multipass_depth_scale(input->gbuffer);
    GLuint depth_buffer = 0;
    multipass *m = calloc(1, sizeof *m);
    if (!m)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a baseline");
    m->camera = input->gbuffer->camera;
    m->draws_volumes = draws_volumes;
    TRY(tl_prepare(input->gbuffer, input->lights, &(tl_prepare_options){.tile_size = 16}, NULL,
                   &m->prepared, err));
    TRY(tl_baseline_check(&m->prepared.needs, 1u << TL_MODEL_PHONG,
                          ~(1u << TL_FADE_LINEAR_FROM), err));
    for (uint32_t i = 0; i < m->prepared.frame.global_count; i++)
        m->prepared.lights[i].range2 = INFINITY;
    m->rectangles = calloc(m->prepared.frame.light_count + 1u, sizeof *m->rectangles);
    if (!m->rectangles)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a baseline"));
    TRY(tl_gl_open(&m->gl, err));
    TRY(tl_multipass_upload(m->gl, input->gbuffer, &m->prepared, scale, &depth_buffer, err));
    TRY(make_targets(m, depth_buffer, err));
    TRY(make_vertices(m, err));
    TRY(link_programs(m, err));
    set_uniforms(m, scale);
    set_state(m);
    TRY(tl_gl_check(m->gl, "making a baseline ready", err));
    *out = m;
    m = NULL;
done:
    multipass_destroy(m);
    return status;
}

tl_status multipass_create_quads(const tl_baseline_input *input, void **out, tl_error *err)
{
    return create(input, false, out, err);
}

tl_status multipass_create_volumes(const tl_baseline_input *input, void **out, tl_error *err)
{
    return create(input, true, out, err);
}

/* --- per frame --------------------------------------------------------------------------------- */

static void find_rectangles(multipass *m)
{
    const float per_width = 2.0f / (float)m->camera.width;
    const float per_height = 2.0f / (float)m->camera.height;
    for (uint32_t i = 0; i < m->prepared.frame.light_count; i++) {
        const tl_view_light *light = &m->prepared.lights[i];
        tl_pixel_rect rect = {0, 0, m->camera.width, m->camera.height};
        if (i >= m->prepared.frame.global_count)
            tl_sphere_bounds(&m->camera, light->position, sqrtf(light->range2), &rect);
        m->rectangles[i][0] = (float)rect.x0 * per_width - 1.0f;
        m->rectangles[i][1] = (float)rect.y0 * per_height - 1.0f;
        m->rectangles[i][2] = (float)rect.x1 * per_width - 1.0f;
        m->rectangles[i][3] = (float)rect.y1 * per_height - 1.0f;
    }
}

static void upload_lights(const multipass *m)
{
    const size_t count = m->prepared.frame.light_count;
    m->gl->NamedBufferSubData(m->light_buffer, 0, (GLsizeiptr)(count * sizeof(tl_view_light)),
                              m->prepared.lights);
    m->gl->NamedBufferSubData(m->rectangle_buffer, 0,
                              (GLsizeiptr)(count * sizeof *m->rectangles), m->rectangles);
}

/* Lights [first, end). */
static void draw_quads(const multipass *m, uint32_t first, uint32_t end)
{
    if (first == end)
        return;
    m->gl->UseProgram(m->quad_program);
    m->gl->DrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)(end - first),
                                           first);
}

static void draw_volumes(const multipass *m, uint32_t first, uint32_t end)
{
    const tl_gl *gl = m->gl;
    if (first == end)
        return;
    gl->UseProgram(m->volume_program);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_CULL_FACE);
    gl->DrawElementsInstancedBaseInstance(GL_TRIANGLES, 3 * SOLID_FACE_COUNT, GL_UNSIGNED_INT,
                                          NULL, (GLsizei)(end - first), first);
    gl->Disable(GL_CULL_FACE);
    gl->Disable(GL_DEPTH_TEST);
}

/* A light that reaches everything has no volume. */
static void draw_lights(const multipass *m)
{
    static const GLfloat black[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    const tl_frame *frame = &m->prepared.frame;
    m->gl->BindFramebuffer(GL_FRAMEBUFFER, m->light_targets);
    for (GLint lobe = 0; lobe < (m->prepared.needs.specular ? 2 : 1); lobe++)
        m->gl->ClearNamedFramebufferfv(m->light_targets, GL_COLOR, lobe, black);
    m->gl->Enable(GL_BLEND);
    draw_quads(m, 0, m->draws_volumes ? frame->global_count : frame->light_count);
    if (m->draws_volumes)
        draw_volumes(m, frame->global_count, frame->light_count);
    m->gl->Disable(GL_BLEND);
}

static void resolve(const multipass *m)
{
    m->gl->BindFramebuffer(GL_FRAMEBUFFER, m->radiance_targets);
    m->gl->UseProgram(m->resolve_program);
    m->gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

static void read_back(const multipass *m, tl_image *image)
{
    m->gl->PixelStorei(GL_PACK_ROW_LENGTH, (GLint)image->pitch);
    for (unsigned i = 0; i < 3; i++) {
        m->gl->NamedFramebufferReadBuffer(m->radiance_targets, GL_COLOR_ATTACHMENT0 + i);
        m->gl->ReadPixels(0, 0, (GLsizei)image->width, (GLsizei)image->height, GL_RED, GL_FLOAT,
                          tl_image_plane(image, i));
    }
}

tl_status multipass_run(void *state, tl_image *image, tl_timings *timings, tl_error *err)
{
    multipass *m = state;
    double clock = tl_seconds();
    const tl_status status = tl_gl_use(m->gl, err);
    if (status != TL_OK)
        return status;
    find_rectangles(m);
    upload_lights(m);
    clock = tl_timings_end(timings, "rectangles", clock);
    draw_lights(m);
    m->gl->Finish();
    clock = tl_timings_end(timings, "lights", clock);
    resolve(m);
    m->gl->Finish();
    clock = tl_timings_end(timings, "resolve", clock);
    read_back(m, image);
    tl_timings_end(timings, "readback", clock);
    return tl_gl_check(m->gl, "lighting a frame", err);
}
