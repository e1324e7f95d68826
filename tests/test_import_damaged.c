/* Does a damaged capture of another program ever do more than be refused? Every truncation of small good
 * files of each kind, and changed bytes: a sentence, or the right frame, and no harm. */
#define _POSIX_C_SOURCE 200809L /* setenv, truncate, pwrite */
#include "testing.h"

#include "foreign_exr.h"
#include "foreign_frame.h"
#include "plan.h"

#include <fcntl.h>
#include <unistd.h>

static const struct {
    const char *name;
    foreign_part part; /* but for its channels */
    int part_count;    /* 3: depth, normals and colours in one each */
    exr_pixel_type_t type;
} files[] = {
    {"scanlines, cropped", {.crop = {1, 1, 2, -1}}, 1, EXR_PIXEL_HALF},
    {"three parts", {.name = "a"}, 3, EXR_PIXEL_HALF},
    {"three parts, zip", {.name = "a", .compression = EXR_COMPRESSION_ZIP}, 3, EXR_PIXEL_FLOAT},
    {"tiles",
     {.storage = EXR_STORAGE_TILED, .tile_width = 4, .tile_height = 4},
     1,
     EXR_PIXEL_HALF},
    {"tiles, zips, mipmaps",
     {.storage = EXR_STORAGE_TILED,
      .levels = EXR_TILE_MIPMAP_LEVELS,
      .compression = EXR_COMPRESSION_ZIPS,
      .tile_width = 4,
      .tile_height = 4},
     1,
     EXR_PIXEL_FLOAT},
    {"three parts, tiles, piz",
     {.name = "a",
      .storage = EXR_STORAGE_TILED,
      .compression = EXR_COMPRESSION_PIZ,
      .tile_width = 5,
      .tile_height = 3},
     3,
     EXR_PIXEL_HALF},
};
enum { EXR_COUNT = sizeof files / sizeof files[0], FILE_COUNT = EXR_COUNT + 2 };

static void camera(exr_context_t file, void *context)
{
    static const exr_attr_m44f_t ndc = {
        {1, 0, 0, 0, 0, -1, 0, 0, -0.5f, -0.5f, -1, -1, 0, 0, -1, 0}};
    (void)context;
    foreign_must(exr_attr_set_m44f(file, 0, "worldToNDC", &ndc), "ndc");
}

static void write_exr(size_t index, const char *path)
{
    static foreign_file file;
    static foreign_frame frame;
    foreign_fill(&frame);
    foreign_describe(&file, &frame, files[index].type);
    const foreign_part described = file.parts[0];
    const int firsts[4] = {0, 2, 5, 8};
    file.part_count = files[index].part_count;
    file.attributes = camera;
    for (int p = 0; p < file.part_count; p++) {
        static const char *const names[3] = {"one", "two", "three"};
        const int first = file.part_count == 1 ? 0 : firsts[p];
        const int last = file.part_count == 1 ? 8 : firsts[p + 1];
        file.parts[p] = files[index].part;
        if (file.part_count > 1)
            file.parts[p].name = names[p];
        file.parts[p].channel_count = last - first;
        memcpy(file.parts[p].channels, described.channels + first,
               (size_t)(last - first) * sizeof described.channels[0]);
    }
    foreign_write(&file, path);
}

/* Depth of one number, or of three; in either order of bytes. */
static void write_pfm(int numbers, const char *path)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "%s\n5 3\n%s\n", numbers == 3 ? "PF" : "Pf", numbers == 3 ? "-1.0" : "1.0");
    for (int i = 0; i < 5 * 3 * numbers * 4; i++)
        fputc(i % 4 == (numbers == 3 ? 3 : 0) ? 0x40 : i % 7, file);
    assert_int_equal(fclose(file), 0);
}

static const char *write_file(size_t index, const char *path)
{
    if (index < EXR_COUNT) {
        write_exr(index, path);
        return files[index].name;
    }
    write_pfm(index == EXR_COUNT ? 1 : 3, path);
    return index == EXR_COUNT ? "Pf" : "PF";
}

/* A changed bit makes a frame of millions of pixels, all sky but for a few: its header is read, and it
 * is left at that, or sanitizers take minutes. */
static int is_large(const char *path, const tl_import_options *options)
{
    tl_import_plan plan = {0};
    if (tl_import_plan_open(&plan, path, options, NULL, NULL) != TL_OK)
        return 0;
    const int is = (uint64_t)plan.width * plan.height > 1 << 16;
    tl_import_plan_close(&plan);
    return is;
}

/* Reads a file by the table, or as all planes of a frame. NULL where it was refused, by a sentence. */
static tl_gbuffer *try_reading(size_t index, const char *name, const char *path)
{
    tl_error err = {.status = TL_OK};
    tl_gbuffer *g = NULL;
    tl_import_options options = tl_import_options_default();
    if (index >= EXR_COUNT) {
        static const tl_import_plane planes[] = {TL_IMPORT_DEPTH, TL_IMPORT_NORMAL};
        static const char *const channels[2][2] = {{"Y", "Y,Y,Y"}, {"R", "RGB"}};
        options.camera.vertical_fov = 60.0;
        for (int i = 0; i < 2; i++) {
            tl_import_map *map = &options.maps[options.map_count++];
            map->plane = planes[i];
            snprintf(map->channels, sizeof map->channels, "%s",
                     channels[index == EXR_COUNT ? 0 : 1][i]);
        }
    }
    if (is_large(path, &options))
        return NULL;
    const tl_status status = tl_import_read(path, &options, NULL, &g, NULL, &err);
    if (status != TL_OK && (err.status != status || err.message[0] == '\0' || g))
        fail_msg("%s: status %d without a sentence, or with a frame", name, status);
    if (status != TL_OK && tl_exit_status(status) != 3)
        fail_msg("%s: status %d is no bad input: %s", name, status, err.message);
    return g;
}

static void assert_same(const char *name,
                        size_t length,
                        const tl_gbuffer *a,
                        const tl_gbuffer *b)
{
    const size_t size = (size_t)tl_gbuffer_pixel_size(a) * a->pitch * a->rows;
    if (a->present != b->present || memcmp(&a->camera, &b->camera, sizeof a->camera) != 0 ||
        memcmp(a->planes, b->planes, size) != 0)
        fail_msg("%s: cut to %zu bytes it is read, and another frame", name, length);
}

static void truncations_are_refused(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "import-damaged");
    for (size_t i = 0; i < FILE_COUNT; i++) {
        size_t size, read_count = 0;
        const char *name = write_file(i, path);
        unsigned char *bytes = load_bytes(path, &size);
        tl_gbuffer *good = try_reading(i, name, path);
        if (!good)
            fail_msg("%s: is refused whole", name);
        for (size_t length = size; length-- > 0;) {
            assert_int_equal(truncate(path, (off_t)length), 0);
            tl_gbuffer *g = try_reading(i, name, path);
            if (g) {
                assert_same(name, length, good, g);
                read_count++;
            }
            tl_gbuffer_destroy(g);
        }
        /* What may be lacking is the coarser levels of mipmaps, which are not read. */
        if (read_count > 0 && files[i].part.levels != EXR_TILE_MIPMAP_LEVELS)
            fail_msg("%s: %zu truncations are read", name, read_count);
        tl_gbuffer_destroy(good);
        free(bytes);
    }
    remove(path);
}

/* One byte in four, each in one of three ways: readings take a millisecond. */
static void changed_bytes_do_no_harm(void **state)
{
    static const unsigned char changes[] = {0x01, 0x80, 0xff};
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "import-damaged");
    for (size_t i = 0; i < FILE_COUNT; i++) {
        size_t size;
        const char *name = write_file(i, path);
        unsigned char *bytes = load_bytes(path, &size);
        const int file = open(path, O_WRONLY);
        assert_true(file >= 0);
        for (size_t at = i % 4; at < size; at += 4) {
            const unsigned char changed = bytes[at] ^ changes[at / 4 % sizeof changes];
            assert_int_equal(pwrite(file, &changed, 1, (off_t)at), 1);
            tl_gbuffer_destroy(try_reading(i, name, path));
            assert_int_equal(pwrite(file, bytes + at, 1, (off_t)at), 1);
        }
        close(file);
        free(bytes);
    }
    remove(path);
}

/* Several bits at once, anywhere: 100 a file, the same on every run. */
static void flipped_bits_do_no_harm(void **state)
{
    (void)state;
    char path[512];
    uint32_t random = 11;
    scratch_path(path, sizeof path, "import-damaged");
    for (size_t i = 0; i < FILE_COUNT; i++) {
        size_t size;
        const char *name = write_file(i, path);
        unsigned char *bytes = load_bytes(path, &size);
        unsigned char *changed = malloc(size);
        assert_non_null(changed);
        for (int round = 0; round < 100; round++) {
            memcpy(changed, bytes, size);
            for (uint32_t k = 0; k <= (next_random(&random) >> 16) % 8; k++) {
                const uint32_t bit = next_random(&random) >> 29;
                changed[(next_random(&random) >> 8) % size] ^= (unsigned char)(1u << bit);
            }
            save_bytes(path, changed, size);
            tl_gbuffer_destroy(try_reading(i, name, path));
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
        cmocka_unit_test(flipped_bits_do_no_harm),
    };
    setenv("TILELIGHT_THREADS", "1", 1); /* starting threads would take most of the time */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
