/* A power cut, for a program that does not know: loaded before the C library, this keeps account of what of
 * one folder is on the disk for good, and at a chosen operation leaves of the rest what a cut may leave, and ends
 * the process.
 *
 * On the disk for good is the content that a file had when it was last synced, and the names that the folder
 * had when it was. What was written since may be there or not, and what was named since as well, but in its
 * order: a name is not there if an earlier one is not.
 *
 *   POWER_FOLDER    the folder, absolute; what is in folders within it is not followed
 *   POWER_JOURNAL   another on the same disk, empty: for what may come back
 *   POWER_CUT_AT    at which operation, counted from 1, in place of it; "end": once all is done; else never
 *   POWER_NAMES     of names since the last sync: "keep", "lose", or "some"
 *   POWER_CONTENTS  of contents: "keep", "lose", or "part", half of what there is
 *   POWER_COUNT     a file that is told how many operations there were, at the end
 *
 * Operations are what makes, writes, cuts, syncs, renames and removes a file there. Of files that are opened
 * with stdio or written through memory nothing is known. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_FILES = 4096, MOST_CHANGES = 65536, NAME = 256 };

/* A file, whatever its names. */
typedef struct file {
    ino_t inode;
    bool is_dirty; /* written since it was synced */
    bool
        has_synced; /* the journal has the content of then, as "synced-I"; "file-I" is the file itself */
} file;

/* A change of names since the folder was synced. */
typedef struct change {
    char from[NAME], to[NAME]; /* "" where there is none: made, removed */
    int file, replaced;        /* what has moved, and what was there; -1: nothing */
} change;

#pragma GCC diagnostic ignored \
    "-Wpedantic" /* a pointer to data becomes one to a function, as POSIX has it */

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static file files[MOST_FILES];
static change changes[MOST_CHANGES];
static int file_count, change_count;
static unsigned long operation, cut_at;
static const char *folder, *journal;
static ino_t folder_inode;

#define REAL(name, type) ((type)(void *)real(#name))

static void *real(const char *name)
{
    void *const found = dlsym(RTLD_NEXT, name);
    if (!found)
        abort();
    return found;
}

typedef int open_call(const char *, int, ...);
typedef int rename_call(const char *, const char *);
typedef int unlink_call(const char *);
typedef int fsync_call(int);
typedef int ftruncate_call(int, off_t);
typedef ssize_t write_call(int, const void *, size_t);
typedef ssize_t pwrite_call(int, const void *, size_t, off_t);

static void fail(const char *what)
{
    fprintf(stderr, "power cut: %s: %s\n", what, strerror(errno));
    abort();
}

static bool says(const char *variable, const char *word)
{
    const char *value = getenv(variable);
    return value && strcmp(value, word) == 0;
}

static void path_in(char *out, const char *where, const char *name)
{
    if (snprintf(out, PATH_MAX, "%s/%s", where, name) >= PATH_MAX)
        fail("name");
}

static void journal_path(char *out, const char *what, int index)
{
    char name[64];
    snprintf(name, sizeof name, "%s-%d", what, index);
    path_in(out, journal, name);
}

/* Half of it, where `is_half`. */
static void copy(const char *from, const char *to, bool is_half)
{
    char bytes[65536];
    struct stat seen;
    const int in = REAL(open, open_call *)(from, O_RDONLY);
    const int out = REAL(open, open_call *)(to, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (in < 0 || out < 0 || fstat(in, &seen) != 0)
        fail(from);
    off_t left = is_half ? seen.st_size / 2 : seen.st_size;
    while (left > 0) {
        const ssize_t got =
            read(in, bytes, left < (off_t)sizeof bytes ? (size_t)left : sizeof bytes);
        if (got <= 0 || REAL(write, write_call *)(out, bytes, (size_t)got) != got)
            fail(to);
        left -= got;
    }
    close(in);
    close(out);
}

/* The name within the folder, or NULL: it is elsewhere. */
static const char *name_in_folder(const char *path)
{
    char parent[PATH_MAX], whole[PATH_MAX];
    const char *slash = strrchr(path, '/');
    if (!folder || strlen(path) >= PATH_MAX)
        return NULL;
    snprintf(parent, sizeof parent, "%.*s", slash ? (int)(slash - path) + 1 : 1,
             slash ? path : ".");
    if (!realpath(parent, whole) || strcmp(whole, folder) != 0)
        return NULL;
    return slash ? slash + 1 : path;
}

static int find_file(ino_t inode)
{
    for (int i = 0; i < file_count; i++)
        if (files[i].inode == inode)
            return i;
    return -1;
}

/* Of a name in the folder, -1 where there is nothing; what was there before is on the disk for good. */
static int know_file(const char *name, bool is_new)
{
    char path[PATH_MAX], kept[PATH_MAX];
    struct stat seen;
    path_in(path, folder, name);
    if (lstat(path, &seen) != 0 || !S_ISREG(seen.st_mode))
        return -1;
    const int known = find_file(seen.st_ino);
    if (known >= 0)
        return known;
    if (file_count == MOST_FILES)
        fail("files");
    files[file_count] = (file){.inode = seen.st_ino, .is_dirty = is_new, .has_synced = !is_new};
    journal_path(kept, "file", file_count);
    if (link(path, kept) != 0)
        fail(kept);
    if (!is_new) {
        journal_path(kept, "synced", file_count);
        copy(path, kept, false);
    }
    return file_count++;
}

static void add_change(const char *from, const char *to, int subject, int replaced)
{
    if (change_count == MOST_CHANGES)
        fail("changes");
    change *const made = &changes[change_count++];
    *made = (change){.file = subject, .replaced = replaced};
    snprintf(made->from, NAME, "%s", from);
    snprintf(made->to, NAME, "%s", to);
}

/* Back under the name. */
static void name_again(int index, const char *name)
{
    char kept[PATH_MAX], path[PATH_MAX];
    journal_path(kept, "file", index);
    path_in(path, folder, name);
    if (link(kept, path) != 0)
        fail(path);
}

static void undo(const change *last)
{
    char path[PATH_MAX];
    if (last->to[0]) {
        path_in(path, folder, last->to);
        if (REAL(unlink, unlink_call *)(path) != 0)
            fail(path);
        if (last->replaced >= 0)
            name_again(last->replaced, last->to);
    }
    if (last->from[0])
        name_again(last->file, last->from);
}

static void leave_names(void)
{
    int kept = says("POWER_NAMES", "keep") ? change_count : 0;
    if (says("POWER_NAMES", "some"))
        kept = change_count / 2;
    while (change_count > kept)
        undo(&changes[--change_count]);
}

static void leave_contents(void)
{
    for (int i = 0; i < file_count && !says("POWER_CONTENTS", "keep"); i++) {
        char path[PATH_MAX], synced[PATH_MAX], half[PATH_MAX];
        if (!files[i].is_dirty)
            continue;
        journal_path(path, "file", i);
        journal_path(synced, "synced", i);
        journal_path(half, "half", i);
        if (says("POWER_CONTENTS", "part")) {
            copy(path, half, true);
            copy(half, path, false);
        } else if (files[i].has_synced) {
            copy(synced, path, false);
        } else if (truncate(path, 0) != 0) {
            fail(path);
        }
    }
}

static void cut(void)
{
    leave_names();
    leave_contents();
    kill(getpid(), SIGKILL);
}

/* Before each operation, which holds the lock. */
static void begin_operation(void)
{
    if (++operation == cut_at)
        cut();
}

__attribute__((constructor)) static void begin(void)
{
    struct stat seen;
    const char *at = getenv("POWER_CUT_AT");
    folder = getenv("POWER_FOLDER");
    journal = getenv("POWER_JOURNAL");
    if (!folder || !journal || stat(folder, &seen) != 0)
        folder = NULL;
    else
        folder_inode = seen.st_ino;
    cut_at = at ? strtoul(at, NULL, 10) : 0;
}

__attribute__((destructor)) static void end(void)
{
    const char *count = getenv("POWER_COUNT");
    if (!folder)
        return;
    FILE *const to = count ? fopen(count, "w") : NULL;
    if (to) {
        fprintf(to, "%lu\n", operation);
        fclose(to);
    }
    if (says("POWER_CUT_AT", "end"))
        cut();
}

/* The file behind a descriptor, if it is one of the folder's; -1. */
static int file_of(int descriptor)
{
    struct stat seen;
    if (!folder || fstat(descriptor, &seen) != 0 || !S_ISREG(seen.st_mode))
        return -1;
    return find_file(seen.st_ino);
}

/* Under the lock: opens what may be new, or is emptied. */
static int open_there(const char *path, const char *name, int flags, mode_t mode)
{
    struct stat seen;
    const bool is_new = lstat(path, &seen) != 0;
    if ((flags & O_ACCMODE) == O_RDONLY && !(flags & O_CREAT))
        return REAL(open, open_call *)(path, flags, mode);
    if (!is_new)
        know_file(name, false);
    if (is_new && (flags & O_CREAT))
        begin_operation();
    const int descriptor = REAL(open, open_call *)(path, flags, mode);
    if (descriptor >= 0 && is_new)
        add_change("", name, know_file(name, true), -1);
    if (descriptor >= 0 && !is_new && (flags & O_TRUNC))
        files[know_file(name, false)].is_dirty = true;
    return descriptor;
}

int open(const char *path, int flags, ...)
{
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    pthread_mutex_lock(&lock);
    const char *const name = name_in_folder(path);
    const int descriptor =
        name ? open_there(path, name, flags, mode) : REAL(open, open_call *)(path, flags, mode);
    const int failure = errno;
    pthread_mutex_unlock(&lock);
    errno = failure;
    return descriptor;
}

/* Runs `call` as an operation on the content of a file of the folder; of others as it is. */
#define ON_CONTENT(descriptor, type, call) \
    pthread_mutex_lock(&lock);             \
    const int which = file_of(descriptor); \
    if (which >= 0) {                      \
        begin_operation();                 \
        files[which].is_dirty = true;      \
    }                                      \
    const type result = call;              \
    const int failure = errno;             \
    pthread_mutex_unlock(&lock);           \
    errno = failure;                       \
    return result

ssize_t write(int descriptor, const void *bytes, size_t size)
{
    ON_CONTENT(descriptor, ssize_t, REAL(write, write_call *)(descriptor, bytes, size));
}

ssize_t pwrite(int descriptor, const void *bytes, size_t size, off_t offset)
{
    ON_CONTENT(descriptor, ssize_t,
               REAL(pwrite, pwrite_call *)(descriptor, bytes, size, offset));
}

int ftruncate(int descriptor, off_t size)
{
    ON_CONTENT(descriptor, int, REAL(ftruncate, ftruncate_call *)(descriptor, size));
}

static void note_sync(int descriptor)
{
    char path[PATH_MAX], synced[PATH_MAX];
    struct stat seen;
    const int which = file_of(descriptor);
    if (which >= 0) {
        journal_path(path, "file", which);
        journal_path(synced, "synced", which);
        copy(path, synced, false);
        files[which].is_dirty = false;
        files[which].has_synced = true;
    } else if (fstat(descriptor, &seen) == 0 && seen.st_ino == folder_inode) {
        change_count = 0;
    }
}

static bool is_of_folder(int descriptor)
{
    struct stat seen;
    return folder && fstat(descriptor, &seen) == 0 &&
           (seen.st_ino == folder_inode || file_of(descriptor) >= 0);
}

/* What is synced needs no disk here. */
int fsync(int descriptor)
{
    pthread_mutex_lock(&lock);
    const bool is_ours = is_of_folder(descriptor);
    if (is_ours) {
        begin_operation();
        note_sync(descriptor);
    }
    const int result = is_ours ? 0 : REAL(fsync, fsync_call *)(descriptor);
    pthread_mutex_unlock(&lock);
    return result;
}

int fdatasync(int descriptor)
{
    return fsync(descriptor);
}

int rename(const char *from, const char *to)
{
    pthread_mutex_lock(&lock);
    const char *const old_name = name_in_folder(from), *const new_name = name_in_folder(to);
    if (old_name && new_name) {
        begin_operation();
        add_change(old_name, new_name, know_file(old_name, false), know_file(new_name, false));
    }
    const int result = REAL(rename, rename_call *)(from, to);
    const int failure = errno;
    if (result != 0 && old_name && new_name)
        change_count--;
    pthread_mutex_unlock(&lock);
    errno = failure;
    return result;
}

int unlink(const char *path)
{
    struct stat seen;
    pthread_mutex_lock(&lock);
    const char *const name = name_in_folder(path);
    const bool is_there = name && lstat(path, &seen) == 0;
    if (is_there) {
        begin_operation();
        add_change(name, "", know_file(name, false), -1);
    }
    const int result = REAL(unlink, unlink_call *)(path);
    const int failure = errno;
    if (result != 0 && is_there)
        change_count--;
    pthread_mutex_unlock(&lock);
    errno = failure;
    return result;
}
