#include "tilelight/gbuffer_file.h"

#include "camera_attributes.h"
#include "exr_writer.h"
#include "gbuffer_preview.h"
#include "material_attribute.h"
#include "plane_channels.h"
#include "shadow_parts.h"
#include "try.h"
#include "word_channels.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

/* Channels of words that do not stand in memory as in the file. */
typedef struct joined {
    tl_word_planes planes;
    tl_word_channel channels[TL_EXR_MAX_COMPUTED - TL_PREVIEW_COUNT];
    size_t count;
} joined;

/* What rows that are computed are computed from. */
typedef struct source {
    const tl_gbuffer *gbuffer;
    tl_unpacking unpacking;
    joined joined;
} source;

/* The words of a channel as one number, the first in its lowest bits. */
static void join_words(
    const joined *from, const tl_word_channel *c, size_t first, uint32_t *row, uint32_t count)
{
    for (uint32_t x = 0; x < count; x++) {
        uint32_t shift = 0;
        row[x] = 0;
        for (uint32_t w = c->first_word; w < c->first_word + c->word_count; w++) {
            row[x] |= tl_word_at(&from->planes, w, first + x) << shift;
            shift += 8 * from->planes.layout->words[w].bytes;
        }
    }
}

static void compute_rows(const void *context, uint32_t y, void *const rows[TL_EXR_MAX_COMPUTED])
{
    const source *from = context;
    float *const preview[TL_PREVIEW_COUNT] = {rows[0], rows[1], rows[2], rows[3]};
    tl_preview_row(&from->unpacking, y, preview);
    for (size_t i = 0; i < from->joined.count; i++)
        join_words(&from->joined, &from->joined.channels[i], (size_t)y * from->gbuffer->pitch,
                   rows[TL_PREVIEW_COUNT + i], from->gbuffer->camera.width);
}

/* The planes that words stand for, by the names they have in full float. */
static void format_planes(uint32_t present, char *text, size_t size)
{
    size_t length = 0;
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (present & TL_HAS(p))
            length += (size_t)snprintf(text + length, size - length, "%s%s", length ? " " : "",
                                       tl_plane_channels[p]);
}

static tl_status set_attributes(tl_exr_stream *stream,
                                const tl_gbuffer *gbuffer,
                                const tl_light_set *lights,
                                tl_error *err)
{
    tl_status status = TL_OK;
    const exr_context_t context = stream->context;
    char *text = NULL, planes[256];
    TRY(tl_exr_check(stream, exr_attr_set_int(context, 0, "tilelight:version", 1), err));
    TRY(tl_exr_check(
        stream,
        exr_attr_set_string(context, 0, "tilelight:layout", tl_layout_word(gbuffer->layout)),
        err));
    format_planes(gbuffer->present, planes, sizeof planes);
    /* Where channels are planes, they say so themselves. */
    if (gbuffer->layout != TL_LAYOUT_FLOAT)
        TRY(tl_exr_check(stream, exr_attr_set_string(context, 0, "tilelight:planes", planes),
                         err));
    if (gbuffer->samples > 1)
        TRY(tl_exr_check(
            stream,
            exr_attr_set_int(context, 0, "tilelight:samples", (int32_t)gbuffer->samples), err));
    TRY(tl_material_attribute_write(stream, &gbuffer->materials, err));
    TRY(tl_camera_attributes_write(stream, 0, &gbuffer->camera, err));
    if (lights) {
        TRY(tl_lights_format(lights, stream->path, &text, err));
        TRY(tl_exr_check(stream, exr_attr_set_string(context, 0, "tilelight:lights", text),
                         err));
    }
done:
    free(text);
    return status;
}

/* `words` are kept by the channels. Returns how many there are. */
static size_t list_channels(source *from,
                            tl_word_channel words[TL_MAX_WORDS],
                            tl_exr_channel channels[TL_PREVIEW_COUNT + TL_MAX_WORDS])
{
    static const char *const preview[TL_PREVIEW_COUNT] = {"R", "G", "B", "A"};
    const tl_gbuffer *gbuffer = from->gbuffer;
    const size_t word_count = tl_word_channels(gbuffer->layout, gbuffer->present, words);
    size_t count = 0;
    while (count < TL_PREVIEW_COUNT) {
        channels[count] = (tl_exr_channel){
            .name = preview[count], .type = EXR_PIXEL_HALF, .held = EXR_PIXEL_FLOAT};
        count++;
    }
    for (size_t i = 0; i < word_count; i++) {
        const exr_pixel_type_t type = (exr_pixel_type_t)words[i].type;
        const bool whole = tl_word_is_whole(&words[i]);
        assert(whole || from->joined.count < TL_EXR_MAX_COMPUTED - TL_PREVIEW_COUNT);
        if (!whole)
            from->joined.channels[from->joined.count++] = words[i];
        channels[count++] = (tl_exr_channel){
            .name = words[i].name,
            .type = type,
            .held = (exr_pixel_type_t)words[i].held,
            .plane = whole ? tl_gbuffer_words(gbuffer, words[i].first_word) : NULL};
    }
    return count;
}

static const exr_compression_t compressions[TL_COMPRESSION_COUNT] = {
    [TL_COMPRESSION_NONE] = EXR_COMPRESSION_NONE,
    [TL_COMPRESSION_RLE] = EXR_COMPRESSION_RLE,
    [TL_COMPRESSION_ZIPS] = EXR_COMPRESSION_ZIPS,
    [TL_COMPRESSION_ZIP] = EXR_COMPRESSION_ZIP,
    [TL_COMPRESSION_PIZ] = EXR_COMPRESSION_PIZ,
    [TL_COMPRESSION_PXR24] = EXR_COMPRESSION_PXR24,
    [TL_COMPRESSION_B44] = EXR_COMPRESSION_B44,
    [TL_COMPRESSION_B44A] = EXR_COMPRESSION_B44A,
};

static tl_status join_pictures(const tl_exr_picture *shown,
                               const tl_shadow_pictures *shadows,
                               const char *path,
                               tl_exr_picture **out,
                               tl_error *err)
{
    *out = malloc((1 + (size_t)shadows->count) * sizeof **out);
    if (!*out)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its parts", path);
    (*out)[0] = *shown;
    for (uint32_t i = 0; i < shadows->count; i++)
        (*out)[1 + i] = shadows->of[i];
    return TL_OK;
}

tl_status tl_gbuffer_write_compressed(const char *path,
                                      const tl_gbuffer *gbuffer,
                                      const tl_light_set *lights,
                                      tl_compression compression,
                                      tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_writer writer = {.stream.context = NULL};
    tl_shadow_pictures shadows = {0};
    tl_exr_picture *pictures = NULL;
    tl_word_channel words[TL_MAX_WORDS];
    tl_exr_channel channels[TL_PREVIEW_COUNT + TL_MAX_WORDS];
    source from = {.gbuffer = gbuffer,
                   .unpacking = tl_unpacking_of(gbuffer),
                   .joined.planes = tl_word_planes_of(gbuffer)};
    const exr_compression_t how = compressions[compression];
    const tl_exr_picture shown = {.width = gbuffer->camera.width,
                                  .height = gbuffer->camera.height,
                                  .pitch = gbuffer->pitch,
                                  .channel_count = list_channels(&from, words, channels),
                                  .channels = channels,
                                  .compute = compute_rows,
                                  .context = &from};

    TRY(tl_exr_writer_open(&writer, path, err));
    /* A part that is alone needs no name. */
    TRY(tl_exr_writer_add(&writer, gbuffer->shadows.count > 0 ? "surface" : NULL, shown.width,
                          shown.height, how, err));
    TRY(set_attributes(&writer.stream, gbuffer, lights, err));
    TRY(tl_shadow_parts_add(&writer, &gbuffer->shadows, how, &shadows, err));
    TRY(join_pictures(&shown, &shadows, path, &pictures, err));
    TRY(tl_exr_writer_parts(&writer, pictures, 1 + (int)shadows.count, err));
    TRY(tl_exr_writer_commit(&writer, err));
done:
    tl_exr_writer_abandon(&writer);
    tl_shadow_pictures_clear(&shadows);
    free(pictures);
    return status;
}

tl_status tl_gbuffer_write(const char *path,
                           const tl_gbuffer *gbuffer,
                           const tl_light_set *lights,
                           tl_error *err)
{
    return tl_gbuffer_write_compressed(path, gbuffer, lights, TL_COMPRESSION_NONE, err);
}
