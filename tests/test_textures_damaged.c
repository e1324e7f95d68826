/* Is a texture whose parts are not all there refused by its size, before a decoder takes memory for what is
 * missing? */
#include "decode.h"
#include "picture_parts.h"
#include "png_bytes.h"

/* Where the length of the chunk of pixels stands in what png_encode makes. */
enum { LENGTH_OF_PIXELS = 33 };

static png_bytes picture(void)
{
    static const uint8_t rgba[2 * 4] = {1, 2, 3, 255, 4, 5, 6, 255};
    return png_encode(rgba, 2, 1);
}

static int has_size(const png_bytes *png, size_t size)
{
    uint32_t width = 0, height = 0;
    return tl_decode_size(png->data, size, &width, &height) && width == 2 && height == 1;
}

static void whole_pictures_have_a_size(void **state)
{
    const png_bytes png = picture();
    (void)state;
    assert_int_equal(memcmp(png.data + LENGTH_OF_PIXELS + 4, "IDAT", 4), 0);
    assert_true(has_size(&png, png.size));
    assert_true(has_size(&png, png.size - 4)); /* decoders do without the last checksum */
    free(png.data);
}

static void chunks_beyond_the_end_are_refused(void **state)
{
    static const uint8_t lengths[][4] = {
        {0x55, 0, 0, 0x0f}, {0xff, 0xff, 0xff, 0xff}, {0xff, 0xff, 0xff, 0xf4}, {0, 0, 1, 0}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(lengths); i++) {
        const png_bytes png = picture();
        memcpy(png.data + LENGTH_OF_PIXELS, lengths[i], 4);
        if (has_size(&png, png.size))
            fail_msg("a chunk of %02x%02x%02x%02x bytes is taken for there", lengths[i][0],
                     lengths[i][1], lengths[i][2], lengths[i][3]);
        free(png.data);
    }
}

/* Cut anywhere from the head of the pixels' chunk to its end. */
static void cut_pixels_are_refused(void **state)
{
    const png_bytes png = picture();
    const size_t length = png.data[LENGTH_OF_PIXELS + 3];
    (void)state;
    for (size_t size = LENGTH_OF_PIXELS + 8; size < LENGTH_OF_PIXELS + 8 + length; size++)
        assert_false(has_size(&png, size));
    free(png.data);
}

/* The head of a JPEG with one table, of `per_size` codes of each of the 16 sizes. */
static int table_is_sound(uint8_t per_size)
{
    uint8_t file[4 + 19 + 16 * 256] = {0xff, 0xd8, 0xff, 0xc4};
    const size_t length = 19 + (size_t)16 * per_size;
    file[4] = (uint8_t)(length >> 8);
    file[5] = (uint8_t)length;
    memset(file + 7, per_size, 16);
    return tl_picture_is_sound(file, 4 + length);
}

static void more_codes_than_places_are_refused(void **state)
{
    (void)state;
    assert_true(table_is_sound(1));
    assert_true(table_is_sound(16)); /* 256 in all */
    assert_false(table_is_sound(17));
    assert_false(table_is_sound(255));
}

/* Where a decoder reads on: of a segment that ends in the numbers of codes, and of a file that does. */
static void cut_tables_are_refused(void **state)
{
    static const uint8_t file[] = {0xff, 0xd8, 0xff, 0xc4, 0, 4, 0, 255, 255, 255};
    uint32_t width, height;
    (void)state;
    assert_false(tl_picture_is_sound(file, sizeof file));
    assert_false(tl_decode_size(file, sizeof file, &width, &height));
    assert_true(tl_picture_is_sound(file, 8)); /* 255 codes */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_pictures_have_a_size),
        cmocka_unit_test(chunks_beyond_the_end_are_refused),
        cmocka_unit_test(cut_pixels_are_refused),
        cmocka_unit_test(more_codes_than_places_are_refused),
        cmocka_unit_test(cut_tables_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
