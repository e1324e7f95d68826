/* Files made by others, in the folder TILELIGHT_ASSETS, or ../shared/assets beside the sources; not part
 * of the project. */
#ifndef TL_TEST_ASSETS_H
#define TL_TEST_ASSETS_H

#include "testing.h"

/* Where such a file is, if it is there; the caller frees it. */
static inline char *asset_path(const char *file)
{
    const char *const assets = getenv("TILELIGHT_ASSETS"), *source = getenv("TILELIGHT_SOURCE");
    const char *const folder = assets ? assets : source ? source : ".";
    const char *const beside = assets ? "" : "/../shared/assets";
    const size_t size = strlen(folder) + strlen(beside) + strlen(file) + 2;
    char *const path = malloc(size);
    assert_non_null(path);
    snprintf(path, size, "%s%s/%s", folder, beside, file);
    return path;
}

/* `size` bytes from `offset` on; 0: there is no such file, or it is shorter. */
static inline int read_asset(const char *file, long offset, void *to, size_t size)
{
    char *const path = asset_path(file);
    FILE *const stream = fopen(path, "rb");
    free(path);
    if (!stream)
        return 0;
    const int done = fseek(stream, offset, SEEK_SET) == 0 && fread(to, 1, size, stream) == size;
    fclose(stream);
    return done;
}

#endif
