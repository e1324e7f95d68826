#define _GNU_SOURCE /* asprintf */
#include "target.h"

#include <errno.h>
#include <linux/magic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

enum { MAX_LINKS = 40 /* as the kernel's own limit */ };

char *tl_target_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    return strndup(path, slash ? (size_t)(slash - path) + 1 : 0);
}

/* Where a link points, seen from where the link stands. The caller frees it. */
static char *follow(const char *link)
{
    char to[4096], *joined = NULL;
    const ssize_t length = readlink(link, to, sizeof to - 1);
    if (length < 0)
        return NULL;
    to[length] = '\0';
    if (to[0] == '/')
        return strdup(to);
    char *folder = tl_target_folder(link);
    if (folder && asprintf(&joined, "%s%s", folder, to) < 0)
        joined = NULL;
    free(folder);
    return joined;
}

/* Names under /proc stand for open files: renaming over what they show would leave the process
 * that opened it with the old one. */
static bool is_in_proc(const char *path)
{
    struct statfs system;
    char *folder = tl_target_folder(path);
    const bool yes = folder && statfs(folder[0] ? folder : ".", &system) == 0 &&
                     system.f_type == PROC_SUPER_MAGIC;
    free(folder);
    return yes;
}

int tl_target_resolve(const char *target, char **out, bool *in_place)
{
    struct stat seen;
    char *path = strdup(target);
    *in_place = false;
    for (int links = 0; path && !(*in_place = is_in_proc(path)); links++) {
        if (lstat(path, &seen) != 0 || !S_ISLNK(seen.st_mode))
            break;
        if (links == MAX_LINKS) {
            free(path);
            return ELOOP;
        }
        char *next = follow(path);
        free(path);
        path = next;
    }
    if (!path)
        return errno;
    if (stat(path, &seen) == 0) {
        *in_place = *in_place || !S_ISREG(seen.st_mode);
        if (S_ISDIR(seen.st_mode)) {
            free(path);
            return EISDIR;
        }
    }
    *out = path;
    return 0;
}
