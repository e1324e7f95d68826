#include "source.h"

#include "regular_file.h"
#include "tilelight/import.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

const tl_source_format *const tl_source_formats[] = {&tl_source_exr, &tl_source_pfm,
                                                     &tl_source_png};
const size_t tl_source_format_count = sizeof tl_source_formats / sizeof tl_source_formats[0];

static const tl_source_format *format_of(const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < tl_source_format_count; i++)
        if (tl_source_formats[i]->recognises(bytes, size))
            return tl_source_formats[i];
    return NULL;
}

bool tl_import_recognises(const unsigned char *bytes, size_t size)
{
    return format_of(bytes, size) != NULL;
}

static tl_status read_start(tl_source *source, tl_error *err)
{
    unsigned char bytes[64];
    size_t got;
    const tl_status status =
        tl_regular_file_start(source->path, bytes, sizeof bytes, &got, &source->file_size, err);
    if (status != TL_OK)
        return status;
    source->format = format_of(bytes, got);
    if (!source->format)
        return tl_fail(err, TL_ERR_FORMAT, "%s: is neither OpenEXR nor PFM nor PNG",
                       source->path);
    return TL_OK;
}

tl_status tl_source_open(tl_source *source, const char *path, tl_error *err)
{
    tl_status status = TL_OK;
    *source = (tl_source){.path = path};
    TRY(read_start(source, err));
    TRY(source->format->open(source, err));
done:
    if (status != TL_OK)
        tl_source_close(source);
    return status;
}

void tl_source_close(tl_source *source)
{
    if (source->format)
        source->format->close(source);
    free(source->parts);
    free(source->channels);
    *source = (tl_source){0};
}

/* Arrays grow by doubling: at powers of two. */
static void *grown(void *array, uint32_t count, size_t size)
{
    if (count > 0 && (count & (count - 1)) != 0)
        return array;
    return realloc(array, (count ? 2 * (size_t)count : 1) * size);
}

tl_status tl_source_add_part(tl_source *source, const tl_source_part *part, tl_error *err)
{
    void *parts = grown(source->parts, source->part_count, sizeof *part);
    if (!parts)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its parts", source->path);
    source->parts = parts;
    source->parts[source->part_count++] = *part;
    return TL_OK;
}

tl_status tl_source_add_channel(tl_source *source,
                                const tl_source_channel *channel,
                                tl_error *err)
{
    if (source->channel_count == TL_MAX_SOURCE_CHANNELS)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has more channels than the %d that are read",
                       source->path, TL_MAX_SOURCE_CHANNELS);
    void *channels = grown(source->channels, source->channel_count, sizeof *channel);
    if (!channels)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its channels", source->path);
    source->channels = channels;
    source->channels[source->channel_count++] = *channel;
    return TL_OK;
}

tl_status tl_source_add_picture(tl_source *source,
                                uint32_t width,
                                uint32_t height,
                                size_t numbers,
                                const char *type,
                                tl_error *err)
{
    static const char *const names[] = {"R", "G", "B"};
    const tl_source_part part = {
        .name = "", .width = width, .height = height, .storage = "", .compression = ""};
    tl_status status = TL_OK;
    TRY(tl_source_add_part(source, &part, err));
    for (size_t i = 0; i < numbers; i++) {
        const tl_source_channel channel = {
            .name = numbers == 1 ? "Y" : names[i], .type = type, .is_number = true};
        TRY(tl_source_add_channel(source, &channel, err));
    }
done:
    return status;
}
