/* Temporary names that are held for a target: whoever holds one has tl_atomic_file_begin write there, so that
 * a name that follows from the target's says who is at it, and what a killed process left is written over. */
#ifndef TL_HELD_NAME_H
#define TL_HELD_NAME_H

#include "tilelight/error.h"

#include <stdbool.h>

/* All zero is none. Must not move while it is held. */
typedef struct tl_held_name {
    char *target;    /* where links end; owned */
    char *temporary; /* beside it, the same for every process; owned */
    int descriptor;  /* of the temporary file, locked; -1: none */
    bool is_renamed; /* it has become the target; under the lock of all names */
    struct tl_held_name *next;
} tl_held_name;

/* Creates the temporary file, or opens what was left of one, locks it, and holds its name in this process.
 * *is_held: false where another process or thread has it locked; then nothing is held. The content stays, for
 * it may be the target's by the time that it is locked; tl_atomic_file_begin empties it.
 *
 * The lock is one of the open file description, which the system releases when the process ends, however it
 * does. Fails with TL_ERR_WRITE, naming the target and the reason, among them a target that is no regular
 * file and a file system without locks; TL_ERR_MEMORY. */
tl_status tl_held_name_take(const char *target,
                            tl_held_name *out,
                            bool *is_held,
                            tl_error *err);

/* Removes the temporary file unless it has become the target, and the lock. Accepts none. */
void tl_held_name_drop(tl_held_name *name);

/* Notes that the temporary file has become the target. */
void tl_held_name_renamed(tl_held_name *name);

/* Whether a temporary file of that name is there. */
bool tl_held_name_is_there(const char *target);

/* The one that this process holds for a target, of which links have been followed; or NULL. */
tl_held_name *tl_held_name_of(const char *target);

#endif
