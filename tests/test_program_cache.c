/* Does the folder of compiled programs give back what was put in, and nothing else: not what is
 * cut, damaged, of another key or of another format, whoever writes at the same time? */
#define _GNU_SOURCE /* utimensat, setenv */
#include "testing.h"

#include "program_cache.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char folder[512];

static const tl_bytes key = {"source and options", 18}, other_key = {"source and option", 17};
static const tl_bytes note = {"note", 4};
static char code[1003];
static const tl_bytes binary = {code, sizeof code};

static int make_folder(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof code; i++)
        code[i] = (char)(i * 7 + i / 256);
    scratch_path(folder, sizeof folder, "program-cache-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return 0;
}

static int remove_folder(void **state)
{
    char command[600];
    (void)state;
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

static int has_suffix(const char *name, const char *suffix)
{
    const size_t length = strlen(name), end = strlen(suffix);
    return length >= end && strcmp(name + length - end, suffix) == 0;
}

/* How many files of the folder end in this; the path of the last. */
static int count_files(const char *suffix, char path[1024])
{
    int count = 0;
    DIR *opened = opendir(folder);
    assert_non_null(opened);
    for (const struct dirent *entry; (entry = readdir(opened));)
        if (entry->d_name[0] != '.' && has_suffix(entry->d_name, suffix)) {
            count++;
            if (path)
                snprintf(path, 1024, "%s/%s", folder, entry->d_name);
        }
    closedir(opened);
    return count;
}

static void empty_folder(void)
{
    char path[1024];
    while (count_files("", path) > 0)
        assert_int_equal(remove(path), 0);
}

static void assert_found(tl_bytes wanted_key)
{
    tl_program_entry entry;
    assert_true(tl_program_cache_read(folder, wanted_key, &entry));
    assert_int_equal(entry.note.size, note.size);
    assert_memory_equal(entry.note.data, note.data, note.size);
    assert_int_equal(entry.binary.size, binary.size);
    assert_memory_equal(entry.binary.data, binary.data, binary.size);
    assert_int_equal((uintptr_t)entry.binary.data % 8, 0);
    tl_program_entry_release(&entry);
    assert_null(entry.memory);
}

static void assert_missing(tl_bytes wanted_key)
{
    tl_program_entry entry;
    if (tl_program_cache_read(folder, wanted_key, &entry))
        fail_msg("found what is not there");
    assert_null(entry.memory);
}

/* The file of the one entry, [*size]; the caller frees it. */
static char *load_entry(char path[1024], size_t *size)
{
    struct stat seen;
    assert_int_equal(count_files(".program", path), 1);
    assert_int_equal(stat(path, &seen), 0);
    *size = (size_t)seen.st_size;
    char *bytes = malloc(*size);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static void store(const char *path, const char *bytes, size_t size)
{
    remove(path); /* some file systems wait for the disk where a file is emptied and filled */
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void what_was_put_in(void **state)
{
    static const tl_bytes nothing = {NULL, 0};
    tl_program_entry entry;
    (void)state;
    empty_folder();
    assert_missing(key);
    assert_true(tl_program_cache_write(folder, key, note, binary));
    assert_found(key);
    assert_missing(other_key);
    assert_true(tl_program_cache_write(folder, other_key, nothing, nothing));
    assert_true(tl_program_cache_read(folder, other_key, &entry));
    assert_int_equal(entry.note.size + entry.binary.size, 0);
    tl_program_entry_release(&entry);
    assert_found(key);
    assert_int_equal(count_files("", NULL), 2);
}

static void cut_at_every_length(void **state)
{
    char path[1024];
    size_t size;
    (void)state;
    empty_folder();
    assert_true(tl_program_cache_write(folder, key, note, binary));
    char *bytes = load_entry(path, &size);
    for (size_t length = 0; length < size; length++) {
        store(path, bytes, length);
        assert_missing(key);
    }
    bytes = realloc(bytes, size + 1);
    bytes[size] = 0;
    store(path, bytes, size + 1); /* and where something follows */
    assert_missing(key);
    store(path, bytes, size);
    assert_found(key);
    free(bytes);
}

static void damaged_in_every_byte(void **state)
{
    char path[1024];
    size_t size;
    (void)state;
    empty_folder();
    assert_true(tl_program_cache_write(folder, key, note, binary));
    char *bytes = load_entry(path, &size);
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (char)(bytes[i] ^ (1 << i % 8));
        store(path, bytes, size);
        assert_missing(key);
        bytes[i] = (char)(bytes[i] ^ (1 << i % 8));
    }
    free(bytes);
    assert_true(tl_program_cache_write(folder, key, note, binary));
    assert_found(key);
}

/* As if two keys had one hash. */
static void of_another_key(void **state)
{
    static const tl_bytes twin = {"source and Options", 18};
    char path[1024];
    size_t size;
    (void)state;
    empty_folder();
    assert_true(tl_program_cache_write(folder, key, note, binary));
    char *bytes = load_entry(path, &size);
    empty_folder();
    assert_true(tl_program_cache_write(folder, twin, note, binary));
    free(load_entry(path, &(size_t){0}));
    store(path, bytes, size);
    assert_missing(twin);
    free(bytes);
}

static void no_file_at_all(void **state)
{
    char path[1024];
    (void)state;
    empty_folder();
    assert_true(tl_program_cache_write(folder, key, note, binary));
    free(load_entry(path, &(size_t){0}));
    remove(path);
    assert_int_equal(mkfifo(path, 0600), 0); /* must not wait for a writer */
    assert_missing(key);
    remove(path);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_missing(key);
    assert_false(tl_program_cache_write(folder, key, note, binary));
    assert_int_equal(rmdir(path), 0);
}

static void nowhere_to_write(void **state)
{
    struct rlimit before, none;
    char file[600];
    (void)state;
    snprintf(file, sizeof file, "%s/file", folder);
    empty_folder();
    store(file, "", 0);
    assert_false(tl_program_cache_write(file, key, note, binary));
    assert_false(tl_program_cache_write("/proc/none", key, note, binary));
    assert_int_equal(tl_program_cache_lock("/proc/none", key, 10.0), -1);
    tl_program_cache_unlock("/proc/none", key, -1);
    tl_program_cache_trim("/proc/none", 0);
    remove(file);
    /* A full disk, as far as a process can have one of its own. */
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    none = before;
    none.rlim_cur = 200;
    setrlimit(RLIMIT_FSIZE, &none);
    const bool written = tl_program_cache_write(folder, key, note, binary);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_false(written);
    assert_int_equal(count_files("", NULL), 0);
    assert_missing(key);
}

static void folders_are_made(void **state)
{
    char deep[600], path[700];
    struct stat seen;
    (void)state;
    empty_folder();
    snprintf(deep, sizeof deep, "%s/a/b", folder);
    assert_true(tl_program_cache_write(deep, key, note, binary));
    assert_int_equal(stat(deep, &seen), 0);
    assert_int_equal(seen.st_mode & 0777, 0700);
    snprintf(path, sizeof path, "rm -r '%s/a'", folder);
    assert_int_equal(system(path), 0);
}

static void set(const char *name, const char *value)
{
    if (value)
        setenv(name, value, 1);
    else
        unsetenv(name);
}

static void folder_by_environment(void **state)
{
    static const struct {
        const char *own, *caches, *home, *folder;
    } cases[] = {
        {"/a", "/b", "/c", "/a"},
        {"a", "/b", "/c", "a"},
        {"", "/b", "/c", NULL},
        {NULL, "/b", "/c", "/b/tilelight"},
        {NULL, "b", "/c", "/c/.cache/tilelight"}, /* the specification: ignore relative ones */
        {NULL, "", "/c", "/c/.cache/tilelight"},
        {NULL, NULL, "/c", "/c/.cache/tilelight"},
        {NULL, NULL, "", NULL},
        {NULL, NULL, NULL, NULL},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        set("TILELIGHT_CACHE", cases[i].own);
        set("XDG_CACHE_HOME", cases[i].caches);
        set("HOME", cases[i].home);
        char *got = tl_program_cache_folder();
        if (cases[i].folder)
            assert_string_equal(got, cases[i].folder);
        else
            assert_null(got);
        free(got);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A process that takes the lock, says so, and then holds it or dies of it. */
static pid_t start_holder(int hold_ms, int finish)
{
    int ready[2];
    char said = 0;
    assert_int_equal(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        const int lock = tl_program_cache_lock(folder, key, 10.0);
        if (write(ready[1], lock >= 0 ? "y" : "n", 1) != 1)
            _exit(1);
        usleep((useconds_t)hold_ms * 1000);
        if (finish) {
            tl_program_cache_write(folder, key, note, binary);
            tl_program_cache_unlock(folder, key, lock);
        }
        _exit(0);
    }
    assert_int_equal(read(ready[0], &said, 1), 1);
    close(ready[0]);
    close(ready[1]);
    assert_int_equal(said, 'y');
    return child;
}

static void locks(void **state)
{
    (void)state;
    empty_folder();
    const int lock = tl_program_cache_lock(folder, key, 0.0);
    assert_true(lock >= 0);
    assert_int_equal(tl_program_cache_lock(folder, key, 0.05), -1); /* gives up */
    const int beside = tl_program_cache_lock(folder, other_key, 0.0);
    assert_true(beside >= 0);
    tl_program_cache_unlock(folder, other_key, beside);
    tl_program_cache_unlock(folder, key, lock);
    assert_int_equal(count_files("", NULL), 0);

    pid_t child = start_holder(100, 1); /* makes the entry: nothing is left to lock */
    double start = seconds();
    assert_int_equal(tl_program_cache_lock(folder, key, 10.0), -1);
    assert_true(seconds() - start < 5.0);
    assert_found(key);
    waitpid(child, NULL, 0);

    /* Where an entry is there and unfit, its lock is worth waiting for; and the dead hold none. */
    child = start_holder(100, 0);
    start = seconds();
    const int inherited = tl_program_cache_lock(folder, key, 10.0);
    assert_true(inherited >= 0);
    assert_true(seconds() - start < 5.0);
    waitpid(child, NULL, 0);
    tl_program_cache_unlock(folder, key, inherited);
    assert_int_equal(count_files(".lock", NULL), 0);
}

static void write_and_read(double until)
{
    tl_program_entry entry;
    while (seconds() < until) {
        tl_program_cache_write(folder, key, note, binary);
        if (!tl_program_cache_read(folder, key, &entry))
            _exit(1);
        if (entry.binary.size != binary.size ||
            memcmp(entry.binary.data, binary.data, binary.size) != 0)
            _exit(2);
        tl_program_entry_release(&entry);
        tl_program_cache_trim(folder, UINT64_C(1) << 20);
    }
    _exit(0);
}

static void many_processes(void **state)
{
    enum { PROCESSES = 8 };
    const double until = seconds() + 0.5;
    (void)state;
    empty_folder();
    for (int i = 0; i < PROCESSES; i++)
        if (fork() == 0)
            write_and_read(until);
    for (int i = 0; i < PROCESSES; i++) {
        int status = -1;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
    assert_found(key);
    assert_int_equal(count_files("", NULL), 1);
}

static void put_at(const char *name, time_t age_s)
{
    char path[1024];
    struct timespec times[2] = {{0}};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    store(path, code, 1000);
    times[0].tv_sec = times[1].tv_sec = time(NULL) - age_s;
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

static int exists(const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, F_OK) == 0;
}

static void bounded(void **state)
{
    enum { OLD = 7200 };
    (void)state;
    empty_folder();
    put_at("1.program", 10);
    put_at("2.program", 40);
    put_at("3.program", 30);
    put_at("4.program", 20);
    put_at("old.lock", OLD);
    put_at("new.lock", 1);
    put_at(".1.program.tilelight-7-0", OLD);
    put_at(".2.program.tilelight-7-0", 1);
    put_at("notes.txt", OLD); /* not ours */
    tl_program_cache_trim(folder, 4000);
    assert_int_equal(count_files(".program", NULL), 4);
    tl_program_cache_trim(folder, 2999);
    assert_true(exists("1.program") && !exists("2.program") && !exists("3.program") &&
                exists("4.program"));
    assert_true(!exists("old.lock") && exists("new.lock"));
    assert_true(!exists(".1.program.tilelight-7-0") && exists(".2.program.tilelight-7-0"));
    assert_true(exists("notes.txt"));
    remove(".2.program.tilelight-7-0");

    /* Reading is use. */
    empty_folder();
    char path[1024];
    assert_true(tl_program_cache_write(folder, key, note, binary));
    free(load_entry(path, &(size_t){0}));
    const struct timespec long_ago[2] = {{1000, 0}, {1000, 0}};
    assert_int_equal(utimensat(AT_FDCWD, path, long_ago, 0), 0);
    put_at("5.program", 60);
    assert_found(key);
    tl_program_cache_trim(folder, 1500);
    assert_found(key);
    assert_false(exists("5.program"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_put_in),
        cmocka_unit_test(cut_at_every_length),
        cmocka_unit_test(damaged_in_every_byte),
        cmocka_unit_test(of_another_key),
        cmocka_unit_test(no_file_at_all),
        cmocka_unit_test(nowhere_to_write),
        cmocka_unit_test(folders_are_made),
        cmocka_unit_test(folder_by_environment),
        cmocka_unit_test(locks),
        cmocka_unit_test(many_processes),
        cmocka_unit_test(bounded),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
