/* Files that appear whole or not at all.
 *
 * The bytes go to a temporary file in the target's folder; commit syncs it and renames it over the
 * target, abandon removes it. A killed process leaves at most the temporary file, never a target
 * half written. Links are followed: what they point at is replaced, not they.
 *
 * A target that exists and is no regular file (a device, a FIFO, /dev/stdout), and any name under
 * /proc such as an open descriptor's, cannot be renamed over: the bytes wait in memory, and
 * commit copies them into it.
 *
 * Where this process holds a temporary name for the target (held_name.h), that is the temporary file's, and
 * abandon leaves it to whoever holds it. */
#ifndef TL_ATOMIC_FILE_H
#define TL_ATOMIC_FILE_H

#include "tilelight/error.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_atomic_file {
    char *target;    /* owned; NULL when there is nothing to commit or abandon */
    char *temporary; /* owned; its name, NULL where the bytes wait in memory */
    int descriptor;  /* what to write to, at any offset; meaningful while target is not NULL */
    struct tl_held_name *held; /* whose name that is; NULL: its own */
} tl_atomic_file;

/* Creates the temporary file, empty, with the permissions that the umask leaves of 0666. Fails
 * with TL_ERR_WRITE, naming the target and the reason (no such folder, read-only, no permission,
 * target is a folder), or TL_ERR_MEMORY. */
tl_status tl_atomic_file_begin(tl_atomic_file *file, const char *target, tl_error *err);

/* Syncs the temporary file, renames it to the target, syncs the folder. Fails with TL_ERR_WRITE,
 * the temporary file removed. */
tl_status tl_atomic_file_commit(tl_atomic_file *file, tl_error *err);

/* Removes the temporary file. Does nothing after a commit, or on an all-zero file. */
void tl_atomic_file_abandon(tl_atomic_file *file);

/* Writes all bytes at the descriptor's position; returns 0 or an errno. */
int tl_write_all(int descriptor, const void *data, size_t size);

/* The sentence for a write to `target` that ended with an errno: TL_ERR_WRITE, what, and what to
 * do about it. */
tl_status tl_write_failed(const char *target, int error_number, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
