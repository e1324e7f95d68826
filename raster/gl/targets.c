#include "targets.h"

#include "interface.h"
#include "parallel.h"

#include <math.h>
#include <stdlib.h>

enum { TARGET_COUNT = 4 };
enum { NO_PLANE = TL_PLANE_COUNT };

/* All targets are 32-bit floats: the planes are. */
static const struct target {
    GLenum storage, format;
    int channel_count;
    int planes[4];  /* of enum tl_plane, channel by channel */
    float empty[4]; /* the planes' values where nothing was hit */
} targets[TARGET_COUNT] = {
    [TARGET_NORMAL_DEPTH] = {GL_RGBA32F,
                             GL_RGBA,
                             4,
                             {TL_NORMAL_X, TL_NORMAL_Y, TL_NORMAL_Z, TL_DEPTH},
                             {0.0f, 0.0f, 0.0f, INFINITY}},
    [TARGET_ALBEDO_METALLIC] = {GL_RGBA32F,
                                GL_RGBA,
                                4,
                                {TL_ALBEDO_R, TL_ALBEDO_G, TL_ALBEDO_B, TL_METALLIC},
                                {0.0f, 0.0f, 0.0f, 0.0f}},
    [TARGET_ROUGHNESS_OCCLUSION] = {GL_RG32F,
                                    GL_RG,
                                    2,
                                    {TL_ROUGHNESS, TL_OCCLUSION, NO_PLANE, NO_PLANE},
                                    {0.0f, 1.0f, 0.0f, 0.0f}},
    [TARGET_EMISSIVE] = {GL_RGBA32F,
                         GL_RGBA,
                         4,
                         {TL_EMISSIVE_R, TL_EMISSIVE_G, TL_EMISSIVE_B, NO_PLANE},
                         {0.0f, 0.0f, 0.0f, 0.0f}},
};

/* Pixels read back at a time: small enough to be split into planes while still in the cache, and
 * fresh memory is slow to touch. */
static const uint32_t chunk_pixels = 1u << 18;

/* Pixels per band: 60 bytes each, 1 GB in all, so that a picture of 4096 x 4096 is one band. */
static const uint32_t band_pixels = 1u << 24;

static int is_wanted(int target, uint32_t present)
{
    return (present & TL_HAS(targets[target].planes[0])) != 0;
}

static GLuint make_buffer(const tl_gl *gl, GLenum storage, const tl_targets *made)
{
    GLuint buffer = 0;
    gl->CreateRenderbuffers(1, &buffer);
    gl->NamedRenderbufferStorage(buffer, storage, (GLsizei)made->width, (GLsizei)made->rows);
    return buffer;
}

tl_status tl_targets_create(const tl_gl *gl,
                            const tl_gbuffer *gbuffer,
                            tl_targets *out,
                            tl_error *err)
{
    const tl_camera *const camera = &gbuffer->camera;
    const uint32_t fitting = band_pixels / camera->width;
    tl_targets made = {.width = camera->width,
                       .rows = camera->height < fitting ? camera->height : fitting,
                       .present = gbuffer->present};
    GLenum draws[TARGET_COUNT];

    gl->CreateFramebuffers(1, &made.framebuffer);
    for (int i = 0; i < TARGET_COUNT; i++) {
        draws[i] = is_wanted(i, made.present) ? GL_COLOR_ATTACHMENT0 + (GLenum)i : GL_NONE;
        if (draws[i] != GL_NONE)
            gl->NamedFramebufferRenderbuffer(made.framebuffer, draws[i], GL_RENDERBUFFER,
                                             make_buffer(gl, targets[i].storage, &made));
    }
    gl->NamedFramebufferRenderbuffer(made.framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                     make_buffer(gl, GL_DEPTH_COMPONENT32F, &made));
    gl->NamedFramebufferDrawBuffers(made.framebuffer, TARGET_COUNT, draws);
    const tl_status status = tl_gl_check(gl, "making the geometry pass's targets", err);
    if (status != TL_OK)
        return status;
    if (gl->CheckNamedFramebufferStatus(made.framebuffer, GL_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE)
        return tl_fail(err, TL_ERR_DEVICE, "OpenGL cannot render to float targets of %u x %u",
                       made.width, made.rows);
    made.chunk_rows = chunk_pixels / made.width; /* at least 16 */
    made.scratch = malloc((size_t)made.width * made.chunk_rows * 4 * sizeof(float));
    if (!made.scratch)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for reading back %u x %u pixels",
                       made.width, made.chunk_rows);
    *out = made;
    return TL_OK;
}

void tl_targets_clear(tl_targets *given)
{
    free(given->scratch);
    *given = (tl_targets){0};
}

void tl_targets_wipe(const tl_gl *gl, const tl_targets *given)
{
    static const GLfloat far_end = 0.0f;
    for (int i = 0; i < TARGET_COUNT; i++)
        if (is_wanted(i, given->present))
            gl->ClearNamedFramebufferfv(given->framebuffer, GL_COLOR, i, targets[i].empty);
    gl->ClearNamedFramebufferfv(given->framebuffer, GL_DEPTH, 0, &far_end);
}

/* Rows of one target, from pixels side by side to planes. */
typedef struct split {
    const struct target *target;
    const float *from; /* [rows][width][channel_count] */
    float *to[4];      /* [rows][pitch]; NULL: not wanted */
    size_t width, pitch;
} split;

static void split_rows(void *context, size_t begin, size_t end)
{
    const split *const work = context;
    const size_t channels = (size_t)work->target->channel_count;
    for (size_t y = begin; y < end; y++)
        for (size_t c = 0; c < channels; c++) {
            const float *const from = work->from + y * work->width * channels + c;
            float *const to = work->to[c] ? work->to[c] + y * work->pitch : NULL;
            for (size_t x = 0; to && x < work->width; x++)
                to[x] = from[x * channels];
        }
}

/* Rows [from, from + rows) of one target to rows from `to` on of its planes. */
static void read_chunk(const tl_gl *gl,
                       const tl_targets *given,
                       tl_gbuffer *gbuffer,
                       int target,
                       uint32_t from,
                       uint32_t to,
                       uint32_t rows)
{
    split work = {&targets[target], given->scratch, {NULL}, given->width, gbuffer->pitch};
    for (int c = 0; c < targets[target].channel_count; c++) {
        const int plane = targets[target].planes[c];
        float *const found =
            plane == NO_PLANE ? NULL : tl_gbuffer_plane(gbuffer, (enum tl_plane)plane);
        work.to[c] = found ? found + (size_t)to * gbuffer->pitch : NULL;
    }
    gl->ReadPixels(0, (GLint)from, (GLsizei)given->width, (GLsizei)rows, targets[target].format,
                   GL_FLOAT, given->scratch);
    tl_parallel(rows, 16, split_rows, &work);
}

void tl_targets_read(const tl_gl *gl,
                     const tl_targets *given,
                     tl_gbuffer *gbuffer,
                     uint32_t first,
                     uint32_t rows)
{
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, given->framebuffer);
    for (int i = 0; i < TARGET_COUNT; i++) {
        if (!is_wanted(i, given->present))
            continue;
        gl->NamedFramebufferReadBuffer(given->framebuffer, GL_COLOR_ATTACHMENT0 + (GLenum)i);
        for (uint32_t y = 0; y < rows; y += given->chunk_rows) {
            const uint32_t left = rows - y;
            read_chunk(gl, given, gbuffer, i, y, first + y,
                       left < given->chunk_rows ? left : given->chunk_rows);
        }
    }
}
