/* Does every beginning of a good scene end in a refusal or in a picture?
 *
 * Also every .glb with one byte of its binary chunk's frame changed, as that is where a parser that
 * trusts lengths reads beyond the file. */
#include "gltf_scene.h"

#include "png_bytes.h"

static const tl_capture_options options = {.width = 4, .height = 4};

static void append_32(png_bytes *to, uint32_t value)
{
    const uint8_t bytes[4] = {(uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16),
                              (uint8_t)(value >> 24)};
    png_append(to, bytes, 4);
}

/* The square as .glb; its data are the binary chunk. */
static png_bytes square_glb(void)
{
    char json[sizeof square_text + 4];
    png_bytes file = {0};
    size_t length = (size_t)snprintf(json, sizeof json, square_text, "");
    while (length % 4 != 0)
        json[length++] = ' ';
    png_append(&file, "glTF", 4);
    append_32(&file, 2);
    append_32(&file, (uint32_t)(12 + 8 + length + 8 + SQUARE_BYTES));
    append_32(&file, (uint32_t)length);
    append_32(&file, 0x4E4F534A);
    png_append(&file, json, length);
    append_32(&file, SQUARE_BYTES);
    append_32(&file, 0x004E4942);
    png_append(&file, &square, SQUARE_BYTES);
    return file;
}

static tl_status capture_bytes(const char *file, const uint8_t *data, size_t size)
{
    char path[512];
    shot taken;
    write_file(scratch_path(path, sizeof path, file), data, size);
    const tl_status status = shoot(path, &options, &taken);
    if (status != TL_OK && (taken.err.status != status || !taken.err.message[0]))
        fail_msg("%s cut to %zu bytes: status %d without a sentence", file, size, (int)status);
    if (status != TL_OK && status != TL_ERR_FORMAT && status != TL_ERR_READ &&
        status != TL_ERR_UNSUPPORTED)
        fail_msg("%s cut to %zu bytes: status %d: %s", file, size, (int)status,
                 taken.err.message);
    shot_clear(&taken);
    return status;
}

static void every_beginning_of_glb(void **state)
{
    const png_bytes file = square_glb();
    (void)state;
    assert_int_equal(capture_bytes("whole.glb", file.data, file.size), TL_OK);
    for (size_t size = 0; size < file.size; size++)
        assert_int_not_equal(capture_bytes("cut.glb", file.data, size), TL_OK);
    free(file.data);
}

/* Cut files whose header says how long they are now: only the chunk's length is wrong. */
static void every_beginning_with_its_length(void **state)
{
    const png_bytes file = square_glb();
    (void)state;
    for (size_t size = 12; size < file.size; size++) {
        file.data[8] = (uint8_t)size;
        file.data[9] = (uint8_t)(size >> 8);
        assert_int_not_equal(capture_bytes("cut.glb", file.data, size), TL_OK);
    }
    free(file.data);
}

static void every_beginning_of_gltf(void **state)
{
    char *const text = square_scene(&square);
    const size_t size = strlen(text);
    (void)state;
    assert_int_equal(capture_bytes("whole.gltf", (const uint8_t *)text, size), TL_OK);
    for (size_t cut = 0; cut + 2 < size; cut++) /* but the line's end and the last bracket */
        assert_int_not_equal(capture_bytes("cut.gltf", (const uint8_t *)text, cut), TL_OK);
    free(text);
}

/* Every byte of both headers, with every bit of it changed. */
static void every_bit_of_the_frame(void **state)
{
    const png_bytes file = square_glb();
    const size_t json_size = file.data[12] | (size_t)file.data[13] << 8;
    const size_t starts[2] = {0, 20 + json_size};
    const size_t sizes[2] = {20, 8};
    (void)state;
    for (int part = 0; part < 2; part++)
        for (size_t i = starts[part]; i < starts[part] + sizes[part]; i++)
            for (int bit = 0; bit < 8; bit++) {
                file.data[i] ^= (uint8_t)(1u << bit);
                capture_bytes("changed.glb", file.data, file.size);
                file.data[i] ^= (uint8_t)(1u << bit);
            }
    free(file.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_beginning_of_glb),
        cmocka_unit_test(every_beginning_with_its_length),
        cmocka_unit_test(every_beginning_of_gltf),
        cmocka_unit_test(every_bit_of_the_frame),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
