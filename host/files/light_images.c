#define _XOPEN_SOURCE 700 /* realpath */
#include "light_images.h"

#include "largest.h"
#include "srgb.h"
#include "tilelight/image.h"
#include "try.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of a path up to its last slash, or NULL: the working directory. */
static char *folder_of(const char *file)
{
    const char *slash = file && strcmp(file, "-") != 0 ? strrchr(file, '/') : NULL;
    const size_t length = slash ? (size_t)(slash - file) + 1 : 0;
    char *folder = slash ? malloc(length + 1) : NULL;
    if (folder) {
        memcpy(folder, file, length);
        folder[length] = '\0';
    }
    return folder;
}

tl_status tl_light_images_begin(tl_light_set *set, const char *file, tl_error *err)
{
    set->folder = folder_of(file);
    if (!set->folder && file && strchr(file, '/'))
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the name of a folder");
    return TL_OK;
}

char *tl_light_path(const char *folder, const char *path)
{
    const char *before = folder && path[0] != '/' ? folder : "";
    const size_t size = strlen(before) + strlen(path) + 1;
    char *whole = malloc(size);
    if (whole)
        snprintf(whole, size, "%s%s", before, path);
    return whole;
}

static tl_status check_extent(const tl_place *at,
                              const char *field,
                              const char *path,
                              const tl_image *image,
                              tl_error *err)
{
    if (image->width > TL_MOST_IMAGE_EXTENT || image->height > TL_MOST_IMAGE_EXTENT ||
        (uint64_t)image->width * image->height > TL_MOST_IMAGE_PIXELS)
        return tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "%s:%s \"%s\": %s is %u x %u pixels; at most %u each way and %u in all are "
            "taken",
            at->source, at->inside, field, path, image->width, image->height,
            TL_MOST_IMAGE_EXTENT, TL_MOST_IMAGE_PIXELS);
    return TL_OK;
}

/* Pixels as lights have them, from malloc. */
static tl_status linear_pixels(const tl_place *at,
                               const char *field,
                               const char *path,
                               const tl_image *image,
                               int is_png,
                               float **out,
                               tl_error *err)
{
    const size_t width = image->width, count = width * image->height;
    float *made = malloc(3 * count * sizeof *made);
    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its pixels", path);
    for (size_t i = 0; i < 3 * count; i++) {
        const size_t x = i / 3 % width, y = i / 3 / width;
        const float v = tl_image_plane(image, (unsigned)(i % 3))[y * image->pitch + x];
        if (!(v >= 0.0f && v <= TL_BRIGHTEST)) {
            free(made);
            return tl_fail(
                err, TL_ERR_FORMAT,
                "%s:%s \"%s\": %s: pixel (%zu, %zu) has the value %g; light is from 0 "
                "to %g",
                at->source, at->inside, field, path, x, y, (double)v, (double)TL_BRIGHTEST);
        }
        made[i] = is_png ? (float)tl_linear_from_srgb((double)v) : v;
    }
    *out = made;
    return TL_OK;
}

static tl_status add_picture(const tl_place *at,
                             const char *field,
                             const char *name,
                             tl_light_set *set,
                             uint32_t *out,
                             tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *image = NULL;
    float *pixels = NULL;
    int is_png = 0;
    tl_error why;
    char *const path = tl_light_path(set->folder, name);
    if (!path)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the name of a picture"));
    status = tl_image_read(path, &image, &is_png, &why);
    if (status != TL_OK)
        TRY(tl_fail(err, status, "%s:%s \"%s\": %s", at->source, at->inside, field,
                    why.message));
    TRY(check_extent(at, field, path, image, err));
    TRY(linear_pixels(at, field, path, image, is_png, &pixels, err));
    TRY(tl_light_set_add_image(set, name, image->width, image->height, pixels, out, err));
done:
    tl_image_destroy(image);
    free(path);
    return status;
}

tl_status tl_light_image_read(const tl_place *at,
                              const char *field,
                              const json_t *value,
                              tl_light_set *set,
                              uint32_t *out,
                              tl_error *err)
{
    const char *name = json_string_value(value);
    if (!name || !name[0])
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"%s\" must be a string, the name of an OpenEXR or PNG file",
                       at->source, at->inside, field);
    for (size_t i = 0; i < set->image_count; i++)
        if (strcmp(set->images[i].path, name) == 0) {
            *out = (uint32_t)i + 1;
            return TL_OK;
        }
    return add_picture(at, field, name, set, out, err);
}

tl_status tl_light_set_read_sky(tl_light_set *set, const char *path, tl_error *err)
{
    const tl_place at = {.source = "the sky", .inside = ""};
    char *const whole = realpath(path, NULL);
    json_t *const name = json_string(whole ? whole : "");
    uint32_t image = 0;
    tl_status status = TL_OK;
    if (!whole)
        TRY(tl_fail(err, TL_ERR_READ, "the sky: %s: %s", path, strerror(errno)));
    if (!name)
        TRY(tl_fail(err, TL_ERR_FORMAT, "the sky: %s: this name is no UTF-8", path));
    TRY(tl_light_image_read(&at, "image", name, set, &image, err));
    set->sky_type = TL_SKY_IMAGE;
    set->sky_image = image;
    set->sky_intensity = 1.0f;
    set->sky_rotation = 0.0f;
done:
    json_decref(name);
    free(whole);
    return status;
}

/* Whether two folders are one; NULL is the working directory. */
static int is_same_folder(const char *a, const char *b)
{
    char *const real_a = realpath(a ? a : ".", NULL), *const real_b =
                                                          realpath(b ? b : ".", NULL);
    const int same = real_a && real_b && strcmp(real_a, real_b) == 0;
    free(real_a);
    free(real_b);
    return same;
}

char *tl_light_file_name(const tl_light_set *set, const char *named, const char *file)
{
    char *const folder = folder_of(file);
    const int stands = named[0] == '/' || is_same_folder(set->folder, folder);
    free(folder);
    if (stands)
        return tl_light_path(NULL, named);
    char *const path = tl_light_path(set->folder, named);
    char *const whole = path ? realpath(path, NULL) : NULL;
    if (whole) {
        free(path);
        return whole;
    }
    return path; /* it is gone meanwhile */
}
