#define _GNU_SOURCE /* memfd_create */
#include "fuzz.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* One thread: starting others costs more than what they would share, and hides what led to a fault. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    return setenv("TILELIGHT_THREADS", "1", 1);
}

void fuzz_must(bool condition, const char *format, ...)
{
    va_list args;
    if (condition)
        return;
    va_start(args, format);
    fputs("broken promise: ", stderr);
    vfprintf(stderr, format, args);
    fputs("\n", stderr);
    va_end(args);
    abort();
}

const char *fuzz_file(const void *data, size_t size)
{
    static int file = -1;
    static char path[64];
    if (file < 0) {
        file = memfd_create("input", 0);
        snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    }
    fuzz_must(file >= 0 && ftruncate(file, 0) == 0, "no file can be made in memory");
    fuzz_must(pwrite(file, data, size, 0) == (ssize_t)size, "%zu bytes are too many", size);
    return path;
}

void fuzz_must_tell(tl_status status, const tl_error *err, const char *path)
{
    if (status == TL_OK)
        return;
    fuzz_must(err->status == status && strstr(err->message, path),
              "status %d with the sentence \"%s\"", (int)status, err->message);
    fuzz_must(status != TL_ERR_MEMORY, "memory ran out: %s", err->message);
}

uint8_t fuzz_byte(fuzz_bytes *from)
{
    if (from->left == 0)
        return 0;
    from->left--;
    return *from->at++;
}

float fuzz_float(fuzz_bytes *from)
{
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)fuzz_byte(from) << 8 * i;
    memcpy(&value, &bits, sizeof value);
    return value;
}
