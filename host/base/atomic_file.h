/* Files that appear whole or not at all.
 *
 * The bytes go to a temporary name in the same folder; commit syncs and renames it over the
 * target, abandon removes it. A killed process leaves at most the temporary file, never a target
 * half written. */
#ifndef TL_ATOMIC_FILE_H
#define TL_ATOMIC_FILE_H

#include "tilelight/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_atomic_file {
    char *target; /* owned */
    char *
        temporary; /* owned; what to write to. NULL when there is nothing to commit or abandon */
} tl_atomic_file;

/* Creates the temporary file, empty. Fails with TL_ERR_WRITE, naming the target and the reason: no
 * such folder, read-only, no permission, target is a folder. */
tl_status tl_atomic_file_begin(tl_atomic_file *file, const char *target, tl_error *err);

/* Syncs the temporary file, renames it to the target, syncs the folder. Fails with TL_ERR_WRITE,
 * the temporary file removed. */
tl_status tl_atomic_file_commit(tl_atomic_file *file, tl_error *err);

/* Removes the temporary file. Does nothing after a commit, or on an all-zero file. */
void tl_atomic_file_abandon(tl_atomic_file *file);

#ifdef __cplusplus
}
#endif

#endif
