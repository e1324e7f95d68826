/* Are PNG files read to the values they hold, whatever their colour type; do ours come back; are
 * damaged ones refused? */
#define _GNU_SOURCE /* truncate, mknod */
#include "file_cases.h"

#include "full_device.h"
#include "png_cases.h"
#include "tilelight/image.h"

#include <unistd.h>

static void values_of_every_colour_type(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "case.png");
    for (size_t i = 0; i < COUNT_OF(png_cases); i++) {
        tl_error err;
        tl_image *image = NULL;
        int is_png = 0;
        save_bytes(path, png_cases[i].bytes, png_cases[i].size);
        if (tl_image_read(path, &image, &is_png, &err) != TL_OK)
            fail_msg("%s: %s", png_cases[i].name, err.message);
        assert_int_equal(is_png, 1);
        assert_int_equal(image->width, png_cases[i].width);
        assert_int_equal(image->height, png_cases[i].height);
        for (unsigned y = 0; y < image->height; y++)
            for (unsigned x = 0; x < image->width; x++)
                for (unsigned c = 0; c < 3; c++) {
                    const float got = tl_image_plane(image, c)[y * image->pitch + x];
                    const float sample = png_cases[i].samples[(y * image->width + x) * 3 + c];
                    if (!same_bits(got, sample / png_cases[i].largest))
                        fail_msg("%s: (%u, %u) channel %u is %g, not %g / %g",
                                 png_cases[i].name, x, y, c, (double)got, (double)sample,
                                 (double)png_cases[i].largest);
                }
        tl_image_destroy(image);
    }
    remove(path);
}

static uint8_t *make_rgb(uint32_t width, uint32_t height)
{
    uint32_t random = width;
    uint8_t *rgb = malloc((size_t)width * height * 3);
    assert_non_null(rgb);
    for (size_t i = 0; i < (size_t)width * height * 3; i++)
        rgb[i] = (uint8_t)(next_random(&random) >> 24);
    return rgb;
}

static void ours_come_back(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {1, 50}, {333, 1}, {67, 129}};
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "ours.png");
    for (size_t s = 0; s < COUNT_OF(sizes); s++) {
        const uint32_t width = sizes[s][0], height = sizes[s][1];
        tl_error err;
        tl_image *image = NULL;
        uint8_t *rgb = make_rgb(width, height);
        ASSERT_OK(tl_png_write(path, rgb, width, height, TL_CURVE_SRGB, &err), err);
        ASSERT_OK(tl_image_read(path, &image, NULL, &err), err);
        assert_int_equal(image->width, width);
        assert_int_equal(image->height, height);
        for (size_t i = 0; i < (size_t)width * height * 3; i++) {
            const size_t x = i / 3 % width, y = i / 3 / width;
            const float got = tl_image_plane(image, (unsigned)(i % 3))[y * image->pitch + x];
            assert_true(same_bits(got, (float)rgb[i] / 255.0f));
        }
        tl_image_destroy(image);
        free(rgb);
    }
    remove(path);
}

static void deep_ones_come_back(void **state)
{
    enum { WIDTH = 67, HEIGHT = 29 };
    static uint16_t rgb[3 * WIDTH * HEIGHT];
    uint32_t random = 3;
    char path[512];
    tl_error err;
    tl_image *image = NULL;
    (void)state;
    scratch_path(path, sizeof path, "deep.png");
    for (size_t i = 0; i < COUNT_OF(rgb); i++)
        rgb[i] = (uint16_t)(next_random(&random) >> 16);
    ASSERT_OK(tl_png_write_deep(path, rgb, WIDTH, HEIGHT, TL_CURVE_SRGB, &err), err);
    ASSERT_OK(tl_image_read(path, &image, NULL, &err), err);
    assert_int_equal(image->width, WIDTH);
    assert_int_equal(image->height, HEIGHT);
    for (size_t i = 0; i < COUNT_OF(rgb); i++) {
        const size_t x = i / 3 % WIDTH, y = i / 3 / WIDTH;
        const float got = tl_image_plane(image, (unsigned)(i % 3))[y * image->pitch + x];
        assert_true(same_bits(got, (float)rgb[i] / 65535.0f));
    }
    tl_image_destroy(image);
    remove(path);
}

/* IHDR stands first (ISO/IEC 15948, 5.6): 8 bits, colour type 2, not interlaced. */
static void ours_say_srgb(void **state)
{
    static const unsigned char header[] = {0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0,
                                           3, 0, 0, 0,  2,   8,   2,   0,   0, 0};
    static const unsigned char srgb[] = {0, 0, 0, 1, 's', 'R', 'G', 'B', 0};
    (void)state;
    char path[512];
    tl_error err;
    size_t size;
    int found = 0;
    uint8_t *rgb = make_rgb(3, 2);
    scratch_path(path, sizeof path, "srgb.png");
    ASSERT_OK(tl_png_write(path, rgb, 3, 2, TL_CURVE_SRGB, &err), err);
    unsigned char *bytes = load_bytes(path, &size);
    assert_memory_equal(bytes + 8, header, sizeof header);
    for (size_t i = 0; i + sizeof srgb <= size; i++)
        found += memcmp(bytes + i, srgb, sizeof srgb) == 0;
    assert_int_equal(found, 1);
    free(bytes);
    free(rgb);
    remove(path);
}

static void truncations_are_refused(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "cut.png");
    for (size_t i = 0; i < COUNT_OF(png_cases); i++) {
        save_bytes(path, png_cases[i].bytes, png_cases[i].size);
        /* The last 4 bytes are the checksum of the end chunk, which holds nothing. */
        for (size_t length = png_cases[i].size - 4; length-- > 0;) {
            tl_error err = {.status = TL_OK};
            tl_image *image = NULL;
            assert_int_equal(truncate(path, (off_t)length), 0);
            if (tl_image_read(path, &image, NULL, &err) != TL_ERR_FORMAT ||
                !strstr(err.message, path))
                fail_msg("%s, cut to %zu bytes: %s", png_cases[i].name, length, err.message);
            assert_null(image);
        }
    }
    remove(path);
}

static void changed_bytes_do_no_harm(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "changed.png");
    for (size_t i = 0; i < COUNT_OF(png_cases); i++) {
        unsigned char bytes[sizeof png_cases[i].bytes];
        memcpy(bytes, png_cases[i].bytes, sizeof bytes);
        for (size_t at = 0; at < png_cases[i].size; at++) {
            tl_error err = {.status = TL_OK};
            tl_image *image = NULL;
            bytes[at] ^= 0x41;
            save_bytes(path, bytes, png_cases[i].size);
            if (tl_image_read(path, &image, NULL, &err) != TL_OK)
                assert_non_null(strstr(err.message, path));
            tl_image_destroy(image);
            bytes[at] ^= 0x41;
        }
    }
    remove(path);
}

static void others_are_refused(void **state)
{
    static const char *const neither[] = {"neither", "PNG", NULL};
    static const char *const absent[] = {"cannot be opened", NULL};
    static const char *const folder[] = {"cannot be read", NULL};
    static const char *const full_words[] = {"No space", NULL};
    (void)state;
    char path[512], full[512];
    tl_error err;
    tl_image *image = NULL;
    static const uint8_t rgb[3] = {1, 2, 3};
    scratch_path(path, sizeof path, "other.png");
    remove(path); /* of a run that failed */
    assert_refused("absent", tl_image_read(path, &image, NULL, &err), TL_ERR_READ, &err,
                   absent);
    save_bytes(path, "GIF89a", 6);
    assert_refused("gif", tl_image_read(path, &image, NULL, &err), TL_ERR_FORMAT, &err,
                   neither);
    assert_refused("folder", tl_image_read("/", &image, NULL, &err), TL_ERR_READ, &err, folder);
    own_device(full, sizeof full, "png_full", 7);
    assert_refused("full", tl_png_write(full, rgb, 1, 1, TL_CURVE_SRGB, &err), TL_ERR_WRITE,
                   &err, full_words);
    remove_device(full);
    assert_null(image);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_every_colour_type),
        cmocka_unit_test(ours_come_back),
        cmocka_unit_test(deep_ones_come_back),
        cmocka_unit_test(ours_say_srgb),
        cmocka_unit_test(truncations_are_refused),
        cmocka_unit_test(changed_bytes_do_no_harm),
        cmocka_unit_test(others_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
