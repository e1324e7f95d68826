/* Do pictures come back from OpenEXR files: floats bit for bit, halves to the nearest, the same
 * bytes for any number of threads? */
#define _GNU_SOURCE /* setenv, mknod */
#include "file_cases.h"

#include "exr_reader.h"
#include "full_device.h"
#include "tilelight/image.h"

#include <float.h>
#include <unistd.h>

static tl_image *make_image(uint32_t width, uint32_t height)
{
    tl_error err;
    tl_image *image = NULL;
    uint32_t random = 17;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++)
                tl_image_plane(image, c)[(size_t)y * image->pitch + x] =
                    ldexpf((float)(next_random(&random) >> 8), -20 - (int)(random >> 3 & 7));
    return image;
}

/* Half has 11 bits, and steps of 2^-24 below 2^-14; rounding to nearest is off by half a step. */
static void assert_near(float got, float wanted, int half, const char *name)
{
    const double error = fabs((double)got - (double)wanted);
    const double bound = half ? fmax(0x1p-11 * (double)wanted, 0x1p-25) : 0.0;
    if (!(error <= bound))
        fail_msg("%s: %a, not %a", name, (double)got, (double)wanted);
}

static void pictures_come_back(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {129, 1}, {1, 70}, {70, 35}};
    (void)state;
    char path[512], name[64];
    scratch_path(path, sizeof path, "picture.exr");
    for (size_t s = 0; s < COUNT_OF(sizes); s++)
        for (int half = 0; half < 2; half++) {
            tl_error err;
            tl_image *read = NULL, *image = make_image(sizes[s][0], sizes[s][1]);
            int is_png = 1;
            snprintf(name, sizeof name, "%u x %u, %s", image->width, image->height,
                     half ? "half" : "float");
            ASSERT_OK(tl_image_write_exr(path, image, (tl_exr_form){.half = half}, &err), err);
            ASSERT_OK(tl_image_read(path, &read, &is_png, &err), err);
            assert_int_equal(is_png, 0);
            assert_int_equal(read->width, image->width);
            assert_int_equal(read->height, image->height);
            for (unsigned c = 0; c < 3; c++)
                for (size_t i = 0; i < (size_t)image->rows * image->pitch; i++)
                    assert_near(tl_image_plane(read, c)[i], tl_image_plane(image, c)[i], half,
                                name);
            tl_image_destroy(read);
            tl_image_destroy(image);
        }
    remove(path);
}

#define WORD(name, word, is_written, what) [name] = word,
#define WRITTEN(name, word, is_written, what) [name] = is_written,
static const char *const words[] = {TL_EXR_COMPRESSIONS(WORD)};
static const int written[] = {TL_EXR_COMPRESSIONS(WRITTEN)};

/* What a compression adds to the rounding to the file's numbers. Blocks of B44 hold each half to a 64th of
 * how far the block's halves reach, counted from float to float; here they reach over 31 powers of 2 at
 * most, so that half a step is a quarter of one. */
static double rounding_of(tl_exr_form form, double value)
{
    if (form.compression == TL_EXR_PXR24 && !form.half)
        return 0x1p-16 * value;
    const int is_block = form.compression == TL_EXR_B44 || form.compression == TL_EXR_B44A;
    return is_block && form.half ? 0.25 * value + 0x1p-14 : 0.0;
}

static void every_compression_comes_back(void **state)
{
    char path[512];
    tl_error err;
    tl_image *image = make_image(70, 35);
    (void)state;
    scratch_path(path, sizeof path, "compressed.exr");
    for (unsigned k = 0; k < 2 * TL_EXR_COMPRESSION_COUNT; k++) {
        const tl_exr_form form = {.half = (int)(k % 2),
                                  .compression = (tl_exr_compression)(k / 2)};
        tl_image *read = NULL;
        if (!written[form.compression])
            continue;
        ASSERT_OK(tl_image_write_exr(path, image, form, &err), err);
        ASSERT_OK(tl_image_read(path, &read, NULL, &err), err);
        for (size_t i = 0; i < (size_t)3 * image->rows * image->pitch; i++) {
            const double value = (double)image->planes[i];
            const double bound =
                rounding_of(form, value) + (form.half ? fmax(0x1p-11 * value, 0x1p-25) : 0.0);
            if (!(fabs((double)read->planes[i] - value) <= bound))
                fail_msg("%s of %s: %a, not %a", words[form.compression],
                         form.half ? "halves" : "floats", (double)read->planes[i], value);
        }
        tl_image_destroy(read);
    }
    tl_image_destroy(image);
    remove(path);
}

/* The library refuses those that the table says it lacks, and nothing is left of the file. */
static void others_are_not_written(void **state)
{
    static const char *const cannot[] = {"cannot do this", NULL};
    char path[512];
    tl_error err;
    tl_image *image = make_image(70, 35);
    (void)state;
    scratch_path(path, sizeof path, "dwa.exr");
    for (int c = 0; c < TL_EXR_COMPRESSION_COUNT; c++)
        if (!written[c]) {
            const tl_exr_form form = {.half = 1, .compression = (tl_exr_compression)c};
            assert_refused(words[c], tl_image_write_exr(path, image, form, &err),
                           TL_ERR_UNSUPPORTED, &err, cannot);
            assert_int_equal(access(path, F_OK), -1);
        }
    tl_image_destroy(image);
}

/* Halves end at 65504: what is above is that, and nothing that is finite becomes infinite. */
static void halves_hold_no_infinity(void **state)
{
    static const float values[] = {65503.0f, 65504.0f, 65519.0f, 65520.0f, 1e30f, FLT_MAX};
    enum { COUNT = sizeof values / sizeof values[0] };
    char path[512];
    tl_image *image = make_image(COUNT, 1), *read = NULL;
    int is_png = 1;
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "bright.exr");
    for (unsigned c = 0; c < 3; c++)
        memcpy(tl_image_plane(image, c), values, sizeof values);
    assert_int_equal(tl_image_count_above(image, 65504.0f), 4);
    ASSERT_OK(tl_image_write_exr(path, image, (tl_exr_form){.half = 1}, &err), err);
    ASSERT_OK(tl_image_read(path, &read, &is_png, &err), err);
    for (unsigned c = 0; c < 3; c++)
        for (size_t i = 0; i < COUNT; i++)
            assert_true(same_bits(tl_image_plane(read, c)[i], 65504.0f));
    tl_image_destroy(read);
    tl_image_destroy(image);
    remove(path);
}

static void threads_change_nothing(void **state)
{
    static const char *const threads[] = {"1", "2", "5"};
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "picture_threads.exr");
    tl_image *image = make_image(100, 333);
    for (int half = 0; half < 2; half++) {
        unsigned char *first = NULL;
        size_t first_size = 0;
        for (size_t i = 0; i < COUNT_OF(threads); i++) {
            tl_error err;
            size_t size;
            setenv("TILELIGHT_THREADS", threads[i], 1);
            ASSERT_OK(tl_image_write_exr(path, image, (tl_exr_form){.half = half}, &err), err);
            unsigned char *bytes = load_bytes(path, &size);
            if (!first) {
                first = bytes;
                first_size = size;
                continue;
            }
            assert_int_equal(size, first_size);
            assert_memory_equal(bytes, first, size);
            free(bytes);
        }
        free(first);
    }
    unsetenv("TILELIGHT_THREADS");
    tl_image_destroy(image);
    remove(path);
}

/* Layers stand beside the picture under names that begin with theirs, of more than 31 bytes too. */
static void layers_come_back(void **state)
{
    static const char *const channels[3] = {
        "diffuse.G", "light_a name of more than 31 bytes, \xc3\xa9.B", "R"};
    tl_image *image = make_image(33, 21), *one = make_image(33, 21), *two = make_image(33, 21);
    tl_image_layer layers[2] = {{"diffuse", one->planes},
                                {"light_a name of more than 31 bytes, \xc3\xa9", two->planes}};
    const float *const planes[3] = {tl_image_plane(one, 1), tl_image_plane(two, 2),
                                    tl_image_plane(image, 0)};
    char path[512];
    (void)state;
    scratch_path(path, sizeof path, "layers.exr");
    for (size_t at = 0; at < 3 * (size_t)image->pitch * image->rows; at++)
        two->planes[at] = 0.5f * image->planes[at];
    for (int half = 0; half < 2; half++) {
        tl_exr_reader reader = {.is_open = false};
        tl_image *read = make_image(33, 21);
        tl_exr_target targets[3];
        tl_error err;
        ASSERT_OK(
            tl_image_write_layers(path, image, layers, 2, (tl_exr_form){.half = half}, &err),
            err);
        ASSERT_OK(tl_exr_reader_open(&reader, path, &err), err);
        for (unsigned c = 0; c < 3; c++) {
            ASSERT_OK(tl_exr_reader_require(&reader, channels[c], &err), err);
            targets[c] = (tl_exr_target){channels[c], EXR_PIXEL_FLOAT, tl_image_plane(read, c)};
        }
        ASSERT_OK(tl_exr_reader_pixels(&reader, targets, 3, read->pitch, &err), err);
        for (unsigned c = 0; c < 3; c++)
            for (uint32_t y = 0; y < read->height; y++)
                for (uint32_t x = 0; x < read->width; x++) {
                    const size_t at = (size_t)y * read->pitch + x;
                    assert_near(tl_image_plane(read, c)[at], planes[c][at], half, channels[c]);
                }
        tl_exr_reader_close(&reader);
        tl_image_destroy(read);
    }
    tl_image_destroy(two);
    tl_image_destroy(one);
    tl_image_destroy(image);
    remove(path);
}

static void failures_are_told(void **state)
{
    static const char *const full_words[] = {"No space", NULL};
    static const char *const absent[] = {"absent/x.exr", "No such file", NULL};
    (void)state;
    char path[512], full[512];
    tl_error err;
    tl_image *image = make_image(40, 30);
    scratch_path(path, sizeof path, "absent/x.exr");
    own_device(full, sizeof full, "image_full", 7);
    assert_refused("full", tl_image_write_exr(full, image, (tl_exr_form){0}, &err),
                   TL_ERR_WRITE, &err, full_words);
    remove_device(full);
    assert_refused("absent", tl_image_write_exr(path, image, (tl_exr_form){.half = 1}, &err),
                   TL_ERR_WRITE, &err, absent);
    tl_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_come_back),
        cmocka_unit_test(every_compression_comes_back),
        cmocka_unit_test(others_are_not_written),
        cmocka_unit_test(halves_hold_no_infinity),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(layers_come_back),
        cmocka_unit_test(failures_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
