/* Do files appear whole or not at all: on a full disk, in a read-only place, over links, devices
 * and pipes? */
#define _GNU_SOURCE /* unshare */
#include "file_cases.h"

#include "atomic_file.h"
#include "full_device.h"
#include "tilelight/gbuffer_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

static char folder[512];

/* A path in the test's own folder. */
static const char *in_folder(const char *name)
{
    static char paths[4][1024];
    static int next;
    next = (next + 1) % 4;
    snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
    return paths[next];
}

static int make_folder(void **state)
{
    (void)state;
    scratch_path(folder, sizeof folder, "atomic-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    const int left = count_names(folder);
    rmdir(folder);
    if (left > 0)
        print_error("%d names left in %s\n", left, folder);
    return left;
}

static tl_status write_text(const char *path, const char *text, tl_error *err)
{
    tl_atomic_file file = {0};
    tl_status status = tl_atomic_file_begin(&file, path, err);
    if (status != TL_OK)
        return status;
    assert_int_equal(tl_write_all(file.descriptor, text, strlen(text)), 0);
    status = tl_atomic_file_commit(&file, err);
    assert_null(file.target);
    return status;
}

static void old_until_commit(void **state)
{
    (void)state;
    tl_error err;
    struct stat seen;
    tl_atomic_file file = {0};
    const char *path = in_folder("a");
    const mode_t before = umask(027);
    ASSERT_OK(write_text(path, "old", &err), err);
    ASSERT_OK(tl_atomic_file_begin(&file, path, &err), err);
    assert_int_equal(tl_write_all(file.descriptor, "new", 3), 0);
    assert_holds(path, "old");
    assert_int_equal(count_names(folder), 2);
    ASSERT_OK(tl_atomic_file_commit(&file, &err), err);
    umask(before);
    assert_holds(path, "new");
    assert_int_equal(count_names(folder), 1);
    assert_int_equal(stat(path, &seen), 0);
    assert_int_equal(seen.st_mode & 0777, 0640);
    tl_atomic_file_abandon(&file);
    assert_holds(path, "new");
    remove(path);
}

static void abandoned(void **state)
{
    (void)state;
    tl_error err;
    tl_atomic_file file = {0}, none = {0};
    const char *path = in_folder("b");
    ASSERT_OK(write_text(path, "old", &err), err);
    ASSERT_OK(tl_atomic_file_begin(&file, path, &err), err);
    assert_int_equal(tl_write_all(file.descriptor, "new", 3), 0);
    tl_atomic_file_abandon(&file);
    tl_atomic_file_abandon(&file);
    tl_atomic_file_abandon(&none);
    assert_holds(path, "old");
    assert_int_equal(count_names(folder), 1);
    remove(path);
}

/* The longest name that a folder takes, and one more. */
static void long_names(void **state)
{
    static const char *const words[] = {"too long", NULL};
    (void)state;
    tl_error err;
    char name[257];
    memset(name, 'n', sizeof name);
    name[255] = '\0';
    ASSERT_OK(write_text(in_folder(name), "x", &err), err);
    assert_holds(in_folder(name), "x");
    remove(in_folder(name));
    name[255] = 'n';
    name[256] = '\0';
    assert_refused("long", write_text(in_folder(name), "x", &err), TL_ERR_WRITE, &err, words);
}

static void places_that_are_none(void **state)
{
    static const char *const missing[] = {"absent/x", "No such file", "folder", NULL};
    static const char *const is_folder[] = {"directory", "name a file in it", NULL};
    static const char *const no_folder[] = {"Not a directory", NULL};
    static const char *const loop[] = {"symbolic links", NULL};
    static const char *const nothing[] = {"No such file", NULL};
    (void)state;
    tl_error err;
    assert_refused("missing folder", write_text(in_folder("absent/x"), "x", &err), TL_ERR_WRITE,
                   &err, missing);
    assert_refused("folder", write_text(folder, "x", &err), TL_ERR_WRITE, &err, is_folder);
    assert_refused("folder/", write_text(in_folder(""), "x", &err), TL_ERR_WRITE, &err,
                   is_folder);
    assert_refused("no name", write_text("", "x", &err), TL_ERR_WRITE, &err, nothing);
    ASSERT_OK(write_text(in_folder("file"), "x", &err), err);
    assert_refused("in a file", write_text(in_folder("file/x"), "x", &err), TL_ERR_WRITE, &err,
                   no_folder);
    assert_int_equal(symlink("loop", in_folder("loop")), 0);
    assert_refused("loop", write_text(in_folder("loop"), "x", &err), TL_ERR_WRITE, &err, loop);
    remove(in_folder("loop"));
    remove(in_folder("file"));
}

/* The target turns into a folder in the meantime, so the rename fails. */
static void rename_fails(void **state)
{
    static const char *const words[] = {"cannot be written", NULL};
    (void)state;
    tl_error err;
    tl_atomic_file file = {0};
    ASSERT_OK(tl_atomic_file_begin(&file, in_folder("c"), &err), err);
    assert_int_equal(mkdir(in_folder("c"), 0777), 0);
    assert_refused("rename", tl_atomic_file_commit(&file, &err), TL_ERR_WRITE, &err, words);
    assert_int_equal(count_names(folder), 1);
    rmdir(in_folder("c"));
}

static void links_are_followed(void **state)
{
    (void)state;
    tl_error err;
    struct stat seen;
    assert_int_equal(mkdir(in_folder("sub"), 0777), 0);
    ASSERT_OK(write_text(in_folder("sub/real"), "old", &err), err);
    assert_int_equal(symlink("sub/real", in_folder("first")), 0);
    assert_int_equal(symlink(in_folder("first"), in_folder("second")), 0);
    assert_int_equal(symlink("sub/new", in_folder("dangling")), 0);
    ASSERT_OK(write_text(in_folder("second"), "new", &err), err);
    ASSERT_OK(write_text(in_folder("dangling"), "made", &err), err);
    assert_holds(in_folder("sub/real"), "new");
    assert_holds(in_folder("sub/new"), "made");
    assert_int_equal(lstat(in_folder("second"), &seen), 0);
    assert_true(S_ISLNK(seen.st_mode));
    assert_int_equal(count_names(folder), 4);
    assert_int_equal(count_names(in_folder("sub")), 2);
    remove(in_folder("second"));
    remove(in_folder("first"));
    remove(in_folder("dangling"));
    remove(in_folder("sub/real"));
    remove(in_folder("sub/new"));
    rmdir(in_folder("sub"));
}

static void devices(void **state)
{
    static const char *const words[] = {"No space left", "free some space", NULL};
    (void)state;
    char null[512], full[512];
    tl_error err;
    struct stat seen;
    own_device(null, sizeof null, "atomic_null", 3);
    own_device(full, sizeof full, "atomic_full", 7);
    ASSERT_OK(write_text(null, "x", &err), err);
    assert_int_equal(stat(null, &seen), 0);
    assert_true(S_ISCHR(seen.st_mode));
    assert_refused("full", write_text(full, "x", &err), TL_ERR_WRITE, &err, words);
    assert_int_equal(stat(full, &seen), 0);
    assert_true(S_ISCHR(seen.st_mode));
    remove_device(null);
    remove_device(full);
}

static void *drain(void *path)
{
    static char got[64];
    FILE *pipe = fopen(path, "rb");
    got[pipe ? fread(got, 1, sizeof got - 1, pipe) : 0] = '\0';
    if (pipe)
        fclose(pipe);
    return got;
}

static void pipes(void **state)
{
    (void)state;
    tl_error err;
    pthread_t reader;
    void *got = NULL;
    char path[1024];
    snprintf(path, sizeof path, "%s", in_folder("pipe"));
    assert_int_equal(mkfifo(path, 0666), 0);
    assert_int_equal(pthread_create(&reader, NULL, drain, path), 0);
    ASSERT_OK(write_text(path, "through", &err), err);
    assert_int_equal(pthread_join(reader, &got), 0);
    assert_string_equal(got, "through");
    remove(path);
}

/* As /dev/stdout stands for what a shell's >> has opened: the file must stay the same one. */
static void open_descriptors(void **state)
{
    (void)state;
    tl_error err;
    char path[64];
    struct stat before, after;
    save_bytes(in_folder("log"), "first ", 6);
    const int descriptor = open(in_folder("log"), O_WRONLY | O_APPEND);
    assert_true(descriptor >= 0);
    assert_int_equal(fstat(descriptor, &before), 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    assert_int_equal(symlink(path, in_folder("out")), 0);
    ASSERT_OK(write_text(path, "second ", &err), err);
    ASSERT_OK(write_text(in_folder("out"), "third", &err), err);
    close(descriptor);
    assert_holds(in_folder("log"), "first second third");
    assert_int_equal(stat(in_folder("log"), &after), 0);
    assert_int_equal(before.st_ino, after.st_ino);
    remove(in_folder("out"));
    remove(in_folder("log"));
}

/* Writes a G-buffer of some 400 KB over an old file and expects it to fail. */
static void assert_frame_refused(const char *name, const char *const *words)
{
    tl_error err = {.status = TL_OK};
    tl_gbuffer *gbuffer = NULL;
    char path[1024];
    const tl_camera camera = awkward_camera(120, 100);
    snprintf(path, sizeof path, "%s", in_folder("disk/frame.exr"));
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &gbuffer, &err), err);
    assert_refused(name, tl_gbuffer_write(path, gbuffer, NULL, &err), TL_ERR_WRITE, &err,
                   words);
    assert_holds(path, "old");
    assert_int_equal(count_names(in_folder("disk")), 1);
    tl_gbuffer_destroy(gbuffer);
}

/* A disk of 64 KiB in a mount namespace of our own, which ends with the process. */
static void full_and_read_only_disks(void **state)
{
    static const char *const full[] = {"frame.exr", "No space left", NULL};
    static const char *const read_only[] = {"frame.exr", "Read-only", NULL};
    (void)state;
    assert_int_equal(mkdir(in_folder("disk"), 0777), 0);
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0 ||
        mount("tmpfs", in_folder("disk"), "tmpfs", 0, "size=64k") != 0) {
        rmdir(in_folder("disk"));
        print_message("needs the right to mount: skipped\n");
        skip();
    }
    save_bytes(in_folder("disk/frame.exr"), "old", 3);
    assert_frame_refused("full", full);
    assert_int_equal(mount("tmpfs", in_folder("disk"), "tmpfs", MS_REMOUNT | MS_RDONLY, ""), 0);
    assert_frame_refused("read-only", read_only);
    assert_int_equal(umount(in_folder("disk")), 0);
    rmdir(in_folder("disk"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(old_until_commit), cmocka_unit_test(abandoned),
        cmocka_unit_test(long_names),       cmocka_unit_test(places_that_are_none),
        cmocka_unit_test(rename_fails),     cmocka_unit_test(links_are_followed),
        cmocka_unit_test(devices),          cmocka_unit_test(pipes),
        cmocka_unit_test(open_descriptors), cmocka_unit_test(full_and_read_only_disks),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
