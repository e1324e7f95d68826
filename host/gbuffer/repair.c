/* Pixels that no arithmetic can light are made ones that it can. */
#include "repair.h"

#include "parallel.h"
#include "plane_values.h"

#include <stdio.h>

static const char *const channels[TL_OPACITY_FAULT + 1] = {
#define CHANNEL(name, channel, empty, meaning) [name] = channel,
    TL_PLANES(CHANNEL)
#undef CHANNEL
        [TL_OPACITY_FAULT] = "opacity",
};

/* What a layout packs together goes by one name. */
static const char *const attributes[TL_OPACITY_FAULT + 1] = {
    [TL_DEPTH] = "depth",         [TL_NORMAL_X] = "normal",     [TL_ALBEDO_R] = "albedo",
    [TL_SPECULAR_R] = "specular", [TL_SHININESS] = "shininess", [TL_METALLIC] = "metallic",
    [TL_ROUGHNESS] = "roughness", [TL_OCCLUSION] = "ao",        [TL_EMISSIVE_R] = "emissive",
    [TL_BRDF] = "brdf",           [TL_TANGENT_X] = "tangent",   [TL_OPACITY_FAULT] = "opacity",
};

typedef struct scan {
    float *planes[TL_PLANE_COUNT];
    const tl_gbuffer *gbuffer;
    float deepest; /* m */
    tl_faults *faults;
} scan;

void tl_faults_note(tl_faults *faults, uint32_t row, uint32_t column, int plane)
{
    const unsigned long long here =
        (unsigned long long)row << 40 | (unsigned long long)column << 8 | (unsigned)plane;
    unsigned long long first = atomic_load(&faults->first);
    while (here < first && !atomic_compare_exchange_weak(&faults->first, &first, here))
        ;
}

void tl_faults_add(tl_faults *faults, tl_fault_counts counts)
{
    atomic_fetch_add(&faults->depth, counts.depth);
    atomic_fetch_add(&faults->normal, counts.normal);
    atomic_fetch_add(&faults->value, counts.value);
}

void tl_faults_add_indices(tl_faults *faults, const tl_index_set *set)
{
    for (int i = 0; i < TL_INDEX_WORDS; i++)
        atomic_fetch_or(&faults->indices[i], set->bits[i]);
}

static int is_sky(float depth)
{
    return depth == INFINITY;
}

/* Coordinates of what a perspective camera sees grow with depth: up to here none is beyond TL_FARTHEST. */
static float deepest_of(const tl_camera *camera)
{
    const float across = fmaxf(fabsf(camera->left), fabsf(camera->right));
    const float edge = fmaxf(across, fmaxf(fabsf(camera->bottom), fabsf(camera->top)));
    if (camera->projection == TL_ORTHOGRAPHIC || edge <= 1.0f)
        return TL_FARTHEST;
    return TL_FARTHEST / edge;
}

/* Orthographic cameras may have surfaces behind the eye point. */
static int has_no_depth(const scan *s, float depth)
{
    if (isnan(depth) || fabsf(depth) > s->deepest)
        return 1;
    return s->gbuffer->camera.projection == TL_PERSPECTIVE && !(depth > 0.0f);
}

static int has_no_normal(float nx, float ny, float nz)
{
    const float most = fmaxf(fabsf(nx), fmaxf(fabsf(ny), fabsf(nz)));
    return isnan(nx) || isnan(ny) || isnan(nz) || !(most >= TL_SHORTEST) ||
           !(most <= TL_LONGEST);
}

static void clear_pixel(scan *s, size_t at)
{
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (s->planes[p])
            s->planes[p][at] = tl_plane_empty[p];
}

/* Of repaired values. */
static uint32_t reflects(const scan *s, size_t at)
{
    for (int p = TL_ALBEDO_R; p <= TL_SPECULAR_B; p++)
        if (s->planes[p] && tl_says_more_than_absence(p, s->planes[p][at]))
            return TL_REFLECTS;
    return s->planes[TL_METALLIC] && s->planes[TL_METALLIC][at] != 1.0f ? TL_REFLECTS : 0;
}

/* *telling gathers the planes that are not neutral here. */
static unsigned long long repair_values(
    scan *s, size_t at, uint32_t row, uint32_t column, uint32_t *telling)
{
    unsigned long long repaired = 0;
    for (int p = TL_ALBEDO_R; p < TL_PLANE_COUNT; p++) {
        if (!s->planes[p])
            continue;
        const float v = s->planes[p][at], repaired_value = tl_repaired_value(p, v);
        if (!(v == repaired_value)) {
            s->planes[p][at] = repaired_value;
            tl_faults_note(s->faults, row, column, p);
            repaired = 1;
        }
        *telling |= tl_says_more_than_absence(p, s->planes[p][at]) << p;
    }
    if (!(*telling & TL_REFLECTS))
        *telling |= reflects(s, at);
    return repaired;
}

static void repair_rows(void *context, size_t begin, size_t end)
{
    scan *const s = context;
    tl_fault_counts counts = {0, 0, 0};
    uint32_t telling = 0;
    tl_index_set indices = {{0}};
    const float *brdf = s->planes[TL_BRDF];
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
            if (has_no_depth(s, depth)) {
                tl_faults_note(s->faults, row, column, TL_DEPTH);
                counts.depth++;
                clear_pixel(s, at);
                continue;
            }
            if (has_no_normal(nx[at], ny[at], nz[at])) {
                tl_faults_note(s->faults, row, column, TL_NORMAL_X);
                counts.normal++;
                nx[at] = ny[at] = nz[at] = 0.0f;
            }
            counts.value += repair_values(s, at, row, column, &telling);
            if (brdf)
                tl_index_note(&indices, (uint32_t)brdf[at]);
        }
    }
    tl_faults_add(s->faults, counts);
    tl_faults_add_indices(s->faults, &indices);
    atomic_fetch_or(&s->faults->telling, telling);
}

static void repair_float(tl_gbuffer *gbuffer, tl_faults *faults)
{
    scan s = {.gbuffer = gbuffer, .deepest = deepest_of(&gbuffer->camera), .faults = faults};
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        s.planes[p] = tl_gbuffer_plane(gbuffer, p);
    tl_parallel(gbuffer->camera.height, 16, repair_rows, &s);
}

static tl_status refuse(const tl_gbuffer *gbuffer,
                        const char *name,
                        unsigned long long first,
                        tl_error *err)
{
    const int plane = first & 0xff, is_packed = gbuffer->layout != TL_LAYOUT_FLOAT;
    return tl_fail(
        err, TL_ERR_FORMAT,
        "%s: pixel (%llu, %llu), %s %s cannot be lit as it is; without --strict it is "
        "repaired",
        name, first >> 8 & 0xffffffff, first >> 40, is_packed ? "packed" : "channel",
        is_packed ? attributes[plane] : channels[plane]);
}

/* A colour is neutral whole or not at all, and so is a tangent. */
static uint32_t neutral_planes(uint32_t present, uint32_t telling)
{
    static const uint32_t threes[] = {TL_THREE(TL_SPECULAR_R), TL_GROUP_EMISSIVE,
                                      TL_GROUP_TANGENT};
    uint32_t neutral = present & TL_MAY_BE_NEUTRAL & ~telling;
    for (size_t i = 0; i < sizeof threes / sizeof threes[0]; i++)
        if ((neutral & threes[i]) != threes[i])
            neutral &= ~threes[i];
    return neutral;
}

/* Of one surface: layers are G-buffers of their own. */
static tl_status repair_surface(
    tl_gbuffer *gbuffer, const char *name, bool strict, tl_repairs *out, tl_error *err)
{
    tl_faults faults;
    atomic_init(&faults.depth, 0);
    atomic_init(&faults.normal, 0);
    atomic_init(&faults.value, 0);
    atomic_init(&faults.first, ~0ull);
    atomic_init(&faults.telling, 0);
    for (int i = 0; i < TL_INDEX_WORDS; i++)
        atomic_init(&faults.indices[i], 0);
    if (gbuffer->layout == TL_LAYOUT_FLOAT)
        repair_float(gbuffer, &faults);
    else
        tl_repair_packed(gbuffer, &faults);
    if (gbuffer->opacity)
        tl_repair_opacity(gbuffer, &faults);
    gbuffer->neutral = neutral_planes(gbuffer->present, atomic_load(&faults.telling));
    gbuffer->is_dark = !(atomic_load(&faults.telling) & TL_REFLECTS);
    gbuffer->knows_indices = true;
    for (int i = 0; i < TL_INDEX_WORDS; i++)
        gbuffer->indices[i] = atomic_load(&faults.indices[i]);
    const unsigned long long first = atomic_load(&faults.first);
    if (strict && first != ~0ull)
        return refuse(gbuffer, name, first, err);
    out->depth += atomic_load(&faults.depth);
    out->normal += atomic_load(&faults.normal);
    out->value += atomic_load(&faults.value);
    return TL_OK;
}

tl_status tl_gbuffer_repair(
    tl_gbuffer *gbuffer, const char *name, bool strict, tl_repairs *out, tl_error *err)
{
    tl_repairs sum = {0};
    tl_status status = repair_surface(gbuffer, name, strict, &sum, err);
    for (uint32_t i = 0; status == TL_OK && i < gbuffer->layers.count; i++) {
        char layer[1024];
        snprintf(layer, sizeof layer, "%.1000s: layer %u", name ? name : "", i);
        status = repair_surface(gbuffer->layers.of[i], layer, strict, &sum, err);
    }
    if (status == TL_OK && out)
        *out = sum;
    return status;
}
