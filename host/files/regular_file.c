#define _POSIX_C_SOURCE 200809L
#include "regular_file.h"

#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

tl_status tl_regular_file_open(const char *path, int *descriptor, uint64_t *size, tl_error *err)
{
    struct stat seen;
    const int opened = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (opened < 0)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, strerror(errno));
    if (fstat(opened, &seen) != 0 || !S_ISREG(seen.st_mode)) {
        close(opened);
        return tl_fail(err, TL_ERR_READ, "%s: cannot be read: it is no regular file", path);
    }
    *descriptor = opened;
    *size = (uint64_t)seen.st_size;
    return TL_OK;
}

bool tl_regular_file_read_at(
    int descriptor, void *to, size_t size, uint64_t offset, size_t *got)
{
    for (*got = 0; *got < size;) {
        const ssize_t count =
            pread(descriptor, (char *)to + *got, size - *got, (off_t)(offset + *got));
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return count == 0;
        *got += (size_t)count;
    }
    return true;
}

tl_status tl_regular_file_start(
    const char *path, void *bytes, size_t room, size_t *got, uint64_t *size, tl_error *err)
{
    int descriptor;
    tl_status status = tl_regular_file_open(path, &descriptor, size, err);
    if (status != TL_OK)
        return status;
    if (!tl_regular_file_read_at(descriptor, bytes, room, 0, got))
        TRY(tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", path, strerror(errno)));
done:
    close(descriptor);
    return status;
}
