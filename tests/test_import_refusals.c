/* Is a capture that cannot be lit refused by a sentence that says why and what to do, and are maps that
 * name nothing? */
#include "testing.h"

#include "foreign_exr.h"
#include "foreign_frame.h"

/* Channels to leave out, and what to do otherwise. */
static const struct {
    const char *name;
    const char *without; /* first letters of channels that are left out; NULL: none */
    foreign_part part;
    const char *maps[2];
    double fov;
    tl_depth_kind kind;
    tl_status status;
    const char *words[4];
} cases[] = {
    {"no depth", "Z", {.name = NULL}, {NULL}, 60, 0, TL_ERR_UNSUPPORTED, {"depth", "--map"}},
    {"no normals",
     "N",
     {.name = NULL},
     {NULL},
     60,
     0,
     TL_ERR_UNSUPPORTED,
     {"normals", "--map"}},
    {"neither", "NZ", {.name = NULL}, {NULL}, 60, 0, TL_ERR_UNSUPPORTED, {"depth or normals"}},
    {"no camera",
     NULL,
     {.name = NULL},
     {NULL},
     0,
     0,
     TL_ERR_UNSUPPORTED,
     {"--fov", "--camera-file"}},
    {"DWA",
     NULL,
     {.compression = EXR_COMPRESSION_DWAA},
     {NULL},
     60,
     0,
     TL_ERR_UNSUPPORTED,
     {"DWA", "zip or none"}},
    {"a buffer without near and far",
     NULL,
     {.name = NULL},
     {NULL},
     60,
     TL_DEPTH_KIND_NDC_REVERSED,
     TL_ERR_ARGUMENT,
     {"ndc-reversed", "--near", "--far"}},
    {"a channel that is not there",
     NULL,
     {.name = NULL},
     {"depth=z"},
     60,
     0,
     TL_ERR_FORMAT,
     {"--map depth", "\"z\"", "did you mean \"Z\"?"}},
    {"a part that is not there",
     NULL,
     {.name = NULL},
     {"depth=beauty/Z"},
     60,
     0,
     TL_ERR_FORMAT,
     {"--map depth", "in a part \"beauty\""}},
    {"two channels of three",
     NULL,
     {.name = NULL},
     {"albedo=N.X,N.Y"},
     60,
     0,
     TL_ERR_FORMAT,
     {"--map albedo", "three channels"}},
    {"one plane twice",
     NULL,
     {.name = NULL},
     {"depth=Z", "depth=A"},
     60,
     0,
     TL_ERR_ARGUMENT,
     {"\"depth\"", "twice"}},
    {"a file that is not there",
     NULL,
     {.name = NULL},
     {"depth=/nonexistent.pfm"},
     60,
     0,
     TL_ERR_READ,
     {"/nonexistent.pfm", "cannot be opened"}},
};

/* DWA cannot be written by the library in C either: the header alone says it. */
static void write_case(size_t i, const foreign_frame *frame, const char *path)
{
    static foreign_file file;
    foreign_describe(&file, frame, EXR_PIXEL_FLOAT);
    const foreign_part described = file.parts[0];
    file.parts[0] = cases[i].part;
    file.parts[0].compression = EXR_COMPRESSION_NONE;
    file.parts[0].channel_count = 0;
    for (int c = 0; c < described.channel_count; c++)
        if (!cases[i].without || !strchr(cases[i].without, described.channels[c].name[0]))
            file.parts[0].channels[file.parts[0].channel_count++] = described.channels[c];
    foreign_write(&file, path);
    if (cases[i].part.compression == EXR_COMPRESSION_DWAA) {
        size_t size;
        unsigned char *bytes = load_bytes(path, &size);
        static const char word[] =
            "compression\0compression"; /* name, type, then 4 bytes of size */
        for (size_t at = 0; at + sizeof word + 4 < size; at++)
            if (memcmp(bytes + at, word, sizeof word) == 0) {
                bytes[at + sizeof word + 4] = (unsigned char)EXR_COMPRESSION_DWAA;
                break;
            }
        save_bytes(path, bytes, size);
        free(bytes);
    }
}

static void captures_are_refused(void **state)
{
    static foreign_frame frame;
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "refused.exr");
    foreign_fill(&frame);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_gbuffer *g = NULL;
        tl_import_options options = tl_import_options_default();
        options.camera.vertical_fov = cases[i].fov;
        options.depth_kind = cases[i].kind;
        for (int m = 0; m < 2 && cases[i].maps[m]; m++)
            ASSERT_OK(
                tl_import_map_parse(cases[i].maps[m], &options.maps[options.map_count++], &err),
                err);
        write_case(i, &frame, path);
        const tl_status status = tl_import_read(path, &options, NULL, &g, NULL, &err);
        assert_refused(cases[i].name, status, cases[i].status, &err, cases[i].words);
        assert_null(g);
        remove(path);
    }
}

/* Parts of other sizes, whole numbers where a plane is meant, and a part that is named but deep or odd. */
static void parts_are_refused(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    static const char *const sizes[] = {"normal", "5 x 4", "9 x 7", "one size", NULL};
    static const char *const numbers[] = {"--map depth", "whole numbers", NULL};
    (void)state;
    char path[512], other[512], map[1024];
    tl_error err;
    tl_gbuffer *g = NULL;
    tl_import_options options = foreign_options();
    scratch_path(path, sizeof path, "refused.exr");
    scratch_path(other, sizeof other, "smaller.exr");
    foreign_fill(&frame);
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    foreign_add(&file.parts[0], "id", EXR_PIXEL_UINT, frame.alpha);
    foreign_write(&file, path);
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    file.width = 5;
    file.height = 4;
    foreign_write(&file, other);
    snprintf(map, sizeof map, "normal=%s:N", other);
    ASSERT_OK(tl_import_map_parse(map, &options.maps[options.map_count++], &err), err);
    assert_refused("sizes", tl_import_read(path, &options, NULL, &g, NULL, &err), TL_ERR_FORMAT,
                   &err, sizes);
    ASSERT_OK(tl_import_map_parse("depth=id", &options.maps[0], &err), err);
    assert_refused("numbers", tl_import_read(path, &options, NULL, &g, NULL, &err),
                   TL_ERR_FORMAT, &err, numbers);
    remove(path);
    remove(other);
}

static void words_of_maps_are_refused(void **state)
{
    static const struct {
        const char *text, *words[3];
    } maps[] = {
        {"depth", {"\"depth\" is no map", "PLANE=", NULL}},
        {"depth=", {"is no map", NULL}},
        {"=Z", {"no such plane", "planes: depth", NULL}},
        {"normals=N", {"did you mean \"normal\"?", NULL}},
        {"", {"is no map", NULL}},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(maps); i++) {
        tl_error err;
        tl_import_map map;
        assert_refused(maps[i].text, tl_import_map_parse(maps[i].text, &map, &err),
                       TL_ERR_ARGUMENT, &err, maps[i].words);
    }
}

static void words_of_maps_are_read(void **state)
{
    static const struct {
        const char *text;
        tl_import_plane plane;
        const char *file, *part, *channels;
    } maps[] = {
        {"depth=Z", TL_IMPORT_DEPTH, "", "", "Z"},
        {"depth=d.exr:R", TL_IMPORT_DEPTH, "d.exr", "", "R"},
        {"depth=a/b:c/d.exr:part one/R", TL_IMPORT_DEPTH, "a/b:c/d.exr", "part one", "R"},
        {"normal=beauty/N.XYZ", TL_IMPORT_NORMAL, "", "beauty", "N.XYZ"},
        {"albedo=a/b.png", TL_IMPORT_ALBEDO, "a/b.png", "", ""},
        {"ao=x.pfm:", TL_IMPORT_OCCLUSION, "x.pfm", "", ""},
        {"emissive=R,G,B", TL_IMPORT_EMISSIVE, "", "", "R,G,B"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(maps); i++) {
        tl_error err;
        tl_import_map map;
        ASSERT_OK(tl_import_map_parse(maps[i].text, &map, &err), err);
        assert_int_equal(map.plane, maps[i].plane);
        assert_string_equal(map.file, maps[i].file);
        assert_string_equal(map.part, maps[i].part);
        assert_string_equal(map.channels, maps[i].channels);
    }
}

/* A header and no pixels that fit: PFM says its size before. */
static void pfm_is_refused(void **state)
{
    static const struct {
        const char *text, *words[3];
    } files[] = {
        {"Pf\n2 1\n-1\n12345678", {NULL}}, /* good */
        {"Pf\n2 1\n-1\n1234567", {"cut short", "promises", NULL}},
        {"Pf\n2 1\n-1\n123456789", {"damaged", "promises", NULL}},
        {"PF\n2 1\n-1\n12345678", {"cut short", NULL}},
        {"Pf\n0 1\n-1\n", {"width and height", NULL}},
        {"Pf\n2 -1\n-1\n", {"width and height", NULL}},
        {"Pf\n2 16385\n-1\n", {"16384", NULL}},
        {"Pf\n99999999999 1\n-1\n", {"width and height", NULL}},
        {"Pf\n16384 16384\n-1\n", {"cut short", NULL}},
        {"Pf\n2 1\n0\n12345678", {"scale", NULL}},
        {"Pf\n2 1\nx\n12345678", {"scale", NULL}},
        {"Pf\n2 1\nnan\n12345678", {"scale", NULL}},
        {"Pf\n2 1\n-1", {"scale", NULL}},
        {"Pf\n2 1", {"width and height", NULL}},
        {"Pf\n", {"width and height", NULL}},
        {"Pf", {"neither OpenEXR nor PFM", NULL}},
        {"P6\n2 1\n255\n", {"neither OpenEXR nor PFM", NULL}},
    };
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "refused.pfm");
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        tl_error err;
        tl_gbuffer *g = NULL;
        tl_import_options options = foreign_options();
        ASSERT_OK(tl_import_map_parse("depth=Y", &options.maps[0], &err), err);
        ASSERT_OK(tl_import_map_parse("normal=Y,Y,Y", &options.maps[1], &err), err);
        options.map_count = 2;
        save_bytes(path, files[i].text, strlen(files[i].text));
        const tl_status status = tl_import_read(path, &options, NULL, &g, NULL, &err);
        if (!files[i].words[0])
            ASSERT_OK(status, err);
        else
            assert_refused(files[i].text, status, TL_ERR_FORMAT, &err, files[i].words);
        tl_gbuffer_destroy(g);
    }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(captures_are_refused),
        cmocka_unit_test(parts_are_refused),
        cmocka_unit_test(words_of_maps_are_refused),
        cmocka_unit_test(words_of_maps_are_read),
        cmocka_unit_test(pfm_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
