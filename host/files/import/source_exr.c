/* OpenEXR files of any number of parts as sources. */
#include "size_limit.h"
#include "source.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool recognises(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[] = {0x76, 0x2f, 0x31, 0x01};
    return size >= sizeof magic && memcmp(bytes, magic, sizeof magic) == 0;
}

static const char *compression_words(exr_compression_t compression)
{
    static const char *const words[] = {
        [EXR_COMPRESSION_NONE] = "none", [EXR_COMPRESSION_RLE] = "rle",
        [EXR_COMPRESSION_ZIPS] = "zips", [EXR_COMPRESSION_ZIP] = "zip",
        [EXR_COMPRESSION_PIZ] = "piz",   [EXR_COMPRESSION_PXR24] = "pxr24",
        [EXR_COMPRESSION_B44] = "b44",   [EXR_COMPRESSION_B44A] = "b44a",
        [EXR_COMPRESSION_DWAA] = "dwaa", [EXR_COMPRESSION_DWAB] = "dwab",
    };
    const size_t count = sizeof words / sizeof words[0];
    return (size_t)compression < count ? words[compression] : "unknown";
}

static tl_status add_part(tl_source *source, int index, tl_error *err)
{
    tl_status status = TL_OK;
    tl_error reason = {.status = TL_OK};
    tl_source_part part = {.name = ""};
    tl_status opened =
        tl_exr_part_open(&source->stream, source->file_size, index, &part.exr, &reason);
    if (opened == TL_OK) /* the frame is the display window */
        opened = tl_exr_part_extent(&part.exr, &part.exr.display, &part.width, &part.height,
                                    &reason);
    if (opened != TL_OK && opened != TL_ERR_FORMAT && opened != TL_ERR_UNSUPPORTED)
        TRY(tl_fail(err, opened, "%s", reason.message));
    part.name = part.exr.name;
    part.storage = tl_exr_storage_words(part.exr.storage);
    part.compression = compression_words(part.exr.compression);
    if (opened != TL_OK)
        snprintf(part.refusal, sizeof part.refusal, "%.500s", reason.message);
    const uint32_t at = source->part_count;
    TRY(tl_source_add_part(source, &part, err));
    for (int i = 0; part.exr.channels && i < part.exr.channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &part.exr.channels->entries[i];
        const tl_source_channel channel = {
            .part = at,
            .name = entry->name.str,
            .type = tl_exr_type_words[entry->pixel_type],
            .is_number = !part.refusal[0] && entry->pixel_type != EXR_PIXEL_UINT,
            .is_whole = !part.refusal[0] && entry->pixel_type == EXR_PIXEL_UINT};
        TRY(tl_source_add_channel(source, &channel, err));
    }
done:
    return status;
}

static tl_status open_exr(tl_source *source, tl_error *err)
{
    tl_status status = TL_OK;
    int count = 0;
    TRY(tl_exr_stream_open(&source->stream, source->path, &source->file_size, err));
    TRY(tl_exr_check(&source->stream, exr_get_count(source->stream.context, &count), err));
    if (count < 1 || count > TL_MAX_SOURCE_PARTS)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: has %d parts; 1 to %d are read", source->path,
                    count, TL_MAX_SOURCE_PARTS));
    for (int i = 0; i < count; i++)
        TRY(add_part(source, i, err));
done:
    return status;
}

/* What both windows cover, from a picture of the data window into one of the display window. */
static void copy_overlap(const tl_exr_part *part, const float *from, float *to, size_t pitch)
{
    const exr_attr_v2i_t data = part->data.min, display = part->display.min;
    exr_attr_box2i_t both;
    if (!tl_exr_part_overlap(part, &both))
        return;
    const size_t width = (size_t)((int64_t)both.max.x - both.min.x + 1);
    for (int64_t y = both.min.y; y <= both.max.y; y++)
        memcpy(to + (size_t)(y - display.y) * pitch + (size_t)((int64_t)both.min.x - display.x),
               from + (size_t)(y - data.y) * part->width +
                   (size_t)((int64_t)both.min.x - data.x),
               width * sizeof *to);
}

static tl_status read_exr(tl_source *source,
                          const uint32_t *indices,
                          float *const *planes,
                          size_t count,
                          size_t pitch,
                          tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_target targets[TL_MAX_READ] = {{NULL, EXR_PIXEL_FLOAT, NULL}};
    float *cropped[TL_MAX_READ] = {NULL};
    const tl_exr_part *part = &source->parts[source->channels[indices[0]].part].exr;
    const bool is_direct = tl_exr_part_is_uncropped(part);
    const size_t pixels = (size_t)part->width * part->height;
    if (!is_direct)
        TRY(tl_check_decoded_size(source->path, source->file_size,
                                  (uint64_t)count * pixels * sizeof(float), err));
    for (size_t i = 0; i < count; i++) {
        if (!is_direct && !(cropped[i] = malloc(pixels * sizeof(float))))
            TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for channel \"%s\"",
                        source->path, source->channels[indices[i]].name));
        targets[i] = (tl_exr_target){.channel = source->channels[indices[i]].name,
                                     .held = EXR_PIXEL_FLOAT,
                                     .plane = is_direct ? planes[i] : cropped[i]};
    }
    TRY(tl_exr_part_pixels(part, targets, count, is_direct ? pitch : part->width, err));
    for (size_t i = 0; i < count && !is_direct; i++)
        copy_overlap(part, cropped[i], planes[i], pitch);
done:
    for (size_t i = 0; i < count; i++)
        free(cropped[i]);
    return status;
}

static void close_exr(tl_source *source)
{
    tl_exr_stream_close_file(&source->stream);
}

const tl_source_format tl_source_exr = {"OpenEXR", recognises, open_exr, read_exr, close_exr};
