#define _GNU_SOURCE /* F_OFD_SETLK */
#include "held_name.h"

#include "atomic_file.h"
#include "target.h"
#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    MOST_NAME = 200, /* bytes of the target's name in the temporary one, which has 255 in all */
    START_OF_LONG = 180, /* bytes of a longer one, with what tells it from others behind */
    MOST_TRIES = 1000    /* at a name that others take and drop all the time */
};

/* FNV-1a of 64 bits (Fowler, Noll, Vo, 1991). */
static uint64_t hash_of(const char *text)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return hash;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The caller frees it; NULL: out of memory. */
static char *temporary_of(const char *target)
{
    char *made = NULL;
    const char *name = name_of(target);
    const int folder = (int)(name - target);
    const int size = strlen(name) <= MOST_NAME
                         ? asprintf(&made, "%.*s.%s.tilelight-part", folder, target, name)
                         : asprintf(&made, "%.*s.%.*s-%016" PRIx64 ".tilelight-part", folder,
                                    target, START_OF_LONG, name, hash_of(name));
    return size < 0 ? NULL : made;
}

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static tl_held_name *held; /* the first of all */

static void hold(tl_held_name *name)
{
    pthread_mutex_lock(&lock);
    name->next = held;
    held = name;
    pthread_mutex_unlock(&lock);
}

static void let_go(const tl_held_name *name)
{
    pthread_mutex_lock(&lock);
    for (tl_held_name **at = &held; *at; at = &(*at)->next)
        if (*at == name) {
            *at = name->next;
            break;
        }
    pthread_mutex_unlock(&lock);
}

void tl_held_name_renamed(tl_held_name *name)
{
    pthread_mutex_lock(&lock);
    name->is_renamed = true;
    pthread_mutex_unlock(&lock);
}

tl_held_name *tl_held_name_of(const char *target)
{
    pthread_mutex_lock(&lock);
    tl_held_name *found = held;
    while (found && (found->is_renamed || strcmp(found->target, target) != 0))
        found = found->next;
    pthread_mutex_unlock(&lock);
    return found;
}

/* Whether the name still leads to the file that was opened: by the time that it was locked, who had it may
 * have renamed or removed it. */
static bool is_still_there(int descriptor, const char *name)
{
    struct stat opened, named;
    return fstat(descriptor, &opened) == 0 && lstat(name, &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/* Returns 0, EAGAIN where another has it, or an errno. *descriptor stays open on 0 alone. */
static int lock_file(const char *temporary, int *descriptor)
{
    for (int i = 0; i < MOST_TRIES; i++) {
        struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
        const int file = open(temporary, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file < 0)
            return errno;
        const int failure = fcntl(file, F_OFD_SETLK, &whole) == 0 ? 0 : errno;
        if (failure == 0 && is_still_there(file, temporary)) {
            *descriptor = file;
            return 0;
        }
        close(file);
        if (failure != 0)
            return failure == EACCES ? EAGAIN : failure;
    }
    return EAGAIN;
}

tl_status tl_held_name_take(const char *target, tl_held_name *out, bool *is_held, tl_error *err)
{
    tl_held_name made = {.descriptor = -1};
    bool in_place = false;
    int failure = tl_target_resolve(target, &made.target, &in_place);
    *is_held = false;
    if (failure == 0 && !name_of(made.target)[0])
        failure = ENOENT;
    if (failure == 0 && in_place) {
        free(made.target);
        return tl_fail(err, TL_ERR_WRITE, "%s: is no regular file, which it must be; name one",
                       target);
    }
    if (failure == 0 && !(made.temporary = temporary_of(made.target)))
        failure = ENOMEM;
    if (failure == 0)
        failure = lock_file(made.temporary, &made.descriptor);
    if (failure != 0) {
        free(made.temporary);
        free(made.target);
        if (failure == EAGAIN)
            return TL_OK;
        return failure == ENOMEM ? tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", target)
                                 : tl_write_failed(target, failure, err);
    }
    *out = made;
    hold(out);
    *is_held = true;
    return TL_OK;
}

void tl_held_name_drop(tl_held_name *name)
{
    if (!name->target)
        return;
    let_go(name);
    /* While it is locked: later the name may be another's. */
    if (!name->is_renamed)
        unlink(name->temporary);
    close(name->descriptor);
    free(name->temporary);
    free(name->target);
    *name = (tl_held_name){.descriptor = -1};
}

bool tl_held_name_is_there(const char *target)
{
    bool in_place = false, is_there = false;
    char *path = NULL;
    if (tl_target_resolve(target, &path, &in_place) != 0)
        return false;
    char *const temporary = in_place ? NULL : temporary_of(path);
    if (temporary)
        is_there = access(temporary, F_OK) == 0;
    free(temporary);
    free(path);
    return is_there;
}
