#include "upload.h"

#include "accessor.h"
#include "interface.h"
#include "parallel.h"
#include "try.h"

#include <stdlib.h>

/* The locations in the shaders are the attributes' numbers here. */
_Static_assert((int)ATTRIBUTE_POSITION == (int)TL_GLTF_POSITION &&
                   (int)ATTRIBUTE_NORMAL == (int)TL_GLTF_NORMAL &&
                   (int)ATTRIBUTE_TANGENT == (int)TL_GLTF_TANGENT &&
                   (int)ATTRIBUTE_TEXCOORD_0 == (int)TL_GLTF_TEXCOORD_0 &&
                   (int)MOST_SETS == (int)TL_GLTF_TEXCOORD_COUNT &&
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
        const int width = tl_accessor_width((int)i);
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

static GLsizei level_count(const tl_pixels *pixels)
{
    uint32_t extent = pixels->width > pixels->height ? pixels->width : pixels->height;
    GLsizei count = 1;
    for (; extent > 1; extent /= 2)
        count++;
    return count;
}

static GLuint upload_pixels(const tl_gl *gl, const tl_pixels *pixels, const uint16_t *rgba)
{
    GLuint made = 0;
    gl->CreateTextures(GL_TEXTURE_2D, 1, &made);
    gl->TextureStorage2D(made, pixels->mipmaps ? level_count(pixels) : 1, GL_RGBA16,
                         (GLsizei)pixels->width, (GLsizei)pixels->height);
    gl->TextureSubImage2D(made, 0, 0, 0, (GLsizei)pixels->width, (GLsizei)pixels->height,
                          GL_RGBA, GL_UNSIGNED_SHORT, rgba);
    if (pixels->mipmaps)
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

/* A few images at a time: all of them decoded would need as much memory again as OpenGL's copies. */
static tl_status upload_images(const tl_gl *gl,
                               const tl_model *model,
                               GLuint *textures,
                               tl_timings *timings,
                               tl_error *err)
{
    const size_t batch = 4 * (size_t)tl_thread_count();
    tl_texels *const texels = calloc(batch, sizeof *texels);
    tl_status status = TL_OK;
    double clock = tl_seconds();
    if (!texels)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its images",
                       model->gltf->path);
    for (size_t first = 0; first < model->pixels_count; first += batch) {
        const size_t left = model->pixels_count - first;
        const size_t count = left < batch ? left : batch;
        TRY(tl_model_decode(model, first, count, texels, err));
        clock = tl_timings_end(timings, "decode", clock);
        for (size_t i = 0; i < count; i++)
            textures[first + i] = upload_pixels(gl, &model->pixels[first + i], texels[i].rgba);
        clock = tl_timings_end(timings, "upload", clock);
    }
done:
    for (size_t i = 0; i < batch; i++)
        free(texels[i].rgba);
    free(texels);
    return status;
}

static void upload_geometry(const tl_gl *gl, const tl_model *model, tl_scene_objects *out)
{
    for (size_t i = 0; i < model->vertices_count; i++)
        out->vertex_arrays[i] = upload_vertices(gl, &model->vertices[i]);
    for (size_t i = 0; i < model->part_count; i++)
        if (model->parts[i].index_count > 0)
            out->index_buffers[i] = upload_buffer(
                gl, model->parts[i].indices, model->parts[i].index_count * sizeof(uint32_t));
    for (size_t i = 0; i < model->texture_count; i++)
        out->samplers[i] = make_sampler(gl, &model->textures[i].sampler);
}

tl_status tl_upload(const tl_gl *gl,
                    const tl_model *model,
                    tl_scene_objects *out,
                    tl_timings *timings,
                    tl_error *err)
{
    tl_status status = TL_OK;
    const double clock = tl_seconds();
    out->vertex_arrays = calloc(model->vertices_count + 1, sizeof(GLuint));
    out->index_buffers = calloc(model->part_count + 1, sizeof(GLuint));
    out->textures = calloc(model->pixels_count + 1, sizeof(GLuint));
    out->samplers = calloc(model->texture_count + 1, sizeof(GLuint));
    if (!out->vertex_arrays || !out->index_buffers || !out->textures || !out->samplers)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the scene's objects",
                       model->gltf->path);
    upload_geometry(gl, model, out);
    tl_timings_end(timings, "upload", clock);
    TRY(upload_images(gl, model, out->textures, timings, err));
    TRY(tl_gl_check(gl, "uploading the scene", err));
done:
    return status;
}

void tl_scene_objects_clear(tl_scene_objects *objects)
{
    free(objects->vertex_arrays);
    free(objects->index_buffers);
    free(objects->textures);
    free(objects->samplers);
    *objects = (tl_scene_objects){0};
}
