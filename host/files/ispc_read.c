#define _POSIX_C_SOURCE 200809L
#include "ispc_read.h"

#include "packing.h"
#include "regular_file.h"
#include "try.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#    error "words are read as the file has them: little-endian"
#endif

enum { HEADER_SIZE = 152, PIXEL_PLANES = 8, LIGHT_PLANES = 8, PLANES = 16 };

/* Planes of lights, float each, behind those of pixels, which are the words of the layout.
 * Positions are in the example's view space: +z forward. */
enum { LIGHT_X, LIGHT_Y, LIGHT_Z, LIGHT_BEGIN, LIGHT_R, LIGHT_G, LIGHT_B, LIGHT_END };

typedef struct header {
    float proj[4][4]; /* row vectors */
    float near, far;  /* m */
    int32_t width, height, light_count, chunk_size;
    int32_t offsets[PLANES]; /* of bytes behind the header */
} header;

/* The fields follow one another in the file as they do here. */
_Static_assert(sizeof(header) == HEADER_SIZE, "the header has no padding");

static bool makes_sense(const header *h)
{
    return h->width >= 1 && h->width <= TL_MAX_EXTENT && h->height >= 1 &&
           h->height <= TL_MAX_EXTENT && h->light_count >= 0 && h->chunk_size > 0 &&
           h->near > 0.0f && h->near < h->far && isfinite(h->far) && isfinite(h->proj[0][0]) &&
           isfinite(h->proj[1][1]) && isfinite(h->proj[2][2]) && isfinite(h->proj[3][2]);
}

bool tl_ispc_recognises(const tl_capture_start *start)
{
    header h;
    if (start->size < sizeof h)
        return false;
    memcpy(&h, start->bytes, sizeof h);
    return makes_sense(&h);
}

static tl_status read_at(
    int file, const char *path, void *to, size_t size, uint64_t offset, tl_error *err)
{
    size_t got;
    if (!tl_regular_file_read_at(file, to, size, offset, &got))
        return tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", path, strerror(errno));
    if (got < size)
        return tl_fail(err, TL_ERR_FORMAT, "%s: is cut short: it ends at byte %" PRIu64, path,
                       offset + got);
    return TL_OK;
}

static tl_status check_size(const char *path,
                            const header *h,
                            uint64_t file_size,
                            tl_error *err)
{
    const uint64_t promised = HEADER_SIZE + (uint64_t)h->chunk_size;
    if (file_size < promised)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is cut short: its header promises %" PRIu64
                       " bytes, it has %" PRIu64,
                       path, promised, file_size);
    if (file_size > promised)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: has %" PRIu64 " bytes behind the %" PRIu64
                       " that its header promises",
                       path, file_size - promised, promised);
    return TL_OK;
}

/* Bytes of an element of a plane. */
static uint64_t element_size(int plane)
{
    return plane < PIXEL_PLANES ? tl_layouts[TL_LAYOUT_ISPC].words[plane].bytes : sizeof(float);
}

static tl_status check_planes(const char *path, const header *h, tl_error *err)
{
    const uint64_t pixels = (uint64_t)h->width * (uint64_t)h->height;
    for (int p = 0; p < PLANES; p++) {
        const uint64_t size =
            element_size(p) * (p < PIXEL_PLANES ? pixels : (uint64_t)h->light_count);
        if (h->offsets[p] < 0 || (uint64_t)h->offsets[p] + size > (uint64_t)h->chunk_size)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: plane %d, %" PRIu64 " bytes from %d on, is not within the %d "
                           "bytes behind the header",
                           path, p, size, (int)h->offsets[p], (int)h->chunk_size);
    }
    return TL_OK;
}

/* What the example takes a matrix for: (x P00, y P11, z P22 + P32) / z for the point (x, y, z). */
static tl_status check_projection(const char *path, const header *h, tl_error *err)
{
    static const float plain[4][4] = {
        {NAN, 0, 0, 0}, {0, NAN, 0, 0}, {0, 0, NAN, 1}, {0, 0, NAN, 0}};
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            if (!isnan(plain[row][column]) && !(h->proj[row][column] == plain[row][column]))
                return tl_fail(err, TL_ERR_UNSUPPORTED,
                               "%s: the projection has %g in row %d, column %d: only a centred "
                               "left-handed perspective is read, which has %g there",
                               path, (double)h->proj[row][column], row, column,
                               (double)plain[row][column]);
    if (!(h->proj[0][0] > 0.0f && h->proj[1][1] > 0.0f && isfinite(h->proj[0][0]) &&
          isfinite(h->proj[1][1])))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: the projection scales x by %g and y by %g; both must be above 0",
                       path, (double)h->proj[0][0], (double)h->proj[1][1]);
    return TL_OK;
}

/* m; of a depth that is stored as z. */
static double view_depth(const header *h, double z)
{
    return (double)h->proj[3][2] / (z - (double)h->proj[2][2]);
}

/* Whether z is 1 on the near plane. */
static bool is_reversed(const header *h)
{
    return h->proj[3][2] > 0.0f;
}

/* The planes that z = 0 and 1 stand for; pixels outside of the header's own two do not count. */
static tl_status find_planes(
    const char *path, const header *h, float *near, float *far, tl_error *err)
{
    const double z0 = view_depth(h, 0.0), z1 = view_depth(h, 1.0);
    *near = (float)(is_reversed(h) ? z1 : z0);
    *far = (float)(is_reversed(h) ? z0 : z1);
    if (!(*near > 0.0f && *near < *far && isfinite(*far)))
        return tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "%s: the projection puts depth 0 at %g m and depth 1 at %g m; both planes "
            "must be before the camera, at finite distances",
            path, z0, z1);
    return TL_OK;
}

/* Ours looks along -z and theirs along +z; world space is view space. */
static tl_status camera_of(const char *path, const header *h, tl_camera *out, tl_error *err)
{
    const double right = 1.0 / (double)h->proj[0][0], top = 1.0 / (double)h->proj[1][1];
    tl_camera camera = {.projection = TL_PERSPECTIVE,
                        .width = (uint32_t)h->width,
                        .height = (uint32_t)h->height,
                        .left = (float)-right,
                        .right = (float)right,
                        .bottom = (float)-top,
                        .top = (float)top};
    tl_error reason;
    tl_status status = find_planes(path, h, &camera.near, &camera.far, err);
    for (int i = 0; i < 3; i++)
        camera.view_from_world[i][i] = 1.0f;
    if (status == TL_OK && tl_camera_check(&camera, &reason) != TL_OK)
        status = tl_fail(err, TL_ERR_FORMAT, "%s: %.1000s", path, reason.message);
    *out = camera;
    return status;
}

static tl_status read_plane(
    int file, const char *path, const header *h, int plane, const tl_gbuffer *to, tl_error *err)
{
    const uint32_t bytes = tl_gbuffer_word_size(to, (uint32_t)plane);
    const size_t row_size = (size_t)h->width * bytes;
    const uint64_t first = HEADER_SIZE + (uint64_t)h->offsets[plane];
    unsigned char *words = tl_gbuffer_words(to, (uint32_t)plane);
    tl_status status = TL_OK;
    for (size_t row = 0; row < (size_t)h->height && status == TL_OK; row++)
        status = read_at(file, path, words + row * to->pitch * bytes, row_size,
                         first + row * row_size, err);
    return status;
}

/* Pixels that do not count: sky, which is 0 where depth is reversed. */
static void cut_depths(const header *h, const tl_gbuffer *g)
{
    float *const depths = tl_gbuffer_words(g, 0);
    const float sky = is_reversed(h) ? 0.0f : 1.0f;
    for (size_t row = 0; row < (size_t)h->height; row++)
        for (size_t x = 0; x < (size_t)h->width; x++) {
            float *const z = &depths[row * g->pitch + x];
            const double depth = view_depth(h, (double)*z);
            if (depth < (double)h->near || depth >= (double)h->far)
                *z = sky;
        }
}

static tl_status read_gbuffer(
    int file, const char *path, const header *h, tl_gbuffer **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;
    tl_camera camera;
    TRY(camera_of(path, h, &camera, err));
    TRY(tl_gbuffer_create_packed(&camera,
                                 is_reversed(h) ? TL_LAYOUT_ISPC_REVERSED : TL_LAYOUT_ISPC,
                                 TL_GROUP_BASE | TL_GROUP_PHONG, &made, err));
    for (int p = 0; p < PIXEL_PLANES; p++)
        TRY(read_plane(file, path, h, p, made, err));
    cut_depths(h, made);
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}

/* planes: [LIGHT_PLANES][count] */
static tl_light light_at(const float *planes, size_t count, size_t index)
{
    tl_light light = tl_light_default();
    const float *const of = planes + index;
    light.falloff = TL_FALLOFF_LINEAR;
    light.position[0] = of[LIGHT_X * count];
    light.position[1] = of[LIGHT_Y * count];
    light.position[2] = -of[LIGHT_Z * count];
    light.color[0] = of[LIGHT_R * count];
    light.color[1] = of[LIGHT_G * count];
    light.color[2] = of[LIGHT_B * count];
    light.begin = of[LIGHT_BEGIN * count];
    light.range = of[LIGHT_END * count];
    return light;
}

static tl_status read_lights(
    int file, const char *path, const header *h, tl_light_set *out, tl_error *err)
{
    const size_t count = (size_t)h->light_count;
    tl_status status = TL_OK;
    tl_light_set made = {.model = TL_MODEL_BLINN_PHONG_NORMALIZED};
    float *planes = malloc(LIGHT_PLANES * (count + 1) * sizeof *planes);
    if (!planes)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %zu lights", path, count));
    for (int p = 0; p < LIGHT_PLANES; p++)
        TRY(read_at(file, path, planes + (size_t)p * count, count * sizeof *planes,
                    HEADER_SIZE + (uint64_t)h->offsets[PIXEL_PLANES + p], err));
    for (size_t i = 0; i < count; i++) {
        const tl_light light = light_at(planes, count, i);
        if (light.range == 0.0f)
            continue; /* reaches nothing, and is none that other programs can have made */
        TRY(tl_light_set_add(&made, &light, err));
    }
    TRY(tl_light_set_check(&made, path, err));
    *out = made;
    made = (tl_light_set){0};
done:
    tl_light_set_clear(&made);
    free(planes);
    return status;
}

static tl_status read_header(
    int file, uint64_t file_size, const char *path, header *out, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(read_at(file, path, out, sizeof *out, 0, err));
    if (!makes_sense(out))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: is no capture: its header has sizes or planes that none can have",
                    path));
    TRY(check_size(path, out, file_size, err));
    TRY(check_planes(path, out, err));
    TRY(check_projection(path, out, err));
done:
    return status;
}

tl_status tl_ispc_read(const tl_capture_request *request, tl_captured *out, tl_error *err)
{
    const char *const path = request->path;
    tl_status status = TL_OK;
    tl_captured read = {.has_lights = true,
                        .has_look = true,
                        .look = {.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}};
    header h;
    uint64_t file_size;
    int file = -1;
    status = tl_regular_file_open(path, &file, &file_size, err);
    if (status != TL_OK)
        return status;
    TRY(read_header(file, file_size, path, &h, err));
    TRY(read_lights(file, path, &h, &read.lights, err));
    TRY(read_gbuffer(file, path, &h, &read.gbuffer, err));
    *out = read;
    read = (tl_captured){0};
done:
    tl_captured_clear(&read);
    close(file);
    return status;
}
