/* Is a texture whose parts are not all there refused by its size, before a decoder takes memory for what is
 * missing? */
#include "decode.h"
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_pictures_have_a_size),
        cmocka_unit_test(chunks_beyond_the_end_are_refused),
        cmocka_unit_test(cut_pixels_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
