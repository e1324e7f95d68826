#include "shadow_parts.h"

#include "camera_attributes.h"
#include "number.h"
#include "size_limit.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char attribute_kind[] = "tilelight:shadow", attribute_view[] = "tilelight:view",
                  attribute_position[] = "tilelight:lightPosition",
                  attribute_direction[] = "tilelight:lightDirection",
                  attribute_fitted[] = "tilelight:fitted",
                  attribute_slack[] = "tilelight:slack";

/* In the order of rows that are computed. */
enum { DEPTH, SLOPE_X, SLOPE_Y, CHANNEL_COUNT };
static const char *const channel_names[CHANNEL_COUNT] = {"Z", "slope.x", "slope.y"};
static const exr_pixel_type_t channel_types[CHANNEL_COUNT] = {EXR_PIXEL_FLOAT, EXR_PIXEL_HALF,
                                                              EXR_PIXEL_HALF};

/* --- writing --------------------------------------------------------------------------------------- */

struct tl_shadow_picture {
    const tl_shadow_map *map;
    uint32_t view;
    tl_exr_channel channels[CHANNEL_COUNT];
};
typedef struct tl_shadow_picture source;

/* [size][2] of a row of a view. */
static uint32_t *row_of(const tl_shadow_map *map, uint32_t view, uint32_t y)
{
    return map->texels + ((size_t)view * map->size + y) * map->size * 2;
}

static void compute_rows(const void *context, uint32_t y, void *const *rows)
{
    const source *from = context;
    const uint32_t *texels = row_of(from->map, from->view, y);
    float *const depths = rows[DEPTH], *const right = rows[SLOPE_X],
                 *const down = rows[SLOPE_Y];
    for (uint32_t x = 0; x < from->map->size; x++) {
        memcpy(&depths[x], &texels[2 * x], sizeof depths[x]);
        right[x] = value_of_half(texels[2 * x + 1], 0);
        down[x] = value_of_half(texels[2 * x + 1], 16);
    }
}

static tl_exr_picture picture_of(source *from)
{
    for (int i = 0; i < CHANNEL_COUNT; i++)
        from->channels[i] = (tl_exr_channel){
            .name = channel_names[i], .type = channel_types[i], .held = EXR_PIXEL_FLOAT};
    return (tl_exr_picture){.width = from->map->size,
                            .height = from->map->size,
                            .pitch = from->map->size,
                            .channel_count = CHANNEL_COUNT,
                            .channels = from->channels,
                            .compute = compute_rows,
                            .context = from};
}

static tl_status set_attributes(
    tl_exr_stream *stream, int part, const tl_shadow_map *map, uint32_t view, tl_error *err)
{
    const exr_context_t context = stream->context;
    exr_attr_v3f_t position, direction;
    memcpy(&position, map->position, sizeof position);
    memcpy(&direction, map->direction, sizeof direction);
    const exr_result_t results[] = {
        exr_attr_set_string(context, part, attribute_kind, tl_shadow_kind_words[map->kind]),
        exr_attr_set_int(context, part, attribute_view, (int32_t)view),
        exr_attr_set_v3f(context, part, attribute_position, &position),
        exr_attr_set_v3f(context, part, attribute_direction, &direction),
        exr_attr_set_int(context, part, attribute_fitted, (int32_t)map->is_fitted),
        exr_attr_set_float(context, part, attribute_slack, map->slack),
    };
    for (size_t i = 0; i < sizeof results / sizeof results[0]; i++)
        if (results[i] != EXR_ERR_SUCCESS)
            return tl_exr_check(stream, results[i], err);
    return tl_camera_attributes_write(stream, part, &map->views[view], err);
}

uint32_t tl_shadow_part_count(const tl_shadow_maps *maps)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < maps->count; i++)
        count += tl_shadow_view_count(&maps->of[i]);
    return count;
}

tl_status tl_shadow_parts_add(tl_exr_writer *writer,
                              const tl_shadow_maps *maps,
                              exr_compression_t compression,
                              tl_shadow_pictures *out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    const uint32_t count = tl_shadow_part_count(maps);
    *out = (tl_shadow_pictures){.of = calloc(count + 1, sizeof *out->of),
                                .sources = calloc(count + 1, sizeof *out->sources)};
    if (!out->of || !out->sources)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %u parts", writer->stream.path,
                    count));
    for (uint32_t i = 0; i < maps->count; i++)
        for (uint32_t v = 0; v < tl_shadow_view_count(&maps->of[i]); v++) {
            const tl_shadow_map *map = &maps->of[i];
            const uint32_t n = out->count++;
            char name[64];
            snprintf(name, sizeof name, "shadow.%u.%u", i, v);
            out->sources[n] = (source){.map = map, .view = v};
            out->of[n] = picture_of(&out->sources[n]);
            TRY(tl_exr_writer_add(writer, name, map->size, map->size, compression, err));
            TRY(set_attributes(&writer->stream, (int)n + 1, map, v, err));
        }
done:
    return status;
}

void tl_shadow_pictures_clear(tl_shadow_pictures *pictures)
{
    free(pictures->of);
    free(pictures->sources);
    *pictures = (tl_shadow_pictures){0};
}

/* --- reading --------------------------------------------------------------------------------------- */

static tl_status lacks(const tl_exr_part *part,
                       const char *attribute,
                       const char *type,
                       tl_error *err)
{
    return tl_fail(err, TL_ERR_FORMAT, "%s: part \"%s\" has no attribute \"%s\" of type %s",
                   part->stream->path, part->name, attribute, type);
}

static tl_status read_kind(const tl_exr_part *part, uint32_t *out, tl_error *err)
{
    const char *word = NULL;
    int32_t length;
    if (exr_attr_get_string(part->stream->context, part->index, attribute_kind, &length,
                            &word) != EXR_ERR_SUCCESS)
        return lacks(part, attribute_kind, "string", err);
    for (uint32_t i = 0; i < TL_SHADOW_KIND_COUNT; i++)
        if (strcmp(word, tl_shadow_kind_words[i]) == 0) {
            *out = i;
            return TL_OK;
        }
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "%s: part \"%s\": attribute \"%s\" is \"%.64s\"; spot, directional and cube "
                   "are known",
                   part->stream->path, part->name, attribute_kind, word);
}

/* All but the view's camera. */
static tl_status read_attributes(const tl_exr_part *part,
                                 tl_shadow_map *map,
                                 uint32_t *view,
                                 tl_error *err)
{
    tl_status status = TL_OK;
    const exr_context_t context = part->stream->context;
    exr_attr_v3f_t position, direction;
    int32_t index = 0, fitted = 0;
    TRY(read_kind(part, &map->kind, err));
    if (exr_attr_get_int(context, part->index, attribute_view, &index) != EXR_ERR_SUCCESS)
        TRY(lacks(part, attribute_view, "int", err));
    if (exr_attr_get_v3f(context, part->index, attribute_position, &position) !=
        EXR_ERR_SUCCESS)
        TRY(lacks(part, attribute_position, "v3f", err));
    if (exr_attr_get_v3f(context, part->index, attribute_direction, &direction) !=
        EXR_ERR_SUCCESS)
        TRY(lacks(part, attribute_direction, "v3f", err));
    if (exr_attr_get_int(context, part->index, attribute_fitted, &fitted) != EXR_ERR_SUCCESS)
        TRY(lacks(part, attribute_fitted, "int", err));
    if (exr_attr_get_float(context, part->index, attribute_slack, &map->slack) !=
        EXR_ERR_SUCCESS)
        TRY(lacks(part, attribute_slack, "float", err));
    memcpy(map->position, &position, sizeof position);
    memcpy(map->direction, &direction, sizeof direction);
    *view = (uint32_t)index;
    map->is_fitted = fitted != 0;
    if (part->width != part->height || part->width < TL_LEAST_SHADOW_SIZE ||
        part->width > TL_MOST_SHADOW_SIZE)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: part \"%s\" is of %u x %u texels; shadow maps are square, of %d to %d",
                    part->stream->path, part->name, part->width, part->height,
                    TL_LEAST_SHADOW_SIZE, TL_MOST_SHADOW_SIZE));
    map->size = part->width;
done:
    return status;
}

static bool is_same_map(const tl_shadow_map *a, const tl_shadow_map *b)
{
    return a->kind == b->kind && a->size == b->size &&
           memcmp(a->position, b->position, sizeof a->position) == 0 &&
           memcmp(a->direction, b->direction, sizeof a->direction) == 0;
}

static tl_status require_channels(const tl_exr_part *part, tl_error *err)
{
    for (int i = 0; i < CHANNEL_COUNT; i++) {
        const exr_attr_chlist_entry_t *found = tl_exr_part_channel(part, channel_names[i]);
        if (!found || found->pixel_type != channel_types[i])
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: part \"%s\" has no channel \"%s\" of type %s",
                           part->stream->path, part->name, channel_names[i],
                           tl_exr_type_words[channel_types[i]]);
    }
    return TL_OK;
}

/* Halves as they are stored. */
static tl_status read_texels(const tl_exr_part *part,
                             const tl_shadow_map *map,
                             uint32_t view,
                             tl_error *err)
{
    tl_status status = TL_OK;
    const size_t count = (size_t)map->size * map->size;
    unsigned char *planes = malloc(count * 8);
    uint32_t *texels = row_of(map, view, 0);
    if (!planes)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for part \"%s\"", part->stream->path,
                    part->name));
    uint16_t *const right = (uint16_t *)(void *)(planes + 4 * count), *const down =
                                                                          right + count;
    const tl_exr_target targets[CHANNEL_COUNT] = {
        {channel_names[DEPTH], EXR_PIXEL_FLOAT, planes},
        {channel_names[SLOPE_X], EXR_PIXEL_HALF, right},
        {channel_names[SLOPE_Y], EXR_PIXEL_HALF, down},
    };
    TRY(tl_exr_part_pixels(part, targets, CHANNEL_COUNT, map->size, err));
    for (size_t i = 0; i < count; i++) {
        memcpy(&texels[2 * i], planes + 4 * i, 4);
        texels[2 * i + 1] = (uint32_t)down[i] << 16 | right[i];
    }
done:
    free(planes);
    return status;
}

/* A view with index 0 begins a map, the others follow theirs. */
static tl_status read_view(const tl_exr_part *part,
                           tl_shadow_maps *maps,
                           uint32_t *next,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_shadow_map found = {0};
    uint32_t view = 0;
    TRY(require_channels(part, err));
    TRY(read_attributes(part, &found, &view, err));
    if (view != *next || (view > 0 && !is_same_map(&found, &maps->of[maps->count - 1])))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: part \"%s\" has view %u, where view %u of a shadow map should be",
                    part->stream->path, part->name, view, *next));
    if (view == 0) {
        TRY(tl_check_decoded_size(part->stream->path, part->file_size,
                                  tl_shadow_map_size(&found), err));
        TRY(tl_shadow_maps_add(maps, &found, err));
    }
    tl_shadow_map *map = &maps->of[maps->count - 1];
    TRY(tl_camera_attributes_read(part->stream, part->index, map->size, map->size,
                                  &map->views[view], err));
    TRY(read_texels(part, map, view, err));
    *next = view + 1 < tl_shadow_view_count(map) ? view + 1 : 0;
done:
    return status;
}

tl_status tl_shadow_parts_read(tl_exr_stream *stream,
                               uint64_t file_size,
                               tl_shadow_maps *out,
                               tl_error *err)
{
    tl_status status = TL_OK;
    int count = 0;
    uint32_t next = 0;
    TRY(tl_exr_check(stream, exr_get_count(stream->context, &count), err));
    for (int i = 1; i < count; i++) {
        const tl_exr_part asked = {.stream = stream, .index = i};
        tl_exr_part part;
        if (!tl_exr_part_attribute(&asked, attribute_kind))
            continue;
        TRY(tl_exr_part_open(stream, file_size, i, &part, err));
        TRY(read_view(&part, out, &next, err));
    }
    if (next != 0)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: lacks view %u of its last shadow map",
                    stream->path, next));
    for (uint32_t i = 0; i < out->count; i++) {
        tl_error reason = {.status = TL_OK};
        if (tl_shadow_map_check(&out->of[i], &reason) != TL_OK)
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: shadow map %u: %.3000s", stream->path, i,
                        reason.message));
    }
done:
    return status;
}
