/* Any camera, any surfaces, any lights that pass the checks: does culling ever lose a light that a pixel is
 * lit by, and is any value of the picture no number?
 *
 * Tiles are bounded, and their lists made, from the formulas of the kernels, in float; pixels lit by the
 * lists of their tiles must have the bits of pixels lit by every light. */
#include "fuzz.h"
#include "fuzz_frame.h"
#include "packing.h"
#include "prepared.h"
#include "shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LIGHTS = 12, MOST_EXTENT = 24, MOST_BOXES = 2, MOST_PIXELS = 32 * 32 };

/* A float out of a few bytes: any bits, or an ordinary number, which most inputs need to get anywhere. */
static float number(fuzz_bytes *from)
{
    const uint8_t kind = fuzz_byte(from);
    if (kind == 255)
        return fuzz_float(from);
    const float whole = (float)((int)fuzz_byte(from) - 128);
    return ldexpf(whole, (int)(kind % 64) - 32);
}

static float above_zero(fuzz_bytes *from)
{
    return fabsf(number(from));
}

static void unit_vector(fuzz_bytes *from, float out[3])
{
    double v[3], length2 = 0.0;
    for (int i = 0; i < 3; i++) {
        v[i] = (double)number(from);
        length2 += v[i] * v[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = length2 > 0.0 ? (float)(v[i] / sqrt(length2)) : i == 2 ? -1.0f : 0.0f;
}

/* Turned by quarters of a turn or by some angle, and moved. */
static void place(fuzz_bytes *from, tl_camera *camera)
{
    const double angle = (double)fuzz_byte(from) * 0.78539816339744831 * 0.125;
    const float c = (float)cos(angle), s = (float)sin(angle);
    const float turned[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int i = 0; i < 3; i++) {
        memcpy(camera->view_from_world[i], turned[i], sizeof turned[i]);
        camera->view_from_world[i][3] = number(from);
    }
}

static tl_camera any_camera(fuzz_bytes *from)
{
    tl_camera camera = {.projection = fuzz_byte(from) % 2 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE};
    camera.width = 1 + fuzz_byte(from) % MOST_EXTENT;
    camera.height = 1 + fuzz_byte(from) % MOST_EXTENT;
    camera.left = number(from);
    camera.right = camera.left + above_zero(from);
    camera.bottom = number(from);
    camera.top = camera.bottom + above_zero(from);
    camera.near = number(from);
    camera.far = camera.near + above_zero(from);
    if (fuzz_byte(from) % 4 == 0)
        camera.far = INFINITY;
    place(from, &camera);
    return camera;
}

static tl_light any_light(fuzz_bytes *from)
{
    tl_light light = tl_light_default();
    const uint8_t kind = fuzz_byte(from);
    light.type = (tl_light_type)(kind % TL_LIGHT_TYPE_COUNT);
    light.falloff = kind & 64 ? TL_FALLOFF_LINEAR : TL_FALLOFF_INVERSE_SQUARE;
    for (int i = 0; i < 3; i++)
        light.position[i] = number(from);
    unit_vector(from, light.direction);
    light.range = kind & 128 ? INFINITY : above_zero(from);
    light.begin = kind & 32 ? light.range * ((float)fuzz_byte(from) / 255.0f) : 0.0f;
    light.outer_cone = (float)fuzz_byte(from) * 0.0123f;
    light.inner_cone = light.outer_cone * ((float)fuzz_byte(from) / 255.0f);
    light.intensity = above_zero(from);
    light.ambient = kind & 16 ? 1.0f : 0.0f;
    return light;
}

/* Those of up to MOST_LIGHTS that pass the checks. */
static tl_light_set any_lights(fuzz_bytes *from)
{
    tl_light_set set = {.ambient = {0.1f, 0.1f, 0.1f}};
    tl_error err = {.status = TL_OK};
    const uint8_t model = fuzz_byte(from), count = fuzz_byte(from);
    set.model = (enum tl_shading_model)(model % TL_MODEL_COUNT);
    for (int i = 0; i < count % (MOST_LIGHTS + 1); i++) {
        const tl_light light = any_light(from);
        fuzz_must(tl_light_set_add(&set, &light, &err) == TL_OK, "%s", err.message);
        if (tl_light_set_check(&set, "lights", NULL) != TL_OK)
            set.count--;
    }
    return set;
}

/* Surfaces at a few depths, by turns, each an ulp or so from the last one. */
static void any_surfaces(fuzz_bytes *from, tl_gbuffer *g)
{
    float depths[8];
    uint8_t pattern[8];
    for (int i = 0; i < 8; i++) {
        depths[i] = number(from);
        pattern[i] = fuzz_byte(from);
    }
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            const uint32_t turn = (x ^ (y * pattern[x % 8])) % 8;
            const float depth = depths[turn];
            tl_gbuffer_plane(g, TL_DEPTH)[at] = y % 2 ? nextafterf(depth, 0.0f) : depth;
            tl_gbuffer_plane(g, TL_NORMAL_X + turn % 3)[at] = turn < 4 ? 1.0f : -1.0f;
            tl_gbuffer_plane(g, TL_NORMAL_Z)[at] += 0.5f;
            for (int p = TL_ALBEDO_R; p <= TL_SPECULAR_B; p++)
                tl_gbuffer_plane(g, (enum tl_plane)p)[at] = 0.5f;
            tl_gbuffer_plane(g, TL_SHININESS)[at] = (float)pattern[turn] * 39.0f;
        }
}

/* The frame in some layout; NULL where there is none such. */
static tl_gbuffer *any_frame(fuzz_bytes *from)
{
    tl_gbuffer *made = NULL, *packed = NULL;
    tl_error err = {.status = TL_OK};
    const tl_camera camera = any_camera(from);
    const enum tl_layout_name layout = (enum tl_layout_name)(fuzz_byte(from) % TL_LAYOUT_COUNT);
    if (tl_camera_check(&camera, NULL) != TL_OK)
        return NULL;
    fuzz_must(tl_gbuffer_create(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, &made, &err) == TL_OK,
              "%s", err.message);
    any_surfaces(from, made);
    fuzz_repair(made);
    if (layout == TL_LAYOUT_FLOAT)
        return made;
    const tl_status status = tl_gbuffer_pack(made, layout, &packed, NULL, &err);
    fuzz_must(status == TL_OK || status == TL_ERR_UNSUPPORTED, "%s", err.message);
    tl_gbuffer_destroy(made);
    return status == TL_OK ? packed : NULL;
}

/* A tile of the frame: its pixels, its boxes, as cull_rows.cl makes them. */
typedef struct tile {
    size_t pixel_count;
    struct {
        pixel in;
        surface of;
        uint32_t column, row;
    } pixels[MOST_PIXELS];
    box boxes[MOST_BOXES];
    int box_count;
} tile;

static box box_between(const tile *t, real above, real up_to)
{
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < t->pixel_count; i++) {
        const vec3 p = t->pixels[i].of.position;
        if (!(-p.z > above && -p.z <= up_to))
            continue;
        b.low = (vec3){fminf(b.low.x, p.x), fminf(b.low.y, p.y), fminf(b.low.z, p.z)};
        b.high = (vec3){fmaxf(b.high.x, p.x), fmaxf(b.high.y, p.y), fmaxf(b.high.z, p.z)};
    }
    return b;
}

static void bound(tile *t)
{
    const box all = box_between(t, -INFINITY, 0x1.fffffep127f);
    const real middle = -0.5f * (all.low.z + all.high.z);
    t->boxes[0] = all;
    t->box_count = 1;
    if (all.high.z - all.low.z > fmaxf(all.high.x - all.low.x, all.high.y - all.low.y)) {
        t->boxes[0] = box_between(t, -INFINITY, middle);
        t->boxes[1] = box_between(t, middle, 0x1.fffffep127f);
        t->box_count = 2;
    }
}

static void load(const tl_prepared *prepared,
                 const tl_gbuffer *g,
                 uint32_t tile_x,
                 uint32_t tile_y,
                 tile *out)
{
    const uint32_t size = prepared->frame.tile_size;
    const tl_word_planes planes = tl_word_planes_of(g);
    out->pixel_count = 0;
    for (uint32_t row = tile_y * size; row < (tile_y + 1) * size; row++)
        for (uint32_t column = tile_x * size; column < (tile_x + 1) * size; column++) {
            const tl_words words = tl_words_at(&planes, (size_t)row * g->pitch + column);
            const surface s = unpacked_surface(&prepared->frame, prepared->needs, planes.layout,
                                               &words, prepared->rows, (real)column, (real)row);
            const pixel in = pixel_of(prepared->needs, planes.layout, &words, -s.position.z);
            if (!(in.depth < INFINITY))
                continue;
            out->pixels[out->pixel_count].in = in;
            out->pixels[out->pixel_count].of = s;
            out->pixels[out->pixel_count].column = column;
            out->pixels[out->pixel_count++].row = row;
        }
    bound(out);
}

static bool is_listed(const tl_prepared *prepared,
                      const tile *t,
                      uint32_t tile_x,
                      uint32_t tile_y,
                      uint32_t light)
{
    const int orthographic = (int)prepared->needs.orthographic;
    const tl_view_window window = view_window(&prepared->frame, TL_LEAST_DEPTH(orthographic),
                                              TL_GREATEST_DEPTH, orthographic);
    const tl_view_light of = prepared->lights[light];
    const tl_view_spot spot = prepared->spots[light];
    const tl_tile_rect rect = tile_rect_of_spot(window, &prepared->frame, of, spot);
    bool reached = false;
    for (int b = 0; b < t->box_count; b++)
        reached |= t->boxes[b].low.x <= t->boxes[b].high.x && reaches_box(of, t->boxes[b]) &&
                   cone_meets_box(spot, of, t->boxes[b]);
    return reached && rect.x0 <= (int)tile_x && (int)tile_x < rect.x1 &&
           rect.y0 <= (int)tile_y && (int)tile_y < rect.y1;
}

static vec3 lit_by(const tl_prepared *prepared, const tile *t, size_t i, const bool *listed)
{
    const substance m =
        substance_at(&prepared->frame, prepared->needs, t->pixels[i].in, prepared->rows);
    const finish f = finish_of(prepared->needs, t->pixels[i].of, m);
    received sum = nothing_received();
    for (uint32_t k = 0; k < prepared->frame.light_count; k++)
        if (!listed || k < prepared->frame.global_count || listed[k])
            sum = add_any_light(sum, &prepared->frame, prepared->needs, prepared->lights,
                                t->pixels[i].of, f, prepared->lights[k], prepared->spots[k],
                                k < prepared->frame.global_count);
    return radiance_of(&prepared->frame, prepared->needs, t->pixels[i].in, m, sum);
}

static void cull_tile(const tl_prepared *prepared, const tile *t, uint32_t x, uint32_t y)
{
    bool listed[MOST_LIGHTS] = {false};
    for (uint32_t k = prepared->frame.global_count; k < prepared->frame.light_count; k++)
        listed[k] = is_listed(prepared, t, x, y, k);
    for (size_t i = 0; i < t->pixel_count; i++) {
        const vec3 all = lit_by(prepared, t, i, NULL), some = lit_by(prepared, t, i, listed);
        fuzz_must(isfinite(all.x) && isfinite(all.y) && isfinite(all.z),
                  "pixel (%u, %u) is (%g, %g, %g)", t->pixels[i].column, t->pixels[i].row,
                  (double)all.x, (double)all.y, (double)all.z);
        fuzz_must(memcmp(&all, &some, sizeof all) == 0,
                  "pixel (%u, %u) is (%a, %a, %a), by the list of its tile (%a, %a, %a)",
                  t->pixels[i].column, t->pixels[i].row, (double)all.x, (double)all.y,
                  (double)all.z, (double)some.x, (double)some.y, (double)some.z);
    }
}

static void cull(const tl_gbuffer *g, const tl_light_set *lights, uint32_t tile_size)
{
    tl_prepared prepared = {.capacity = 0};
    tl_error err = {.status = TL_OK};
    static tile t;
    fuzz_must(tl_prepare(g, lights,
                         &(tl_prepare_options){.tile_size = tile_size, .box_count = 2}, NULL,
                         &prepared, &err) == TL_OK,
              "%s", err.message);
    for (uint32_t y = 0; y < prepared.frame.tiles_y; y++)
        for (uint32_t x = 0; x < prepared.frame.tiles_x; x++) {
            load(&prepared, g, x, y, &t);
            cull_tile(&prepared, &t, x, y);
        }
    tl_prepared_clear(&prepared);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes from = {data, size};
    const uint32_t tile_size = 8u << fuzz_byte(&from) % 3;
    tl_gbuffer *const frame = any_frame(&from);
    if (!frame)
        return 0;
    tl_light_set lights = any_lights(&from);
    cull(frame, &lights, tile_size);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(frame);
    return 0;
}
