#define _POSIX_C_SOURCE 200809L
#include "exr_writer.h"

#include "parallel.h"
#include "try.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Bytes of the widest number in a channel; computed ones have rows of that. */
enum { WIDEST = 4 };

/* zlib's; half the time of its default for 1 % more bytes. */
enum { ZIP_LEVEL = 4 };

/* What the encoding threads share. Chunks are taken in order and written in order, so the thread
 * with the lowest chunk never waits. */
typedef struct encoding {
    tl_exr_writer *writer;
    const tl_exr_picture *picture;
    int part;
    int lines;             /* per chunk */
    int first_line;        /* of the data window */
    int chunk_count;       /* in the file */
    size_t computed_count; /* of the picture's channels */
    atomic_int next;       /* chunk to encode */
    pthread_mutex_t lock;
    pthread_cond_t turned;
    int turn;            /* chunk to write */
    exr_result_t result; /* the first failure; stops all threads */
} encoding;

/* What one thread has. */
typedef struct encoder {
    encoding *shared;
    exr_encode_pipeline_t pipeline;
    bool is_ready; /* the pipeline has its routines */
    int chunk;
    unsigned char
        *computed; /* [computed][lines][width][WIDEST]; NULL where nothing is computed */
    void **rows;   /* [computed]: one of each channel's lines there; NULL likewise */
} encoder;

tl_status tl_exr_writer_open(tl_exr_writer *writer, const char *path, tl_error *err)
{
    tl_status status = TL_OK;
    *writer = (tl_exr_writer){.stream.context = NULL};
    TRY(tl_atomic_file_begin(&writer->file, path, err));
    TRY(tl_exr_stream_write(&writer->stream, path, writer->file.descriptor, ZIP_LEVEL, err));
done:
    if (status != TL_OK)
        tl_exr_writer_abandon(writer);
    return status;
}

/* OpenEXR's files have one display window for all their parts. */
static exr_result_t share_display(exr_context_t context, int part)
{
    exr_attr_box2i_t display;
    const exr_result_t result = exr_get_display_window(context, 0, &display);
    return result == EXR_ERR_SUCCESS ? exr_set_display_window(context, part, &display) : result;
}

tl_status tl_exr_writer_add(tl_exr_writer *writer,
                            const char *name,
                            uint32_t width,
                            uint32_t height,
                            exr_compression_t compression,
                            tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = &writer->stream;
    int part;
    TRY(tl_exr_check(stream, exr_add_part(stream->context, name, EXR_STORAGE_SCANLINE, &part),
                     err));
    TRY(tl_exr_check(stream,
                     exr_initialize_required_attr_simple(stream->context, part, (int32_t)width,
                                                         (int32_t)height, compression),
                     err));
    if (part > 0)
        TRY(tl_exr_check(stream, share_display(stream->context, part), err));
done:
    if (status != TL_OK)
        tl_exr_writer_abandon(writer);
    return status;
}

tl_status tl_exr_writer_begin(tl_exr_writer *writer,
                              const char *path,
                              uint32_t width,
                              uint32_t height,
                              exr_compression_t compression,
                              tl_error *err)
{
    const tl_status status = tl_exr_writer_open(writer, path, err);
    if (status != TL_OK)
        return status;
    return tl_exr_writer_add(writer, NULL, width, height, compression, err);
}

tl_status tl_exr_writer_window(tl_exr_writer *writer,
                               uint32_t x,
                               uint32_t y,
                               uint32_t whole_width,
                               uint32_t whole_height,
                               tl_error *err)
{
    const exr_context_t context = writer->stream.context;
    exr_attr_box2i_t data, display;
    exr_result_t result = exr_get_data_window(context, 0, &data);
    display = data;
    display.max.x = (int32_t)whole_width - 1;
    display.max.y = (int32_t)whole_height - 1;
    data.min.x += (int32_t)x;
    data.max.x += (int32_t)x;
    data.min.y += (int32_t)y;
    data.max.y += (int32_t)y;
    if (result == EXR_ERR_SUCCESS)
        result = exr_set_data_window(context, 0, &data);
    if (result == EXR_ERR_SUCCESS)
        result = exr_set_display_window(context, 0, &display);
    return tl_exr_check(&writer->stream, result, err);
}

static exr_result_t wait_for_turn(exr_encode_pipeline_t *pipeline)
{
    const encoder *own = pipeline->encoding_user_data;
    encoding *shared = own->shared;
    pthread_mutex_lock(&shared->lock);
    while (shared->turn != own->chunk && shared->result == EXR_ERR_SUCCESS)
        pthread_cond_wait(&shared->turned, &shared->lock);
    const exr_result_t result = shared->result;
    pthread_mutex_unlock(&shared->lock);
    return result;
}

/* Passes the turn on, or stops everyone. */
static void end_turn(encoding *shared, exr_result_t result)
{
    pthread_mutex_lock(&shared->lock);
    if (result == EXR_ERR_SUCCESS)
        shared->turn++;
    else if (shared->result == EXR_ERR_SUCCESS)
        shared->result = result;
    pthread_cond_broadcast(&shared->turned);
    pthread_mutex_unlock(&shared->lock);
}

/* Computes the rows of the chunk that have no plane. */
static void compute_rows(encoder *own, uint32_t first_row)
{
    const tl_exr_picture *picture = own->shared->picture;
    const size_t lines = (size_t)own->shared->lines;
    if (!picture->compute)
        return;
    for (uint32_t y = first_row; y < first_row + lines && y < picture->height; y++) {
        for (size_t i = 0; i < own->shared->computed_count; i++)
            own->rows[i] =
                own->computed + (i * lines + y - first_row) * picture->width * WIDEST;
        picture->compute(picture->context, y, own->rows);
    }
}

/* Points every channel of the pipeline, which has its own order, at its first row. */
static exr_result_t set_sources(encoder *own, uint32_t first_row)
{
    const tl_exr_picture *picture = own->shared->picture;
    const size_t lines = (size_t)own->shared->lines;
    for (int c = 0; c < own->pipeline.channel_count; c++) {
        exr_coding_channel_info_t *channel = &own->pipeline.channels[c];
        size_t i = 0, computed_count = 0;
        while (i < picture->channel_count &&
               strcmp(picture->channels[i].name, channel->channel_name) != 0)
            computed_count += picture->channels[i++].plane == NULL;
        if (i == picture->channel_count)
            return EXR_ERR_INVALID_ARGUMENT;
        const exr_pixel_type_t held = picture->channels[i].held;
        const unsigned char *plane = picture->channels[i].plane;
        const size_t bytes = held == EXR_PIXEL_HALF ? 2 : 4;
        const size_t pitch = plane ? picture->pitch * bytes : picture->width * (size_t)WIDEST;
        channel->user_data_type = (uint16_t)held;
        channel->user_bytes_per_element = (int16_t)bytes;
        channel->user_pixel_stride = (int32_t)bytes;
        channel->user_line_stride = (int32_t)pitch;
        channel->encode_from_ptr =
            plane ? plane + first_row * pitch : own->computed + computed_count * lines * pitch;
    }
    return EXR_ERR_SUCCESS;
}

/* Prepares the pipeline for the chunk of own->chunk. */
static exr_result_t prepare(encoder *own, uint32_t first_row)
{
    const exr_context_t context = own->shared->writer->stream.context;
    const int part = own->shared->part;
    exr_chunk_info_t info;
    exr_result_t result = exr_write_scanline_chunk_info(
        context, part, own->shared->first_line + (int)first_row, &info);
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = own->is_ready ? exr_encoding_update(context, part, &info, &own->pipeline)
                           : exr_encoding_initialize(context, part, &info, &own->pipeline);
    if (result == EXR_ERR_SUCCESS)
        result = set_sources(own, first_row);
    if (result != EXR_ERR_SUCCESS || own->is_ready)
        return result;
    own->is_ready = true;
    result = exr_encoding_choose_default_routines(context, part, &own->pipeline);
    own->pipeline.yield_until_ready_fn = wait_for_turn;
    own->pipeline.encoding_user_data = own;
    return result;
}

/* One thread's share: whatever chunks are left. begin and end count threads. */
static void encode_chunks(void *context, size_t begin, size_t end)
{
    encoding *shared = context;
    const exr_context_t file = shared->writer->stream.context;
    const tl_exr_picture *picture = shared->picture;
    encoder own = {.shared = shared};
    exr_result_t result = EXR_ERR_SUCCESS;
    (void)begin;
    (void)end;

    if (picture->compute) {
        own.computed = calloc(shared->computed_count * (size_t)shared->lines,
                              picture->width * (size_t)WIDEST);
        own.rows = calloc(shared->computed_count, sizeof *own.rows);
        if (!own.computed || !own.rows)
            result = EXR_ERR_OUT_OF_MEMORY;
    }
    while (result == EXR_ERR_SUCCESS) {
        own.chunk = atomic_fetch_add(&shared->next, 1);
        if (own.chunk >= shared->chunk_count)
            break;
        const uint32_t first_row = (uint32_t)(own.chunk * shared->lines);
        compute_rows(&own, first_row);
        result = prepare(&own, first_row);
        if (result == EXR_ERR_SUCCESS)
            result = exr_encoding_run(file, shared->part, &own.pipeline);
        if (result == EXR_ERR_SUCCESS)
            end_turn(shared, result);
    }
    if (result != EXR_ERR_SUCCESS)
        end_turn(shared, result);
    exr_encoding_destroy(file, &own.pipeline);
    free(own.rows);
    free(own.computed);
}

/* Names of more than 31 bytes are a flag of the file, which is not set without need. */
static exr_result_t allow_long_names(exr_context_t context, const tl_exr_picture *picture)
{
    enum { SHORT_NAME = 31 };
    for (size_t i = 0; i < picture->channel_count; i++)
        if (strlen(picture->channels[i].name) > SHORT_NAME)
            return exr_set_longname_support(context, 1);
    return EXR_ERR_SUCCESS;
}

static tl_status add_channels(tl_exr_stream *stream,
                              int part,
                              const tl_exr_picture *picture,
                              tl_error *err)
{
    tl_status status = TL_OK;
    TRY(tl_exr_check(stream, allow_long_names(stream->context, picture), err));
    for (size_t i = 0; i < picture->channel_count; i++)
        TRY(tl_exr_check(stream,
                         exr_add_channel(stream->context, part, picture->channels[i].name,
                                         picture->channels[i].type,
                                         EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1),
                         err));
done:
    return status;
}

static tl_status encode(tl_exr_writer *writer,
                        int part,
                        const tl_exr_picture *picture,
                        tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = &writer->stream;
    encoding shared = {.writer = writer, .picture = picture, .part = part};
    exr_attr_box2i_t data;
    for (size_t i = 0; i < picture->channel_count; i++)
        shared.computed_count += picture->channels[i].plane == NULL;
    TRY(tl_exr_check(stream, exr_get_scanlines_per_chunk(stream->context, part, &shared.lines),
                     err));
    TRY(tl_exr_check(stream, exr_get_data_window(stream->context, part, &data), err));
    shared.first_line = data.min.y;
    TRY(tl_exr_check(stream, exr_get_chunk_count(stream->context, part, &shared.chunk_count),
                     err));
    pthread_mutex_init(&shared.lock, NULL);
    pthread_cond_init(&shared.turned, NULL);
    tl_parallel(tl_thread_count(), 1, encode_chunks, &shared);
    pthread_cond_destroy(&shared.turned);
    pthread_mutex_destroy(&shared.lock);
    TRY(tl_exr_check(stream, shared.result, err));
done:
    return status;
}

tl_status tl_exr_writer_parts(tl_exr_writer *writer,
                              const tl_exr_picture *pictures,
                              int count,
                              tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = &writer->stream;
    for (int part = 0; part < count; part++)
        TRY(add_channels(stream, part, &pictures[part], err));
    TRY(tl_exr_check(stream, exr_write_header(stream->context), err));
    for (int part = 0; part < count; part++)
        TRY(encode(writer, part, &pictures[part], err));
done:
    return status;
}

tl_status tl_exr_writer_pixels(tl_exr_writer *writer,
                               const tl_exr_picture *picture,
                               tl_error *err)
{
    return tl_exr_writer_parts(writer, picture, 1, err);
}

tl_status tl_exr_writer_commit(tl_exr_writer *writer, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(tl_exr_stream_close(&writer->stream, err));
    TRY(tl_atomic_file_commit(&writer->file, err));
done:
    return status;
}

void tl_exr_writer_abandon(tl_exr_writer *writer)
{
    tl_exr_stream_close(&writer->stream, NULL);
    tl_atomic_file_abandon(&writer->file);
}
