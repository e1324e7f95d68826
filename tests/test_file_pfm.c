/* Do pictures come back from PFM files bit for bit, and is everything else refused? */
#define _GNU_SOURCE /* truncate, mknod */
#include "file_cases.h"

#include "full_device.h"
#include "tilelight/image.h"

#include <unistd.h>

/* Floats of every kind, NaN and infinity too; padding stays 0. */
static tl_image *make_image(uint32_t width, uint32_t height)
{
    static const uint32_t special[] = {0x00000000, 0x80000000, 0x00000001, 0x7f7fffff,
                                       0x7f800000, 0xff800000, 0x7fc00001, 0xbf800000};
    tl_image *image = NULL;
    tl_error err;
    uint32_t random = 5;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    for (unsigned c = 0; c < 3; c++)
        for (size_t i = 0; i < (size_t)width * height; i++) {
            const uint32_t any = next_random(&random);
            const uint32_t bits = any >> 30 ? any & 0x7effffff : special[any >> 10 & 7];
            memcpy(&tl_image_plane(image, c)[i / width * image->pitch + i % width], &bits, 4);
        }
    return image;
}

static void pictures_come_back(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {129, 1}, {1, 70}, {70, 35}};
    char path[512];
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "picture.pfm");
    for (size_t s = 0; s < COUNT_OF(sizes); s++) {
        tl_image *read = NULL, *image = make_image(sizes[s][0], sizes[s][1]);
        int is_png = 1;
        ASSERT_OK(tl_image_write_pfm(path, image, &err), err);
        ASSERT_OK(tl_image_read(path, &read, &is_png, &err), err);
        assert_int_equal(is_png, 0);
        assert_int_equal(read->width, image->width);
        assert_int_equal(read->height, image->height);
        assert_memory_equal(read->planes, image->planes,
                            (size_t)3 * image->rows * image->pitch * sizeof(float));
        tl_image_destroy(read);
        tl_image_destroy(image);
    }
    remove(path);
}

/* Colour, the lowest byte first, the bottom row first, as it is described. */
static void bytes_are_as_described(void **state)
{
    static const unsigned char wanted[] = {
        'P', 'F', '\n', '1',  ' ', '2', '\n', '-',  '1', '.', '0',  '\n',
        0,   0,   0,    0x40, 0,   0,   0x40, 0x40, 0,   0,   0x80, 0x40, /* below: 2 3 4 */
        0,   0,   0x80, 0x3f, 0,   0,   0,    0x3f, 0,   0,   0x80, 0x3e, /* above: 1 .5 .25 */
    };
    static const float values[2][3] = {{1.0f, 0.5f, 0.25f}, {2.0f, 3.0f, 4.0f}};
    char path[512];
    size_t size;
    tl_image *image = NULL;
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "bytes.pfm");
    ASSERT_OK(tl_image_create(1, 2, &image, &err), err);
    for (unsigned i = 0; i < 6; i++)
        tl_image_plane(image, i % 3)[i / 3 * image->pitch] = values[i / 3][i % 3];
    ASSERT_OK(tl_image_write_pfm(path, image, &err), err);
    unsigned char *bytes = load_bytes(path, &size);
    assert_int_equal(size, sizeof wanted);
    assert_memory_equal(bytes, wanted, sizeof wanted);
    free(bytes);
    tl_image_destroy(image);
    remove(path);
}

/* Files of other programs: one number, the other order of bytes, other white space. */
static void others_are_read(void **state)
{
    static const struct {
        const char *name, *header;
        unsigned char numbers[12];
        size_t numbers_size;
        float expected[3];
    } cases[] = {
        {"gray", "Pf\n1 1\n-1\n", {0, 0, 0x80, 0x3f}, 4, {1, 1, 1}},
        {"big-endian", "Pf 1\t1\r\n+2.5\n", {0x3f, 0, 0, 0}, 4, {0.5, 0.5, 0.5}},
        {"colour",
         "PF\n1\n1\n-0.5\n",
         {0, 0, 0, 0x40, 0, 0, 0, 0, 0, 0, 0x80, 0x3f},
         12,
         {2, 0, 1}},
    };
    char path[512];
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "other.pfm");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        unsigned char bytes[64];
        tl_image *image = NULL;
        const size_t length = strlen(cases[i].header);
        memcpy(bytes, cases[i].header, length);
        memcpy(bytes + length, cases[i].numbers, cases[i].numbers_size);
        save_bytes(path, bytes, length + cases[i].numbers_size);
        ASSERT_OK(tl_image_read(path, &image, NULL, &err), err);
        for (unsigned c = 0; c < 3; c++)
            if (!same_bits(tl_image_plane(image, c)[0], cases[i].expected[c]))
                fail_msg("%s: channel %u is %g", cases[i].name, c,
                         (double)tl_image_plane(image, c)[0]);
        tl_image_destroy(image);
    }
    remove(path);
}

static void what_is_wrong_is_refused(void **state)
{
    static const struct {
        const char *text, *words[3];
    } cases[] = {
        {"PF\n0 1\n-1\n", {"no width and height from 1 to 16384", NULL}},
        {"PF\n1 16385\n-1\n", {"no width and height", NULL}},
        {"PF\n4294967297 1\n-1\nabcdefghijkl", {"no width and height", NULL}},
        {"PF\n1 1\n0\nabcdefghijkl", {"no scale", NULL}},
        {"PF\n1 1\nnan\nabcdefghijkl", {"no scale", NULL}},
        {"PF\n1 1\n-1x\nabcdefghijkl", {"no scale", NULL}},
        {"PF\n16384 16384\n-1\nabcdefghijkl", {"cut short", "3221225", NULL}},
        {"PF\n1 1\n-1\nabcdefghijklm", {"is damaged: 23 bytes", NULL}},
    };
    char path[512];
    tl_error err;
    tl_image *image = NULL;
    (void)state;
    scratch_path(path, sizeof path, "wrong.pfm");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        save_bytes(path, cases[i].text, strlen(cases[i].text));
        assert_refused(cases[i].text, tl_image_read(path, &image, NULL, &err), TL_ERR_FORMAT,
                       &err, cases[i].words);
        assert_null(image);
    }
    remove(path);
}

static void truncations_are_refused(void **state)
{
    char path[512];
    tl_error err;
    tl_image *image = make_image(5, 3), *read = NULL;
    size_t size;
    (void)state;
    scratch_path(path, sizeof path, "cut.pfm");
    ASSERT_OK(tl_image_write_pfm(path, image, &err), err);
    free(load_bytes(path, &size));
    while (size-- > 0) {
        assert_int_equal(truncate(path, (off_t)size), 0);
        if (tl_image_read(path, &read, NULL, &err) != TL_ERR_FORMAT ||
            !strstr(err.message, path))
            fail_msg("cut to %zu bytes: %s", size, err.message);
        assert_null(read);
    }
    tl_image_destroy(image);
    remove(path);
}

static void failures_are_told(void **state)
{
    static const char *const full_words[] = {"No space", NULL};
    static const char *const absent[] = {"absent/x.pfm", "No such file", NULL};
    char path[512], full[512];
    tl_error err;
    tl_image *image = make_image(40, 30);
    (void)state;
    scratch_path(path, sizeof path, "absent/x.pfm");
    own_device(full, sizeof full, "pfm_full", 7);
    assert_refused("full", tl_image_write_pfm(full, image, &err), TL_ERR_WRITE, &err,
                   full_words);
    remove_device(full);
    assert_refused("absent", tl_image_write_pfm(path, image, &err), TL_ERR_WRITE, &err, absent);
    tl_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_come_back),      cmocka_unit_test(bytes_are_as_described),
        cmocka_unit_test(others_are_read),         cmocka_unit_test(what_is_wrong_is_refused),
        cmocka_unit_test(truncations_are_refused), cmocka_unit_test(failures_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
