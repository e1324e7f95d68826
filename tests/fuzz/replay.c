/* Gives a fuzzer the inputs that are named: files, and all files of folders. Fails where there are none. */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>

static size_t replay_file(const char *path)
{
    FILE *const file = fopen(path, "rb");
    if (!file)
        return 0;
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    rewind(file);
    uint8_t *const bytes = malloc(size > 0 ? (size_t)size : 1);
    fuzz_must(bytes && size >= 0 && fread(bytes, 1, (size_t)size, file) == (size_t)size,
              "%s cannot be read", path);
    fclose(file);
    fprintf(stderr, "%s\n", path); /* the last one named is the one that ended the process */
    LLVMFuzzerTestOneInput(bytes, (size_t)size);
    free(bytes);
    return 1;
}

static size_t replay(const char *path)
{
    size_t count = 0;
    DIR *const folder = opendir(path);
    if (!folder)
        return replay_file(path);
    for (const struct dirent *entry; (entry = readdir(folder));) {
        char inside[4096];
        snprintf(inside, sizeof inside, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.')
            count += replay_file(inside);
    }
    closedir(folder);
    return count;
}

int main(int argc, char **argv)
{
    size_t count = 0;
    LLVMFuzzerInitialize(&argc, &argv);
    for (int i = 1; i < argc; i++)
        count += replay(argv[i]);
    printf("%zu inputs\n", count);
    return count > 0 ? 0 : 1;
}
