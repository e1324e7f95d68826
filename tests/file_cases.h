/* What the tests of files share: whole files as bytes, and G-buffers of awkward values. */
#ifndef TL_FILE_CASES_H
#define TL_FILE_CASES_H

#include "testing.h"

#include "tilelight/gbuffer.h"

#include <dirent.h>
#include <sys/stat.h>

/* The caller frees it; fails the test where the file cannot be read. */
static inline unsigned char *load_bytes(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *size = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static inline void save_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline void assert_holds(const char *path, const char *text)
{
    size_t size;
    unsigned char *bytes = load_bytes(path, &size);
    assert_int_equal(size, strlen(text));
    assert_memory_equal(bytes, text, size);
    free(bytes);
}

/* In a folder, but for "." and "..". */
static inline int count_names(const char *path)
{
    DIR *opened = opendir(path);
    assert_non_null(opened);
    int count = 0;
    for (const struct dirent *entry; (entry = readdir(opened));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(opened);
    return count;
}

/* Fails the test unless `step` failed with `wanted` and a sentence that has every word of the
 * NULL-terminated `words`. */
static inline void assert_refused(const char *name,
                                  tl_status got,
                                  tl_status wanted,
                                  const tl_error *err,
                                  const char *const *words)
{
    if (got != wanted || err->status != wanted)
        fail_msg("%s: status %d, not %d: %s", name, got, wanted,
                 got == TL_OK ? "accepted" : err->message);
    for (; *words; words++)
        if (!strstr(err->message, *words))
            fail_msg("%s: \"%s\" does not name \"%s\"", name, err->message, *words);
}

/* A camera without symmetries, so that exchanged edges or axes show. */
static inline tl_camera awkward_camera(uint32_t width, uint32_t height)
{
    static const double eye[3] = {1.5, -2.25, 7.0}, target[3] = {0.1, 0.2, -0.3};
    static const double up[3] = {0.05, 1.0, 0.0};
    tl_camera camera = tl_camera_look_at(eye, target, up, 0.9, width, height, 0.05, 250.0);
    camera.left -= 0.125f;
    camera.top += 0.0625f;
    return camera;
}

/* A step of a linear congruential generator (Numerical Recipes' constants). */
static inline uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state;
}

/* Every kind of float that files must not touch, among ordinary values. */
static inline void fill_awkward(tl_gbuffer *gbuffer, uint32_t seed)
{
    static const uint32_t special[] = {
        0x00000000, 0x80000000, 0x00000001, 0x807fffff, /* zeros, denormals */
        0x7f800000, 0xff800000, 0x7f7fffff, 0x7fc00001, /* infinities, largest, NaN */
    };
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++) {
        float *plane = tl_gbuffer_plane(gbuffer, p);
        for (uint32_t y = 0; plane && y < gbuffer->camera.height; y++)
            for (uint32_t x = 0; x < gbuffer->camera.width; x++) {
                const uint32_t random = next_random(&seed);
                float value = (float)(random >> 8) * 0x1p-20f - 4.0f;
                if (random >> 28 == 0)
                    memcpy(&value, &special[random >> 10 & 7], sizeof value);
                if (p == TL_BRDF) /* whole numbers in the file */
                    value = (float)(random >> 8);
                plane[(size_t)y * gbuffer->pitch + x] = value;
            }
    }
}

static inline void assert_same_gbuffer(const char *name,
                                       const tl_gbuffer *a,
                                       const tl_gbuffer *b)
{
    if (a->layout != b->layout || a->present != b->present || a->pitch != b->pitch ||
        a->rows != b->rows)
        fail_msg("%s: planes %x or pitch differ from %x", name, a->present, b->present);
    if (a->samples != b->samples)
        fail_msg("%s: %u samples of a pixel, not %u", name, a->samples, b->samples);
    if (memcmp(&a->camera, &b->camera, sizeof a->camera) != 0)
        fail_msg("%s: the camera differs", name);
    const size_t size = (size_t)tl_gbuffer_pixel_size(a) * a->pitch * a->rows;
    for (size_t i = 0; i < size; i++)
        if (a->planes[i] != b->planes[i])
            fail_msg("%s: byte %zu of %zu is %02x, not %02x", name, i, size, a->planes[i],
                     b->planes[i]);
}

#endif
