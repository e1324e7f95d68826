#define _POSIX_C_SOURCE 200809L
#include "exr_reader.h"

#include "parallel.h"
#include "size_limit.h"
#include "tilelight/camera.h"
#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* More than any renderer's list of outputs; the decoder's memory grows with it. */
enum { MAX_CHANNELS = 1024 };

/* What the decoding threads share. */
typedef struct decoding {
    tl_exr_reader *reader;
    const tl_exr_target *targets;
    size_t target_count, pitch;
    _Atomic exr_result_t result; /* a failure; stops all threads */
} decoding;

static tl_status check_storage(tl_exr_reader *reader, tl_error *err)
{
    static const char *const kinds[] = {
        [EXR_STORAGE_TILED] = "tiles",
        [EXR_STORAGE_DEEP_SCANLINE] = "deep scanlines",
        [EXR_STORAGE_DEEP_TILED] = "deep tiles",
    };
    tl_status status = TL_OK;
    exr_storage_t storage;
    tl_exr_stream *stream = &reader->stream;
    TRY(tl_exr_check(stream, exr_get_storage(stream->context, 0, &storage), err));
    if (storage != EXR_STORAGE_SCANLINE)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: its first part is stored as %s; save it as plain scanlines",
                    stream->path, kinds[storage]));
done:
    return status;
}

static tl_status check_windows(tl_exr_reader *reader, tl_error *err)
{
    tl_status status = TL_OK;
    exr_attr_box2i_t data, display;
    tl_exr_stream *stream = &reader->stream;
    TRY(tl_exr_check(stream, exr_get_data_window(stream->context, 0, &data), err));
    TRY(tl_exr_check(stream, exr_get_display_window(stream->context, 0, &display), err));
    const int64_t width = (int64_t)data.max.x - data.min.x + 1;
    const int64_t height = (int64_t)data.max.y - data.min.y + 1;
    if (width < 1 || width > TL_MAX_EXTENT || height < 1 || height > TL_MAX_EXTENT)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: is %" PRId64 " x %" PRId64 " pixels; 1 to %d per side are read",
                    stream->path, width, height, TL_MAX_EXTENT));
    if (memcmp(&data, &display, sizeof data) != 0 || data.min.x != 0 || data.min.y != 0)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: its data window (%d, %d) to (%d, %d) is not the whole display window "
                    "(%d, %d) to (%d, %d) from (0, 0) on; save it uncropped",
                    stream->path, data.min.x, data.min.y, data.max.x, data.max.y, display.min.x,
                    display.min.y, display.max.x, display.max.y));
    reader->width = (uint32_t)width;
    reader->height = (uint32_t)height;
done:
    return status;
}

static tl_status check_channels(tl_exr_reader *reader, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = &reader->stream;
    TRY(tl_exr_check(stream, exr_get_channels(stream->context, 0, &reader->channels), err));
    const int count = reader->channels->num_channels;
    if (count < 1 || count > MAX_CHANNELS)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: has %d channels; 1 to %d are read", stream->path,
                    count, MAX_CHANNELS));
    reader->pixel_size = 0;
    for (int i = 0; i < count; i++) {
        const exr_attr_chlist_entry_t *channel = &reader->channels->entries[i];
        if (channel->x_sampling != 1 || channel->y_sampling != 1)
            TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                        "%s: channel \"%s\" has a value for every %d x %d pixels only; save it "
                        "at full resolution",
                        stream->path, channel->name.str, channel->x_sampling,
                        channel->y_sampling));
        reader->pixel_size += channel->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
done:
    return status;
}

/* The header promises a table of chunks and, uncompressed, every byte of the pixels. */
static tl_status check_length(tl_exr_reader *reader, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = &reader->stream;
    exr_compression_t compression;
    int chunk_count;
    TRY(tl_exr_check(stream, exr_get_compression(stream->context, 0, &compression), err));
    if (compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: DWA compression cannot be read; save it with zip or none",
                    stream->path));
    TRY(tl_exr_check(stream, exr_get_scanlines_per_chunk(stream->context, 0, &reader->lines),
                     err));
    TRY(tl_exr_check(stream, exr_get_chunk_count(stream->context, 0, &chunk_count), err));
    if (reader->lines < 1 || chunk_count < 0 ||
        (uint32_t)chunk_count !=
            (reader->height + (uint32_t)reader->lines - 1) / (uint32_t)reader->lines)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: is damaged: %d chunks for %u rows", stream->path,
                    chunk_count, reader->height));
    const uint64_t table = 16 * (uint64_t)chunk_count; /* an offset, then row and size */
    const uint64_t pixels = compression == EXR_COMPRESSION_NONE
                                ? reader->pixel_size * reader->width * reader->height
                                : 0;
    if (reader->file_size < table + pixels)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: is cut short: %" PRIu64 " bytes, where its header promises %" PRIu64
                    " at least",
                    stream->path, reader->file_size, table + pixels));
done:
    return status;
}

static tl_status open_file(tl_exr_reader *reader, const char *path, tl_error *err)
{
    struct stat seen;
    const int opened = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (opened < 0)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, strerror(errno));
    if (fstat(opened, &seen) != 0 || !S_ISREG(seen.st_mode)) {
        close(opened);
        return tl_fail(err, TL_ERR_READ, "%s: cannot be read: it is no regular file", path);
    }
    reader->stream.descriptor = opened;
    reader->file_size = (uint64_t)seen.st_size;
    reader->is_open = true;
    return TL_OK;
}

tl_status tl_exr_reader_open(tl_exr_reader *reader, const char *path, tl_error *err)
{
    tl_status status = TL_OK;
    *reader = (tl_exr_reader){.is_open = false};
    TRY(open_file(reader, path, err));
    TRY(tl_exr_stream_read(&reader->stream, path, reader->stream.descriptor, err));
    TRY(check_storage(reader, err));
    TRY(check_windows(reader, err));
    TRY(check_channels(reader, err));
    TRY(check_length(reader, err));
done:
    if (status != TL_OK)
        tl_exr_reader_close(reader);
    return status;
}

void tl_exr_reader_close(tl_exr_reader *reader)
{
    if (!reader->is_open)
        return;
    const int descriptor = reader->stream.descriptor;
    tl_exr_stream_close(&reader->stream, NULL);
    close(descriptor);
    reader->is_open = false;
}

static const exr_attr_chlist_entry_t *find_channel(const tl_exr_reader *reader,
                                                   const char *name)
{
    for (int i = 0; i < reader->channels->num_channels; i++)
        if (strcmp(reader->channels->entries[i].name.str, name) == 0)
            return &reader->channels->entries[i];
    return NULL;
}

bool tl_exr_reader_has_channel(const tl_exr_reader *reader, const char *name)
{
    return find_channel(reader, name) != NULL;
}

tl_status tl_exr_reader_require(const tl_exr_reader *reader, const char *channel, tl_error *err)
{
    const exr_attr_chlist_entry_t *found = find_channel(reader, channel);
    if (!found)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has no channel \"%s\"", reader->stream.path,
                       channel);
    if (found->pixel_type != EXR_PIXEL_HALF && found->pixel_type != EXR_PIXEL_FLOAT)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: channel \"%s\" holds whole numbers; it must be half or float",
                       reader->stream.path, channel);
    return TL_OK;
}

tl_status tl_exr_reader_require_type(const tl_exr_reader *reader,
                                     const char *channel,
                                     exr_pixel_type_t type,
                                     tl_error *err)
{
    static const char *const types[] = {
        [EXR_PIXEL_UINT] = "uint", [EXR_PIXEL_HALF] = "half", [EXR_PIXEL_FLOAT] = "float"};
    const exr_attr_chlist_entry_t *found = find_channel(reader, channel);
    if (!found)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has no channel \"%s\"", reader->stream.path,
                       channel);
    if (found->pixel_type != type)
        return tl_fail(
            err, TL_ERR_FORMAT,
            "%s: channel \"%s\" is %s; its bits are a word of the layout, so it must "
            "be %s",
            reader->stream.path, channel, types[found->pixel_type], types[type]);
    return TL_OK;
}

bool tl_exr_reader_has_attribute(const tl_exr_reader *reader, const char *name)
{
    const exr_context_t context = reader->stream.context;
    const exr_attribute_t *attribute;
    int count = 0;
    if (exr_get_attribute_count(context, 0, &count) != EXR_ERR_SUCCESS)
        return false;
    /* By index: asking by name for one that is absent counts as an error of the stream. */
    for (int i = 0; i < count; i++)
        if (exr_get_attribute_by_index(context, 0, EXR_ATTR_LIST_FILE_ORDER, i, &attribute) ==
                EXR_ERR_SUCCESS &&
            strcmp(attribute->name, name) == 0)
            return true;
    return false;
}

tl_status tl_exr_reader_check_size(const tl_exr_reader *reader, uint64_t size, tl_error *err)
{
    return tl_check_decoded_size(reader->stream.path, reader->file_size, size, err);
}

/* Points the channels of the pipeline, which has its own order, at their first rows. */
static void set_destinations(const decoding *shared,
                             exr_decode_pipeline_t *pipeline,
                             size_t first_row)
{
    for (int c = 0; c < pipeline->channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[c];
        channel->decode_to_ptr = NULL; /* skipped */
        for (size_t i = 0; i < shared->target_count; i++) {
            if (strcmp(shared->targets[i].channel, channel->channel_name) != 0)
                continue;
            const exr_pixel_type_t held = shared->targets[i].held;
            const size_t bytes = held == EXR_PIXEL_HALF ? 2 : 4;
            channel->user_data_type = (uint16_t)held;
            channel->user_bytes_per_element = (int16_t)bytes;
            channel->user_pixel_stride = (int32_t)bytes;
            channel->user_line_stride = (int32_t)(shared->pitch * bytes);
            channel->decode_to_ptr =
                (uint8_t *)shared->targets[i].plane + first_row * shared->pitch * bytes;
        }
    }
}

/* The library trusts these; a damaged file must not. */
static bool is_plausible(const tl_exr_reader *reader,
                         const exr_chunk_info_t *info,
                         size_t first_row)
{
    const uint64_t unpacked =
        (uint64_t)info->width * (uint64_t)info->height * reader->pixel_size;
    return info->width == (int32_t)reader->width && info->height >= 1 &&
           info->height <= reader->lines &&
           first_row + (size_t)info->height <= reader->height &&
           info->unpacked_size == unpacked && info->packed_size <= unpacked &&
           info->data_offset <= reader->file_size &&
           info->packed_size <= reader->file_size - info->data_offset;
}

/* The pipeline is initialised by the range's first chunk. */
static exr_result_t decode_chunk(const decoding *shared,
                                 exr_decode_pipeline_t *pipeline,
                                 bool is_first,
                                 size_t first_row)
{
    const exr_context_t context = shared->reader->stream.context;
    exr_chunk_info_t info;
    exr_result_t result = exr_read_scanline_chunk_info(context, 0, (int)first_row, &info);
    if (result == EXR_ERR_SUCCESS && !is_plausible(shared->reader, &info, first_row))
        result = EXR_ERR_CORRUPT_CHUNK;
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = is_first ? exr_decoding_initialize(context, 0, &info, pipeline)
                      : exr_decoding_update(context, 0, &info, pipeline);
    if (result != EXR_ERR_SUCCESS)
        return result;
    set_destinations(shared, pipeline, first_row);
    if (is_first)
        result = exr_decoding_choose_default_routines(context, 0, pipeline);
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(context, 0, pipeline) : result;
}

static void decode_chunks(void *context, size_t begin, size_t end)
{
    decoding *shared = context;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    for (size_t chunk = begin; chunk < end; chunk++) {
        if (atomic_load(&shared->result) != EXR_ERR_SUCCESS)
            break;
        const exr_result_t result = decode_chunk(shared, &pipeline, chunk == begin,
                                                 chunk * (size_t)shared->reader->lines);
        if (result != EXR_ERR_SUCCESS)
            atomic_store(&shared->result, result);
    }
    exr_decoding_destroy(shared->reader->stream.context, &pipeline);
}

tl_status tl_exr_reader_pixels(tl_exr_reader *reader,
                               const tl_exr_target *targets,
                               size_t target_count,
                               size_t pitch,
                               tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = &reader->stream;
    decoding shared = {
        .reader = reader, .targets = targets, .target_count = target_count, .pitch = pitch};
    exr_chunk_info_t first;
    int chunk_count;
    TRY(tl_exr_check(stream, exr_get_chunk_count(stream->context, 0, &chunk_count), err));
    /* Before the threads start: the first call reads the table of chunks. */
    TRY(tl_exr_check(stream, exr_read_scanline_chunk_info(stream->context, 0, 0, &first), err));
    tl_parallel((size_t)chunk_count, 1, decode_chunks, &shared);
    TRY(tl_exr_check(stream, shared.result, err));
done:
    return status;
}
