/* A device that is always full, and is the test's own where root runs it: code under test that
 * renames over devices would else replace /dev/full for the whole machine. Needs _GNU_SOURCE. */
#ifndef TL_FULL_DEVICE_H
#define TL_FULL_DEVICE_H

#include "testing.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

/* Makes character device 1:`minor` (3 is null, 7 is full) as `name` in the scratch folder, or gives
 * the machine's where that is not allowed: then /dev cannot be changed either. */
static inline const char *own_device(char *buffer,
                                     size_t size,
                                     const char *name,
                                     unsigned minor_number)
{
    scratch_path(buffer, size, name);
    remove(buffer);
    const int made = mknod(buffer, S_IFCHR | 0666, makedev(1, minor_number)) == 0;
    const int opened = made ? open(buffer, O_WRONLY) : -1;
    if (opened >= 0) {
        close(opened);
        return buffer;
    }
    remove(buffer);
    snprintf(buffer, size, "/dev/%s", minor_number == 3 ? "null" : "full");
    return buffer;
}

static inline void remove_device(const char *path)
{
    if (strncmp(path, "/dev/", 5) != 0)
        remove(path);
}

#endif
