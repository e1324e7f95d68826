/* Does a damaged OpenEXR file ever do more than be refused? Every truncation of small good files,
 * and changed bytes in header, chunk table and compressed pixels. */
#define _POSIX_C_SOURCE 200809L /* setenv, pwrite, truncate */
#include "file_cases.h"

#include "exr_recipes.h"
#include "tilelight/gbuffer_file.h"

static const char lights[] =
    "{ \"tilelight\": 1, \"lights\": [ { \"type\": \"point\", \"position\": [0, 1, 2] } ] }";

/* Every codec that is read, on pictures small enough for thousands of readings. */
static const struct {
    const char *name;
    exr_recipe recipe;
} files[] = {
    {"none", {.width = 7, .height = 5, .lights = lights}},
    {"rle", {.width = 7, .height = 5, .compression = EXR_COMPRESSION_RLE}},
    {"zips", {.width = 7, .height = 5, .compression = EXR_COMPRESSION_ZIPS}},
    {"zip", {.width = 7, .height = 19, .compression = EXR_COMPRESSION_ZIP}},
    {"piz", {.width = 17, .height = 9, .compression = EXR_COMPRESSION_PIZ}},
    {"pxr24", {.width = 7, .height = 19, .compression = EXR_COMPRESSION_PXR24}},
    {"b44",
     {.width = 17, .height = 9, .compression = EXR_COMPRESSION_B44, .type = EXR_PIXEL_HALF}},
    {"b44a",
     {.width = 17, .height = 9, .compression = EXR_COMPRESSION_B44A, .type = EXR_PIXEL_HALF}},
    {"two parts", {.width = 3, .height = 2, .second_part = 1}},
};

static unsigned char *make(const exr_recipe *recipe, const char *path, size_t *size)
{
    exr_recipe_write(recipe, path);
    return load_bytes(path, size);
}

/* Reads the file; a failure must bring a sentence. Returns whether it was read. */
static int try_reading(const char *name, const char *path)
{
    tl_error err = {.status = TL_OK};
    tl_gbuffer *gbuffer = NULL;
    tl_light_set set = {0};
    const tl_status status = tl_gbuffer_read(path, &gbuffer, &set, NULL, &err);
    if (status != TL_OK && (err.status != status || !strstr(err.message, path)))
        fail_msg("%s: status %d without a sentence: \"%s\"", name, status, err.message);
    if (status != TL_OK && (gbuffer || set.count))
        fail_msg("%s: status %d, and yet outputs", name, status);
    tl_gbuffer_destroy(gbuffer);
    tl_light_set_clear(&set);
    return status == TL_OK;
}

/* The last part of a file of two is not read, so a file may lack some of it. */
static void truncations_are_refused(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "damaged.exr");
    for (size_t f = 0; f < COUNT_OF(files); f++) {
        size_t size;
        unsigned char *bytes = make(&files[f].recipe, path, &size);
        assert_true(try_reading(files[f].name, path));
        free(bytes);
        for (size_t length = size; length-- > 0;) {
            assert_int_equal(truncate(path, (off_t)length), 0);
            if (try_reading(files[f].name, path) && !files[f].recipe.second_part)
                fail_msg("%s: read although cut to %zu of %zu bytes", files[f].name, length,
                         size);
        }
    }
    remove(path);
}

static void changed_bytes_do_no_harm(void **state)
{
    static const unsigned char changes[] = {0x01, 0x80, 0xff};
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "damaged.exr");
    for (size_t f = 0; f < COUNT_OF(files); f++) {
        size_t size;
        unsigned char *bytes = make(&files[f].recipe, path, &size);
        const int file = open(path, O_WRONLY);
        assert_true(file >= 0);
        for (size_t i = 0; i < size; i++) {
            for (size_t c = 0; c < COUNT_OF(changes); c++) {
                const unsigned char changed = bytes[i] ^ changes[c];
                assert_int_equal(pwrite(file, &changed, 1, (off_t)i), 1);
                try_reading(files[f].name, path);
            }
            assert_int_equal(pwrite(file, bytes + i, 1, (off_t)i), 1);
        }
        close(file);
        free(bytes);
    }
    remove(path);
}

/* Several bytes at once, anywhere: 300 a file, the same on every run. */
static void many_changes_do_no_harm(void **state)
{
    (void)state;
    char path[512];
    uint32_t random = 5;
    scratch_path(path, sizeof path, "damaged.exr");
    for (size_t f = 0; f < COUNT_OF(files); f++) {
        size_t size;
        unsigned char *bytes = make(&files[f].recipe, path, &size);
        unsigned char *changed = malloc(size);
        assert_non_null(changed);
        for (int i = 0; i < 300; i++) {
            memcpy(changed, bytes, size);
            for (uint32_t k = 0; k <= (next_random(&random) >> 16) % 12; k++)
                changed[(next_random(&random) >> 8) % size] =
                    (unsigned char)(next_random(&random) >> 24);
            save_bytes(path, changed, size);
            try_reading(files[f].name, path);
        }
        free(changed);
        free(bytes);
    }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truncations_are_refused),
        cmocka_unit_test(changed_bytes_do_no_harm),
        cmocka_unit_test(many_changes_do_no_harm),
    };
    setenv("TILELIGHT_THREADS", "1", 1); /* starting threads would take most of the time */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
