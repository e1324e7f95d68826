/* OpenEXR files as other programs might make them, by the library's C API: a good G-buffer with
 * one thing about it changed. Include file_cases.h before. */
#ifndef TL_EXR_RECIPES_H
#define TL_EXR_RECIPES_H

#include "testing.h"

#include <fcntl.h>
#include <openexr.h>
#include <unistd.h>

/* All zero but for the extents is a good, uncompressed G-buffer without optional planes. */
typedef struct exr_recipe {
    int width, height;
    exr_storage_t storage;
    exr_compression_t compression;
    exr_pixel_type_t type;       /* of every channel; EXR_PIXEL_UINT stands for float */
    const char *without_channel; /* left out */
    const char *uint_channel;    /* of type uint */
    const char *sparse_channel;  /* sampled 2 x 2 */
    const char *extra_channels[4];
    int window_offset; /* of the data window from the display window, in x */
    int both_windows_offset;
    const char *without_attribute;
    const char *wrong_attribute; /* written with the type double */
    const char *projection, *layout, *lights;
    int version;
    int samples; /* 0: no attribute */
    float near;
    int second_part;
} exr_recipe;

enum { EXR_RECIPE_CHANNELS = 12 };

static const char *const exr_recipe_channels[] = {"N.X",      "N.Y",      "N.Z",     "Z",
                                                  "albedo.B", "albedo.G", "albedo.R"};

/* Exact in half, different for neighbours and channels. */
static inline float exr_recipe_value(const char *channel, int x, int y)
{
    const int last = channel[strlen(channel) - 1];
    return (float)((x * 7 + y * 13 + last * 5) % 1024) / 16.0f + 0.0625f;
}

static inline void exr_must(exr_result_t result, const char *what)
{
    if (result != EXR_ERR_SUCCESS)
        fail_msg("%s: %s", what, exr_get_default_error_message(result));
}

static inline int exr_recipe_wants(const exr_recipe *recipe, const char *attribute)
{
    return !recipe->without_attribute || strcmp(recipe->without_attribute, attribute) != 0;
}

static inline int exr_recipe_wrongs(const exr_recipe *recipe,
                                    exr_context_t file,
                                    const char *name)
{
    if (!recipe->wrong_attribute || strcmp(recipe->wrong_attribute, name) != 0)
        return 0;
    exr_must(exr_attr_set_double(file, 0, name, 1.0), name);
    return 1;
}

static inline void exr_recipe_attributes(const exr_recipe *recipe, exr_context_t file)
{
    const struct {
        const char *name, *value;
    } texts[] = {
        {"tilelight:projection", recipe->projection ? recipe->projection : "perspective"},
        {"tilelight:layout", recipe->layout ? recipe->layout : "float"},
        {"tilelight:lights", recipe->lights},
    };
    const exr_attr_m44f_t view = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    exr_attr_box2f_t frustum;
    frustum.min.x = frustum.min.y = -1.0f;
    frustum.max.x = frustum.max.y = 1.0f;
    for (size_t i = 0; i < COUNT_OF(texts); i++)
        if (texts[i].value && exr_recipe_wants(recipe, texts[i].name) &&
            !exr_recipe_wrongs(recipe, file, texts[i].name))
            exr_must(exr_attr_set_string(file, 0, texts[i].name, texts[i].value),
                     texts[i].name);
    if (exr_recipe_wants(recipe, "tilelight:version") &&
        !exr_recipe_wrongs(recipe, file, "tilelight:version"))
        exr_must(exr_attr_set_int(file, 0, "tilelight:version",
                                  recipe->version ? recipe->version : 1),
                 "version");
    if (recipe->samples != 0 && !exr_recipe_wrongs(recipe, file, "tilelight:samples"))
        exr_must(exr_attr_set_int(file, 0, "tilelight:samples", recipe->samples), "samples");
    if (exr_recipe_wants(recipe, "tilelight:near"))
        exr_must(exr_attr_set_float(file, 0, "tilelight:near",
                                    recipe->near != 0.0f ? recipe->near : 0.5f),
                 "near");
    if (exr_recipe_wants(recipe, "tilelight:far"))
        exr_must(exr_attr_set_float(file, 0, "tilelight:far", 100.0f), "far");
    if (exr_recipe_wants(recipe, "tilelight:frustum"))
        exr_must(exr_attr_set_box2f(file, 0, "tilelight:frustum", &frustum), "frustum");
    if (exr_recipe_wants(recipe, "tilelight:viewFromWorld"))
        exr_must(exr_attr_set_m44f(file, 0, "tilelight:viewFromWorld", &view), "view");
}

static inline void exr_recipe_add_channel(const exr_recipe *recipe,
                                          exr_context_t file,
                                          int part,
                                          const char *name)
{
    const int is_uint = recipe->uint_channel && strcmp(name, recipe->uint_channel) == 0;
    const int step =
        recipe->sparse_channel && strcmp(name, recipe->sparse_channel) == 0 ? 2 : 1;
    const exr_pixel_type_t type = is_uint                          ? EXR_PIXEL_UINT
                                  : recipe->type == EXR_PIXEL_HALF ? EXR_PIXEL_HALF
                                                                   : EXR_PIXEL_FLOAT;
    if (!recipe->without_channel || strcmp(name, recipe->without_channel) != 0)
        exr_must(exr_add_channel(file, part, name, type, EXR_PERCEPTUALLY_LINEAR, step, step),
                 name);
}

/* One chunk from values made for the purpose. */
static inline void exr_recipe_chunk(const exr_recipe *recipe,
                                    exr_context_t file,
                                    int part,
                                    int first_row,
                                    exr_encode_pipeline_t *pipeline)
{
    exr_chunk_info_t info;
    float *rows[EXR_RECIPE_CHANNELS] = {NULL};
    exr_must(exr_write_scanline_chunk_info(file, part, first_row, &info), "chunk info");
    exr_must(exr_encoding_initialize(file, part, &info, pipeline), "encoding");
    for (int c = 0; c < pipeline->channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[c];
        const int is_uint = channel->data_type == EXR_PIXEL_UINT;
        rows[c] = calloc((size_t)recipe->width * (size_t)info.height, sizeof(float));
        assert_non_null(rows[c]);
        for (int y = 0; y < info.height && !is_uint; y++)
            for (int x = 0; x < recipe->width; x++)
                rows[c][y * recipe->width + x] =
                    exr_recipe_value(channel->channel_name, x, first_row + y);
        channel->user_data_type = is_uint ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = 4;
        channel->user_pixel_stride = 4;
        channel->user_line_stride = recipe->width * 4;
        channel->encode_from_ptr = (const uint8_t *)rows[c];
    }
    exr_must(exr_encoding_choose_default_routines(file, part, pipeline), "routines");
    exr_must(exr_encoding_run(file, part, pipeline), "encoding");
    exr_must(exr_encoding_destroy(file, pipeline), "encoding");
    for (int c = 0; c < EXR_RECIPE_CHANNELS; c++)
        free(rows[c]);
}

static inline void exr_recipe_part(const exr_recipe *recipe, exr_context_t file, int part)
{
    const int shift = recipe->both_windows_offset;
    const exr_attr_box2i_t display = {
        .min = {.x = shift, .y = 0},
        .max = {.x = shift + recipe->width - 1, .y = recipe->height - 1}};
    exr_attr_box2i_t data = display;
    const exr_attr_v2f_t center = {.x = 0.0f, .y = 0.0f};
    data.min.x += recipe->window_offset;
    data.max.x += recipe->window_offset;
    exr_must(exr_initialize_required_attr(file, part, &display, &data, 1.0f, &center, 1.0f,
                                          EXR_LINEORDER_INCREASING_Y, recipe->compression),
             "required attributes");
    for (size_t i = 0; i < COUNT_OF(exr_recipe_channels); i++)
        exr_recipe_add_channel(recipe, file, part, exr_recipe_channels[i]);
    for (size_t i = 0; i < COUNT_OF(recipe->extra_channels); i++)
        if (recipe->extra_channels[i])
            exr_recipe_add_channel(recipe, file, part, recipe->extra_channels[i]);
}

/* The library's own writer removes a file that got no pixels. */
static inline int64_t exr_recipe_put(exr_const_context_t file,
                                     void *descriptor,
                                     const void *bytes,
                                     uint64_t size,
                                     uint64_t offset,
                                     exr_stream_error_func_ptr_t report)
{
    (void)file;
    (void)report;
    return pwrite(*(int *)descriptor, bytes, size, (off_t)offset);
}

/* Tiled and deep files get a header and no pixels: reading them ends before. */
static inline void exr_recipe_write(const exr_recipe *recipe, const char *path)
{
    exr_context_initializer_t quiet = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file = NULL;
    const int part_count = recipe->second_part ? 2 : 1;
    int part, lines;
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    assert_true(descriptor >= 0);
    quiet.write_fn = exr_recipe_put;
    quiet.user_data = &descriptor;
    exr_must(exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &quiet), path);
    for (int i = 0; i < part_count; i++) {
        exr_must(exr_add_part(file, i == 0 ? "surface" : "beneath", recipe->storage, &part),
                 "part");
        exr_recipe_part(recipe, file, i);
    }
    if (recipe->storage == EXR_STORAGE_TILED || recipe->storage == EXR_STORAGE_DEEP_TILED)
        exr_must(
            exr_set_tile_descriptor(file, 0, 16, 16, EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN),
            "tiles");
    exr_recipe_attributes(recipe, file);
    exr_must(exr_write_header(file), "header");
    for (int i = 0; i < part_count && recipe->storage == EXR_STORAGE_SCANLINE; i++) {
        exr_must(exr_get_scanlines_per_chunk(file, i, &lines), "lines");
        for (int y = 0; y < recipe->height; y += lines) {
            exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
            exr_recipe_chunk(recipe, file, i, y, &pipeline);
        }
    }
    exr_finish(&file);
    close(descriptor);
}

#endif
