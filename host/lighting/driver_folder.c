#define _GNU_SOURCE /* asprintf, flock, nftw */
#include "driver_folder.h"

#include "program_cache.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

static const char variable[] = "POCL_CACHE_DIR";

/* A folder is told from others by its name; it is in use while its lock is held. */
static const char prefix[] = "tilelight-driver-", lock_name[] = "lock";

enum {
    ROOM = 64 << 20,    /* bytes; a program takes a quarter of a megabyte */
    UNLOCKED_AGE_S = 60 /* of a folder that has no lock yet, because it is just being made */
};

static char *lent;    /* NULL: none */
static pid_t owner;   /* a forked child has the variables, and not the folder */
static bool is_named; /* in the environment, by us */

static int remove_one(const char *path, const struct stat *seen, int kind, struct FTW *at)
{
    (void)seen;
    (void)kind;
    (void)at;
    remove(path);
    return 0;
}

static void remove_tree(const char *path)
{
    nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

static void remove_lent(void)
{
    if (getpid() == owner)
        remove_tree(lent);
    free(lent);
    lent = NULL;
}

/* Whether nobody uses the folder any more. */
static bool is_abandoned(const char *path)
{
    struct stat seen;
    char *lock_path = NULL;
    if (lstat(path, &seen) != 0 || !S_ISDIR(seen.st_mode) || seen.st_uid != geteuid() ||
        asprintf(&lock_path, "%s/%s", path, lock_name) < 0)
        return false;
    const int lock = open(lock_path, O_RDWR | O_CLOEXEC);
    free(lock_path);
    if (lock < 0)
        return time(NULL) - seen.st_mtime > UNLOCKED_AGE_S;
    const bool free_now = flock(lock, LOCK_EX | LOCK_NB) == 0;
    close(lock);
    return free_now;
}

static void sweep(const char *base)
{
    DIR *opened = opendir(base);
    if (!opened)
        return;
    for (const struct dirent *entry; (entry = readdir(opened));) {
        char *path = NULL;
        if (strncmp(entry->d_name, prefix, strlen(prefix)) != 0 ||
            asprintf(&path, "%s/%s", base, entry->d_name) < 0)
            continue;
        if (is_abandoned(path))
            remove_tree(path);
        free(path);
    }
    closedir(opened);
}

/* Compiled kernels are loaded as libraries, which a file system may forbid. */
static bool suits(const char *base)
{
    struct statvfs system;
    return base && base[0] == '/' && statvfs(base, &system) == 0 &&
           !(system.f_flag & (ST_RDONLY | ST_NOEXEC)) &&
           (uint64_t)system.f_bavail * system.f_frsize >= ROOM;
}

/* The folder, locked until the process ends; NULL where it cannot be made. */
static char *make_in(const char *base)
{
    char *path = NULL, *lock_path = NULL;
    int lock = -1;
    if (!suits(base) || asprintf(&path, "%s/%sXXXXXX", base, prefix) < 0)
        return NULL;
    if (mkdtemp(path) && asprintf(&lock_path, "%s/%s", path, lock_name) >= 0)
        lock = open(lock_path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    free(lock_path);
    /* The descriptor stays open: that is what holds the lock. */
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0) {
        sweep(base);
        return path;
    }
    if (lock >= 0)
        close(lock);
    remove_tree(path);
    free(path);
    return NULL;
}

void tl_driver_folder_lend(void)
{
    if (lent || getenv(variable))
        return;
    char *cache = tl_program_cache_folder();
    const char *const bases[] = {getenv("XDG_RUNTIME_DIR"), "/dev/shm", getenv("TMPDIR"),
                                 "/tmp", cache};
    for (size_t i = 0; !lent && i < sizeof bases / sizeof bases[0]; i++)
        lent = make_in(bases[i]);
    free(cache);
    if (!lent)
        return;
    owner = getpid();
    atexit(remove_lent);
    is_named = setenv(variable, lent, 1) == 0;
}

void tl_driver_folder_forget(void)
{
    if (is_named)
        unsetenv(variable);
    is_named = false;
}
