#define _GNU_SOURCE /* memfd_create */
#include "atomic_file.h"

#include "held_name.h"
#include "target.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    MAX_NAME_LENGTH = 200, /* of the target's name in the temporary one: 255 bytes in all */
    MAX_TRIES = 100        /* leftovers of a killed process with our id */
};

tl_status tl_write_failed(const char *target, int error_number, tl_error *err)
{
    static const struct {
        int error_number;
        const char *advice;
    } known[] = {
        {ENOENT, "; create its folder first"},
        {ENOSPC, "; free some space or write elsewhere"},
        {EDQUOT, "; free some space or write elsewhere"},
        {EROFS, "; write elsewhere"},
        {EACCES, "; write elsewhere or change the permissions"},
        {EPERM, "; write elsewhere or change the permissions"},
        {EISDIR, "; name a file in it"},
        {EFBIG, "; write elsewhere or raise the limit on file sizes"},
    };
    const char *advice = "";
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (known[i].error_number == error_number)
            advice = known[i].advice;
    return tl_fail(err, TL_ERR_WRITE, "%s: cannot be written: %s%s", target,
                   strerror(error_number), advice);
}

int tl_write_all(int descriptor, const void *data, size_t size)
{
    const char *left = data;
    while (size > 0) {
        const ssize_t written = write(descriptor, left, size);
        if (written < 0 && errno != EINTR)
            return errno;
        if (written > 0) {
            left += written;
            size -= (size_t)written;
        }
    }
    return 0;
}

static void release(tl_atomic_file *file)
{
    if (file->descriptor >= 0)
        close(file->descriptor);
    free(file->temporary);
    free(file->target);
    *file = (tl_atomic_file){0};
}

/* Returns 0 or an errno. */
static int create_temporary(tl_atomic_file *file)
{
    static atomic_uint serial;
    const char *slash = strrchr(file->target, '/');
    const char *name = slash ? slash + 1 : file->target;
    if (!name[0])
        return slash ? EISDIR : ENOENT;
    for (int i = 0; i < MAX_TRIES; i++) {
        char *temporary = NULL;
        if (asprintf(&temporary, "%.*s.%.*s.tilelight-%ld-%u", (int)(name - file->target),
                     file->target, MAX_NAME_LENGTH, name, (long)getpid(),
                     atomic_fetch_add(&serial, 1u)) < 0)
            return ENOMEM;
        file->descriptor = open(temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->descriptor >= 0) {
            file->temporary = temporary;
            return 0;
        }
        free(temporary);
        if (errno != EEXIST)
            return errno;
    }
    return EEXIST;
}

/* Empty, whatever a killed process left in it. Returns 0 or an errno. */
static int open_held(tl_atomic_file *file, tl_held_name *name)
{
    file->temporary = strdup(name->temporary);
    file->descriptor = fcntl(name->descriptor, F_DUPFD_CLOEXEC, 0);
    if (!file->temporary || file->descriptor < 0)
        return file->temporary ? errno : ENOMEM;
    file->held = name;
    if (ftruncate(file->descriptor, 0) != 0 || lseek(file->descriptor, 0, SEEK_SET) != 0)
        return errno;
    return 0;
}

/* Returns 0 or an errno. */
static int open_temporary(tl_atomic_file *file)
{
    tl_held_name *const name = tl_held_name_of(file->target);
    return name ? open_held(file, name) : create_temporary(file);
}

tl_status tl_atomic_file_begin(tl_atomic_file *file, const char *target, tl_error *err)
{
    tl_atomic_file made = {.descriptor = -1};
    bool in_place = false;
    int failure = tl_target_resolve(target, &made.target, &in_place);
    if (failure == 0 && in_place) {
        made.descriptor = memfd_create("tilelight", MFD_CLOEXEC);
        failure = made.descriptor < 0 ? errno : 0;
    } else if (failure == 0) {
        failure = open_temporary(&made);
    }
    if (failure != 0) {
        release(&made);
        return failure == ENOMEM ? tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", target)
                                 : tl_write_failed(target, failure, err);
    }
    *file = made;
    return TL_OK;
}

/* What waits in memory, into the target. Appending suits a shell's `>>`; `>` has emptied the file
 * before. Returns 0 or an errno. */
static int copy_in_place(const tl_atomic_file *file)
{
    struct stat held;
    void *bytes = NULL;
    int failure = 0;
    const int out = open(file->target, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (out < 0)
        return errno;
    if (fstat(file->descriptor, &held) != 0)
        failure = errno;
    const size_t size = failure == 0 ? (size_t)held.st_size : 0;
    if (size > 0) {
        bytes = mmap(NULL, size, PROT_READ, MAP_SHARED, file->descriptor, 0);
        failure = bytes == MAP_FAILED ? errno : tl_write_all(out, bytes, size);
        if (bytes != MAP_FAILED)
            munmap(bytes, size);
    }
    /* Pipes and terminals have nothing to sync. */
    if (failure == 0 && fsync(out) != 0 && errno != EINVAL && errno != EROFS)
        failure = errno;
    if (close(out) != 0 && failure == 0)
        failure = errno;
    return failure;
}

/* The name must survive a power cut as the bytes do. Where a folder cannot be opened or synced the
 * rename still stands, so this reports nothing. */
static void sync_folder(const char *path)
{
    char *folder = tl_target_folder(path);
    const int descriptor =
        folder ? open(folder[0] ? folder : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
    free(folder);
}

tl_status tl_atomic_file_commit(tl_atomic_file *file, tl_error *err)
{
    tl_status status = TL_OK;
    int failure = 0;
    if (file->temporary) {
        if (fsync(file->descriptor) != 0)
            failure = errno;
        if (close(file->descriptor) != 0 && failure == 0)
            failure = errno;
        file->descriptor = -1;
        if (failure == 0 && rename(file->temporary, file->target) != 0)
            failure = errno;
    } else {
        failure = copy_in_place(file);
    }
    if (failure != 0) {
        status = tl_write_failed(file->target, failure, err);
        tl_atomic_file_abandon(file);
        return status;
    }
    if (file->held)
        tl_held_name_renamed(file->held);
    if (file->temporary)
        sync_folder(file->target);
    release(file);
    return TL_OK;
}

void tl_atomic_file_abandon(tl_atomic_file *file)
{
    if (!file->target)
        return;
    /* A name that is held stays until it is dropped. */
    if (file->temporary && !file->held)
        unlink(file->temporary);
    release(file);
}
