/* Is a packed file that contradicts itself, lacks something or is damaged refused, with a sentence that says
 * why? */
#define _POSIX_C_SOURCE 200809L /* setenv, pwrite, truncate */
#include "file_cases.h"

#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"

#include <fcntl.h>
#include <unistd.h>

enum { WIDTH = 3, HEIGHT = 2 };

static const uint32_t phong = TL_GROUP_BASE | TL_GROUP_PHONG;
static const uint32_t metal_rough = TL_GROUP_BASE | TL_GROUP_METAL_ROUGH;

/* Bytes of a good file replaced by as many others; a channel's type stands behind its name. */
#define BYTES(text) text, sizeof text - 1

static const struct {
    const char *name;
    enum tl_layout_name layout;
    int is_metal_rough;
    const char *from;
    size_t from_size;
    const char *to;
    size_t to_size;
    tl_status status;
    const char *words[4];
} cases[] = {
    {"a layout of the future",
     TL_LAYOUT_ISPC,
     0,
     BYTES("ispc"),
     BYTES("ispd"),
     TL_ERR_UNSUPPORTED,
     {"tilelight:layout", "\"ispd\"", "float, float-forward"}},
    {"words of another layout",
     TL_LAYOUT_COMPACT_16,
     0,
     BYTES("compact-16"),
     BYTES("compact-12"),
     TL_ERR_FORMAT,
     {"\"word00.depth\" is float", "must be uint"}},
    {"no layout",
     TL_LAYOUT_ISPC,
     0,
     BYTES("tilelight:layout"),
     BYTES("tilelight:layouX"),
     TL_ERR_FORMAT,
     {"no attribute \"tilelight:layout\""}},
    {"no planes",
     TL_LAYOUT_ISPC,
     0,
     BYTES("tilelight:planes"),
     BYTES("tilelight:planeX"),
     TL_ERR_FORMAT,
     {"no attribute \"tilelight:planes\"", "string"}},
    {"a plane that is none",
     TL_LAYOUT_ISPC,
     0,
     BYTES("N.Z albedo"),
     BYTES("N.W albedo"),
     TL_ERR_FORMAT,
     {"tilelight:planes", "\"N.W\" is no plane"}},
    {"a plane of no name",
     TL_LAYOUT_ISPC,
     0,
     BYTES("N.Z albedo.R"),
     BYTES("N.Z  lbedo.R"),
     TL_ERR_FORMAT,
     {"\"\" is no plane"}},
    {"a plane twice",
     TL_LAYOUT_ISPC,
     0,
     BYTES("N.Y N.Z"),
     BYTES("N.Y N.Y"),
     TL_ERR_FORMAT,
     {"\"N.Y\" is there twice"}},
    {"a plane that the layout cannot hold",
     TL_LAYOUT_ISPC,
     0,
     BYTES(" shininess"),
     BYTES(" roughness"),
     TL_ERR_FORMAT,
     {"layout ispc has no place for \"roughness\""}},
    {"an index and a specular colour in the same bits",
     TL_LAYOUT_MERLIN,
     0,
     BYTES(" shininess"),
     BYTES(" brdf\0    "),
     TL_ERR_FORMAT,
     {"layout merlin has one place", "\"brdf\""}},
    {"planes of another frame",
     TL_LAYOUT_COMPACT_16,
     1,
     BYTES("metallic roughness"),
     BYTES("ao roughness\0     "),
     TL_ERR_FORMAT,
     {"metallic and roughness", "all of it"}},
    {"a word under another name",
     TL_LAYOUT_ISPC,
     0,
     BYTES("word03.specular"),
     BYTES("word03.reflects"),
     TL_ERR_FORMAT,
     {"no channel \"word03.specular\""}},
    {"a half in place of a whole number",
     TL_LAYOUT_ISPC,
     0,
     BYTES("word05.albedo\0\0"),
     BYTES("word05.albedo\0\1"),
     TL_ERR_FORMAT,
     {"\"word05.albedo\" is half", "must be uint"}},
    {"a float in place of a whole number",
     TL_LAYOUT_ISPC,
     0,
     BYTES("word05.albedo\0\0"),
     BYTES("word05.albedo\0\2"),
     TL_ERR_FORMAT,
     {"\"word05.albedo\" is float", "must be uint"}},
    {"a whole number in place of a float",
     TL_LAYOUT_ISPC,
     0,
     BYTES("word00.depth\0\2"),
     BYTES("word00.depth\0\0"),
     TL_ERR_FORMAT,
     {"\"word00.depth\" is uint", "must be float"}},
    {"a half in place of a float",
     TL_LAYOUT_ISPC,
     0,
     BYTES("word00.depth\0\2"),
     BYTES("word00.depth\0\1"),
     TL_ERR_FORMAT,
     {"\"word00.depth\" is half", "must be float"}},
    {"infinitely far, and depth a share of it",
     TL_LAYOUT_FLOAT_FRACTION,
     0,
     BYTES("tilelight:far\0float\0\4\0\0\0\0\0\x7a\x43"),
     BYTES("tilelight:far\0float\0\4\0\0\0\0\0\x80\x7f"),
     TL_ERR_FORMAT,
     {"layout float-fraction", "infinitely far"}},
};

/* The far plane of awkward_camera is at 250 m, 0x437a0000. */
static unsigned char *make(const char *path,
                           enum tl_layout_name layout,
                           uint32_t present,
                           size_t *size)
{
    tl_error err;
    tl_gbuffer *g = NULL;
    tl_light_set lights = {0};
    const tl_light light = tl_light_default();
    const tl_camera camera = awkward_camera(WIDTH, HEIGHT);
    ASSERT_OK(tl_gbuffer_create_packed(&camera, layout, present, &g, &err), err);
    ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    ASSERT_OK(tl_gbuffer_write(path, g, &lights, &err), err);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
    return load_bytes(path, size);
}

static void replace(const char *name, unsigned char *bytes, size_t size, size_t index)
{
    const size_t length = cases[index].from_size;
    assert_int_equal(length, cases[index].to_size);
    for (size_t i = 0; i + length <= size; i++)
        if (memcmp(bytes + i, cases[index].from, length) == 0) {
            memcpy(bytes + i, cases[index].to, length);
            return;
        }
    fail_msg("%s: nothing to replace", name);
}

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "words_refused.exr");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err = {.status = TL_OK};
        tl_gbuffer *gbuffer = NULL;
        size_t size;
        unsigned char *bytes = make(
            path, cases[i].layout,
            cases[i].is_metal_rough ? metal_rough : phong & tl_layout_planes(cases[i].layout),
            &size);
        replace(cases[i].name, bytes, size, i);
        save_bytes(path, bytes, size);
        free(bytes);
        const tl_status status = tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err);
        assert_refused(cases[i].name, status, cases[i].status, &err, cases[i].words);
        assert_non_null(strstr(err.message, path));
        assert_null(gbuffer);
    }
    remove(path);
}

/* The last number of the file is the last pixel's albedo, three bytes in a channel of four. */
static void numbers_beyond_their_words_are_refused(void **state)
{
    static const char *const words[] = {"\"word05.albedo\"", "more than 24 bits", NULL};
    (void)state;
    char path[512];
    tl_error err = {.status = TL_OK};
    tl_gbuffer *gbuffer = NULL;
    size_t size;
    scratch_path(path, sizeof path, "words_beyond.exr");
    unsigned char *bytes = make(path, TL_LAYOUT_ISPC, phong, &size);
    bytes[size - 2] = 0xff;
    save_bytes(path, bytes, size);
    ASSERT_OK(tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err), err);
    assert_int_equal(((const uint8_t *)tl_gbuffer_words(gbuffer, 7))[gbuffer->pitch + 2], 0xff);
    tl_gbuffer_destroy(gbuffer);
    gbuffer = NULL;
    bytes[size - 1] = 0x01;
    save_bytes(path, bytes, size);
    free(bytes);
    const tl_status status = tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err);
    assert_refused("25 bits", status, TL_ERR_FORMAT, &err, words);
    assert_null(gbuffer);
    remove(path);
}

/* Reads the file; a failure must bring a sentence. Returns whether it was read. */
static int try_reading(const char *path)
{
    tl_error err = {.status = TL_OK};
    tl_gbuffer *gbuffer = NULL;
    tl_light_set set = {0};
    const tl_status status = tl_gbuffer_read(path, &gbuffer, &set, NULL, &err);
    if (status != TL_OK && (err.status != status || !strstr(err.message, path)))
        fail_msg("status %d without a sentence: \"%s\"", (int)status, err.message);
    if (status != TL_OK && (gbuffer || set.count))
        fail_msg("status %d, and yet outputs", (int)status);
    tl_gbuffer_destroy(gbuffer);
    tl_light_set_clear(&set);
    return status == TL_OK;
}

static void truncations_are_refused(void **state)
{
    (void)state;
    char path[512];
    size_t size;
    scratch_path(path, sizeof path, "words_cut.exr");
    free(make(path, TL_LAYOUT_ISPC, phong, &size));
    assert_true(try_reading(path));
    for (size_t length = size; length-- > 0;) {
        assert_int_equal(truncate(path, (off_t)length), 0);
        if (try_reading(path))
            fail_msg("read although cut to %zu of %zu bytes", length, size);
    }
    remove(path);
}

static void changed_bytes_do_no_harm(void **state)
{
    static const unsigned char changes[] = {0x01, 0x80, 0xff};
    (void)state;
    char path[512];
    size_t size;
    scratch_path(path, sizeof path, "words_changed.exr");
    unsigned char *bytes = make(path, TL_LAYOUT_ISPC, phong, &size);
    const int file = open(path, O_WRONLY);
    assert_true(file >= 0);
    for (size_t i = 0; i < size; i++) {
        for (size_t c = 0; c < COUNT_OF(changes); c++) {
            const unsigned char changed = bytes[i] ^ changes[c];
            assert_int_equal(pwrite(file, &changed, 1, (off_t)i), 1);
            try_reading(path);
        }
        assert_int_equal(pwrite(file, bytes + i, 1, (off_t)i), 1);
    }
    close(file);
    free(bytes);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_wrong_is_named),
        cmocka_unit_test(numbers_beyond_their_words_are_refused),
        cmocka_unit_test(truncations_are_refused),
        cmocka_unit_test(changed_bytes_do_no_harm),
    };
    setenv("TILELIGHT_THREADS", "1", 1); /* starting threads would take most of the time */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
