/* Pixels that no arithmetic can light, as layouts pack them.
 *
 * What counts is what kernels read, in float and in double: of stored positions the two differ, and
 * either may be behind the eye, or off its ray, by what the other is not. */
#define TL_REAL_DOUBLE 1
#include "packing_setup.h"

#include "float_position.h"
#include "parallel.h"
#include "repair.h"

#include <stddef.h>

/* What is checked beyond depth and normal, where a layout stores it in numbers that may be at fault. */
static const struct {
    size_t attribute; /* offset in tl_layout */
    enum tl_plane first;
} values[] = {
    {offsetof(tl_layout, albedo), TL_ALBEDO_R},
    {offsetof(tl_layout, specular), TL_SPECULAR_R},
    {offsetof(tl_layout, shininess), TL_SHININESS},
    {offsetof(tl_layout, metallic), TL_METALLIC},
    {offsetof(tl_layout, roughness), TL_ROUGHNESS},
    {offsetof(tl_layout, occlusion), TL_OCCLUSION},
    {offsetof(tl_layout, emissive), TL_EMISSIVE_R},
    {offsetof(tl_layout, brdf), TL_BRDF},
    {offsetof(tl_layout, tangent), TL_TANGENT_X},
};
enum { VALUE_COUNT = sizeof values / sizeof values[0], MOST_VALUES = 3 * VALUE_COUNT };

typedef struct checked_value {
    tl_channel channel;
    enum tl_plane plane;
} checked_value;

/* Bits of a word that are these where a pixel does not tell of something. */
typedef struct telling_field {
    uint32_t word, mask, neutral;
    uint32_t of; /* of a plane, bit 1 << plane, that it is not neutral; or TL_REFLECTS */
} telling_field;

typedef struct job {
    tl_faults *faults;
    const tl_gbuffer *gbuffer;
    tl_word_planes planes;
    tl_words sky;
    tl_packing packing; /* what is the same for every pixel */
    checked_value values[MOST_VALUES];
    int value_count;
    telling_field fields[2 * MOST_VALUES];
    int field_count;
    atomic_ullong slack_x, slack_y; /* bits of doubles, which are in order for values >= 0 */
} job;

typedef struct slack {
    double x, y;
} slack;

/* Where a pixel is, as both arithmetics read it. */
typedef struct readings {
    vec3 of[2];
} readings;

/* Whole numbers always say something; floats need not. */
static int is_number(tl_channel c, real value)
{
    return c.number == TL_NUMBER_HALF ? fabs(value) <= TL_MOST_HALF : isfinite(value);
}

static const tl_attribute *attribute_of(const job *j, int value)
{
    return (const void *)((const char *)j->planes.layout + values[value].attribute);
}

static void list_values(job *j)
{
    for (int i = 0; i < VALUE_COUNT; i++) {
        const tl_attribute *a = attribute_of(j, i);
        for (int k = 0; k < 3 && (j->gbuffer->present & TL_HAS(values[i].first)); k++) {
            const tl_channel c = a->channels[k];
            if (a->code && c.bits > 0 && c.number <= TL_NUMBER_FLOAT24)
                j->values[j->value_count++] = (checked_value){c, values[i].first};
        }
    }
}

static uint32_t largest_field(tl_channel c)
{
    return (uint32_t)((1ull << c.bits) - 1u);
}

/* What bits of the channel read as exactly 1, in float and in double; returns whether there are any. */
static int field_of_one(tl_channel c, uint32_t *field)
{
    const uint32_t most = largest_field(c);
    *field = c.number == TL_NUMBER_FLOAT ? 0x3f800000u : most;
    return c.number == TL_NUMBER_FLOAT ||
           (c.number == TL_NUMBER_UNORM && (float)most * (1.0f / (float)most) == 1.0f &&
            (double)most * (1.0 / (double)most) == 1.0);
}

/* What bits of channel k read as the value that absence means, in float and in double: 0 does in every
 * number and code but an octahedron's, whose first number says so; of a 1 it is a matter of rounding.
 * Returns whether there are any. */
static int neutral_field(const tl_attribute *a, int k, enum tl_plane plane, uint32_t *field)
{
    const tl_channel c = a->channels[k];
    *field = plane == TL_TANGENT_X && a->code == TL_NORMAL_OCTAHEDRON && k == 0
                 ? none_bits(c.bits)
                 : 0;
    return plane == TL_OCCLUSION ? field_of_one(c, field) : 1;
}

static void list_field(job *j, tl_channel c, uint32_t neutral, uint32_t of)
{
    j->fields[j->field_count++] =
        (telling_field){c.word, largest_field(c) << c.shift, neutral << c.shift, of};
}

/* Fields tell of the first plane of their attribute: a colour is neutral whole or not at all. A plane
 * without such bits is told of as if it said something. */
static void list_neutral(job *j)
{
    for (int i = 0; i < VALUE_COUNT; i++) {
        const uint32_t plane = TL_HAS(values[i].first);
        const tl_attribute *a = attribute_of(j, i);
        for (int k = 0; k < 3 && (j->gbuffer->present & TL_MAY_BE_NEUTRAL & plane); k++) {
            const tl_channel c = a->channels[k];
            uint32_t neutral;
            if (!a->code || c.bits == 0)
                continue;
            if (neutral_field(a, k, values[i].first, &neutral))
                list_field(j, c, neutral, plane);
            else
                atomic_fetch_or(&j->faults->telling, plane);
        }
    }
}

/* Of albedo and specular colour 0, of metallic 1: where a layout has no such bits, surfaces are taken to
 * reflect. */
static void list_black(job *j)
{
    for (int i = 0; i < VALUE_COUNT; i++) {
        const enum tl_plane plane = values[i].first;
        const tl_attribute *a = attribute_of(j, i);
        if (plane != TL_ALBEDO_R && plane != TL_SPECULAR_R && plane != TL_METALLIC)
            continue;
        for (int k = 0; k < 3 && (j->gbuffer->present & TL_HAS(plane)); k++) {
            const tl_channel c = a->channels[k];
            uint32_t field = 0;
            if (!a->code || c.bits == 0)
                continue;
            if (plane == TL_METALLIC && !field_of_one(c, &field))
                atomic_fetch_or(&j->faults->telling, TL_REFLECTS);
            list_field(j, c, field, TL_REFLECTS);
        }
    }
}

/* *telling gathers what pixels tell of. */
static void gather_telling(const job *j, const tl_words *words, uint32_t *telling)
{
    for (int i = 0; i < j->field_count; i++) {
        const telling_field f = j->fields[i];
        if (!(*telling & f.of) && (words->of[f.word] & f.mask) != f.neutral)
            *telling |= f.of;
    }
}

static readings read_position(
    const job *j, const tl_layout *layout, const tl_words *words, uint32_t column, uint32_t row)
{
    const tl_packing *p = &j->packing;
    float in_float[3];
    tl_float_position_of[p->needs.layout](p->frame, p->needs, words, in_float);
    return (readings){{{in_float[0], in_float[1], in_float[2]},
                       position_of(p->frame, p->needs, layout, words, column, row)}};
}

/* Whether what reads as sky was meant so: what is no number, or behind the far plane, does too. */
static int is_stored_sky(const tl_layout *layout, const tl_words *words)
{
    const tl_channel c = layout->depth.channels[0];
    const real stored = stored_depth(layout, words);
    if (TL_IS_NEARNESS(layout->depth.code))
        return stored == 0.0;
    return stored == (c.number == TL_NUMBER_HALF ? 0x1p16 : (real)INFINITY);
}

static int is_within(const tl_packing *p, vec3 at)
{
    if (!(fabs(at.x) <= TL_FARTHEST && fabs(at.y) <= TL_FARTHEST && fabs(at.z) <= TL_FARTHEST))
        return 0;
    return p->needs.orthographic || -at.z >= 0x1p-149;
}

static int has_position(const tl_packing *p,
                        const tl_layout *layout,
                        const tl_words *words,
                        readings at)
{
    const tl_attribute *a = &layout->depth;
    for (int k = 0; k < 3 && TL_IS_POSITION(a->code); k++)
        if (!is_number(a->channels[k], channel_value(a->channels[k], words)))
            return 0;
    return is_within(p, at.of[0]) && is_within(p, at.of[1]);
}

static int has_normal(const tl_layout *layout, const tl_words *words)
{
    const tl_attribute *a = &layout->normal;
    const vec3 n = stored_normal(layout, words);
    const real most = fmax(fabs(n.x), fmax(fabs(n.y), fabs(n.z)));
    for (int k = 0; k < 3 && a->channels[k].bits > 0; k++)
        if (!is_number(a->channels[k], channel_value(a->channels[k], words)))
            return 0;
    return most >= TL_SHORTEST && most <= TL_LONGEST;
}

static void clear_channel(tl_words *words, tl_channel c)
{
    words->of[c.word] &= ~(largest_field(c) << c.shift);
}

static __attribute__((noinline)) void remove_normal(const job *j, tl_words *words)
{
    static const vec3 none = {0.0, 0.0, 0.0};
    tl_packing p = j->packing;
    p.words = *words;
    for (int k = 0; k < 3; k++)
        clear_channel(&p.words, p.layout->normal.channels[k]);
    put_normal(&p, none);
    *words = p.words;
}

/* Returns whether any was at fault. */
static __attribute__((noinline)) int repair_values(const job *j,
                                                   tl_words *words,
                                                   uint32_t column,
                                                   uint32_t row)
{
    tl_packing p = j->packing;
    int repaired = 0;
    p.words = *words;
    for (int i = 0; i < j->value_count; i++) {
        const tl_channel c = j->values[i].channel;
        const real v = channel_value(c, &p.words);
        const real wanted =
            is_number(c, v) ? tl_repaired_value(j->values[i].plane, (float)v) : 0.0;
        if (v == wanted)
            continue;
        clear_channel(&p.words, c);
        put(&p, c, 0u, wanted);
        tl_faults_note(j->faults, row, column, j->values[i].plane);
        repaired = 1;
    }
    *words = p.words;
    return repaired;
}

/* How far the position is off the ray that the rectangles of lights take it to be on
 * (kernels/tile_rect.h): from the same floats, in double. */
static void widen(slack *most, const job *j, readings at, uint32_t column, uint32_t row)
{
    const tl_rays rays = j->packing.frame->rays;
    const double ray_x = rays.x0 + column * (double)rays.dx;
    const double ray_y = rays.y0 + row * (double)rays.dy;
    for (int i = 0; i < 2; i++) {
        const double unit = j->packing.needs.orthographic ? 1.0 : -at.of[i].z;
        most->x = fmax(most->x, fabs(at.of[i].x / unit - ray_x));
        most->y = fmax(most->y, fabs(at.of[i].y / unit - ray_y));
    }
}

static void repair_pixel(const job *j,
                         const tl_layout *layout,
                         tl_words *words,
                         uint32_t column,
                         uint32_t row,
                         tl_fault_counts *counts,
                         uint32_t *telling,
                         tl_index_set *indices,
                         slack *most)
{
    const readings at = read_position(j, layout, words, column, row);
    const int is_sky = isinf(at.of[0].z) && is_stored_sky(layout, words);
    if (is_sky || !has_position(&j->packing, layout, words, at)) {
        if (!is_sky)
            tl_faults_note(j->faults, row, column, TL_DEPTH);
        counts->depth += !is_sky;
        *words = j->sky;
        return;
    }
    if (!has_normal(layout, words)) {
        tl_faults_note(j->faults, row, column, TL_NORMAL_X);
        counts->normal++;
        remove_normal(j, words);
    }
    counts->value += (unsigned)repair_values(j, words, column, row);
    gather_telling(j, words, telling);
    if (j->gbuffer->present & TL_GROUP_BRDF)
        tl_index_note(indices, (uint32_t)channel_value(layout->brdf.channels[0], words));
    if (TL_IS_POSITION(layout->depth.code))
        widen(most, j, at, column, row);
}

static void raise_to(atomic_ullong *most, double value)
{
    unsigned long long bits, before = atomic_load(most);
    memcpy(&bits, &value, sizeof bits);
    while (bits > before && !atomic_compare_exchange_weak(most, &before, bits))
        ;
}

static void repair_rows(job *j, const tl_layout *layout, size_t begin, size_t end)
{
    tl_word_planes planes = j->planes;
    tl_fault_counts counts = {0, 0, 0};
    slack most = {0.0, 0.0};
    uint32_t telling = 0;
    tl_index_set indices = {{0}};
    planes.layout = layout;
    for (uint32_t row = (uint32_t)begin; row < end; row++)
        for (uint32_t column = 0; column < j->gbuffer->camera.width; column++) {
            const size_t at = (size_t)row * j->gbuffer->pitch + column;
            tl_words words = tl_words_at(&planes, at);
            repair_pixel(j, layout, &words, column, row, &counts, &telling, &indices, &most);
            tl_words_put(&planes, at, words);
        }
    tl_faults_add(j->faults, counts);
    tl_faults_add_indices(j->faults, &indices);
    atomic_fetch_or(&j->faults->telling, telling);
    raise_to(&j->slack_x, most.x);
    raise_to(&j->slack_y, most.y);
}

/* One function per layout, in which what is read of the table is constants: 1920 x 1080 pixels of
 * compact-16 take two threads 33 ms in place of 51. */
#define ROWS_OF(name, row, word)                                                              \
    static                                                                                    \
        __attribute__((flatten)) void rows_of_##name(void *context, size_t begin, size_t end) \
    {                                                                                         \
        repair_rows(context, &tl_layouts[name], begin, end);                                  \
    }
TL_LAYOUTS(ROWS_OF)
#undef ROWS_OF

static void (*const rows_of[TL_LAYOUT_COUNT])(void *context, size_t begin, size_t end) = {
#define ROWS_OF(name, row, word) [name] = rows_of_##name,
    TL_LAYOUTS(ROWS_OF)
#undef ROWS_OF
};

/* Up to the next float, and by what the interval of a sphere may be off in double. */
static float slack_of(atomic_ullong *most)
{
    const unsigned long long bits = atomic_load(most);
    double value;
    memcpy(&value, &bits, sizeof value);
    const float most_off = (float)(value * (1.0 + 0x1p-30));
    return most_off > 0.0f ? nextafterf(most_off, INFINITY) : most_off;
}

void tl_repair_packed(tl_gbuffer *gbuffer, tl_faults *faults)
{
    tl_frame frame = {.tile_size = 0};
    job j = {.faults = faults,
             .gbuffer = gbuffer,
             .planes = tl_word_planes_of(gbuffer),
             .sky = tl_sky_words(&gbuffer->camera, gbuffer->layout, gbuffer->present),
             .packing =
                 tl_packing_of(&gbuffer->camera, gbuffer->layout, gbuffer->present, &frame)};
    list_values(&j);
    list_neutral(&j);
    list_black(&j);
    atomic_init(&j.slack_x, 0);
    atomic_init(&j.slack_y, 0);
    tl_parallel(gbuffer->camera.height, 4, rows_of[gbuffer->layout], &j);
    gbuffer->slack_x = slack_of(&j.slack_x);
    gbuffer->slack_y = slack_of(&j.slack_y);
}
