/* Do the words of every layout come back from a file bit for bit, in channels that say what they are and
 * cost what they should? */
#include "file_cases.h"

#include "packing.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/image.h"
#include "tilelight/layouts.h"
#include "word_channels.h"

#include <openexr.h>

/* As many pixels as there are halves, so that each is among them. */
enum { WIDTH = 256, HEIGHT = 256 };

static const uint32_t plane_sets[] = {
    TL_GROUP_BASE,
    TL_GROUP_BASE | TL_GROUP_PHONG,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
    TL_GROUP_BASE | TL_GROUP_OCCLUSION,
    TL_GROUP_BASE | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_HAS(TL_SHININESS) | TL_GROUP_BRDF,
    TL_GROUP_BASE | TL_GROUP_TANGENT,
};

/* 0 and 1 of every kind of word: zeros, infinities, quiet and signalling NaN, denormals. */
static const uint32_t special_words[] = {
    0x00000000, 0x80000000, 0xffffffff, 0x7f800000, 0xff800000, 0x7fc00000,
    0x7fa00000, 0x7f800001, 0xffbfffff, 0x00000001, 0x807fffff, 0x7f7fffff,
    0x7c00fc00, 0xfc017c01, 0x7e007dff, 0x00800080, 0xff00ff00, 0x00ff00ff,
};

static tl_gbuffer *create(const tl_camera *camera, enum tl_layout_name layout, uint32_t present)
{
    tl_gbuffer *made = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create_packed(camera, layout, present, &made, &err), err);
    return made;
}

/* Anything but numbers: both halves of a word run through all 65536 patterns in a frame of WIDTH x HEIGHT,
 * whole words through the special ones and random others. */
static void fill_with_patterns(tl_gbuffer *g)
{
    const tl_word_planes planes = tl_word_planes_of(g);
    const tl_attribute *brdf = &planes.layout->brdf;
    const uint32_t index_word = brdf->code && brdf->channels[0].number == TL_NUMBER_FLOAT
                                    ? brdf->channels[0].word
                                    : TL_MAX_WORDS;
    uint32_t seed = 9;
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const uint32_t index = y * g->camera.width + x;
            tl_words words;
            for (uint32_t w = 0; w < TL_MAX_WORDS; w++) {
                const uint32_t low = (index * 257u + w * 77u) & 0xffffu;
                const uint32_t high = next_random(&seed) & 0xffff0000u;
                words.of[w] = index % 5 == 0
                                  ? special_words[(index / 5 + w) % COUNT_OF(special_words)]
                                  : high | low;
            }
            if (index_word < TL_MAX_WORDS) { /* a whole number in the file */
                const float number = (float)(words.of[index_word] >> 8);
                memcpy(&words.of[index_word], &number, sizeof number);
            }
            tl_words_put(&planes, (size_t)y * g->pitch + x, words);
        }
}

static void assert_same_words(const char *name, const tl_gbuffer *got, const tl_gbuffer *want)
{
    if (got->layout != want->layout || got->present != want->present)
        fail_msg("%s: layout %d or planes %x are not %d, %x", name, (int)got->layout,
                 got->present, (int)want->layout, want->present);
    assert_memory_equal(&got->camera, &want->camera, sizeof got->camera);
    assert_int_equal(got->pitch, want->pitch);
    assert_int_equal(got->rows, want->rows);
    const size_t size = (size_t)want->pitch * want->rows * tl_gbuffer_pixel_size(want);
    for (size_t i = 0; i < size; i++)
        if (got->planes[i] != want->planes[i])
            fail_msg("%s: byte %zu of %zu is %02x, not %02x", name, i, size, got->planes[i],
                     want->planes[i]);
}

static void assert_round_trip(const char *path, const tl_gbuffer *written)
{
    char name[64];
    tl_error err;
    tl_gbuffer *read = NULL;
    snprintf(name, sizeof name, "%s, planes %x", tl_layout_word(written->layout),
             written->present);
    ASSERT_OK(tl_gbuffer_write(path, written, NULL, &err), err);
    if (tl_gbuffer_read(path, &read, NULL, NULL, &err) != TL_OK)
        fail_msg("%s: %s", name, err.message);
    assert_same_words(name, read, written);
    tl_gbuffer_destroy(read);
}

static int has_halves(enum tl_layout_name layout)
{
    tl_word_channel channels[TL_MAX_WORDS];
    const size_t count = tl_word_channels(layout, tl_layout_planes(layout), channels);
    for (size_t i = 0; i < count; i++)
        if (channels[i].type == TL_WORD_HALF)
            return 1;
    return 0;
}

static void every_layout_keeps_its_bits(void **state)
{
    (void)state;
    char path[512];
    const tl_camera large = awkward_camera(WIDTH, HEIGHT), small = awkward_camera(67, 3);
    scratch_path(path, sizeof path, "words.exr");
    for (int l = 0; l < TL_LAYOUT_COUNT; l++)
        for (size_t s = 0; s < COUNT_OF(plane_sets); s++) {
            const enum tl_layout_name layout = (enum tl_layout_name)l;
            if (plane_sets[s] & ~tl_layout_planes(layout))
                continue;
            tl_gbuffer *g = create(has_halves(layout) ? &large : &small, layout, plane_sets[s]);
            fill_with_patterns(g);
            assert_round_trip(path, g);
            tl_gbuffer_destroy(g);
        }
    remove(path);
}

static const struct {
    enum tl_layout_name layout;
    uint32_t present;
    const char *channels; /* name:type, in the file's order, after the preview */
    unsigned pixel_size;  /* bytes in the file, preview included */
} files[] = {
    {TL_LAYOUT_COMPACT_16, TL_GROUP_BASE, "word00.depth:2 word01.normal:0 word02.albedo:0", 20},
    {TL_LAYOUT_COMPACT_16, TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION,
     "word00.depth:2 word01.normal:0 word02.albedo_ao:0 word03.specular_shininess:0", 24},
    {TL_LAYOUT_COMPACT_16, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE,
     "word00.depth:2 word01.normal:0 word02.albedo:0 word03.roughness_metallic:0 "
     "word04.emissive:0",
     28},
    {TL_LAYOUT_COMPACT_12, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION,
     "word00.ao_depth:0 word01.normal_roughness:0 word02.albedo_metallic:0", 20},
    {TL_LAYOUT_TUTORIAL, TL_GROUP_BASE,
     "word00.viewNormal:0 word01.albedo:0 word02.unused:0 word03.depth:2", 24},
    {TL_LAYOUT_MERLIN, TL_GROUP_BASE | TL_GROUP_PHONG,
     "word00.albedo_shininess:0 word01.viewNormal_specular:0 word02.depth:0", 20},
    {TL_LAYOUT_MERLIN, TL_GROUP_BASE | TL_HAS(TL_SHININESS) | TL_GROUP_BRDF,
     "word00.albedo_shininess:0 word01.viewNormal_brdf:0 word02.depth:0", 20},
    {TL_LAYOUT_COMPACT_16, TL_GROUP_BASE | TL_GROUP_BRDF | TL_GROUP_TANGENT,
     "word00.depth:2 word01.normal:0 word02.albedo:0 word05.tangent_brdf:0", 24},
    {TL_LAYOUT_DXR,
     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
     "word00.albedo:0 word01.viewPositionXY:0 word02.viewPositionZ_emissiveR:0 "
     "word03.viewNormalXY:0 word04.viewNormalZ_emissiveG:0 "
     "word05.ao_metallic_roughness_emissiveB:0",
     32},
    /* Three words of a byte each share a channel; a lone one of 16 bits that is no half has 32. */
    {TL_LAYOUT_ISPC, TL_GROUP_BASE | TL_GROUP_PHONG,
     "word00.depth:2 word01.viewNormalU:1 word02.viewNormalV:1 word03.specular:1 "
     "word04.shininess:1 word05.albedo:0",
     24},
    {TL_LAYOUT_SHADERX2_96, TL_GROUP_BASE,
     "word00.worldPositionXY:0 word01.worldPositionZ:1 word02.albedo_normalZ:0 "
     "word03.normalXY:0",
     22},
    {TL_LAYOUT_FLOAT_POSITION, TL_GROUP_BASE,
     "word00.viewPositionX:2 word01.viewPositionY:2 word02.viewPositionZ:2 word03.normalX:2 "
     "word04.normalY:2 word05.normalZ:2 word06.albedoR:2 word07.albedoG:2 word08.albedoB:2",
     44},
};

/* As the library lists them: A, B, G, R come first. */
static void assert_channels(const char *path, const char *wanted)
{
    exr_context_t file = NULL;
    const exr_attr_chlist_t *channels;
    char found[1024] = "";
    size_t length = 0;
    assert_int_equal(exr_start_read(&file, path, NULL), EXR_ERR_SUCCESS);
    assert_int_equal(exr_get_channels(file, 0, &channels), EXR_ERR_SUCCESS);
    for (int i = 4; i < channels->num_channels; i++)
        length += (size_t)snprintf(found + length, sizeof found - length, "%s%s:%d",
                                   i > 4 ? " " : "", channels->entries[i].name.str,
                                   (int)channels->entries[i].pixel_type);
    assert_string_equal(channels->entries[0].name.str, "A");
    assert_string_equal(channels->entries[3].name.str, "R");
    assert_string_equal(found, wanted);
    exr_finish(&file);
}

static size_t file_size_of(const char *path,
                           enum tl_layout_name layout,
                           uint32_t present,
                           uint32_t height)
{
    size_t size;
    tl_error err;
    const tl_camera camera = awkward_camera(WIDTH, height);
    tl_gbuffer *g = create(&camera, layout, present);
    ASSERT_OK(tl_gbuffer_write(path, g, NULL, &err), err);
    free(load_bytes(path, &size));
    tl_gbuffer_destroy(g);
    return size;
}

/* A row costs its pixels, an entry of the table (8 bytes), and its number and size (8). */
static void channels_say_what_they_are_and_cost_no_more(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "channels.exr");
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        const size_t less = file_size_of(path, files[i].layout, files[i].present, 1);
        const size_t more = file_size_of(path, files[i].layout, files[i].present, 11);
        assert_channels(path, files[i].channels);
        assert_int_equal(more - less, 10 * (16 + (size_t)WIDTH * files[i].pixel_size));
        assert_true(less < 2048 + (size_t)WIDTH * files[i].pixel_size);
    }
    remove(path);
}

/* Reads a row of one channel as the library hands it over, without a conversion. */
static void load_row(const char *path, const char *name, void *row, int bytes)
{
    exr_context_t file = NULL;
    exr_chunk_info_t chunk;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    assert_int_equal(exr_start_read(&file, path, NULL), EXR_ERR_SUCCESS);
    assert_int_equal(exr_read_scanline_chunk_info(file, 0, 0, &chunk), EXR_ERR_SUCCESS);
    assert_int_equal(exr_decoding_initialize(file, 0, &chunk, &pipeline), EXR_ERR_SUCCESS);
    for (int c = 0; c < pipeline.channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline.channels[c];
        const int is_it = strcmp(channel->channel_name, name) == 0;
        if (is_it)
            assert_int_equal(channel->bytes_per_element, bytes);
        channel->decode_to_ptr = is_it ? row : NULL;
        channel->user_pixel_stride = channel->user_bytes_per_element;
        channel->user_line_stride = WIDTH * channel->user_bytes_per_element;
    }
    assert_int_equal(exr_decoding_choose_default_routines(file, 0, &pipeline), EXR_ERR_SUCCESS);
    assert_int_equal(exr_decoding_run(file, 0, &pipeline), EXR_ERR_SUCCESS);
    exr_decoding_destroy(file, &pipeline);
    exr_finish(&file);
}

/* Another program finds the words where file-formats.md says: ispc has all three kinds of channel. */
static void another_reader_finds_the_words(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    uint32_t depths[WIDTH], colors[WIDTH];
    uint16_t normals[WIDTH];
    const tl_camera camera = awkward_camera(WIDTH, 2);
    tl_gbuffer *g = create(&camera, TL_LAYOUT_ISPC, TL_GROUP_BASE | TL_GROUP_PHONG);
    const tl_word_planes planes = tl_word_planes_of(g);
    scratch_path(path, sizeof path, "ispc.exr");
    fill_with_patterns(g);
    ASSERT_OK(tl_gbuffer_write(path, g, NULL, &err), err);
    load_row(path, "word00.depth", depths, 4);
    load_row(path, "word01.viewNormalU", normals, 2);
    load_row(path, "word05.albedo", colors, 4);
    for (size_t x = 0; x < WIDTH; x++) {
        assert_int_equal(depths[x], tl_word_at(&planes, 0, x));
        assert_int_equal(normals[x], tl_word_at(&planes, 1, x));
        assert_int_equal(colors[x], tl_word_at(&planes, 5, x) | tl_word_at(&planes, 6, x) << 8 |
                                        tl_word_at(&planes, 7, x) << 16);
    }
    tl_gbuffer_destroy(g);
    remove(path);
}

/* Programs that look for a picture see that of the pixels, whatever they are packed in: the same as in the
 * file of what is unpacked. Wider than what is unpacked at a time. */
static void the_preview_is_that_of_full_float(void **state)
{
    (void)state;
    char path[512];
    const tl_camera camera = awkward_camera(300, 5);
    scratch_path(path, sizeof path, "preview.exr");
    for (int l = 0; l < TL_LAYOUT_COUNT; l++) {
        const enum tl_layout_name layout = (enum tl_layout_name)l;
        const uint32_t present = tl_layout_planes(layout) & (TL_GROUP_BASE | TL_GROUP_EMISSIVE);
        tl_gbuffer *packed = create(&camera, layout, present), *unpacked = NULL;
        tl_image *got = NULL, *want = NULL;
        tl_error err;
        fill_with_patterns(packed);
        ASSERT_OK(tl_gbuffer_repair(packed, "packed", false, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_unpack(packed, &unpacked, &err), err);
        ASSERT_OK(tl_gbuffer_write(path, packed, NULL, &err), err);
        ASSERT_OK(tl_image_read(path, &got, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_write(path, unpacked, NULL, &err), err);
        ASSERT_OK(tl_image_read(path, &want, NULL, &err), err);
        for (unsigned c = 0; c < 3; c++)
            for (uint32_t i = 0; i < camera.width * camera.height; i++) {
                const size_t at = (size_t)(i / camera.width) * got->pitch + i % camera.width;
                const float a = tl_image_plane(got, c)[at], b = tl_image_plane(want, c)[at];
                if (!same_bits(a, b))
                    fail_msg("%s: channel %u of pixel %u is %a, not %a", tl_layout_word(layout),
                             c, i, (double)a, (double)b);
            }
        tl_image_destroy(got);
        tl_image_destroy(want);
        tl_gbuffer_destroy(unpacked);
        tl_gbuffer_destroy(packed);
    }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_keeps_its_bits),
        cmocka_unit_test(channels_say_what_they_are_and_cost_no_more),
        cmocka_unit_test(another_reader_finds_the_words),
        cmocka_unit_test(the_preview_is_that_of_full_float),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
