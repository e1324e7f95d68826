#include "layer_parts.h"

#include "object_attribute.h"
#include "size_limit.h"
#include "try.h"
#include "words_read.h"

#include <inttypes.h>

static const char attribute_count[] = "tilelight:layers",
                  attribute_left[] = "tilelight:layersLeft",
                  attribute_index[] = "tilelight:layer";

tl_status tl_layer_counts_write(tl_exr_stream *stream, const tl_layers *layers, tl_error *err)
{
    tl_status status = TL_OK;
    if (layers->count == 0)
        return TL_OK;
    TRY(tl_exr_check(
        stream, exr_attr_set_int(stream->context, 0, attribute_count, (int32_t)layers->count),
        err));
    TRY(tl_exr_check(
        stream, exr_attr_set_int(stream->context, 0, attribute_left, (int32_t)layers->left),
        err));
done:
    return status;
}

tl_status tl_layer_attribute_write(tl_exr_stream *stream,
                                   int part,
                                   uint32_t index,
                                   tl_error *err)
{
    return tl_exr_check(
        stream, exr_attr_set_int(stream->context, part, attribute_index, (int32_t)index), err);
}

/* Of the first part; 0 where it has none. */
static tl_status read_count(
    tl_exr_reader *reader, const char *attribute, int32_t most, int32_t *out, tl_error *err)
{
    *out = 0;
    if (!tl_exr_reader_has_attribute(reader, attribute))
        return TL_OK;
    if (exr_attr_get_int(reader->stream.context, 0, attribute, out) != EXR_ERR_SUCCESS)
        return tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" is not of type int",
                       reader->stream.path, attribute);
    if (*out < 0 || *out > most)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: attribute \"%s\" is %" PRId32 ", which is not from 0 to %" PRId32,
                       reader->stream.path, attribute, *out, most);
    return TL_OK;
}

static tl_status check_index(const tl_exr_part *part,
                             uint32_t expected,
                             uint32_t count,
                             tl_error *err)
{
    int32_t index = 0;
    if (exr_attr_get_int(part->stream->context, part->index, attribute_index, &index) !=
        EXR_ERR_SUCCESS)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: part \"%s\" has no attribute \"%s\" of type int",
                       part->stream->path, part->name, attribute_index);
    if (expected >= count)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: part \"%s\" is a layer too many: attribute \"%s\" says %u",
                       part->stream->path, part->name, attribute_count, count);
    if ((uint32_t)index != expected)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: part \"%s\" is layer %" PRId32 ", where layer %u should be",
                       part->stream->path, part->name, index, expected);
    return TL_OK;
}

static tl_status check_extent(const tl_exr_reader *reader,
                              const tl_exr_part *part,
                              tl_error *err)
{
    if (part->width == reader->width && part->height == reader->height &&
        tl_exr_part_is_uncropped(part))
        return TL_OK;
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s: part \"%s\" is of %u x %u pixels, its surface of %u x %u",
                   part->stream->path, part->name, part->width, part->height, reader->width,
                   reader->height);
}

static tl_status require(const tl_exr_part *part,
                         const char *channel,
                         exr_pixel_type_t type,
                         tl_error *err)
{
    const exr_attr_chlist_entry_t *found = tl_exr_part_channel(part, channel);
    if (found && found->pixel_type == type)
        return TL_OK;
    return tl_fail(err, TL_ERR_FORMAT, "%s: part \"%s\" has no channel \"%s\" of type %s",
                   part->stream->path, part->name, channel, tl_exr_type_words[type]);
}

static tl_status require_channels(const tl_exr_part *part,
                                  const tl_gbuffer_header *header,
                                  tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < header->channel_count; i++)
        TRY(require(part, header->channels[i].name, (exr_pixel_type_t)header->channels[i].type,
                    err));
    TRY(require(part, TL_OPACITY_CHANNEL, EXR_PIXEL_FLOAT, err));
done:
    return status;
}

/* Of the surface and the layers so far, with one more. */
static uint64_t size_with_one_more(const tl_gbuffer *of)
{
    const uint64_t pixels = (uint64_t)of->camera.width * of->camera.height;
    return pixels *
           (tl_gbuffer_pixel_size(of) +
            (of->layers.count + 1) * (tl_gbuffer_pixel_size(of) + (uint64_t)sizeof(float)));
}

static tl_status read_layer(tl_exr_reader *reader,
                            const tl_exr_part *part,
                            const tl_gbuffer_header *header,
                            tl_gbuffer *out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *layer = NULL;
    TRY(check_extent(reader, part, err));
    TRY(require_channels(part, header, err));
    TRY(tl_check_decoded_size(part->stream->path, part->file_size, size_with_one_more(out),
                              err));
    TRY(tl_layers_add(out, &layer, err));
    const tl_exr_target opacity = {TL_OPACITY_CHANNEL, EXR_PIXEL_FLOAT, layer->opacity};
    TRY(tl_words_read(part, header, layer, err));
    TRY(tl_ids_read(part, layer, err));
    TRY(tl_exr_part_pixels(part, &opacity, 1, layer->pitch, err));
done:
    return status;
}

tl_status tl_layer_parts_read(tl_exr_reader *reader,
                              const tl_gbuffer_header *header,
                              tl_gbuffer *out,
                              tl_error *err)
{
    tl_exr_stream *stream = &reader->stream;
    const int32_t pixel_count = (int32_t)(reader->width * reader->height);
    tl_status status = TL_OK;
    int32_t promised = 0, left = 0;
    int part_count = 0;
    TRY(read_count(reader, attribute_count, TL_MOST_LAYERS, &promised, err));
    TRY(read_count(reader, attribute_left, pixel_count, &left, err));
    TRY(tl_exr_check(stream, exr_get_count(stream->context, &part_count), err));
    out->layers.left = (uint64_t)left;
    for (int i = 1; i < part_count; i++) {
        const tl_exr_part asked = {.stream = stream, .index = i};
        tl_exr_part part;
        if (!tl_exr_part_attribute(&asked, attribute_index))
            continue;
        TRY(tl_exr_part_open(stream, reader->part.file_size, i, &part, err));
        TRY(check_index(&part, out->layers.count, (uint32_t)promised, err));
        TRY(read_layer(reader, &part, header, out, err));
    }
    if (out->layers.count < (uint32_t)promised)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: has %u layers, where attribute \"%s\" says %" PRId32, stream->path,
                    out->layers.count, attribute_count, promised));
done:
    return status;
}
