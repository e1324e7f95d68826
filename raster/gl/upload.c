#include "upload.h"

#include "accessor.h"
#include "interface.h"
#include "try.h"

#include <stdlib.h>

/* The locations in the shaders are the attributes' numbers here. */
_Static_assert((int)ATTRIBUTE_POSITION == (int)TL_GLTF_POSITION &&
                   (int)ATTRIBUTE_NORMAL == (int)TL_GLTF_NORMAL &&
                   (int)ATTRIBUTE_TANGENT == (int)TL_GLTF_TANGENT &&
                   (int)ATTRIBUTE_TEXCOORD_0 == (int)TL_GLTF_TEXCOORD_0 &&
                   (int)ATTRIBUTE_TEXCOORD_1 == (int)TL_GLTF_TEXCOORD_1 &&
                   (int)ATTRIBUTE_COLOR == (int)TL_GLTF_COLOR,
               "shaders/interface.h lists attributes in the order of TL_GLTF_ATTRIBUTES");

static GLuint upload_buffer(const tl_gl *gl, const void *data, size_t size)
{
    GLuint buffer = 0;
    gl->CreateBuffers(1, &buffer);
    gl->NamedBufferStorage(buffer, (GLsizeiptr)size, data, 0);
    return buffer;
}

static GLuint upload_vertices(const tl_gl *gl, const tl_vertices *vertices)
{
    GLuint array = 0;
    gl->CreateVertexArrays(1, &array);
    for (GLuint i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++) {
        const int width = tl_attribute_width((enum tl_gltf_attribute)i);
        const size_t stride = (size_t)width * sizeof(float);
        if (!vertices->attributes[i])
            continue;
        gl->VertexArrayVertexBuffer(
            array, i, upload_buffer(gl, vertices->attributes[i], vertices->count * stride), 0,
            (GLsizei)stride);
        gl->VertexArrayAttribFormat(array, i, width, GL_FLOAT, GL_FALSE, 0);
        gl->VertexArrayAttribBinding(array, i, i);
        gl->EnableVertexArrayAttrib(array, i);
    }
    return array;
}

static bool uses_mipmaps(const tl_gltf_sampler *sampler)
{
    return sampler->min_filter != GL_NEAREST && sampler->min_filter != GL_LINEAR;
}

static GLsizei level_count(const tl_texels *texels)
{
    uint32_t extent = texels->width > texels->height ? texels->width : texels->height;
    GLsizei count = 1;
    for (; extent > 1; extent /= 2)
        count++;
    return count;
}

/* A texture whose pixels another one has already is that one: samplers are objects of their own.
 * Returns `index` if there is none, or none with the mipmaps it needs. */
static size_t same_pixels(const tl_model *model, size_t index)
{
    const tl_texture *const wanted = &model->textures[index];
    for (size_t i = 0; i < index; i++)
        if (model->textures[i].image == wanted->image &&
            model->textures[i].srgb == wanted->srgb &&
            (uses_mipmaps(&model->textures[i].sampler) || !uses_mipmaps(&wanted->sampler)))
            return i;
    return index;
}

static GLuint upload_texture(const tl_gl *gl,
                             const tl_texture *texture,
                             const tl_texels *texels)
{
    const bool mipmaps = uses_mipmaps(&texture->sampler);
    GLuint made = 0;
    gl->CreateTextures(GL_TEXTURE_2D, 1, &made);
    gl->TextureStorage2D(made, mipmaps ? level_count(texels) : 1,
                         texture->srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, (GLsizei)texels->width,
                         (GLsizei)texels->height);
    gl->TextureSubImage2D(made, 0, 0, 0, (GLsizei)texels->width, (GLsizei)texels->height,
                          GL_RGBA, GL_UNSIGNED_BYTE, texels->rgba);
    if (mipmaps)
        gl->GenerateTextureMipmap(made);
    return made;
}

static GLuint make_sampler(const tl_gl *gl, const tl_gltf_sampler *sampler)
{
    GLuint made = 0;
    gl->CreateSamplers(1, &made);
    gl->SamplerParameteri(made, GL_TEXTURE_MIN_FILTER, sampler->min_filter);
    gl->SamplerParameteri(made, GL_TEXTURE_MAG_FILTER, sampler->mag_filter);
    gl->SamplerParameteri(made, GL_TEXTURE_WRAP_S, sampler->wrap_s);
    gl->SamplerParameteri(made, GL_TEXTURE_WRAP_T, sampler->wrap_t);
    return made;
}

tl_status tl_upload(const tl_gl *gl,
                    const tl_model *model,
                    tl_scene_objects *out,
                    tl_error *err)
{
    out->vertex_arrays = calloc(model->vertices_count + 1, sizeof(GLuint));
    out->index_buffers = calloc(model->part_count + 1, sizeof(GLuint));
    out->textures = calloc(model->texture_count + 1, sizeof(GLuint));
    out->samplers = calloc(model->texture_count + 1, sizeof(GLuint));
    if (!out->vertex_arrays || !out->index_buffers || !out->textures || !out->samplers)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the scene's objects",
                       model->gltf->path);
    for (size_t i = 0; i < model->vertices_count; i++)
        out->vertex_arrays[i] = upload_vertices(gl, &model->vertices[i]);
    for (size_t i = 0; i < model->part_count; i++)
        if (model->parts[i].index_count > 0)
            out->index_buffers[i] = upload_buffer(
                gl, model->parts[i].indices, model->parts[i].index_count * sizeof(uint32_t));
    for (size_t i = 0; i < model->texture_count; i++) {
        const tl_texels *const texels = &model->images[model->textures[i].image];
        const size_t same = same_pixels(model, i);
        if (!texels->rgba) /* missing: no material refers to it any more */
            continue;
        out->textures[i] =
            same < i ? out->textures[same] : upload_texture(gl, &model->textures[i], texels);
        out->samplers[i] = make_sampler(gl, &model->textures[i].sampler);
    }
    return tl_gl_check(gl, "uploading the scene", err);
}

void tl_scene_objects_clear(tl_scene_objects *objects)
{
    free(objects->vertex_arrays);
    free(objects->index_buffers);
    free(objects->textures);
    free(objects->samplers);
    *objects = (tl_scene_objects){0};
}
