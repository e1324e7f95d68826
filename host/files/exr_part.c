#include "exr_part.h"

#include "parallel.h"
#include "tilelight/camera.h"
#include "try.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

/* More than any renderer's list of outputs; the decoder's memory grows with it. */
enum { MAX_CHANNELS = 1024 };

const char *const tl_exr_type_words[EXR_PIXEL_LAST_TYPE] = {
    [EXR_PIXEL_UINT] = "uint",
    [EXR_PIXEL_HALF] = "half",
    [EXR_PIXEL_FLOAT] = "float",
};

const char *tl_exr_storage_words(exr_storage_t storage)
{
    static const char *const kinds[] = {
        [EXR_STORAGE_SCANLINE] = "scanlines",
        [EXR_STORAGE_TILED] = "tiles",
        [EXR_STORAGE_DEEP_SCANLINE] = "deep scanlines",
        [EXR_STORAGE_DEEP_TILED] = "deep tiles",
    };
    return kinds[storage];
}

/* Fails with a sentence that begins with the file, and the part where it has a name. */
static TL_PRINTF_LIKE(4, 5) tl_status
    refuse(const tl_exr_part *part, tl_status status, tl_error *err, const char *format, ...)
{
    const char *before = part->name[0] ? " part \"" : "", *behind = part->name[0] ? "\":" : "";
    char reason[512];
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    return tl_fail(err, status, "%s:%s%.64s%s %s", part->stream->path, before, part->name,
                   behind, reason);
}

static tl_status read_storage(tl_exr_part *part, tl_error *err)
{
    tl_status status = TL_OK;
    const exr_context_t context = part->stream->context;
    TRY(tl_exr_check(part->stream, exr_get_storage(context, part->index, &part->storage), err));
    if (part->storage != EXR_STORAGE_SCANLINE && part->storage != EXR_STORAGE_TILED)
        TRY(refuse(part, TL_ERR_UNSUPPORTED, err, "is stored as %s; save it as plain scanlines",
                   tl_exr_storage_words(part->storage)));
done:
    return status;
}

tl_status tl_exr_part_extent(const tl_exr_part *part,
                             const exr_attr_box2i_t *window,
                             uint32_t *width,
                             uint32_t *height,
                             tl_error *err)
{
    const int64_t across = (int64_t)window->max.x - window->min.x + 1;
    const int64_t down = (int64_t)window->max.y - window->min.y + 1;
    if (across < 1 || across > TL_MAX_EXTENT || down < 1 || down > TL_MAX_EXTENT)
        return refuse(part, TL_ERR_FORMAT, err,
                      "its %s window is %" PRId64 " x %" PRId64
                      " pixels; 1 to %d per side are read",
                      window == &part->data ? "data" : "display", across, down, TL_MAX_EXTENT);
    *width = (uint32_t)across;
    *height = (uint32_t)down;
    return TL_OK;
}

static tl_status read_windows(tl_exr_part *part, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = part->stream;
    TRY(tl_exr_check(stream, exr_get_data_window(stream->context, part->index, &part->data),
                     err));
    TRY(tl_exr_check(
        stream, exr_get_display_window(stream->context, part->index, &part->display), err));
    TRY(tl_exr_part_extent(part, &part->data, &part->width, &part->height, err));
done:
    return status;
}

static tl_status read_channels(tl_exr_part *part, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = part->stream;
    TRY(tl_exr_check(stream, exr_get_channels(stream->context, part->index, &part->channels),
                     err));
    const int count = part->channels->num_channels;
    if (count < 1 || count > MAX_CHANNELS)
        TRY(refuse(part, TL_ERR_FORMAT, err, "has %d channels; 1 to %d are read", count,
                   MAX_CHANNELS));
    part->pixel_size = 0;
    for (int i = 0; i < count; i++) {
        const exr_attr_chlist_entry_t *channel = &part->channels->entries[i];
        if (channel->x_sampling != 1 || channel->y_sampling != 1)
            TRY(refuse(part, TL_ERR_UNSUPPORTED, err,
                       "channel \"%s\" has a value for every %d x %d pixels only; save it at "
                       "full resolution",
                       channel->name.str, channel->x_sampling, channel->y_sampling));
        part->pixel_size += channel->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
done:
    return status;
}

static tl_status read_compression(tl_exr_part *part, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = part->stream;
    TRY(tl_exr_check(
        stream, exr_get_compression(stream->context, part->index, &part->compression), err));
    if (part->compression == EXR_COMPRESSION_DWAA || part->compression == EXR_COMPRESSION_DWAB)
        TRY(refuse(part, TL_ERR_UNSUPPORTED, err,
                   "DWA compression cannot be read; save it with zip or none"));
done:
    return status;
}

static tl_status read_chunk_size(tl_exr_part *part, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = part->stream;
    const exr_context_t context = stream->context;
    part->chunk_width = (int)part->width;
    if (part->storage == EXR_STORAGE_TILED)
        TRY(tl_exr_check(stream,
                         exr_get_tile_sizes(context, part->index, 0, 0, &part->chunk_width,
                                            &part->chunk_height),
                         err));
    else
        TRY(tl_exr_check(stream,
                         exr_get_scanlines_per_chunk(context, part->index, &part->chunk_height),
                         err));
done:
    return status;
}

/* The header promises a table of chunks and, uncompressed, every byte of the pixels. */
static tl_status check_length(tl_exr_part *part, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream *stream = part->stream;
    const int is_tiled = part->storage == EXR_STORAGE_TILED;
    int chunk_count;
    TRY(read_chunk_size(part, err));
    TRY(tl_exr_check(stream, exr_get_chunk_count(stream->context, part->index, &chunk_count),
                     err));
    const int64_t tile_width = part->chunk_width, tile_height = part->chunk_height;
    if (tile_width < 1 || tile_height < 1)
        TRY(refuse(part, TL_ERR_FORMAT, err, "is damaged: its tiles have no size"));
    part->chunks_x = (int)(((int64_t)part->width + tile_width - 1) / tile_width);
    part->chunks_y = (int)(((int64_t)part->height + tile_height - 1) / tile_height);
    const int64_t wanted = (int64_t)part->chunks_x * part->chunks_y;
    if (is_tiled ? chunk_count < wanted : chunk_count != wanted)
        TRY(refuse(part, TL_ERR_FORMAT, err, "is damaged: %d chunks for %u rows", chunk_count,
                   part->height));
    /* An offset in the table, then place and size of a chunk: 8, and 8 or more. */
    const uint64_t table = 16 * (uint64_t)chunk_count;
    const uint64_t pixels = part->compression == EXR_COMPRESSION_NONE
                                ? part->pixel_size * part->width * part->height
                                : 0;
    if (part->file_size < table + pixels)
        TRY(refuse(part, TL_ERR_FORMAT, err,
                   "is cut short: %" PRIu64 " bytes, where its header promises %" PRIu64
                   " at least",
                   part->file_size, table + pixels));
done:
    return status;
}

tl_status tl_exr_part_open(
    tl_exr_stream *stream, uint64_t file_size, int index, tl_exr_part *out, tl_error *err)
{
    tl_status status = TL_OK;
    *out = (tl_exr_part){.stream = stream, .file_size = file_size, .index = index, .name = ""};
    const exr_attribute_t *name = tl_exr_part_attribute(out, "name");
    if (name && name->type == EXR_ATTR_STRING && name->string->str)
        out->name = name->string->str;
    TRY(read_storage(out, err));
    TRY(read_windows(out, err));
    TRY(read_channels(out, err));
    TRY(read_compression(out, err));
    TRY(check_length(out, err));
done:
    return status;
}

const exr_attr_chlist_entry_t *tl_exr_part_channel(const tl_exr_part *part, const char *name)
{
    for (int i = 0; part->channels && i < part->channels->num_channels; i++)
        if (strcmp(part->channels->entries[i].name.str, name) == 0)
            return &part->channels->entries[i];
    return NULL;
}

/* The first whose name begins with these `length` characters. */
static const exr_attribute_t *find_attribute(const tl_exr_part *part,
                                             const char *start,
                                             size_t length)
{
    const exr_context_t context = part->stream->context;
    const exr_attribute_t *attribute;
    int count = 0;
    if (exr_get_attribute_count(context, part->index, &count) != EXR_ERR_SUCCESS)
        return NULL;
    /* By index: asking by name for one that is absent counts as an error of the stream. */
    for (int i = 0; i < count; i++)
        if (exr_get_attribute_by_index(context, part->index, EXR_ATTR_LIST_FILE_ORDER, i,
                                       &attribute) == EXR_ERR_SUCCESS &&
            strncmp(attribute->name, start, length) == 0)
            return attribute;
    return NULL;
}

const exr_attribute_t *tl_exr_part_attribute(const tl_exr_part *part, const char *name)
{
    return find_attribute(part, name, strlen(name) + 1); /* with its end */
}

bool tl_exr_part_has_attribute_like(const tl_exr_part *part, const char *start)
{
    return find_attribute(part, start, strlen(start)) != NULL;
}

bool tl_exr_part_is_uncropped(const tl_exr_part *part)
{
    return memcmp(&part->data, &part->display, sizeof part->data) == 0;
}

bool tl_exr_part_overlap(const tl_exr_part *part, exr_attr_box2i_t *out)
{
    const exr_attr_box2i_t *a = &part->data, *b = &part->display;
    out->min.x = a->min.x > b->min.x ? a->min.x : b->min.x;
    out->min.y = a->min.y > b->min.y ? a->min.y : b->min.y;
    out->max.x = a->max.x < b->max.x ? a->max.x : b->max.x;
    out->max.y = a->max.y < b->max.y ? a->max.y : b->max.y;
    return out->min.x <= out->max.x && out->min.y <= out->max.y;
}

/* What the decoding threads share. */
typedef struct decoding {
    const tl_exr_part *part;
    const tl_exr_target *targets;
    size_t target_count, pitch;
    _Atomic exr_result_t result; /* a failure; stops all threads */
} decoding;

/* A chunk of the picture: a tile, or rows. Pixels from the corner of the data window. */
typedef struct chunk {
    int column, row; /* among chunks */
    size_t x, y;
} chunk;

static chunk chunk_at(const tl_exr_part *part, size_t index)
{
    chunk c = {.column = (int)(index % (size_t)part->chunks_x),
               .row = (int)(index / (size_t)part->chunks_x)};
    c.x = (size_t)c.column * (size_t)part->chunk_width;
    c.y = (size_t)c.row * (size_t)part->chunk_height;
    return c;
}

/* Points the channels of the pipeline, which has its own order, at their first pixels. */
static void set_destinations(const decoding *shared,
                             exr_decode_pipeline_t *pipeline,
                             const chunk *c)
{
    const size_t first = c->y * shared->pitch + c->x;
    for (int k = 0; k < pipeline->channel_count; k++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[k];
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
            channel->decode_to_ptr = (uint8_t *)shared->targets[i].plane + first * bytes;
        }
    }
}

/* The library trusts these; a damaged file must not. */
static bool is_plausible(const tl_exr_part *part, const exr_chunk_info_t *info, const chunk *c)
{
    const uint64_t unpacked = (uint64_t)info->width * (uint64_t)info->height * part->pixel_size;
    const size_t width_left = part->width - c->x;
    const int width =
        width_left < (size_t)part->chunk_width ? (int)width_left : part->chunk_width;
    return info->width == width && info->height >= 1 && info->height <= part->chunk_height &&
           c->y + (size_t)info->height <= part->height && info->unpacked_size == unpacked &&
           info->packed_size <= unpacked && info->data_offset <= part->file_size &&
           info->packed_size <= part->file_size - info->data_offset;
}

static exr_result_t find_chunk(const tl_exr_part *part, const chunk *c, exr_chunk_info_t *info)
{
    const exr_context_t context = part->stream->context;
    const exr_result_t result =
        part->storage == EXR_STORAGE_TILED
            ? exr_read_tile_chunk_info(context, part->index, c->column, c->row, 0, 0, info)
            : exr_read_scanline_chunk_info(context, part->index, part->data.min.y + (int)c->y,
                                           info);
    if (result == EXR_ERR_SUCCESS && !is_plausible(part, info, c))
        return EXR_ERR_CORRUPT_CHUNK;
    return result;
}

/* The pipeline is initialised by the range's first chunk. */
static exr_result_t decode_chunk(const decoding *shared,
                                 exr_decode_pipeline_t *pipeline,
                                 bool is_first,
                                 const chunk *c)
{
    const tl_exr_part *part = shared->part;
    const exr_context_t context = part->stream->context;
    exr_chunk_info_t info;
    exr_result_t result = find_chunk(part, c, &info);
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = is_first ? exr_decoding_initialize(context, part->index, &info, pipeline)
                      : exr_decoding_update(context, part->index, &info, pipeline);
    if (result != EXR_ERR_SUCCESS)
        return result;
    set_destinations(shared, pipeline, c);
    if (is_first)
        result = exr_decoding_choose_default_routines(context, part->index, pipeline);
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(context, part->index, pipeline)
                                     : result;
}

static void decode_chunks(void *context, size_t begin, size_t end)
{
    decoding *shared = context;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    for (size_t i = begin; i < end; i++) {
        if (atomic_load(&shared->result) != EXR_ERR_SUCCESS)
            break;
        const chunk c = chunk_at(shared->part, i);
        const exr_result_t result = decode_chunk(shared, &pipeline, i == begin, &c);
        if (result != EXR_ERR_SUCCESS)
            atomic_store(&shared->result, result);
    }
    exr_decoding_destroy(shared->part->stream->context, &pipeline);
}

tl_status tl_exr_part_pixels(const tl_exr_part *part,
                             const tl_exr_target *targets,
                             size_t target_count,
                             size_t pitch,
                             tl_error *err)
{
    tl_status status = TL_OK;
    decoding shared = {
        .part = part, .targets = targets, .target_count = target_count, .pitch = pitch};
    const chunk first = chunk_at(part, 0);
    exr_chunk_info_t info;
    /* Before the threads start: the first call reads the table of chunks. */
    TRY(tl_exr_check(part->stream, find_chunk(part, &first, &info), err));
    tl_parallel((size_t)part->chunks_x * (size_t)part->chunks_y, 1, decode_chunks, &shared);
    TRY(tl_exr_check(part->stream, shared.result, err));
done:
    return status;
}
