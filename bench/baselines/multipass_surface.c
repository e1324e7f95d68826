#include "multipass_surface.h"

#include "shaders/multipass_interface.h"

#include "float_pixel.h"
#include "parallel.h"

#include <math.h>
#include <stdlib.h>

typedef struct surfaces {
    const tl_prepared *prepared;
    float *planes[TL_PLANE_COUNT]; /* [rows][pitch]; NULL where absent */
    depth_scale scale;
    uint32_t width;
    const struct texture *texture;
    float *texels; /* [height][width][channels] */
} surfaces;

static void write_vector(vec3 v, float fourth, float *out)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
    out[3] = fourth;
}

static void write_depth(const surfaces *s, pixel of, float *out)
{
    (void)s;
    *out = of.depth;
}

static void write_depth_buffer(const surfaces *s, pixel of, float *out)
{
    const double depth = (double)of.depth;
    const double w = s->prepared->needs.orthographic ? 1.0 : depth;
    *out = isinf(of.depth) ? 0.0f : (float)((s->scale.offset + s->scale.slope * depth) / w);
}

static void write_normal_exponent(const surfaces *s, pixel of, float *out)
{
    write_vector(view_normal(&s->prepared->frame, of.normal),
                 substance_of(&s->prepared->frame, s->prepared->needs, of).shininess, out);
}

static void write_diffuse(const surfaces *s, pixel of, float *out)
{
    write_vector(substance_of(&s->prepared->frame, s->prepared->needs, of).diffuse, 0.0f, out);
}

static void write_specular(const surfaces *s, pixel of, float *out)
{
    write_vector(substance_of(&s->prepared->frame, s->prepared->needs, of).specular, 0.0f, out);
}

/* Ambient light, emission, sky: what is there before the first light. */
static void write_unlit(const surfaces *s, pixel of, float *out)
{
    const received none = nothing_received();
    write_vector(radiance_of(&s->prepared->frame, s->prepared->needs, of,
                             substance_of(&s->prepared->frame, s->prepared->needs, of), none),
                 0.0f, out);
}

enum { NO_UNIT = -1 };

static const struct texture {
    int unit;
    GLenum storage, format;
    size_t channels;
    void (*write)(const surfaces *s, pixel of, float *out);
} textures[] = {
    {NO_UNIT, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1, write_depth_buffer},
    {UNIT_DEPTH, GL_R32F, GL_RED, 1, write_depth},
    {UNIT_NORMAL_EXPONENT, GL_RGBA32F, GL_RGBA, 4, write_normal_exponent},
    {UNIT_DIFFUSE, GL_RGBA32F, GL_RGBA, 4, write_diffuse},
    {UNIT_SPECULAR, GL_RGBA32F, GL_RGBA, 4, write_specular},
    {UNIT_UNLIT, GL_RGBA32F, GL_RGBA, 4, write_unlit},
};

static void write_rows(void *context, size_t begin, size_t end)
{
    const surfaces *s = context;
    for (size_t y = begin; y < end; y++)
        for (size_t x = 0; x < s->width; x++)
            s->texture->write(s, pixel_at(s->planes, y * s->prepared->frame.pitch + x),
                              s->texels + (y * s->width + x) * s->texture->channels);
}

depth_scale tl_multipass_depth_scale(const tl_gbuffer *gbuffer)
{
    const float *depths = tl_gbuffer_plane(gbuffer, TL_DEPTH);
    double least = (double)INFINITY, most = (double)-INFINITY;
    for (size_t i = 0; i < (size_t)gbuffer->rows * gbuffer->pitch; i++) {
        if (isinf(depths[i]))
            continue;
        least = fmin(least, (double)depths[i]);
        most = fmax(most, (double)depths[i]);
    }
    if (least > most)
        return (depth_scale){0.5, 0.0};
    if (gbuffer->camera.projection == TL_PERSPECTIVE)
        return (depth_scale){0.5 * least, 0.0};
    const double slope = -0.5 / (most - least + 1.0);
    return (depth_scale){0.75 - slope * least, slope};
}

tl_status tl_multipass_upload(const tl_gl *gl,
                              const tl_gbuffer *gbuffer,
                              const tl_prepared *prepared,
                              depth_scale scale,
                              GLuint *depth_buffer,
                              tl_error *err)
{
    const GLsizei width = (GLsizei)gbuffer->camera.width;
    const GLsizei height = (GLsizei)gbuffer->camera.height;
    surfaces s = {.prepared = prepared, .scale = scale, .width = gbuffer->camera.width};
    s.texels = malloc((size_t)width * (size_t)height * 4 * sizeof *s.texels);
    if (!s.texels)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for textures of %d x %d", width,
                       height);
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        s.planes[p] = tl_gbuffer_plane(gbuffer, p);
    for (size_t i = 0; i < sizeof textures / sizeof textures[0]; i++) {
        GLuint made = 0;
        s.texture = &textures[i];
        tl_parallel((size_t)height, 16, write_rows, &s);
        gl->CreateTextures(GL_TEXTURE_2D, 1, &made);
        gl->TextureStorage2D(made, 1, s.texture->storage, width, height);
        gl->TextureSubImage2D(made, 0, 0, 0, width, height, s.texture->format, GL_FLOAT,
                              s.texels);
        if (s.texture->unit == NO_UNIT)
            *depth_buffer = made;
        else
            gl->BindTextureUnit((GLuint)s.texture->unit, made);
    }
    free(s.texels);
    return tl_gl_check(gl, "uploading a G-buffer", err);
}
