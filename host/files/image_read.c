#include "image_exr.h"
#include "image_pfm.h"
#include "image_png.h"

#include "try.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* The formats, told apart by their first bytes. */
static const struct {
    unsigned char magic[8];
    size_t magic_size;
    tl_status (*read)(const char *path, tl_image **out, tl_error *err);
    int is_png;
} formats[] = {
    {{0x76, 0x2f, 0x31, 0x01}, 4, tl_image_read_exr, 0},
    {{'P', 'F'}, 2, tl_image_read_pfm, 0},
    {{'P', 'f'}, 2, tl_image_read_pfm, 0},
    {{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, 8, tl_image_read_png, 1},
};

tl_status tl_image_read(const char *path, tl_image **out, int *is_png, tl_error *err)
{
    tl_status status = TL_OK;
    unsigned char start[8] = {0};
    FILE *file = fopen(path, "rb");
    if (!file)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, strerror(errno));
    const size_t got = fread(start, 1, sizeof start, file);
    if (ferror(file))
        status = tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", path, strerror(errno));
    fclose(file);
    if (status != TL_OK)
        return status;
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (got < formats[i].magic_size ||
            memcmp(start, formats[i].magic, formats[i].magic_size) != 0)
            continue;
        status = formats[i].read(path, out, err);
        if (status == TL_OK && is_png)
            *is_png = formats[i].is_png;
        return status;
    }
    return tl_fail(err, TL_ERR_FORMAT, "%s: is neither an OpenEXR nor a PFM nor a PNG file",
                   path);
}
