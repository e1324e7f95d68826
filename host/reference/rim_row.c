/* How near to a rim rounding may decide, in float.
 *
 * u = 2^-24. Of the kernels, float against double: n turns by 3u sum |r_i w_i|, sqrt(3) 3u at most, and u,
 * and is of length 1 to within 4.5u; with an octahedron by 16.3u more, with a spheremap by 329.2u
 * (docs/accuracy.md). p moves by 5u |p| and 2u |p| along the ray; a position that is stored in world space by
 * 4u of the distance between the world's origin and the eye, and of its own. l rounds by u |l|, and n.l by 3u
 * |l|. So n.l is off by no more than (11 + 17) u |l| + 8u |p| + 4u |eye|, with a spheremap (11 + 330) u |l| +
 * ..., which by Cauchy's inequality is less than 30u, 342u, of sqrt(|l|^2 + |p|^2 + |eye|^2). What is looked
 * at here is off as much again. The margins below are twice that, to the next power of two.
 *
 * d^2 is off by 2 |l| times what l is off by, and 3u of itself: the same margin, of 2 |l| sqrt(...).
 *
 * Compiled once per instruction set: TL_TWIN is the name it then has. */
#include "rims.h"

#include "lit_pixel.h"

tl_rim_row TL_TWIN;

enum { TILE_PIXELS = TL_RIM_TILE * TL_RIM_TILE };

/* Surfaces of a tile, [count] each, so that loops over them are vectors. */
typedef struct surfaces {
    uint32_t count;
    float x[TILE_PIXELS], y[TILE_PIXELS], z[TILE_PIXELS]; /* m */
    float nx[TILE_PIXELS], ny[TILE_PIXELS], nz[TILE_PIXELS];
    float away2[TILE_PIXELS]; /* |p|^2 + |eye|^2, m^2 */
    int at_rim[TILE_PIXELS];
    uint16_t in_tile[TILE_PIXELS]; /* row by row */
} surfaces;

/* What of a frame has rims. */
typedef struct rims {
    float margin2; /* of any */
    float below2;  /* of the rim where n.l = 0; less than 0 where there is none */
    float eye2;    /* m^2; 0 where positions are not in world space */
} rims;

static rims rims_of(const tl_prepared *prepared, const tl_layout *layout)
{
    const tl_needs needs = prepared->needs;
    rims r = {0.0f, -1.0f, 0.0f};
    int is_steep = 0;
    for (tl_u32 model = 0; model < TL_MODEL_COUNT; model++) {
        const tl_u32 traits = needs.models >> model & 1u ? traits_of(model) : 0;
        const tl_u32 steep = (needs.specular ? (tl_u32)TL_LOBE_SPECULAR : 0) | TL_LOBE_EYE;
        is_steep |= (traits & steep) && !(traits & TL_LOBE_COSINE);
    }
    const float margin =
        (layout->normal.code == TL_NORMAL_SPHEREMAP ? 2048.0f : 128.0f) * 0x1p-24f;
    r.margin2 = margin * margin;
    if (is_steep)
        r.below2 = r.margin2;
    if (layout->depth.code == TL_DEPTH_WORLD_POSITION)
        for (int i = 0; i < 3; i++) {
            const float to = prepared->frame.view_from_world[i][3];
            r.eye2 += to * to;
        }
    return r;
}

static void grow(box *b, vec3 p)
{
    const vec3 low = {p.x < b->low.x ? p.x : b->low.x, p.y < b->low.y ? p.y : b->low.y,
                      p.z < b->low.z ? p.z : b->low.z};
    const vec3 high = {p.x > b->high.x ? p.x : b->high.x, p.y > b->high.y ? p.y : b->high.y,
                       p.z > b->high.z ? p.z : b->high.z};
    b->low = low;
    b->high = high;
}

static void add_surface(surfaces *s, vec3 p, vec3 n, float eye2, uint32_t in_tile)
{
    const uint32_t i = s->count++;
    s->x[i] = p.x;
    s->y[i] = p.y;
    s->z[i] = p.z;
    s->nx[i] = n.x;
    s->ny[i] = n.y;
    s->nz[i] = n.z;
    s->away2[i] = dot3(p, p) + eye2;
    s->at_rim[i] = 0;
    s->in_tile[i] = (uint16_t)in_tile;
}

typedef struct corner {
    uint32_t x, y, width, height; /* px, of the part of the tile that is in the picture */
} corner;

/* The words of an attribute, bits 1 << word. */
static uint32_t words_of(const tl_attribute *a)
{
    uint32_t words = 0;
    for (int i = 0; i < 3; i++)
        words |= 1u << a->channels[i].word;
    return words;
}

/* Of a pixel, where its surface is and how it is turned; the rest is left 0. */
static tl_words some_words_at(const tl_word_planes *planes, uint32_t wanted, size_t at)
{
    tl_words words = {{0}};
    for (uint32_t rest = wanted; rest; rest &= rest - 1) {
        const uint32_t word = (uint32_t)__builtin_ctz(rest);
        words.of[word] = tl_word_at(planes, word, at);
    }
    return words;
}

/* Surfaces without a normal are in the box, and at no rim: no light reaches them. */
static box load_tile(const tl_prepared *prepared,
                     const tl_word_planes *planes,
                     corner at,
                     float eye2,
                     surfaces *out)
{
    const tl_frame *frame = &prepared->frame;
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const uint32_t wanted =
        words_of(&planes->layout->depth) | words_of(&planes->layout->normal);
    out->count = 0;
    for (uint32_t y = 0; y < at.height; y++)
        for (uint32_t x = 0; x < at.width; x++) {
            const uint32_t column = at.x + x, row = at.y + y;
            const tl_words words =
                some_words_at(planes, wanted, (size_t)row * frame->pitch + column);
            const vec3 p = position_of(frame, prepared->needs, planes->layout, &words,
                                       (float)column, (float)row);
            if (!(-p.z < INFINITY))
                continue;
            const vec3 stored = stored_normal(planes->layout, &words);
            const vec3 n = planes->layout->normal_space == TL_NORMALS_IN_VIEW
                               ? unit3(stored)
                               : view_normal(frame, stored);
            grow(&b, p);
            if (dot3(n, n) > 0.0f)
                add_surface(out, p, n, eye2, y * TL_RIM_TILE + x);
        }
    return b;
}

/* from: 0 for a directional light, whose l is the same everywhere, and which is nowhere near; else 1. */
static void note_light(surfaces *s, tl_view_light light, float from, float most2, float below2)
{
    const float lx = light.position[0], ly = light.position[1], lz = light.position[2];
    const float near2 = from / (float)(TL_NEARER * TL_NEARER);
    for (uint32_t i = 0; i < s->count; i++) {
        const float x = lx - from * s->x[i], y = ly - from * s->y[i], z = lz - from * s->z[i];
        const float d2 = x * x + y * y + z * z;
        const float facing = s->nx[i] * x + s->ny[i] * y + s->nz[i] * z;
        const int is_rim = facing * facing <= below2 * (d2 + from * s->away2[i]);
        const int is_near = d2 < near2 * s->away2[i];
        s->at_rim[i] |= (d2 <= most2) & (is_rim | is_near);
    }
}

static void note_end(surfaces *s, tl_view_light light, float margin2)
{
    for (uint32_t i = 0; i < s->count; i++) {
        const float x = light.position[0] - s->x[i], y = light.position[1] - s->y[i],
                    z = light.position[2] - s->z[i];
        const float d2 = x * x + y * y + z * z, off = d2 - light.range2;
        s->at_rim[i] |= off * off <= 4.0f * margin2 * d2 * (d2 + s->away2[i]);
    }
}

/* Returns how many lights may reach the tile. */
static uint32_t note_lights(const tl_prepared *prepared, box of, rims r, surfaces *s)
{
    const tl_frame *frame = &prepared->frame;
    uint32_t count = 0;
    for (uint32_t i = 0; i < frame->light_count; i++) {
        const tl_view_light light = prepared->lights[i];
        const int is_global = i < frame->global_count;
        if (!is_global && !reaches_box(light, of))
            continue;
        count++;
        const float from = light.falloff == TL_FADE_NONE ? 0.0f : 1.0f;
        note_light(s, light, from, is_global ? INFINITY : light.range2 * (1.0f + 0x1p-10f),
                   r.below2);
        if (!is_global && has_shape(light.falloff))
            note_end(s, light, r.margin2);
    }
    return count;
}

static tl_rim_tile rim_tile(const tl_prepared *prepared,
                            const tl_word_planes *planes,
                            corner at,
                            uint32_t width,
                            uint8_t *at_rim)
{
    surfaces s;
    const rims r = rims_of(prepared, planes->layout);
    const box of = load_tile(prepared, planes, at, r.eye2, &s);
    tl_rim_tile tile = {.light_count = note_lights(prepared, of, r, &s)};
    if (of.low.z <= of.high.z) {
        tile.nearest = -of.high.z;
        tile.farthest = -of.low.z;
    }
    for (uint32_t y = 0; y < at.height; y++)
        memset(at_rim + (size_t)(at.y + y) * width + at.x, 0, at.width);
    for (uint32_t i = 0; i < s.count; i++) {
        const uint32_t y = at.y + s.in_tile[i] / TL_RIM_TILE,
                       x = at.x + s.in_tile[i] % TL_RIM_TILE;
        at_rim[(size_t)y * width + x] = s.at_rim[i] != 0;
        tile.rim_count += s.at_rim[i] != 0;
    }
    return tile;
}

static uint32_t cut(uint32_t from, uint32_t end)
{
    return end - from < TL_RIM_TILE ? end - from : TL_RIM_TILE;
}

void TL_TWIN(const tl_prepared *prepared,
             const tl_word_planes *planes,
             uint32_t width,
             uint32_t height,
             uint32_t tile_row,
             tl_rim_tile *tiles,
             uint8_t *at_rim)
{
    const uint32_t y = tile_row * TL_RIM_TILE,
                   tiles_x = (width + TL_RIM_TILE - 1) / TL_RIM_TILE;
    for (uint32_t x = 0; x < width; x += TL_RIM_TILE)
        tiles[tile_row * tiles_x + x / TL_RIM_TILE] = rim_tile(
            prepared, planes, (corner){x, y, cut(x, width), cut(y, height)}, width, at_rim);
}
