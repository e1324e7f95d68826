#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "program_key.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern char **environ;

/* With its length, so that no two lists of fields read the same. */
static void put(FILE *out, const char *name, const char *value, size_t size)
{
    fprintf(out, "%s %zu\n", name, size);
    fwrite(value, 1, size, out);
    fputc('\n', out);
}

static void put_text(FILE *out, const char *name, const char *value)
{
    put(out, name, value, strlen(value));
}

/* Lines of /proc/cpuinfo that say which instructions a processor has; the others change with time
 * or from core to core. x86, Arm, POWER and RISC-V have them by different names. */
static bool names_processor(const char *line)
{
    static const char *const fields[] = {"vendor_id", "cpu family", "model", "stepping",
                                         "flags",     "Features",   "CPU",   "CPU implementer",
                                         "CPU part",  "cpu",        "isa",   "uarch"};
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        const size_t length = strlen(fields[i]);
        const char *after = line + length;
        if (strncmp(line, fields[i], length) == 0 && after[strspn(after, " \t")] == ':')
            return true;
    }
    return false;
}

/* The first processor stands for all. */
static void put_processor(FILE *out)
{
    static char text[16384];
    size_t length = 0;
    ssize_t got;
    const int file = open("/proc/cpuinfo", O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return;
    while (length < sizeof text - 1 &&
           (got = read(file, text + length, sizeof text - 1 - length)) > 0)
        length += (size_t)got;
    close(file);
    text[length] = '\0';
    char *end = strstr(text, "\n\n");
    if (end)
        *end = '\0';
    for (char *line = text, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        if (names_processor(line))
            put_text(out, "processor", line);
    }
}

/* Which PoCL compiles by, all but where it keeps its files and what it prints. */
static void put_environment(FILE *out)
{
    static const char *const harmless[] = {"POCL_CACHE_DIR=", "POCL_DEBUG=", "POCL_TRACING"};
    for (char **variable = environ; variable && *variable; variable++) {
        bool counts = strncmp(*variable, "POCL_", 5) == 0;
        for (size_t i = 0; i < sizeof harmless / sizeof harmless[0]; i++)
            counts = counts && strncmp(*variable, harmless[i], strlen(harmless[i])) != 0;
        if (counts)
            put_text(out, "environment", *variable);
    }
}

static void put_device(FILE *out, const tl_device *device)
{
    char version[256] = "", device_version[256] = "";
    cl_platform_id platform = NULL;
    clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_VERSION, sizeof device_version - 1, device_version,
                    NULL);
    if (platform)
        clGetPlatformInfo(platform, CL_PLATFORM_VERSION, sizeof version - 1, version, NULL);
    put_text(out, "platform", device->info.platform);
    put_text(out, "platform version", version);
    put_text(out, "device", device->info.name);
    put_text(out, "device version", device_version);
    put_text(out, "driver", device->info.driver);
    if (device->shares_memory)
        put_processor(out);
}

char *tl_program_key(const tl_device *device,
                     const char *const *texts,
                     size_t text_count,
                     const char *flags,
                     size_t *size)
{
    char *key = NULL;
    FILE *out = open_memstream(&key, size);
    if (!out)
        return NULL;
    put_device(out, device);
    put_environment(out);
    put_text(out, "flags", flags);
    for (size_t i = 0; i < text_count; i++)
        put_text(out, "text", texts[i]);
    const int failed = ferror(out);
    if (fclose(out) != 0 || failed) {
        free(key);
        key = NULL;
    }
    return key;
}
