#include "tilelight/gbuffer_file.h"

#include "camera_attributes.h"
#include "exr_writer.h"
#include "gbuffer_preview.h"
#include "layer_parts.h"
#include "material_attribute.h"
#include "object_attribute.h"
#include "plane_channels.h"
#include "shadow_parts.h"
#include "try.h"
#include "word_channels.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_JOINED = 4 };

/* Channels of words that do not stand in memory as in the file. */
typedef struct joined {
    tl_word_planes planes;
    tl_word_channel channels[MOST_JOINED];
    size_t count;
} joined;

/* A surface as a part: what rows that are computed are computed from, and its channels. */
typedef struct source {
    const tl_gbuffer *gbuffer;
    tl_unpacking unpacking;
    joined joined;
    tl_word_channel words[TL_MAX_WORDS];
    tl_exr_channel channels[TL_PREVIEW_COUNT + TL_MAX_WORDS + 2];
    size_t channel_count;
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

static void compute_rows(const void *context, uint32_t y, void *const *rows)
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
    TRY(tl_object_attribute_write(stream, &gbuffer->objects, err));
    TRY(tl_layer_counts_write(stream, &gbuffer->layers, err));
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

static void list_words(source *from)
{
    const size_t word_count =
        tl_word_channels(from->gbuffer->layout, from->gbuffer->present, from->words);
    for (size_t i = 0; i < word_count; i++) {
        const tl_word_channel *word = &from->words[i];
        const bool whole = tl_word_is_whole(word);
        assert(whole || from->joined.count < MOST_JOINED);
        if (!whole)
            from->joined.channels[from->joined.count++] = *word;
        from->channels[from->channel_count++] = (tl_exr_channel){
            .name = word->name,
            .type = (exr_pixel_type_t)word->type,
            .held = (exr_pixel_type_t)word->held,
            .plane = whole ? tl_gbuffer_words(from->gbuffer, word->first_word) : NULL};
    }
}

/* Which stays where it is. */
static tl_exr_picture picture_of(const tl_gbuffer *gbuffer, source *from)
{
    static const char *const preview[TL_PREVIEW_COUNT] = {"R", "G", "B", "A"};
    *from = (source){.gbuffer = gbuffer,
                     .unpacking = tl_unpacking_of(gbuffer),
                     .joined.planes = tl_word_planes_of(gbuffer)};
    while (from->channel_count < TL_PREVIEW_COUNT) {
        from->channels[from->channel_count] =
            (tl_exr_channel){.name = preview[from->channel_count],
                             .type = EXR_PIXEL_HALF,
                             .held = EXR_PIXEL_FLOAT};
        from->channel_count++;
    }
    list_words(from);
    if (gbuffer->ids)
        from->channels[from->channel_count++] = (tl_exr_channel){.name = TL_ID_CHANNEL,
                                                                 .type = EXR_PIXEL_UINT,
                                                                 .held = EXR_PIXEL_UINT,
                                                                 .plane = gbuffer->ids};
    if (gbuffer->opacity)
        from->channels[from->channel_count++] = (tl_exr_channel){.name = TL_OPACITY_CHANNEL,
                                                                 .type = EXR_PIXEL_FLOAT,
                                                                 .held = EXR_PIXEL_FLOAT,
                                                                 .plane = gbuffer->opacity};
    return (tl_exr_picture){.width = gbuffer->camera.width,
                            .height = gbuffer->camera.height,
                            .pitch = gbuffer->pitch,
                            .channel_count = from->channel_count,
                            .channels = from->channels,
                            .compute = compute_rows,
                            .context = from};
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

/* Everything that a file is written from. All zero is valid to clear. */
typedef struct parts {
    source *surfaces;           /* [1 + layers], owned */
    tl_shadow_pictures shadows; /* owned */
    tl_exr_picture *pictures;   /* [count], owned: the surface, shadow maps, layers */
    uint32_t count;
} parts;

static void parts_clear(parts *p)
{
    tl_shadow_pictures_clear(&p->shadows);
    free(p->surfaces);
    free(p->pictures);
}

static tl_status parts_begin(const tl_gbuffer *gbuffer,
                             const char *path,
                             parts *p,
                             tl_error *err)
{
    const size_t layers = gbuffer->layers.count;
    const size_t shadows = tl_shadow_part_count(&gbuffer->shadows);
    p->surfaces = calloc(1 + layers, sizeof *p->surfaces);
    p->pictures = calloc(1 + layers + shadows, sizeof *p->pictures);
    if (!p->surfaces || !p->pictures)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its parts", path);
    p->pictures[p->count++] = picture_of(gbuffer, &p->surfaces[0]);
    return TL_OK;
}

static tl_status add_layers(tl_exr_writer *writer,
                            const tl_layers *layers,
                            exr_compression_t how,
                            parts *p,
                            tl_error *err)
{
    tl_status status = TL_OK;
    for (uint32_t i = 0; i < layers->count; i++) {
        const tl_camera *camera = &layers->of[i]->camera;
        char name[32];
        snprintf(name, sizeof name, "layer.%u", i);
        TRY(tl_exr_writer_add(writer, name, camera->width, camera->height, how, err));
        TRY(tl_layer_attribute_write(&writer->stream, (int)p->count, i, err));
        p->pictures[p->count++] = picture_of(layers->of[i], &p->surfaces[1 + i]);
    }
done:
    return status;
}

tl_status tl_gbuffer_write_compressed(const char *path,
                                      const tl_gbuffer *gbuffer,
                                      const tl_light_set *lights,
                                      tl_compression compression,
                                      tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_writer writer = {.stream.context = NULL};
    parts p = {.count = 0};
    const tl_camera *camera = &gbuffer->camera;
    const exr_compression_t how = compressions[compression];
    const bool is_alone = gbuffer->shadows.count == 0 && gbuffer->layers.count == 0;

    TRY(parts_begin(gbuffer, path, &p, err));
    TRY(tl_exr_writer_open(&writer, path, err));
    /* A part that is alone needs no name. */
    TRY(tl_exr_writer_add(&writer, is_alone ? NULL : "surface", camera->width, camera->height,
                          how, err));
    TRY(set_attributes(&writer.stream, gbuffer, lights, err));
    TRY(tl_shadow_parts_add(&writer, &gbuffer->shadows, how, &p.shadows, err));
    for (uint32_t i = 0; i < p.shadows.count; i++)
        p.pictures[p.count++] = p.shadows.of[i];
    TRY(add_layers(&writer, &gbuffer->layers, how, &p, err));
    TRY(tl_exr_writer_parts(&writer, p.pictures, (int)p.count, err));
    TRY(tl_exr_writer_commit(&writer, err));
done:
    tl_exr_writer_abandon(&writer);
    parts_clear(&p);
    return status;
}

tl_status tl_gbuffer_write(const char *path,
                           const tl_gbuffer *gbuffer,
                           const tl_light_set *lights,
                           tl_error *err)
{
    return tl_gbuffer_write_compressed(path, gbuffer, lights, TL_COMPRESSION_NONE, err);
}
