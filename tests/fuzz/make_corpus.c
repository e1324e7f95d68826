/* Writes inputs that fuzzers start from: good files of every kind that the readers take.
 *
 *   make_corpus FOLDER
 *
 * FOLDER gets a folder for each of the fuzzers that has any. Beside them are the seeds that are kept. */
#define _POSIX_C_SOURCE 200809L
#include "ispc_captures.h"

#include "exr_recipes.h"
#include "foreign_exr.h"
#include "foreign_frame.h"
#include "png_cases.h"

#include "tilelight/gbuffer_file.h"
#include "tilelight/image.h"
#include "tilelight/layouts.h"

#include <sys/stat.h>

static const char *root;

/* FOLDER/fuzzer/name, until the next call. */
static const char *path_of(const char *fuzzer, const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", root, fuzzer);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/%s/%s", root, fuzzer, name);
    return path;
}

/* The largest frame that each layout takes, with lights inside. */
static void own_frames(void)
{
    const tl_camera camera = awkward_camera(9, 5);
    tl_light_set lights = {.ambient = {0.25f, 0.25f, 0.5f}};
    const tl_light light = tl_light_default();
    tl_error err;
    ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    for (int l = 0; l < TL_LAYOUT_COUNT; l++) {
        const enum tl_layout_name layout = (enum tl_layout_name)l;
        const uint32_t metal = l % 2 ? TL_GROUP_PHONG : TL_GROUP_METAL_ROUGH;
        const uint32_t present =
            TL_GROUP_BASE | ((metal | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE | TL_GROUP_BRDF |
                              TL_GROUP_TANGENT) &
                             tl_layout_planes(layout));
        tl_gbuffer *g = NULL;
        char name[64];
        if (tl_gbuffer_create_packed(&camera, layout, tl_layout_planes_of(layout, present), &g,
                                     &err) != TL_OK)
            continue;
        uint32_t random = 7u + (uint32_t)l;
        for (size_t i = 0; i < (size_t)tl_gbuffer_pixel_size(g) * g->rows * g->pitch; i++)
            g->planes[i] = (unsigned char)(next_random(&random) >> 24);
        snprintf(name, sizeof name, "%s.exr", tl_layout_word(layout));
        ASSERT_OK(tl_gbuffer_write(path_of("gbuffer", name), g, &lights, &err), err);
        tl_gbuffer_destroy(g);
    }
    tl_light_set_clear(&lights);
}

static const exr_compression_t compressions[] = {
    EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,   EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
    EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24, EXR_COMPRESSION_B44,  EXR_COMPRESSION_B44A};

static void compressed_frames(void)
{
    for (size_t c = 0; c < COUNT_OF(compressions); c++)
        for (int half = 0; half < 2; half++) {
            const exr_recipe recipe = {.width = 17,
                                       .height = 19,
                                       .compression = compressions[c],
                                       .second_part = c % 2 != 0,
                                       .type = half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT};
            char name[64];
            snprintf(name, sizeof name, "compression-%zu-%d.exr", c, half);
            exr_recipe_write(&recipe, path_of("gbuffer", name));
        }
}

/* The same file behind the options of fuzz_import.c. */
static void put_options(const char *path, const unsigned char options[6])
{
    size_t size;
    unsigned char *const bytes = load_bytes(path, &size);
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(options, 1, 6, file), 6);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    free(bytes);
}

static void foreign_frames(void)
{
    static foreign_frame frame;
    foreign_file file;
    foreign_fill(&frame);
    for (size_t c = 0; c < COUNT_OF(compressions); c++)
        for (int kind = 0; kind < 4; kind++) {
            char name[64];
            foreign_describe(&file, &frame, kind & 1 ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT);
            file.parts[0].compression = compressions[c];
            if (kind & 2) {
                file.parts[0].storage = EXR_STORAGE_TILED;
                file.parts[0].levels = EXR_TILE_MIPMAP_LEVELS;
                file.parts[0].tile_width = file.parts[0].tile_height = 8;
            } else if (kind & 1) {
                file.parts[0].crop[0] = file.parts[0].crop[3] = 2;
            }
            snprintf(name, sizeof name, "frame-%zu-%d.exr", c, kind);
            foreign_write(&file, path_of("import", name));
            put_options(path_of("import", name),
                        (const unsigned char[6]){(unsigned char)c, 0, 0, 0, 7, 0});
        }
}

/* PFM: 1 or 3 numbers, either order of bytes. */
static void pfm_pictures(void)
{
    for (int kind = 0; kind < 4; kind++) {
        char name[64], header[64];
        unsigned char bytes[64 + 4 * 3 * 12];
        const size_t numbers = kind & 1 ? 3 : 1;
        const int length = snprintf(header, sizeof header, "P%c\n4 3\n%s\n",
                                    numbers == 3 ? 'F' : 'f', kind & 2 ? "1.0" : "-1.0");
        uint32_t random = 3;
        memcpy(bytes, header, (size_t)length);
        for (size_t i = 0; i < 12 * numbers; i++) {
            const float value = 0.25f + (float)(next_random(&random) >> 24) / 64.0f;
            memcpy(bytes + length + 4 * i, &value, 4);
        }
        snprintf(name, sizeof name, "picture-%d.pfm", kind);
        save_bytes(path_of("picture", name), bytes, (size_t)length + 4 * 12 * numbers);
        save_bytes(path_of("import", name), bytes, (size_t)length + 4 * 12 * numbers);
        put_options(path_of("import", name), (const unsigned char[6]){0, 0, 0, 1, 5, 1});
    }
}

static void png_pictures(void)
{
    for (size_t i = 0; i < COUNT_OF(png_cases); i++) {
        char name[64];
        snprintf(name, sizeof name, "case-%zu.png", i);
        save_bytes(path_of("picture", name), png_cases[i].bytes, png_cases[i].size);
        save_bytes(path_of("texture", name), png_cases[i].bytes, png_cases[i].size);
        save_bytes(path_of("import", name), png_cases[i].bytes, png_cases[i].size);
        put_options(path_of("import", name), (const unsigned char[6]){0, 0, 0, 0, 5, 1});
    }
}

static void exr_pictures(void)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(9, 5, &image, &err), err);
    for (size_t i = 0; i < (size_t)3 * image->rows * image->pitch; i++)
        image->planes[i] = (float)(i % 97) * 0.125f;
    ASSERT_OK(
        tl_image_write_exr(path_of("picture", "float.exr"), image, (tl_exr_form){0}, &err),
        err);
    ASSERT_OK(tl_image_write_exr(path_of("picture", "half.exr"), image,
                                 (tl_exr_form){.half = 1}, &err),
              err);
    tl_image_destroy(image);
}

static void ispc_captures(void)
{
    static unsigned char bytes[ISPC_MOST];
    for (int reversed = 0; reversed < 2; reversed++) {
        const ispc_capture example = ispc_example(8, 5, reversed);
        const size_t size = ispc_bytes(&example, bytes);
        save_bytes(path_of("ispc", reversed ? "reversed.bin" : "plain.bin"), bytes, size);
    }
}

/* What fuzz_culling.c reads a frame from, written in its order. */
typedef struct frame_bytes {
    unsigned char bytes[1024];
    size_t size;
    uint32_t random;
} frame_bytes;

static void put_byte(frame_bytes *to, uint32_t value)
{
    to->bytes[to->size++] = (unsigned char)value;
}

/* Within 127 sixteenths. */
static void put_number(frame_bytes *to, double value)
{
    put_byte(to, 28);
    put_byte(to, (uint32_t)(128 + lround(16.0 * value)));
}

static uint32_t any_below(frame_bytes *to, uint32_t count)
{
    return (next_random(&to->random) >> 16) % count;
}

static void put_any(frame_bytes *to, double low, double high)
{
    put_number(to, low + (high - low) * any_below(to, 1000) / 1000.0);
}

/* At the origin, looking along -z, x and y within 0.75 of the depth; of 24 x 20 pixels at most. */
static void put_camera(frame_bytes *to)
{
    put_byte(to, any_below(to, 4) == 0); /* orthographic now and then */
    put_byte(to, 15 + any_below(to, 9));
    put_byte(to, 11 + any_below(to, 9));
    put_number(to, -0.75);
    put_number(to, 1.5);
    put_number(to, -0.625);
    put_number(to, 1.25);
    put_number(to, 0.125);
    put_number(to, 7.5);
    put_byte(to, 1);
    put_byte(to, 0); /* no turn */
    for (int i = 0; i < 3; i++)
        put_number(to, 0.0);
}

static void put_light(frame_bytes *to)
{
    const uint32_t kind = any_below(to, 128);
    put_byte(to, kind);
    put_any(to, -3.0, 3.0);
    put_any(to, -3.0, 3.0);
    put_any(to, -7.0, -0.5);
    for (int i = 0; i < 3; i++)
        put_any(to, -1.0, 1.0);
    put_any(to, 0.25, 2.0);
    if (kind & 32)
        put_byte(to, any_below(to, 256));
    put_byte(to, any_below(to, 256));
    put_byte(to, any_below(to, 256));
    put_any(to, 1.0, 7.0);
}

static void frames_to_cull(void)
{
    for (uint32_t i = 0; i < 3 * TL_LAYOUT_COUNT; i++) {
        frame_bytes frame = {.random = i};
        char name[64];
        put_byte(&frame, i % 3);
        put_camera(&frame);
        put_byte(&frame, i);
        for (int k = 0; k < 8; k++) {
            put_any(&frame, 0.5, 6.0);
            put_byte(&frame, any_below(&frame, 256));
        }
        put_byte(&frame, i);
        put_byte(&frame, 12);
        for (int k = 0; k < 12; k++)
            put_light(&frame);
        snprintf(name, sizeof name, "frame-%u", i);
        save_bytes(path_of("culling", name), frame.bytes, frame.size);
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: make_corpus FOLDER\n");
        return 2;
    }
    root = argv[1];
    mkdir(root, 0777);
    own_frames();
    compressed_frames();
    foreign_frames();
    pfm_pictures();
    png_pictures();
    exr_pictures();
    ispc_captures();
    frames_to_cull();
    return 0;
}
