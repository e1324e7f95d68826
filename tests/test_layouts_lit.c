/* Is a frame of every kind of stored position lit to the same bits whatever is culled, on both paths and in every width,
 * wherever its positions are?
 *
 * The reference has neither tiles nor lists: the C twin shines every light on every pixel. Stored positions
 * are many pixels off their rays here, outside of their lights' rectangles unless those know of it. Of layouts
 * that store positions alike, which is all that culling reads, the first is lit, and the widths take turns:
 * every program takes a second or two to build (what else layouts store: tests/test_layout_device.c). With
 * the argument `all' every layout is lit in every width, which builds some 150 programs, in five minutes. */
#include "rim_lights.h"

#include "device.h"
#include "reference.h"

enum { WIDTH = 70, HEIGHT = 37, LIGHT_COUNT = 120 };

static int is_thorough;

/* One layout is lit under one projection, the next under the other. */
static tl_projection projection_of(int layout)
{
    return layout % 2 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
}

static void moved(tl_gbuffer *g)
{
    move_positions(g, 5);
}

/* As before tl_gbuffer_repair. */
static void moved_unseen(tl_gbuffer *g)
{
    move_positions(g, 5);
    if (TL_IS_POSITION(tl_layouts[g->layout].depth.code))
        g->slack_x = g->slack_y = INFINITY;
}

static void scrambled(tl_gbuffer *g)
{
    scramble(g, 41);
}

static const struct {
    const char *name;
    double eye, field_of_view; /* m from the world's origin, looked at; rad */
    void (*change)(tl_gbuffer *g);
    uint32_t width, height; /* px */
} frames[] = {
    {"as packed", 6.0, 1.2, NULL, WIDTH, HEIGHT},
    {"positions off their rays", 6.0, 1.2, moved, WIDTH, HEIGHT},
    {"nobody knows how far", 6.0, 1.2, moved_unseen, WIDTH, HEIGHT},
    {"a field of view of a ten-thousandth of a degree", 6.0, 2e-6, moved, WIDTH, HEIGHT},
    {"as far away as halves go", 6e4, 1.2, NULL, WIDTH, HEIGHT},
    {"farther", 1e5, 1.2, moved, WIDTH, HEIGHT},
    {"random bits", 6.0, 1.2, scrambled, WIDTH, HEIGHT},
    {"a column of pixels", 6.0, 1.2, moved, 1, WIDTH},
    {"a row of pixels", 6.0, 0.1, moved, WIDTH, 1},
};
enum { MOVED = 1 };

static tl_gbuffer *frame_of(size_t i, enum tl_layout_name layout, tl_projection projection)
{
    const double eye[3] = {frames[i].eye, 30.0, 20.0}, target[3] = {0.0, 0.0, 0.0};
    static const double up[3] = {0.1, 1.0, 0.2};
    tl_camera camera = tl_camera_look_at(eye, target, up, frames[i].field_of_view,
                                         frames[i].width, frames[i].height, 0.1, 100.0);
    camera.projection = projection;
    tl_gbuffer *g = packed_gbuffer(&camera, layout, 1977);
    if (frames[i].change)
        frames[i].change(g);
    return g;
}

/* Positions of random bits may be so far away that squares of distances leave the floats. */
static const float farthest = 1e15f;

/* At where float kernels see pixels at the rims of tiles, and around; the range of each ends at the pixel to
 * the last bit, one float before or beyond it, and it is as bright there as anywhere. */
static void light_the_pixels(const tl_gbuffer *g, tl_light_set *lights)
{
    uint32_t seed = 20110901;
    tl_light far_off = tl_light_default();
    tl_error err;
    far_off.range =
        1.0f; /* of another falloff than those at pixels: all frames call for the same kernels */
    ASSERT_OK(tl_light_set_add(lights, &far_off, &err), err);
    for (uint32_t i = 0; i < LIGHT_COUNT; i++) {
        const rim at = rim_of_tile(g, &seed, i);
        const vec3 p = position_at(g, at.x, at.y);
        tl_light light = tl_light_default();
        float offset[3];
        for (int axis = 0; axis < 3; axis++)
            offset[axis] = uniform(&seed, -0.3f, 0.3f);
        light.range = 1.0f;
        if (fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z))) < farthest)
            light = rim_light(g, at, offset);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

/* What cuts a frame into work-items, and in which arithmetic. */
static const struct {
    const char *name;
    tl_path path;
    uint32_t width;
    tl_precision precision;
} ways[] = {{"width 1", TL_PATH_CPU, 1, TL_PRECISION_FLOAT},
            {"width 4", TL_PATH_CPU, 4, TL_PRECISION_FLOAT},
            {"width 8", TL_PATH_CPU, 8, TL_PRECISION_FLOAT},
            {"width 16", TL_PATH_CPU, 16, TL_PRECISION_FLOAT},
            {"path gpu", TL_PATH_GPU, 0, TL_PRECISION_FLOAT},
            {"double", TL_PATH_CPU, 0, TL_PRECISION_DOUBLE},
            {"double, path gpu", TL_PATH_GPU, 0, TL_PRECISION_DOUBLE}};

static int store_positions_alike(int a, int b)
{
    const tl_attribute *one = &tl_layouts[a].depth, *other = &tl_layouts[b].depth;
    return one->code == other->code && one->channels[0].bits == other->channels[0].bits &&
           one->channels[0].number == other->channels[0].number;
}

/* Layouts before this one that store positions otherwise than all before them; -1: this one is like another. */
static int place_among_positions(int layout)
{
    int place = 0;
    for (int other = 0; other < layout; other++) {
        if (store_positions_alike(other, layout))
            return -1;
        place += place_among_positions(other) >= 0;
    }
    return place;
}

static int is_turn_of(tl_device *device, size_t way, int layout)
{
    if (ways[way].precision == TL_PRECISION_DOUBLE && !tl_device_describe(device).has_double)
        return 0;
    const int place = place_among_positions(layout);
    return is_thorough || (place >= 0 && way == (size_t)place % COUNT_OF(ways));
}

/* A frame, its lights, and what it looks like in float and in double. */
typedef struct scene {
    tl_gbuffer *g;
    tl_light_set lights;
    tl_image *want[TL_PRECISION_COUNT], *got;
} scene;

static scene scene_of(size_t frame, int layout)
{
    tl_prepared prepared = {0};
    scene s = {.g = frame_of(frame, (enum tl_layout_name)layout, projection_of(layout))};
    tl_error err;
    light_the_pixels(s.g, &s.lights);
    s.got = image_like(s.g);
    s.want[TL_PRECISION_FLOAT] = image_like(s.g);
    s.want[TL_PRECISION_DOUBLE] = image_like(s.g);
    ASSERT_OK(tl_prepare(s.g, &s.lights, &(tl_prepare_options){.tile_size = 16, .box_count = 1},
                         NULL, &prepared, &err),
              err);
    tl_reference_light(&prepared, s.g, TL_TWIN_FLOAT, s.want[TL_PRECISION_FLOAT]);
    tl_reference_light(&prepared, s.g, TL_TWIN_DOUBLE, s.want[TL_PRECISION_DOUBLE]);
    tl_prepared_clear(&prepared);
    return s;
}

static void scene_clear(scene *s)
{
    tl_image_destroy(s->want[TL_PRECISION_FLOAT]);
    tl_image_destroy(s->want[TL_PRECISION_DOUBLE]);
    tl_image_destroy(s->got);
    tl_light_set_clear(&s->lights);
    tl_gbuffer_destroy(s->g);
}

/* Twice, so that the second run finds lists of the first. */
static void compare(tl_device *device,
                    const tl_lighting_options *options,
                    const scene *s,
                    const char *what)
{
    tl_lighting *lighting = NULL;
    tl_error err;
    ASSERT_OK(tl_lighting_create(device, options, &lighting, &err), err);
    for (int run = 0; run < 2; run++) {
        ASSERT_OK(tl_lighting_run(lighting, s->g, &s->lights, s->got, NULL, NULL, NULL, &err),
                  err);
        assert_same_image(s->got, s->want[options->precision], what);
    }
    tl_lighting_destroy(lighting);
}

static void every_culling_agrees(tl_device *device,
                                 const scene *s,
                                 size_t way,
                                 const char *frame)
{
    static const uint32_t tiles[] = {8, 16, 32, 64};
    for (size_t t = 0; t < COUNT_OF(tiles); t++)
        for (int cull = 0; cull < TL_CULL_COUNT; cull++) {
            const tl_lighting_options options = {.cull = (tl_cull)cull,
                                                 .path = ways[way].path,
                                                 .precision = ways[way].precision,
                                                 .tile_size = tiles[t],
                                                 .vector_width = ways[way].width};
            char what[160];
            snprintf(what, sizeof what, "%s, %s, %s, tile %u, cull %d",
                     tl_layout_word(s->g->layout), frame, ways[way].name, tiles[t], cull);
            compare(device, &options, s, what);
        }
}

static void culling_never_changes_the_image(void **state)
{
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (size_t frame = 0; frame < COUNT_OF(frames); frame++) {
            scene s = scene_of(frame, layout);
            for (size_t way = 0; way < COUNT_OF(ways); way++)
                if (is_turn_of(*state, way, layout))
                    every_culling_agrees(*state, &s, way, frames[frame].name);
            scene_clear(&s);
        }
}

/* Of a device with memory of its own a band's rows are copied there, plane by plane of their sizes; of
 * one that shares the host's they are found in the whole. */
static void bands_of(tl_device *device, const scene *s, size_t way, int shares_memory)
{
    tl_lighting_options options = {.path = ways[way].path,
                                   .precision = ways[way].precision,
                                   .tile_size = 8,
                                   .vector_width = ways[way].width};
    const int shared = device->shares_memory;
    char what[160];
    snprintf(what, sizeof what, "%s, %s, memory %s", tl_layout_word(s->g->layout),
             ways[way].name, shares_memory ? "shared" : "of its own");
    device->shares_memory = shares_memory;
    const tl_lighting_counts whole = light_frame(device, &options, s->g, &s->lights, s->got);
    assert_same_image(s->got, s->want[options.precision], what);
    options.memory_limit = whole.device_bytes * 15 / 16; /* most of it may be lights */
    const tl_lighting_counts parts = light_frame(device, &options, s->g, &s->lights, s->got);
    device->shares_memory = shared;
    assert_same_image(s->got, s->want[options.precision], what);
    assert_in_range(parts.band_count, 2, 5);
}

static void bands_do_not_show(void **state)
{
    tl_device *device = *state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (size_t way = 0; way < COUNT_OF(ways); way++) {
            if (!is_turn_of(device, way, layout))
                continue;
            scene s = scene_of(MOVED, layout);
            bands_of(device, &s, way, 0);
            if (device->shares_memory)
                bands_of(device, &s, way, 1);
            scene_clear(&s);
        }
}

/* Without a lobe no power is taken, and the reference is the double twin. */
static void the_reference_reads_the_same(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (size_t frame = 0; frame < COUNT_OF(frames); frame++) {
            scene s = scene_of(frame, layout);
            tl_prepared prepared = {0};
            tl_error err;
            for (size_t i = 0; i < s.lights.count; i++)
                s.lights.lights[i].specular = 0.0f;
            ASSERT_OK(tl_prepare(s.g, &s.lights,
                                 &(tl_prepare_options){.tile_size = 16, .box_count = 1}, NULL,
                                 &prepared, &err),
                      err);
            tl_reference_light(&prepared, s.g, TL_TWIN_DOUBLE, s.want[0]);
            tl_reference_light(&prepared, s.g, TL_TWIN_REFERENCE, s.got);
            assert_same_image(s.got, s.want[0], tl_layout_word(s.g->layout));
            tl_prepared_clear(&prepared);
            scene_clear(&s);
        }
}

int main(int argc, char **argv)
{
    is_thorough = argc > 1 && strcmp(argv[1], "all") == 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(culling_never_changes_the_image),
        cmocka_unit_test(bands_do_not_show),
        cmocka_unit_test(the_reference_reads_the_same),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
