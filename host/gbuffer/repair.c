/* Pixels that no arithmetic can light are made ones that it can. */
#include "tilelight/gbuffer.h"

#include "parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

static const struct {
    const char *channel;
    float empty;
} planes[TL_PLANE_COUNT] = {
#define PLANE(name, channel, empty, meaning) [name] = {channel, empty},
    TL_PLANES(PLANE)
#undef PLANE
};

/* The largest value a plane may have, where it is not 1. Above it a value becomes it; what is not
 * finite or negative becomes 0. */
static const float largest[TL_PLANE_COUNT] = {
    [TL_SHININESS] = 10000.0f,
    [TL_EMISSIVE_R] = 1e30f,
    [TL_EMISSIVE_G] = 1e30f,
    [TL_EMISSIVE_B] = 1e30f,
};

/* Squares of lengths within this range neither overflow nor vanish in float. */
static const float shortest_normal = 1e-18f, longest_normal = 1e18f;

/* A depth beyond it would overflow d2; nothing there can be told from the sky. */
static const float deepest = 1e18f;

typedef struct scan {
    float *planes[TL_PLANE_COUNT];
    const tl_gbuffer *gbuffer;
    atomic_ullong depth, normal, value;
    atomic_ullong
        first; /* (row << 40 | column << 8 | plane) of the first fault, for messages */
} scan;

static void note(scan *s, uint32_t row, uint32_t column, int plane)
{
    const unsigned long long here =
        (unsigned long long)row << 40 | (unsigned long long)column << 8 | (unsigned)plane;
    unsigned long long first = atomic_load(&s->first);
    while (here < first && !atomic_compare_exchange_weak(&s->first, &first, here))
        ;
}

static int is_sky(float depth)
{
    return depth == INFINITY;
}

/* Orthographic cameras may have surfaces behind the eye point. */
static int has_no_depth(const tl_gbuffer *gbuffer, float depth)
{
    if (isnan(depth) || fabsf(depth) > deepest)
        return 1;
    return gbuffer->camera.projection == TL_PERSPECTIVE && !(depth > 0.0f);
}

static int has_no_normal(float nx, float ny, float nz)
{
    const float most = fmaxf(fabsf(nx), fmaxf(fabsf(ny), fabsf(nz)));
    return isnan(nx) || isnan(ny) || isnan(nz) || !(most >= shortest_normal) ||
           !(most <= longest_normal);
}

static void clear_pixel(scan *s, size_t at)
{
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (s->planes[p])
            s->planes[p][at] = planes[p].empty;
}

static unsigned long long repair_values(scan *s, size_t at, uint32_t row, uint32_t column)
{
    unsigned long long repaired = 0;
    for (int p = TL_ALBEDO_R; p < TL_PLANE_COUNT; p++) {
        if (!s->planes[p])
            continue;
        const float v = s->planes[p][at], most = largest[p] > 0.0f ? largest[p] : 1.0f;
        if (v >= 0.0f && v <= most)
            continue;
        s->planes[p][at] = v > most && isfinite(v) ? most : 0.0f;
        note(s, row, column, p);
        repaired = 1;
    }
    return repaired;
}

static void repair_rows(void *context, size_t begin, size_t end)
{
    scan *const s = context;
    unsigned long long depths = 0, normals = 0, values = 0;
    float *nx = s->planes[TL_NORMAL_X], *ny = s->planes[TL_NORMAL_Y],
          *nz = s->planes[TL_NORMAL_Z];

    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        for (uint32_t column = 0; column < s->gbuffer->camera.width; column++) {
            const size_t at = (size_t)row * s->gbuffer->pitch + column;
            const float depth = s->planes[TL_DEPTH][at];
            if (is_sky(depth)) {
                clear_pixel(s, at);
                continue;
            }
            if (has_no_depth(s->gbuffer, depth)) {
                note(s, row, column, TL_DEPTH);
                depths++;
                clear_pixel(s, at);
                continue;
            }
            if (has_no_normal(nx[at], ny[at], nz[at])) {
                note(s, row, column, TL_NORMAL_X);
                normals++;
                nx[at] = ny[at] = nz[at] = 0.0f;
            }
            values += repair_values(s, at, row, column);
        }
    }
    atomic_fetch_add(&s->depth, depths);
    atomic_fetch_add(&s->normal, normals);
    atomic_fetch_add(&s->value, values);
}

tl_status tl_gbuffer_repair(
    tl_gbuffer *gbuffer, const char *name, bool strict, tl_repairs *out, tl_error *err)
{
    scan s = {.gbuffer = gbuffer};
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        s.planes[p] = tl_gbuffer_plane(gbuffer, p);
    atomic_init(&s.depth, 0);
    atomic_init(&s.normal, 0);
    atomic_init(&s.value, 0);
    atomic_init(&s.first, ~0ull);
    tl_parallel(gbuffer->camera.height, 16, repair_rows, &s);

    const tl_repairs repairs = {atomic_load(&s.depth), atomic_load(&s.normal),
                                atomic_load(&s.value)};
    const unsigned long long first = atomic_load(&s.first);
    if (strict && first != ~0ull)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: pixel (%llu, %llu), channel %s cannot be lit as it is; without "
                       "--strict it is repaired",
                       name, first >> 8 & 0xffffffff, first >> 40,
                       planes[first & 0xff].channel);
    if (out)
        *out = repairs;
    return TL_OK;
}
