/* Does every capture go to the reader that its first bytes name, and is everything else refused by a
 * sentence that says what is read? */
#include "file_cases.h"

#include "capture_read.h"
#include "tilelight/gbuffer_file.h"

/* No start of a file is claimed by two formats, or the table's order would decide silently. */
static void formats_do_not_overlap(void **state)
{
    static const struct {
        const char *path, *bytes;
        size_t size;
        const char *format; /* NULL: none */
    } starts[] = {
        {"a.exr", "\x76\x2f\x31\x01\x02", 5, "OpenEXR"},
        {"no-suffix", "\x76\x2f\x31\x01\x02", 5, "OpenEXR"},
        {"a.pfm", "Pf\n1 1\n1\n", 10, "PFM, PNG (with --map)"},
        {"a.png", "\x89PNG\r\n\x1a\n", 8, "PFM, PNG (with --map)"},
        {"short.exr", "\x76\x2f\x31", 3, NULL},
        {"empty.exr", "", 0, NULL},
        {"text.exr", "{ \"tilelight\": 1 }", 18, NULL},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(starts); i++) {
        tl_capture_start start = {
            .path = starts[i].path, .size = starts[i].size, .file_size = starts[i].size};
        memcpy(start.bytes, starts[i].bytes, starts[i].size);
        for (size_t f = 0; f < tl_capture_format_count; f++) {
            const tl_capture_format *format = &tl_capture_formats[f];
            const bool wanted = starts[i].format && strcmp(starts[i].format, format->name) == 0;
            if (format->recognises(&start) != wanted)
                fail_msg("%s: %s %s it", starts[i].path, format->name,
                         wanted ? "does not recognise" : "recognises");
        }
    }
}

static tl_status read_capture(const char *path, tl_captured *out, tl_error *err)
{
    const tl_capture_request request = {.path = path};
    return tl_capture_read(&request, out, err);
}

static void our_own_are_read(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *made = NULL;
    tl_captured read = {0};
    const tl_camera camera = awkward_camera(7, 5);
    scratch_path(path, sizeof path, "own-capture.exr");
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &made, &err), err);
    fill_awkward(made, 3);
    ASSERT_OK(tl_gbuffer_write(path, made, NULL, &err), err);
    ASSERT_OK(read_capture(path, &read, &err), err);
    assert_same_gbuffer("own", read.gbuffer, made);
    assert_false(read.has_lights);
    tl_captured_clear(&read);
    assert_null(read.gbuffer);
    tl_gbuffer_destroy(made);
    remove(path);
}

static void others_are_refused(void **state)
{
    static const char *const unknown[] = {"unknown.bin", "no capture", "OpenEXR", NULL};
    static const char *const absent[] = {"absent.exr", "cannot be opened", NULL};
    static const char *const folder[] = {"no regular file", NULL};
    (void)state;
    char path[512];
    tl_error err;
    tl_captured read = {0};
    scratch_path(path, sizeof path, "unknown.bin");
    save_bytes(path, "?", 1);
    assert_refused("unknown", read_capture(path, &read, &err), TL_ERR_FORMAT, &err, unknown);
    remove(path);
    scratch_path(path, sizeof path, "absent.exr");
    assert_refused("absent", read_capture(path, &read, &err), TL_ERR_READ, &err, absent);
    assert_refused("folder", read_capture("/", &read, &err), TL_ERR_READ, &err, folder);
    assert_null(read.gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_do_not_overlap),
        cmocka_unit_test(our_own_are_read),
        cmocka_unit_test(others_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
