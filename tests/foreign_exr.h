/* OpenEXR files as renderers write them, by the library's C API: any parts, windows, channels, storage and
 * compression, from planes of floats. Include testing.h before. */
#ifndef TL_FOREIGN_EXR_H
#define TL_FOREIGN_EXR_H

#include "testing.h"

#include <openexr.h>

enum { FOREIGN_CHANNELS = 24, FOREIGN_PARTS = 4 };

typedef struct foreign_channel {
    char name[64];
    exr_pixel_type_t type;
    const float *plane; /* [height][pitch] of the display window */
} foreign_channel;

/* All zero but for channels is scanlines, uncompressed, the display window from (0, 0) on. */
typedef struct foreign_part {
    const char *name;
    exr_storage_t storage;
    exr_compression_t compression;
    exr_tile_level_mode_t levels;
    int tile_width, tile_height; /* 0: 16 */
    int crop[4]; /* px that the data window lacks: left, top, right, bottom; below 0 it is
                                  * larger, and holds 7777 there */
    foreign_channel channels[FOREIGN_CHANNELS];
    int channel_count;
} foreign_part;

typedef struct foreign_file {
    int width, height; /* px, of the display window */
    size_t pitch;
    int origin[2];      /* of the display window */
    float pixel_aspect; /* 0: 1 */
    foreign_part parts[FOREIGN_PARTS];
    int part_count;
    void (*attributes)(exr_context_t file, void *context); /* NULL: none; of part 0 */
    void *context;
} foreign_file;

static inline void foreign_must(exr_result_t result, const char *what)
{
    if (result != EXR_ERR_SUCCESS)
        fail_msg("%s: %s", what, exr_get_default_error_message(result));
}

static inline void foreign_add(foreign_part *part,
                               const char *name,
                               exr_pixel_type_t type,
                               const float *plane)
{
    assert_true(part->channel_count < FOREIGN_CHANNELS);
    foreign_channel *channel = &part->channels[part->channel_count++];
    snprintf(channel->name, sizeof channel->name, "%s", name);
    channel->type = type;
    channel->plane = plane;
}

/* BASE.X, .Y, .Z of three planes, or whichever letters. Without a base the letters alone. */
static inline void foreign_add_three(foreign_part *part,
                                     const char *base,
                                     const char *letters,
                                     exr_pixel_type_t type,
                                     const float *const planes[3])
{
    for (int i = 0; i < 3; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s%c", base, base[0] ? "." : "", letters[i]);
        foreign_add(part, name, type, planes[i]);
    }
}

/* A value of the data window, from its corner on. */
static inline float foreign_value(const foreign_file *of,
                                  const foreign_part *part,
                                  const foreign_channel *channel,
                                  int x,
                                  int y)
{
    const int column = x + part->crop[0], row = y + part->crop[1];
    if (column < 0 || row < 0 || column >= of->width || row >= of->height)
        return 7777.0f;
    return channel->plane[(size_t)row * of->pitch + (size_t)column];
}

static inline const foreign_channel *foreign_find(const foreign_part *part, const char *name)
{
    for (int i = 0; i < part->channel_count; i++)
        if (strcmp(part->channels[i].name, name) == 0)
            return &part->channels[i];
    return NULL;
}

/* step: pixels of the data window per pixel of the level. */
static inline void foreign_chunk(exr_context_t file,
                                 const foreign_file *of,
                                 int index,
                                 const exr_chunk_info_t *info,
                                 int first_x,
                                 int first_y,
                                 int step)
{
    const foreign_part *part = &of->parts[index];
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    float *rows[FOREIGN_CHANNELS] = {NULL};
    foreign_must(exr_encoding_initialize(file, index, info, &pipeline), "encoding");
    for (int c = 0; c < pipeline.channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline.channels[c];
        const foreign_channel *from = foreign_find(part, channel->channel_name);
        rows[c] = calloc((size_t)info->width * (size_t)info->height, sizeof(float));
        assert_non_null(rows[c]);
        assert_non_null(from);
        for (int y = 0; y < info->height && from->type != EXR_PIXEL_UINT; y++)
            for (int x = 0; x < info->width; x++)
                rows[c][y * info->width + x] =
                    foreign_value(of, part, from, (first_x + x) * step, (first_y + y) * step);
        channel->user_data_type =
            from->type == EXR_PIXEL_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = 4;
        channel->user_pixel_stride = 4;
        channel->user_line_stride = info->width * 4;
        channel->encode_from_ptr = (const uint8_t *)rows[c];
    }
    foreign_must(exr_encoding_choose_default_routines(file, index, &pipeline), "routines");
    foreign_must(exr_encoding_run(file, index, &pipeline), "encoding");
    foreign_must(exr_encoding_destroy(file, &pipeline), "encoding");
    for (int c = 0; c < FOREIGN_CHANNELS; c++)
        free(rows[c]);
}

static inline exr_attr_box2i_t foreign_window(const foreign_file *of, const foreign_part *part)
{
    const exr_attr_box2i_t window = {
        .min = {.x = of->origin[0] + part->crop[0], .y = of->origin[1] + part->crop[1]},
        .max = {.x = of->origin[0] + of->width - 1 - part->crop[2],
                .y = of->origin[1] + of->height - 1 - part->crop[3]}};
    return window;
}

static inline void foreign_scanlines(exr_context_t file, const foreign_file *of, int index)
{
    const exr_attr_box2i_t data = foreign_window(of, &of->parts[index]);
    int lines = 0;
    foreign_must(exr_get_scanlines_per_chunk(file, index, &lines), "lines");
    for (int y = data.min.y; y <= data.max.y; y += lines) {
        exr_chunk_info_t info;
        foreign_must(exr_write_scanline_chunk_info(file, index, y, &info), "chunk");
        foreign_chunk(file, of, index, &info, 0, y - data.min.y, 1);
    }
}

static inline void foreign_tiles(exr_context_t file, const foreign_file *of, int index)
{
    int levels_x = 0, levels_y = 0, width, height, tile_width, tile_height;
    foreign_must(exr_get_tile_levels(file, index, &levels_x, &levels_y), "levels");
    for (int level = 0; level < levels_x; level++) {
        foreign_must(exr_get_level_sizes(file, index, level, level, &width, &height), "level");
        foreign_must(exr_get_tile_sizes(file, index, level, level, &tile_width, &tile_height),
                     "tile");
        for (int y = 0; y * tile_height < height; y++)
            for (int x = 0; x * tile_width < width; x++) {
                exr_chunk_info_t info;
                foreign_must(exr_write_tile_chunk_info(file, index, x, y, level, level, &info),
                             "tile");
                foreign_chunk(file, of, index, &info, x * tile_width, y * tile_height,
                              1 << level);
            }
    }
}

static inline void foreign_header(exr_context_t file, const foreign_file *of, int index)
{
    const foreign_part *part = &of->parts[index];
    const exr_attr_box2i_t display = {
        .min = {.x = of->origin[0], .y = of->origin[1]},
        .max = {.x = of->origin[0] + of->width - 1, .y = of->origin[1] + of->height - 1}};
    const exr_attr_box2i_t data = foreign_window(of, part);
    const exr_attr_v2f_t center = {.x = 0.0f, .y = 0.0f};
    const float aspect = of->pixel_aspect > 0.0f ? of->pixel_aspect : 1.0f;
    int made;
    foreign_must(exr_add_part(file, part->name ? part->name : "", part->storage, &made),
                 "part");
    foreign_must(exr_initialize_required_attr(file, index, &display, &data, aspect, &center,
                                              1.0f, EXR_LINEORDER_INCREASING_Y,
                                              part->compression),
                 "required attributes");
    for (int c = 0; c < part->channel_count; c++)
        foreign_must(exr_add_channel(file, index, part->channels[c].name,
                                     part->channels[c].type, EXR_PERCEPTUALLY_LINEAR, 1, 1),
                     part->channels[c].name);
    if (part->storage == EXR_STORAGE_TILED)
        foreign_must(exr_set_tile_descriptor(
                         file, index, part->tile_width ? (unsigned)part->tile_width : 16u,
                         part->tile_height ? (unsigned)part->tile_height : 16u, part->levels,
                         EXR_TILE_ROUND_DOWN),
                     "tiles");
}

static inline void foreign_write(const foreign_file *of, const char *path)
{
    exr_context_initializer_t quiet = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file = NULL;
    foreign_must(exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &quiet), path);
    for (int i = 0; i < of->part_count; i++)
        foreign_header(file, of, i);
    if (of->attributes)
        of->attributes(file, of->context);
    foreign_must(exr_write_header(file), "header");
    for (int i = 0; i < of->part_count; i++)
        if (of->parts[i].storage == EXR_STORAGE_TILED)
            foreign_tiles(file, of, i);
        else
            foreign_scanlines(file, of, i);
    foreign_must(exr_finish(&file), "finish");
}

#endif
