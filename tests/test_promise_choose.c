/* Is the candidate chosen that keeps the goal at the least cost, and is what was found remembered, and
 * nothing else taken for it? */
#define _GNU_SOURCE
#include "promise_frames.h"

#include "memory.h"
#include "program_cache.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#define NEVER ((double)INFINITY)

typedef struct choice_case {
    const char *name;
    tl_goal_kind kind;
    double limit;
    tl_expectation of[5]; /* ms, error; the last is the reference */
    uint32_t want;
} choice_case;

static const choice_case cases[] = {
    {"the fastest of those that keep it",
     TL_GOAL_RMS,
     1e-3,
     {{10, 1e-6}, {5, 1e-4}, {3, 1e-2}, {40, 1e-9}, {NEVER, 0}},
     1},
    {"within the limit, but not by its margin",
     TL_GOAL_RMS,
     1e-3,
     {{10, 1e-6}, {5, 8e-4}, {3, 1e-2}, {40, 1e-9}, {NEVER, 0}},
     0},
    {"as fast, and more accurate",
     TL_GOAL_RMS,
     1e-3,
     {{10.1, 1e-6}, {10, 1e-4}, {10.2, 1e-5}, {40, 1e-9}, {NEVER, 0}},
     0},
    {"not as fast",
     TL_GOAL_RMS,
     1e-3,
     {{10.4, 1e-6}, {10, 1e-4}, {40, 1e-5}, {40, 1e-9}, {NEVER, 0}},
     1},
    {"unknown ones are none",
     TL_GOAL_RMS,
     1e-3,
     {{NEVER, NEVER}, {NEVER, NEVER}, {3, NEVER}, {40, 1e-9}, {NEVER, 0}},
     3},
    {"nothing holds but the reference",
     TL_GOAL_RMS,
     1e-10,
     {{10, 1e-6}, {5, 1e-4}, {3, 1e-2}, {40, 1e-9}, {NEVER, 0}},
     4},
    {"codes are whole: one is one",
     TL_GOAL_CODES,
     1,
     {{10, 0}, {5, 1}, {3, 2}, {40, 0}, {NEVER, 0}},
     1},
    {"the most accurate in time",
     TL_GOAL_TIME,
     20,
     {{10, 1e-6}, {5, 1e-4}, {3, 1e-2}, {40, 1e-9}, {NEVER, 0}},
     0},
    {"time for all",
     TL_GOAL_TIME,
     100,
     {{10, 1e-6}, {5, 1e-4}, {3, 1e-2}, {40, 1e-9}, {NEVER, 0}},
     3},
    {"time for none: the fastest",
     TL_GOAL_TIME,
     1,
     {{10, 1e-6}, {5, 1e-4}, {3, 1e-2}, {40, 1e-9}, {NEVER, 0}},
     2},
};

static void chooses(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_goal goal = {.kind = cases[i].kind, .limit = cases[i].limit};
        const uint32_t got = tl_choose(&goal, cases[i].of, COUNT_OF(cases[i].of));
        if (got != cases[i].want)
            fail_msg("%s: %u, not %u", cases[i].name, got, cases[i].want);
    }
}

/* Names tell candidates apart, the last is the reference, and an option that promises leave alone stays. */
static void the_table(void **state)
{
    (void)state;
    assert_true(tl_candidate_count <= TL_MOST_CANDIDATES);
    assert_int_equal(tl_candidates[tl_candidate_count - 1].precision, TL_PRECISION_REFERENCE);
    for (uint32_t i = 0; i < tl_candidate_count; i++) {
        tl_lighting_options base = tl_lighting_options_default();
        char name[128], other[128], shorter[12];
        base.tile_size = 32;
        const tl_lighting_options options = tl_candidate_options(i, &base);
        assert_int_equal(options.tile_size, 32);
        assert_int_equal(options.precision, tl_candidates[i].precision);
        assert_true(options.light_cutoff == tl_candidates[i].light_cutoff);
        assert_memory_equal(&options.approximations, &tl_candidates[i].approximations,
                            sizeof options.approximations);
        tl_candidate_name(i, name, sizeof name);
        tl_candidate_name(i, shorter, sizeof shorter);
        assert_memory_equal(name, shorter, sizeof shorter - 1);
        for (uint32_t k = 0; k < i; k++) {
            tl_candidate_name(k, other, sizeof other);
            assert_string_not_equal(name, other);
        }
    }
}

typedef struct prepared_frame {
    promise_frame frame;
    tl_prepared prepared;
} prepared_frame;

static prepared_frame prepare_frame(uint32_t lights)
{
    prepared_frame p = {.frame = bench_frame("spheres", 64, 48, lights)};
    tl_error err;
    ASSERT_OK(tl_prepare(p.frame.gbuffer, &p.frame.lights,
                         &(tl_prepare_options){.tile_size = 16}, NULL, &p.prepared, &err),
              err);
    return p;
}

static void prepared_frame_clear(prepared_frame *p)
{
    tl_prepared_clear(&p->prepared);
    promise_frame_clear(&p->frame);
}

static const tl_device_info device = {
    .name = "a device", .platform = "a platform", .driver = "1.2"};

static json_t *kind_of(const prepared_frame *p, const tl_device_info *on, tl_goal goal)
{
    const tl_lighting_options base = tl_lighting_options_default();
    json_t *kind = tl_memory_kind(on, &base, &goal, p->frame.gbuffer, &p->prepared);
    assert_non_null(kind);
    return kind;
}

static char folder[4096], said[2048];

static void hear(void *context, const char *sentence)
{
    (void)context;
    snprintf(said, sizeof said, "%s", sentence);
}
static const tl_notices listening = {.say = hear};

static int empty_folder(void **state)
{
    char command[8300];
    (void)state;
    scratch_path(folder, sizeof folder, "promise-memory/deep");
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    said[0] = '\0';
    return system(command);
}

static void expectations_for_test(tl_expectation *of)
{
    for (uint32_t i = 0; i < tl_candidate_count; i++)
        of[i] = i == 1 ? (tl_expectation){NEVER, NEVER}
                       : (tl_expectation){1.5 + i, 1e-7 * (1.0 + i)};
}

static int reads(const json_t *kind, tl_expectation *got)
{
    said[0] = '\0';
    return tl_memory_read(folder, kind, got, &listening);
}

/* What was written is read again, infinities too, by frames of that kind and by no others. */
static void remembers(void **state)
{
    (void)state;
    prepared_frame p = prepare_frame(30), like = prepare_frame(33), other = prepare_frame(60);
    const tl_goal rms = {.kind = TL_GOAL_RMS},
                  stops = {.kind = TL_GOAL_CODES, .exposure = 1.0f},
                  codes = {.kind = TL_GOAL_CODES};
    tl_device_info driver = device;
    driver.driver[0] = '2';
    json_t *kind = kind_of(&p, &device, rms);
    json_t *others[] = {kind_of(&other, &device, rms), kind_of(&p, &device, codes),
                        kind_of(&p, &device, stops), kind_of(&p, &driver, rms)};
    json_t *alike = kind_of(&like, &device, rms);
    tl_expectation want[TL_MOST_CANDIDATES], got[TL_MOST_CANDIDATES];
    expectations_for_test(want);
    assert_false(reads(kind, got)); /* there is no folder */
    assert_string_equal(said, "");
    assert_true(tl_memory_write(folder, kind, want));
    assert_true(reads(kind, got));
    for (uint32_t i = 0; i < tl_candidate_count; i++) {
        assert_true(got[i].ms == want[i].ms);
        assert_true(got[i].error == want[i].error ||
                    fabs(got[i].error / want[i].error - 1.0) < 1e-8);
    }
    assert_true(reads(alike, got));
    assert_false(json_equal(others[1], others[2]));
    for (size_t i = 0; i < COUNT_OF(others); i++) {
        assert_false(json_equal(others[i], kind));
        assert_false(reads(others[i], got));
        assert_string_equal(said, "");
        json_decref(others[i]);
    }
    assert_false(tl_memory_read(NULL, kind, got, &listening));
    assert_false(tl_memory_write(NULL, kind, want));
    json_decref(kind);
    json_decref(alike);
    prepared_frame_clear(&p);
    prepared_frame_clear(&like);
    prepared_frame_clear(&other);
}

static void path_of_the_only_file(char *path, size_t size)
{
    DIR *opened = opendir(folder);
    int count = 0;
    assert_non_null(opened);
    for (const struct dirent *entry; (entry = readdir(opened));)
        if (entry->d_name[0] != '.') {
            snprintf(path, size, "%s/%s", folder, entry->d_name);
            count++;
        }
    closedir(opened);
    assert_int_equal(count, 1);
}

static void write_text(const char *path, const char *text, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(text, 1, length, file);
    fclose(file);
}

/* The text with one word in place of another that is in it. */
static void write_changed(const char *path,
                          const char *text,
                          const char *word,
                          const char *other)
{
    const char *at = strstr(text, word);
    char changed[16384];
    assert_non_null(at);
    const int length = snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text,
                                other, at + strlen(word));
    write_text(path, changed, (size_t)length);
}

/* Cut anywhere, of another version, of another kind, with words for numbers: it counts as missing, a sentence
 * says so, and it is replaced. */
static void damage(void **state)
{
    static const char *const changes[][3] = {
        {"\"format\": 1", "\"format\": 2", "another version"},
        {"\"program\": \"", "\"program\": \"9", "another version"},
        {"\"program\"", "\"programm\"", "another version"},
        {"\"a device\"", "\"a devise\"", "another kind"},
        {"\"ms\": 1.5", "\"ms\": -1.5", "damaged"},
        {"\"ms\": 1.5", "\"ms\": \"fast\"", "damaged"},
        {"\"ms\": 1.5", "\"mS\": 1.5", "damaged"},
        {"\"--precision double\"", "\"--precision doublet\"", "another version"},
        {"\"candidates\": {", "\"candidate\": {", "damaged"},
    };
    static char text[16384];
    char path[8300];
    (void)state;
    prepared_frame p = prepare_frame(30);
    json_t *kind = kind_of(&p, &device, (tl_goal){.kind = TL_GOAL_RMS});
    tl_expectation want[TL_MOST_CANDIDATES], got[TL_MOST_CANDIDATES];
    expectations_for_test(want);
    assert_true(tl_memory_write(folder, kind, want));
    path_of_the_only_file(path, sizeof path);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = '\0';
    for (size_t cut = 0; cut < length - 2;
         cut += 1 + cut / 16) { /* the last two are a brace and a newline */
        write_text(path, text, cut);
        assert_false(reads(kind, got));
        assert_non_null(strstr(said, path));
    }
    for (size_t i = 0; i < COUNT_OF(changes); i++) {
        write_changed(path, text, changes[i][0], changes[i][1]);
        assert_false(reads(kind, got));
        if (!strstr(said, changes[i][2]))
            fail_msg("%s for %s: it should say \"%s\", and said: %s", changes[i][1],
                     changes[i][0], changes[i][2], said);
    }
    assert_true(tl_memory_write(folder, kind, want));
    assert_true(reads(kind, got));
    assert_string_equal(said, "");
    json_decref(kind);
    prepared_frame_clear(&p);
}

/* The folder's limit is for these files, too. */
static void trimmed_with_the_programs(void **state)
{
    char path[8300];
    (void)state;
    prepared_frame p = prepare_frame(30);
    json_t *kind = kind_of(&p, &device, (tl_goal){.kind = TL_GOAL_RMS});
    tl_expectation want[TL_MOST_CANDIDATES];
    expectations_for_test(want);
    assert_true(tl_memory_write(folder, kind, want));
    path_of_the_only_file(path, sizeof path);
    tl_program_cache_trim(folder, 1 << 20);
    assert_int_equal(access(path, F_OK), 0);
    tl_program_cache_trim(folder, 16);
    assert_int_not_equal(access(path, F_OK), 0);
    json_decref(kind);
    prepared_frame_clear(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chooses),
        cmocka_unit_test(the_table),
        cmocka_unit_test_setup(remembers, empty_folder),
        cmocka_unit_test_setup(damage, empty_folder),
        cmocka_unit_test_setup(trimmed_with_the_programs, empty_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
