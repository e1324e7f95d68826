#include "targets.h"

#include "layout.h"
#include "parallel.h"

#include <stdlib.h>
#include <string.h>

/* Of formats: how they are made and how they are read. What is stored of a depth buffer is read with the
 * stencil beside it. */
static const struct {
    GLenum storage, format, type;
    uint32_t texel_size; /* bytes, as read */
} formats[TL_FORMAT_COUNT] = {
    [TL_FORMAT_RGBA32F] = {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16},
    [TL_FORMAT_R32F] = {GL_R32F, GL_RED, GL_FLOAT, 4},
    [TL_FORMAT_RGBA16F] = {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8},
    [TL_FORMAT_RG16F] = {GL_RG16F, GL_RG, GL_HALF_FLOAT, 4},
    [TL_FORMAT_R16F] = {GL_R16F, GL_RED, GL_HALF_FLOAT, 2},
    [TL_FORMAT_RGBA8] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    [TL_FORMAT_RGBA8_SNORM] = {GL_RGBA8_SNORM, GL_RGBA, GL_BYTE, 4},
    [TL_FORMAT_RGB10_A2] = {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4},
    [TL_FORMAT_RG8] = {GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2},
    [TL_FORMAT_R32UI] = {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4},
    [TL_FORMAT_D24] = {GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 4},
    [TL_FORMAT_D32F] = {GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL,
                        GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 8},
};
enum { MOST_TEXEL = 16 };

/* Pixels read back at a time: small enough to be split into planes while still in the cache, and
 * fresh memory is slow to touch. */
static const uint32_t chunk_pixels = 1u << 18;

/* Pixels per band: 84 bytes each at most, 1.4 GB in all, so that a picture of 4096 x 4096 is one band. */
static const uint32_t band_pixels = 1u << 24;

/* --- which there are ------------------------------------------------------------------------------- */

static bool is_depth(enum tl_format format)
{
    return format == TL_FORMAT_D24 || format == TL_FORMAT_D32F;
}

tl_depth_buffer tl_depth_buffer_of(enum tl_layout_name layout)
{
    const tl_layout_info *info = tl_layout_describe(layout);
    bool is_stored = false;
    for (uint32_t i = 0; i < info->target_count; i++)
        is_stored = is_stored || is_depth(info->targets[i].format);
    return (tl_depth_buffer){is_stored,
                             !is_stored || tl_layouts[layout].depth.code == TL_DEPTH_REVERSED};
}

bool tl_target_is_color(enum tl_layout_name layout, uint32_t present, uint32_t index)
{
    const tl_target *target = &tl_layout_describe(layout)->targets[index];
    tl_u32 bytes = 0;
    for (uint32_t i = 0; i < target->word_count; i++)
        bytes += word_bytes(&tl_layouts[layout], present, target->first_word + i);
    return bytes > 0 && !is_depth(target->format);
}

int tl_target_of_ids(enum tl_layout_name layout, uint32_t present)
{
    const uint32_t count = tl_layout_describe(layout)->target_count;
    for (uint32_t i = 0; i < TL_MAX_TARGETS; i++)
        if (i >= count || !tl_target_is_color(layout, present, i))
            return (int)i;
    return -1;
}

/* --- making them ------------------------------------------------------------------------------------ */

static GLuint make_color(const tl_gl *gl,
                         const tl_targets *made,
                         uint32_t index,
                         enum tl_format format)
{
    GLuint texture = 0;
    gl->CreateTextures(GL_TEXTURE_2D, 1, &texture);
    gl->TextureStorage2D(texture, 1, formats[format].storage, (GLsizei)made->width,
                         (GLsizei)made->rows);
    gl->NamedFramebufferTexture(made->framebuffer, GL_COLOR_ATTACHMENT0 + index, texture, 0);
    return texture;
}

static void make_depth(const tl_gl *gl, const tl_targets *made, GLenum storage, GLenum where)
{
    GLuint buffer = 0;
    gl->CreateRenderbuffers(1, &buffer);
    gl->NamedRenderbufferStorage(buffer, storage, (GLsizei)made->width, (GLsizei)made->rows);
    gl->NamedFramebufferRenderbuffer(made->framebuffer, where, GL_RENDERBUFFER, buffer);
}

/* A texel is its words, one behind the other. */
static void find_sky(const tl_gbuffer *gbuffer, const tl_target *target, unsigned char *texel)
{
    for (uint32_t i = 0; i < target->word_count; i++) {
        const uint32_t word = target->first_word + i;
        const uint32_t size = tl_layouts[gbuffer->layout].words[word].bytes;
        const void *from = tl_gbuffer_words(gbuffer, word);
        if (from)
            memcpy(texel, from, size);
        texel += size;
    }
}

static void make_targets(const tl_gl *gl, const tl_gbuffer *gbuffer, tl_targets *made)
{
    const tl_layout_info *info = tl_layout_describe(gbuffer->layout);
    GLenum draws[TL_MAX_TARGETS] = {GL_NONE};
    GLsizei draw_count = (GLsizei)info->target_count;
    gl->CreateFramebuffers(1, &made->framebuffer);
    for (uint32_t i = 0; i < info->target_count; i++) {
        const tl_target *target = &info->targets[i];
        draws[i] = GL_NONE;
        if (tl_target_is_color(gbuffer->layout, gbuffer->present, i)) {
            draws[i] = GL_COLOR_ATTACHMENT0 + i;
            made->colors[i] = make_color(gl, made, i, target->format);
            find_sky(gbuffer, target, made->sky[i]);
        } else if (is_depth(target->format)) {
            make_depth(gl, made, formats[target->format].storage, GL_DEPTH_STENCIL_ATTACHMENT);
        }
    }
    if (!tl_depth_buffer_of(gbuffer->layout).is_stored)
        make_depth(gl, made, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
    if (made->id_target >= 0) {
        const uint32_t at = (uint32_t)made->id_target;
        draws[at] = GL_COLOR_ATTACHMENT0 + at;
        made->ids = make_color(gl, made, at, TL_FORMAT_R32UI);
        draw_count = draw_count > made->id_target ? draw_count : made->id_target + 1;
    }
    gl->NamedFramebufferDrawBuffers(made->framebuffer, draw_count, draws);
}

tl_status tl_targets_create(const tl_gl *gl,
                            const tl_gbuffer *gbuffer,
                            tl_targets *out,
                            tl_error *err)
{
    const tl_camera *const camera = &gbuffer->camera;
    const uint32_t fitting = band_pixels / camera->width;
    tl_targets made = {
        .id_target = gbuffer->ids ? tl_target_of_ids(gbuffer->layout, gbuffer->present) : -1,
        .width = camera->width,
        .rows = camera->height < fitting ? camera->height : fitting};
    make_targets(gl, gbuffer, &made);
    const tl_status status = tl_gl_check(gl, "making the geometry pass's targets", err);
    if (status != TL_OK)
        return status;
    if (gl->CheckNamedFramebufferStatus(made.framebuffer, GL_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE)
        return tl_fail(err, TL_ERR_DEVICE,
                       "OpenGL cannot render to the targets of layout %s of %u x %u",
                       tl_layout_word(gbuffer->layout), made.width, made.rows);
    made.chunk_rows = chunk_pixels / made.width; /* at least 16 */
    made.scratch = malloc((size_t)made.width * made.chunk_rows * MOST_TEXEL);
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

void tl_targets_wipe(const tl_gl *gl, const tl_targets *given, enum tl_layout_name layout)
{
    const tl_layout_info *info = tl_layout_describe(layout);
    const tl_depth_buffer depth = tl_depth_buffer_of(layout);
    const GLfloat far_end = depth.is_reversed ? 0.0f : 1.0f;
    for (uint32_t i = 0; i < info->target_count; i++)
        if (given->colors[i])
            gl->ClearTexImage(given->colors[i], 0, formats[info->targets[i].format].format,
                              formats[info->targets[i].format].type, given->sky[i]);
    if (given->ids)
        gl->ClearTexImage(given->ids, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &(GLuint){0});
    if (depth.is_stored)
        gl->ClearNamedFramebufferfi(given->framebuffer, GL_DEPTH_STENCIL, 0, far_end, 0);
    else
        gl->ClearNamedFramebufferfv(given->framebuffer, GL_DEPTH, 0, &far_end);
}

/* --- reading them ----------------------------------------------------------------------------------- */

/* Rows of one target, from texels to the planes of their words. */
typedef struct split {
    unsigned char *from; /* [rows][width][texel_size] */
    size_t width, pitch, texel_size;
    uint32_t word_count;
    unsigned char *to[TL_MAX_WORDS]; /* [rows][pitch]; NULL: not stored */
    size_t sizes[TL_MAX_WORDS];      /* bytes of each word */
    bool is_reversed;
} split;

/* Inlined for each size, so that a copy is a load and a store. */
static inline void copy_words(
    unsigned char *to, const unsigned char *from, size_t size, size_t step, size_t count)
{
    for (size_t i = 0; i < count; i++)
        memcpy(to + i * size, from + i * step, size);
}

static void split_words(const split *work, size_t row)
{
    const unsigned char *from = work->from + row * work->width * work->texel_size;
    for (uint32_t i = 0; i < work->word_count; from += work->sizes[i++]) {
        if (!work->to[i])
            continue;
        unsigned char *const to = work->to[i] + row * work->pitch * work->sizes[i];
        if (work->sizes[i] == 4)
            copy_words(to, from, 4, work->texel_size, work->width);
        else if (work->sizes[i] == 2)
            copy_words(to, from, 2, work->texel_size, work->width);
        else
            copy_words(to, from, 1, work->texel_size, work->width);
    }
}

/* A surface so near to the far plane that its depth is that of the sky gets the last number before it:
 * kernels/encode.h. */
static void split_depth24(const split *work, size_t row)
{
    const uint32_t *const from = (const void *)(work->from + row * work->width * 4);
    uint32_t *const to = (void *)(work->to[0] + row * work->pitch * 4);
    for (size_t x = 0; x < work->width; x++) {
        const uint32_t code = from[x] >> 8, is_surface = from[x] & 0xff;
        to[x] = is_surface && code == 0xffffff ? 0xfffffe : code;
    }
}

static void split_depth_float(const split *work, size_t row)
{
    const struct {
        float depth;
        uint32_t stencil;
    } *const from = (const void *)(work->from + row * work->width * 8);
    float *const to = (void *)(work->to[0] + row * work->pitch * 4);
    const float sky = work->is_reversed ? 0.0f : 1.0f;
    const float last = work->is_reversed ? 0x1p-126f : 1.0f - 0x1p-24f;
    for (size_t x = 0; x < work->width; x++)
        to[x] = (from[x].stencil & 0xff) && from[x].depth == sky ? last : from[x].depth;
}

/* What a target is read with: NULL is split_words. */
static void (*const splits[TL_FORMAT_COUNT])(const split *, size_t row) = {
    [TL_FORMAT_D24] = split_depth24,
    [TL_FORMAT_D32F] = split_depth_float,
};

typedef struct split_job {
    split work;
    void (*split)(const split *, size_t row);
} split_job;

static void split_rows(void *context, size_t begin, size_t end)
{
    const split_job *const job = context;
    for (size_t row = begin; row < end; row++)
        job->split(&job->work, row);
}

/* Rows [from, from + rows) of one target to rows from `to` on of its words. */
static void read_chunk(const tl_gl *gl,
                       const tl_targets *given,
                       const tl_gbuffer *gbuffer,
                       const tl_target *target,
                       uint32_t from,
                       uint32_t to,
                       uint32_t rows)
{
    const size_t texel_size = formats[target->format].texel_size;
    split_job job = {
        .work = {.from = given->scratch,
                 .width = given->width,
                 .pitch = gbuffer->pitch,
                 .texel_size = texel_size,
                 .word_count = target->word_count,
                 .is_reversed = tl_depth_buffer_of(gbuffer->layout).is_reversed},
        .split = splits[target->format] ? splits[target->format] : split_words,
    };
    for (uint32_t i = 0; i < target->word_count; i++) {
        const uint32_t word = target->first_word + i;
        unsigned char *const found = tl_gbuffer_words(gbuffer, word);
        job.work.sizes[i] = tl_layouts[gbuffer->layout].words[word].bytes;
        job.work.to[i] = found ? found + (size_t)to * gbuffer->pitch * job.work.sizes[i] : NULL;
    }
    gl->ReadPixels(0, (GLint)from, (GLsizei)given->width, (GLsizei)rows,
                   formats[target->format].format, formats[target->format].type,
                   given->scratch);
    tl_parallel(rows, 16, split_rows, &job);
}

/* Rows of objects' ids. */
static void read_ids(const tl_gl *gl,
                     const tl_targets *given,
                     tl_gbuffer *gbuffer,
                     uint32_t first,
                     uint32_t rows)
{
    gl->NamedFramebufferReadBuffer(given->framebuffer,
                                   GL_COLOR_ATTACHMENT0 + (GLenum)given->id_target);
    for (uint32_t y = 0; y < rows; y++)
        gl->ReadPixels(0, (GLint)y, (GLsizei)given->width, 1, GL_RED_INTEGER, GL_UNSIGNED_INT,
                       gbuffer->ids + (size_t)(first + y) * gbuffer->pitch);
}

void tl_targets_read(const tl_gl *gl,
                     const tl_targets *given,
                     tl_gbuffer *gbuffer,
                     uint32_t first,
                     uint32_t rows)
{
    const tl_layout_info *info = tl_layout_describe(gbuffer->layout);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, given->framebuffer);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl->ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE); /* signed numbers keep their sign */
    for (uint32_t i = 0; i < info->target_count; i++) {
        if (!given->colors[i] && !is_depth(info->targets[i].format))
            continue;
        if (given->colors[i])
            gl->NamedFramebufferReadBuffer(given->framebuffer, GL_COLOR_ATTACHMENT0 + i);
        for (uint32_t y = 0; y < rows; y += given->chunk_rows) {
            const uint32_t left = rows - y;
            read_chunk(gl, given, gbuffer, &info->targets[i], y, first + y,
                       left < given->chunk_rows ? left : given->chunk_rows);
        }
    }
    if (given->ids)
        read_ids(gl, given, gbuffer, first, rows);
}
