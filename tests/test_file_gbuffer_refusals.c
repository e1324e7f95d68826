/* Is a file that is no good G-buffer refused, with a sentence that says why, and before memory is
 * taken for it? */
#define _POSIX_C_SOURCE 200809L /* pwrite, truncate */
#include "file_cases.h"

#include "exr_recipes.h"
#include "tilelight/gbuffer_file.h"

static const struct {
    const char *name;
    exr_recipe recipe;
    tl_status status;
    const char *words[4];
} cases[] = {
    {"deep",
     {.width = 20, .height = 9, .storage = EXR_STORAGE_DEEP_SCANLINE},
     TL_ERR_UNSUPPORTED,
     {"deep scanlines"}},
    {"deep and tiled",
     {.width = 20, .height = 9, .storage = EXR_STORAGE_DEEP_TILED},
     TL_ERR_UNSUPPORTED,
     {"deep tiles"}},
    {"cropped",
     {.width = 5, .height = 3, .window_offset = 1},
     TL_ERR_UNSUPPORTED,
     {"data window", "display window"}},
    {"windows not at the origin",
     {.width = 5, .height = 3, .both_windows_offset = -2},
     TL_ERR_UNSUPPORTED,
     {"data window (-2, 0)"}},
    {"no depth",
     {.width = 5, .height = 3, .without_channel = "Z"},
     TL_ERR_FORMAT,
     {"no channel \"Z\""}},
    {"two thirds of a normal",
     {.width = 5, .height = 3, .without_channel = "N.Y"},
     TL_ERR_FORMAT,
     {"no channel \"N.Y\""}},
    {"no blue",
     {.width = 5, .height = 3, .without_channel = "albedo.B"},
     TL_ERR_FORMAT,
     {"no channel \"albedo.B\""}},
    {"half a group",
     {.width = 5, .height = 3, .extra_channels = {"metallic"}},
     TL_ERR_FORMAT,
     {"no channel \"roughness\""}},
    {"a third of a group",
     {.width = 5, .height = 3, .extra_channels = {"emissive.G"}},
     TL_ERR_FORMAT,
     {"no channel \"emissive.R\""}},
    {"depth in whole numbers",
     {.width = 5, .height = 3, .uint_channel = "Z"},
     TL_ERR_FORMAT,
     {"\"Z\"", "whole numbers"}},
    {"a channel for every other pixel",
     {.width = 6, .height = 4, .sparse_channel = "albedo.R"},
     TL_ERR_UNSUPPORTED,
     {"\"albedo.R\"", "2 x 2"}},
    {"not ours",
     {.width = 5, .height = 3, .without_attribute = "tilelight:version"},
     TL_ERR_UNSUPPORTED,
     {"tilelight:version", "camera is missing"}},
    {"of the future",
     {.width = 5, .height = 3, .version = 2},
     TL_ERR_UNSUPPORTED,
     {"version 2", "version 1"}},
    {"a version of another type",
     {.width = 5, .height = 3, .wrong_attribute = "tilelight:version"},
     TL_ERR_FORMAT,
     {"tilelight:version", "int"}},
    {"samples that make no square",
     {.width = 10, .height = 5, .samples = 5},
     TL_ERR_FORMAT,
     {"tilelight:samples", "is 5", "square number from 1 to 64"}},
    {"no samples",
     {.width = 10, .height = 5, .samples = -4},
     TL_ERR_FORMAT,
     {"tilelight:samples", "is -4"}},
    {"more samples than there may be",
     {.width = 9, .height = 9, .samples = 81},
     TL_ERR_FORMAT,
     {"tilelight:samples", "is 81"}},
    {"half a pixel of samples",
     {.width = 6, .height = 5, .samples = 4},
     TL_ERR_FORMAT,
     {"6 x 5 pixels", "2 x 2 samples"}},
    {"samples of another type",
     {.width = 6, .height = 4, .samples = 4, .wrong_attribute = "tilelight:samples"},
     TL_ERR_FORMAT,
     {"tilelight:samples", "int"}},
    {"another layout",
     {.width = 5, .height = 3, .layout = "octahedral"},
     TL_ERR_UNSUPPORTED,
     {"tilelight:layout", "\"octahedral\"", "float, float-forward"}},
    {"no layout",
     {.width = 5, .height = 3, .without_attribute = "tilelight:layout"},
     TL_ERR_FORMAT,
     {"tilelight:layout"}},
    {"another projection",
     {.width = 5, .height = 3, .projection = "fisheye"},
     TL_ERR_UNSUPPORTED,
     {"\"fisheye\"", "perspective"}},
    {"no projection",
     {.width = 5, .height = 3, .without_attribute = "tilelight:projection"},
     TL_ERR_FORMAT,
     {"tilelight:projection"}},
    {"no near plane",
     {.width = 5, .height = 3, .without_attribute = "tilelight:near"},
     TL_ERR_FORMAT,
     {"tilelight:near", "float"}},
    {"no far plane",
     {.width = 5, .height = 3, .without_attribute = "tilelight:far"},
     TL_ERR_FORMAT,
     {"tilelight:far"}},
    {"no frustum",
     {.width = 5, .height = 3, .without_attribute = "tilelight:frustum"},
     TL_ERR_FORMAT,
     {"tilelight:frustum", "box2f"}},
    {"placed nowhere",
     {.width = 5, .height = 3, .without_attribute = "tilelight:viewFromWorld"},
     TL_ERR_FORMAT,
     {"tilelight:viewFromWorld", "m44f"}},
    {"near behind far",
     {.width = 5, .height = 3, .near = 200.0f},
     TL_ERR_FORMAT,
     {"tilelight:", "near plane"}},
    {"lights that are no JSON",
     {.width = 5, .height = 3, .lights = "{ \"tilelight\": NaN }"},
     TL_ERR_FORMAT,
     {"tilelight:lights", "line 1", "NaN"}},
    {"lights of another type",
     {.width = 5, .height = 3, .lights = "", .wrong_attribute = "tilelight:lights"},
     TL_ERR_FORMAT,
     {"tilelight:lights", "string"}},
};

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "refused.exr");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err = {.status = TL_OK};
        tl_gbuffer *gbuffer = NULL;
        tl_light_set lights = {0};
        exr_recipe_write(&cases[i].recipe, path);
        const tl_status status = tl_gbuffer_read(path, &gbuffer, &lights, NULL, &err);
        assert_refused(cases[i].name, status, cases[i].status, &err, cases[i].words);
        assert_non_null(strstr(err.message, path));
        assert_null(gbuffer);
        remove(path);
    }
}

/* Overwrites the four ints of a box2i attribute. */
static void patch_window(unsigned char *bytes,
                         size_t size,
                         const char *name,
                         const int32_t box[4])
{
    char key[32];
    const int length = snprintf(key, sizeof key, "%s%cbox2i", name, 0) + 1;
    for (size_t i = 0; i + (size_t)length + 20 < size; i++)
        if (memcmp(bytes + i, key, (size_t)length) == 0) {
            memcpy(bytes + i + length + 4, box, 16);
            return;
        }
    fail_msg("no window %s", name);
}

static const struct {
    const char *name;
    exr_compression_t compression;
    int32_t box[4]; /* x0, y0, x1, y1 */
    size_t padding; /* zeros appended to the file, in bytes */
    const char *words[3];
} windows[] = {
    {"large, uncompressed", EXR_COMPRESSION_NONE, {0, 0, 1023, 1023}, 0, {"cut short"}},
    {"largest, zipped", EXR_COMPRESSION_ZIP, {0, 0, 16383, 16383}, 0, {"cut short"}},
    {"largest, with room for a table of chunks",
     EXR_COMPRESSION_ZIP,
     {0, 0, 16383, 16383},
     40000,
     {"MiB of pixels"}},
    {"one too wide", EXR_COMPRESSION_ZIP, {0, 0, 16384, 3}, 0, {"refused.exr"}},
    {"as large as numbers go",
     EXR_COMPRESSION_ZIP,
     {0, 0, INT32_MAX, INT32_MAX},
     0,
     {"refused.exr"}},
    {"wider than numbers go",
     EXR_COMPRESSION_ZIP,
     {INT32_MIN, 0, INT32_MAX, 1},
     0,
     {"refused.exr"}},
    {"inside out", EXR_COMPRESSION_ZIP, {4, 2, 0, 0}, 0, {"refused.exr"}},
    {"more rows than chunks", EXR_COMPRESSION_ZIP, {0, 0, 4, 4000}, 0, {"refused.exr"}},
};

static void windows_promise_too_much(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "refused.exr");
    for (size_t i = 0; i < COUNT_OF(windows); i++) {
        const exr_recipe recipe = {
            .width = 5, .height = 3, .compression = windows[i].compression};
        tl_error err = {.status = TL_OK};
        tl_gbuffer *gbuffer = NULL;
        size_t size;
        exr_recipe_write(&recipe, path);
        unsigned char *bytes = load_bytes(path, &size);
        patch_window(bytes, size, "dataWindow", windows[i].box);
        patch_window(bytes, size, "displayWindow", windows[i].box);
        save_bytes(path, bytes, size);
        assert_int_equal(truncate(path, (off_t)(size + windows[i].padding)), 0);
        free(bytes);
        const tl_status status = tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err);
        assert_refused(windows[i].name, status, TL_ERR_FORMAT, &err, windows[i].words);
        remove(path);
    }
}

static void files_that_are_none(void **state)
{
    static const char *const absent[] = {"absent.exr", "cannot be opened", NULL};
    static const char *const folder[] = {"no regular file", NULL};
    static const char *const text[] = {"text.exr", "no OpenEXR", NULL};
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *gbuffer = NULL;
    scratch_path(path, sizeof path, "absent.exr");
    remove(path); /* of a run that failed */
    assert_refused("absent", tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err), TL_ERR_READ,
                   &err, absent);
    assert_refused("folder", tl_gbuffer_read("/", &gbuffer, NULL, NULL, &err), TL_ERR_READ,
                   &err, folder);
    scratch_path(path, sizeof path, "text.exr");
    save_bytes(path, "a text that is long enough to hold a header", 43);
    assert_refused("text", tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err), TL_ERR_FORMAT,
                   &err, text);
    save_bytes(path, "", 0);
    assert_refused("empty", tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err), TL_ERR_FORMAT,
                   &err, text);
    assert_null(gbuffer);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_wrong_is_named),
        cmocka_unit_test(windows_promise_too_much),
        cmocka_unit_test(files_that_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
