/* Is the record of an output another one exactly when something changes that it was made from, is it found in
 * pictures of every kind, and is a file that many outputs share read once? */
#define _GNU_SOURCE
#include "record.h"

#include "file_cases.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/lights.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdbool.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

static char folder[512];

static int make_folder(void **state)
{
    (void)state;
    scratch_path(folder, sizeof folder, "record-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return chdir(folder);
}

static int remove_folder(void **state)
{
    char command[600];
    (void)state;
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return chdir("/") | system(command);
}

static void write_text(const char *path, const char *text)
{
    save_bytes(path, text, strlen(text));
}

static void write_picture(const char *path, float value)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(2, 2, &image, &err), err);
    tl_image_plane(image, 0)[0] = value;
    ASSERT_OK(tl_image_write_exr(path, image, (tl_exr_form){0}, &err), err);
    tl_image_destroy(image);
}

static const char profile_text[] =
    "IESNA91\nTILT=NONE\n1,1000,2,2,1,1,2,0,0,0\n0.5,0.5,30\n0,90\n0\n8,4\n";

/* Lights that name three files, one of them twice. */
static const char lights_text[] =
    "{\"tilelight\": 1, \"sky\": {\"type\": \"image\", \"image\": \"sky.exr\"}, \"lights\": ["
    "{\"type\": \"spot\", \"position\": [0, 3, 0], \"direction\": [0, -1, 0], \"texture\": "
    "\"slide.exr\"},"
    "{\"type\": \"point\", \"position\": [0, 2, 0], \"texture\": \"slide.exr\"},"
    "{\"type\": \"point\", \"position\": [0, 3, 0], \"profile\": \"lamp.ies\"}]}";

/* A capture with those lights inside. */
static void write_capture(const char *path)
{
    const tl_camera camera = awkward_camera(8, 6);
    tl_gbuffer *gbuffer = NULL;
    tl_light_set lights = {.count = 0};
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &gbuffer, &err), err);
    ASSERT_OK(tl_lights_read("lights.json", &lights, &err), err);
    ASSERT_OK(tl_gbuffer_write(path, gbuffer, &lights, &err), err);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(gbuffer);
}

static void write_inputs(void)
{
    write_picture("sky.exr", 1.0f);
    write_picture("slide.exr", 2.0f);
    write_text("lamp.ies", profile_text);
    write_text("lights.json", lights_text);
    write_capture("frame.exr");
}

/* With a cache of its own. */
static void record_of(const char *options,
                      const char *version,
                      const tl_record_file *files,
                      size_t count,
                      char out[TL_RECORD_SIZE])
{
    tl_record_cache *cache = NULL;
    tl_error err;
    ASSERT_OK(tl_record_cache_create(&cache, &err), err);
    ASSERT_OK(tl_record_of(cache, options, version, files, count, out, &err), err);
    tl_record_cache_destroy(cache);
    assert_int_equal(strlen(out), TL_RECORD_SIZE - 1);
    assert_memory_equal(out, "1 ", 2);
    assert_int_equal(strspn(out + 2, "0123456789abcdef"), 32);
}

static const tl_record_file given_lights[] = {{"frame.exr", TL_RECORD_PLAIN},
                                              {"lights.json", TL_RECORD_LIGHTS}};
static const tl_record_file own_lights[] = {{"frame.exr", TL_RECORD_CAPTURE}};

/* No two of the records are the same. */
static void assert_differ(char (*records)[TL_RECORD_SIZE], size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count; k++)
            if (strcmp(records[i], records[k]) == 0)
                fail_msg("records %zu and %zu are one", i, k);
}

static void everything_counts(void **state)
{
    static const tl_record_file turned[] = {{"lights.json", TL_RECORD_LIGHTS},
                                            {"frame.exr", TL_RECORD_PLAIN}};
    static const tl_record_file twice[] = {{"frame.exr", TL_RECORD_PLAIN},
                                           {"frame.exr", TL_RECORD_PLAIN}};
    char records[8][TL_RECORD_SIZE], again[TL_RECORD_SIZE];
    (void)state;
    write_inputs();
    record_of("o", "v", given_lights, 2, records[0]);
    record_of("p", "v", given_lights, 2, records[1]);
    record_of("o", "w", given_lights, 2, records[2]);
    record_of("", "vo", given_lights, 2, records[3]);
    record_of("o", "v", turned, 2, records[4]);
    record_of("o", "v", given_lights, 1, records[5]);
    record_of("o", "v", own_lights, 1, records[6]);
    record_of("o", "v", twice, 2, records[7]);
    assert_differ(records, COUNT_OF(records));
    record_of("o", "v", given_lights, 2, again);
    assert_string_equal(again, records[0]);
}

/* The files that lights name, in a file of their own or inside a capture. */
static void named_files_count(void **state)
{
    char records[6][TL_RECORD_SIZE], inside[6][TL_RECORD_SIZE], plain[TL_RECORD_SIZE];
    static const tl_record_file alone[] = {{"lights.json", TL_RECORD_PLAIN}};
    (void)state;
    write_inputs();
    record_of("", "", alone, 1, plain);
    for (int i = 0; i < 5; i++) {
        if (i == 1)
            write_picture("sky.exr", 1.5f);
        if (i == 2)
            write_picture("slide.exr", 2.5f);
        if (i == 3)
            write_text("lamp.ies", "IESNA91\nTILT=NONE\n1,1000,2,2,1,1,2,0,0,0\n0.5,0.5,30\n"
                                   "0,90\n0\n8,5\n");
        if (i == 4)
            write_picture("unnamed.exr", 1.0f);
        record_of("", "", given_lights, 2, records[i]);
        record_of("", "", own_lights, 1, inside[i]);
    }
    assert_differ(records, 4);
    assert_differ(inside, 4);
    assert_string_equal(records[4], records[3]);
    assert_string_equal(inside[4], inside[3]);
    record_of("", "", alone, 1, records[5]);
    assert_string_equal(records[5], plain);
}

/* The same contents elsewhere. */
static void names_do_not_count(void **state)
{
    static const tl_record_file moved[] = {{"away/other.exr", TL_RECORD_PLAIN},
                                           {"away/other.json", TL_RECORD_LIGHTS}};
    char here[TL_RECORD_SIZE], there[TL_RECORD_SIZE];
    (void)state;
    write_inputs();
    record_of("", "", given_lights, 2, here);
    assert_int_equal(system("mkdir away && cp sky.exr slide.exr lamp.ies away && "
                            "cp frame.exr away/other.exr && cp lights.json away/other.json && "
                            "rm sky.exr slide.exr lamp.ies"),
                     0);
    record_of("", "", moved, 2, there);
    assert_string_equal(here, there);
}

static void what_is_missing_is_named(void **state)
{
    static const char *const words[] = {"slide.exr", "No such file", NULL};
    static const char *const gone[] = {"gone.exr", NULL};
    static const tl_record_file absent[] = {{"gone.exr", TL_RECORD_PLAIN}};
    static const tl_record_file absent_capture[] = {{"gone.exr", TL_RECORD_CAPTURE}};
    static const tl_record_file is_folder[] = {{".", TL_RECORD_PLAIN}};
    static const char *const no_file[] = {".:", "no regular file", NULL};
    char record[TL_RECORD_SIZE];
    tl_record_cache *cache = NULL;
    tl_error err;
    (void)state;
    write_inputs();
    remove("slide.exr");
    ASSERT_OK(tl_record_cache_create(&cache, &err), err);
    assert_refused("lights", tl_record_of(cache, "", "", given_lights, 2, record, &err),
                   TL_ERR_READ, &err, words);
    assert_refused("inside", tl_record_of(cache, "", "", own_lights, 1, record, &err),
                   TL_ERR_READ, &err, words);
    assert_refused("plain", tl_record_of(cache, "", "", absent, 1, record, &err), TL_ERR_READ,
                   &err, gone);
    assert_refused("capture", tl_record_of(cache, "", "", absent_capture, 1, record, &err),
                   TL_ERR_READ, &err, gone);
    assert_refused("folder", tl_record_of(cache, "", "", is_folder, 1, record, &err),
                   TL_ERR_READ, &err, no_file);
    tl_record_cache_destroy(cache);
}

/* What is damaged is refused by its reader; until then it is a file like any other. */
static void damaged_files_have_records(void **state)
{
    static const char *const texts[] = {
        "", "{", "[1, 2]", "{\"lights\": 3, \"sky\": []}",
        "{\"lights\": [7, {\"texture\": 3}, {\"texture\": \"\"}]}"};
    static const tl_record_file lights[] = {{"damaged.json", TL_RECORD_LIGHTS}};
    static const tl_record_file capture[] = {{"damaged.exr", TL_RECORD_CAPTURE}};
    static const unsigned char start[] = {0x76, 0x2f, 0x31, 0x01, 0x02, 0x00};
    char records[COUNT_OF(texts) + 1][TL_RECORD_SIZE];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        write_text("damaged.json", texts[i]);
        record_of("", "", lights, 1, records[i]);
    }
    save_bytes("damaged.exr", start, sizeof start);
    record_of("", "", capture, 1, records[COUNT_OF(texts)]);
    assert_differ(records, COUNT_OF(records));
}

/* Bytes that this process has read. */
static long long bytes_read(void)
{
    long long count = -1;
    FILE *file = fopen("/proc/self/io", "r");
    if (file && fscanf(file, "rchar: %lld", &count) != 1)
        count = -1;
    if (file)
        fclose(file);
    return count;
}

enum { LARGE = 64 << 20 };

static void make_large(const char *path, struct timespec age)
{
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const struct timespec times[2] = {age, age};
    assert_true(file >= 0);
    assert_int_equal(ftruncate(file, LARGE), 0);
    assert_int_equal(futimens(file, times), 0);
    close(file);
}

/* Before all else, for what a process had at most stays. */
static void memory_is_bounded(void **state)
{
    static const tl_record_file files[] = {{"large", TL_RECORD_PLAIN}};
    struct rusage before, after;
    char record[TL_RECORD_SIZE];
    (void)state;
    make_large("large", (struct timespec){1000, 0});
    record_of("", "", files, 0, record);
    getrusage(RUSAGE_SELF, &before);
    record_of("", "", files, 1, record);
    getrusage(RUSAGE_SELF, &after);
    assert_true(after.ru_maxrss - before.ru_maxrss < LARGE / 8 / 1024);
}

/* One file for many outputs; and again once it has changed. */
static void shared_files_are_read_once(void **state)
{
    static const tl_record_file files[] = {{"large", TL_RECORD_PLAIN}};
    tl_record_cache *cache = NULL;
    struct stat made;
    char first[TL_RECORD_SIZE], next[TL_RECORD_SIZE];
    tl_error err;
    (void)state;
    make_large("large", (struct timespec){1000, 0});
    do /* what has just changed is not trusted */
        usleep(100000);
    while (stat("large", &made) == 0 && time(NULL) - made.st_ctime < 2);
    ASSERT_OK(tl_record_cache_create(&cache, &err), err);
    if (bytes_read() < 0)
        skip();
    const long long start = bytes_read();
    ASSERT_OK(tl_record_of(cache, "", "", files, 1, first, &err), err);
    assert_true(bytes_read() - start >= LARGE);
    for (int i = 0; i < 100; i++) {
        ASSERT_OK(tl_record_of(cache, "", "", files, 1, next, &err), err);
        assert_string_equal(first, next);
    }
    assert_true(bytes_read() - start < 3LL * LARGE);
    write_text("large", "now another");
    ASSERT_OK(tl_record_of(cache, "", "", files, 1, next, &err), err);
    assert_string_not_equal(first, next);
    tl_record_cache_destroy(cache);
}

/* Another content in the same file, sooner than the clock of its times ticks. */
static void changes_within_a_tick(void **state)
{
    static const tl_record_file files[] = {{"shared", TL_RECORD_PLAIN}};
    char records[2][TL_RECORD_SIZE];
    tl_record_cache *cache = NULL;
    tl_error err;
    (void)state;
    const int file = open("shared", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    assert_true(file >= 0);
    ASSERT_OK(tl_record_cache_create(&cache, &err), err);
    for (int i = 0; i < 100; i++) {
        assert_int_equal(pwrite(file, &i, sizeof i, 0), sizeof i);
        ASSERT_OK(tl_record_of(cache, "", "", files, 1, records[i % 2], &err), err);
        if (i > 0)
            assert_string_not_equal(records[0], records[1]);
    }
    close(file);
    tl_record_cache_destroy(cache);
}

/* Workers of one batch, who share lights and have a capture each. */
enum { WORKERS = 4, TURNS = 50 };

typedef struct worker {
    pthread_t thread;
    tl_record_cache *cache;
    char records[2][TL_RECORD_SIZE]; /* of either way to be lit */
    bool failed;
} worker;

static void *work(void *context)
{
    worker *w = context;
    for (int i = 0; i < TURNS; i++) {
        char first[TL_RECORD_SIZE], second[TL_RECORD_SIZE];
        w->failed |= tl_record_of(w->cache, "", "", given_lights, 2, first, NULL) != TL_OK ||
                     tl_record_of(w->cache, "", "", own_lights, 1, second, NULL) != TL_OK;
        w->failed |=
            i > 0 && (strcmp(first, w->records[0]) != 0 || strcmp(second, w->records[1]) != 0);
        memcpy(w->records[0], first, sizeof first);
        memcpy(w->records[1], second, sizeof second);
    }
    return NULL;
}

static void threads_share_a_cache(void **state)
{
    (void)state;
    worker workers[WORKERS] = {{.failed = false}};
    tl_record_cache *cache = NULL;
    tl_error err;
    write_inputs();
    ASSERT_OK(tl_record_cache_create(&cache, &err), err);
    for (int i = 0; i < WORKERS; i++) {
        workers[i].cache = cache;
        assert_int_equal(pthread_create(&workers[i].thread, NULL, work, &workers[i]), 0);
    }
    for (int i = 0; i < WORKERS; i++)
        assert_int_equal(pthread_join(workers[i].thread, NULL), 0);
    for (int i = 0; i < WORKERS; i++) {
        assert_false(workers[i].failed);
        assert_string_equal(workers[i].records[0], workers[0].records[0]);
        assert_string_equal(workers[i].records[1], workers[0].records[1]);
    }
    tl_record_cache_destroy(cache);
}

static const char written[] = "1 0123456789abcdef0123456789abcdef";

/* Every kind of picture, `record` in it; [KINDS]. */
enum { KINDS = 5 };
static const char *const kinds[KINDS] = {"float.exr", "half.exr", "layers.exr", "8.png",
                                         "16.png"};

static void write_kinds(const char *record)
{
    enum { WIDTH = 20, HEIGHT = 10 };
    static const uint16_t codes[WIDTH * HEIGHT * 3];
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(WIDTH, HEIGHT, &image, &err), err);
    for (int k = 0; k < KINDS; k++) {
        const tl_exr_form form = {.half = k == 1, .record = record};
        const tl_image_layer layer = {.name = "diffuse", .planes = image->planes};
        const tl_png_picture picture = {.codes = codes,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .depth = k == 3 ? 8 : 16,
                                        .record = record};
        ASSERT_OK(k < 2   ? tl_image_write_exr(kinds[k], image, form, &err)
                  : k < 3 ? tl_image_write_layers(kinds[k], image, &layer, 1, form, &err)
                          : tl_png_write_picture(kinds[k], &picture, &err),
                  err);
    }
    tl_image_destroy(image);
}

static void pictures_keep_it(void **state)
{
    char found[TL_IMAGE_RECORD_SIZE];
    (void)state;
    write_kinds(NULL);
    for (int k = 0; k < KINDS; k++) {
        assert_false(tl_image_record(kinds[k], found));
        assert_string_equal(found, "");
        size_t size;
        unsigned char *bytes = load_bytes(kinds[k], &size);
        assert_null(memmem(bytes, size, "tilelight:record", 16));
        free(bytes);
    }
    write_kinds(written);
    for (int k = 0; k < KINDS; k++) {
        assert_true(tl_image_record(kinds[k], found));
        assert_string_equal(found, written);
        tl_image *image = NULL;
        tl_error err;
        ASSERT_OK(tl_image_read(kinds[k], &image, NULL, &err), err);
        tl_image_destroy(image);
    }
}

/* No beginning of a file has the record of the whole. */
static void pictures_cut_short_have_none(void **state)
{
    char found[TL_IMAGE_RECORD_SIZE];
    (void)state;
    write_kinds(written);
    for (int k = 0; k < KINDS; k++) {
        size_t size;
        unsigned char *bytes = load_bytes(kinds[k], &size);
        for (size_t cut = 0; cut < size; cut += 1 + cut / 200) {
            remove("cut"); /* what is cut anew, file systems write out at once */
            save_bytes("cut", bytes, cut);
            if (tl_image_record("cut", found))
                fail_msg("%s has its record after %zu bytes of %zu", kinds[k], cut, size);
        }
        save_bytes("cut", bytes, size - 1);
        assert_false(tl_image_record("cut", found));
        free(bytes);
    }
}

static void what_has_none(void **state)
{
    char found[TL_IMAGE_RECORD_SIZE];
    char long_record[100];
    (void)state;
    memset(long_record, 'x', sizeof long_record - 1);
    long_record[sizeof long_record - 1] = '\0';
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(4, 4, &image, &err), err);
    ASSERT_OK(tl_image_write_exr("long.exr", image, (tl_exr_form){.record = long_record}, &err),
              err);
    tl_image_destroy(image);
    assert_false(tl_image_record("long.exr", found));
    assert_false(tl_image_record("absent", found));
    assert_false(tl_image_record(".", found));
    assert_int_equal(mkfifo("pipe", 0666), 0);
    assert_false(tl_image_record("pipe", found));
    write_text("text", "P6\n1 1\n255\n...");
    assert_false(tl_image_record("text", found));
    assert_string_equal(found, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(everything_counts),
        cmocka_unit_test(named_files_count),
        cmocka_unit_test(names_do_not_count),
        cmocka_unit_test(what_is_missing_is_named),
        cmocka_unit_test(damaged_files_have_records),
        cmocka_unit_test(shared_files_are_read_once),
        cmocka_unit_test(threads_share_a_cache),
        cmocka_unit_test(changes_within_a_tick),
        cmocka_unit_test(pictures_keep_it),
        cmocka_unit_test(pictures_cut_short_have_none),
        cmocka_unit_test(what_has_none),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
