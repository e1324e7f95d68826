/* Do shadow maps come back from a G-buffer's file as they went in, and are damaged ones refused? */
#include "testing.h"

#include "tilelight/gbuffer_file.h"

enum { WIDTH = 70, HEIGHT = 40, SIZE = 64 };

static uint32_t seed = 7;

static uint32_t next_random(void)
{
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

/* Depths from 0 to 1, slopes of any number that a half can be. */
static void fill(tl_shadow_map *map)
{
    for (size_t i = 0; i < tl_shadow_map_size(map) / 8; i++) {
        const float depth = (float)next_random() * 0x1p-24f;
        uint32_t slopes = next_random() << 16 ^ next_random();
        slopes = (slopes & 0x7c00u) == 0x7c00u ? slopes ^ 0x4000u : slopes;
        slopes = (slopes & 0x7c000000u) == 0x7c000000u ? slopes ^ 0x40000000u : slopes;
        memcpy(&map->texels[2 * i], &depth, sizeof depth);
        map->texels[2 * i + 1] = slopes;
    }
}

static const double receivers[2][3] = {{-3, -2, -9}, {4, 3, -1}},
                    casters[2][3] = {{-6, -6, -9}, {6, 6, 12}};

static tl_gbuffer *frame_with_maps(void)
{
    static const double eye[3] = {1, 2, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, WIDTH, HEIGHT, 0.1, 100.0);
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++) {
        tl_shadow_map map = {.kind = kind,
                             .size = kind == TL_SHADOW_PARALLEL ? 2 * SIZE : SIZE,
                             .is_fitted = kind == TL_SHADOW_CUBE, /* as good as any */
                             .slack = 1e-5f * (float)(kind + 1),
                             .position = {0.25f, 2.5f, (float)kind},
                             .direction = {0.36f, -0.48f, 0.8f}};
        if (kind == TL_SHADOW_PARALLEL)
            tl_shadow_view_along(&map, receivers, casters);
        else
            tl_shadow_views_from(&map, map.direction, 0.7, 1e-4);
        ASSERT_OK(tl_shadow_maps_add(&g->shadows, &map, &err), err);
        fill(&g->shadows.of[kind]);
    }
    return g;
}

static void assert_same(const tl_shadow_map *a, const tl_shadow_map *b)
{
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->size, b->size);
    assert_int_equal(a->is_fitted, b->is_fitted);
    assert_true(same_bits(a->slack, b->slack));
    assert_memory_equal(a->position, b->position, sizeof a->position);
    assert_memory_equal(a->direction, b->direction, sizeof a->direction);
    for (uint32_t v = 0; v < tl_shadow_view_count(a); v++)
        assert_memory_equal(&a->views[v], &b->views[v], sizeof a->views[v]);
    assert_memory_equal(a->texels, b->texels, tl_shadow_map_size(a));
}

static void they_come_back(void **state)
{
    char path[512];
    tl_error err;
    (void)state;
    tl_gbuffer *g = frame_with_maps();
    scratch_path(path, sizeof path, "shadows.exr");
    for (int c = TL_COMPRESSION_NONE; c <= TL_COMPRESSION_PIZ; c++) {
        tl_gbuffer *back = NULL;
        ASSERT_OK(tl_gbuffer_write_compressed(path, g, NULL, (tl_compression)c, &err), err);
        ASSERT_OK(tl_gbuffer_read(path, &back, NULL, NULL, &err), err);
        assert_int_equal(back->shadows.count, g->shadows.count);
        for (uint32_t i = 0; i < g->shadows.count; i++)
            assert_same(&back->shadows.of[i], &g->shadows.of[i]);
        tl_gbuffer_destroy(back);
    }
    tl_gbuffer_destroy(g);
}

/* Each makes a map that no file may have; the sentence has these words. */
static void too_deep(tl_shadow_map *map)
{
    const float depth = 1.5f;
    memcpy(&map->texels[10], &depth, sizeof depth);
}

static void slope_of_infinity(tl_shadow_map *map)
{
    map->texels[21] = 0x7c000000u;
}

static void slack_below_0(tl_shadow_map *map)
{
    map->slack = -1.0f;
}

static void parallel_spot(tl_shadow_map *map)
{
    tl_shadow_map other = *map;
    other.kind = TL_SHADOW_PARALLEL;
    tl_shadow_view_along(&other, receivers, casters);
    map->views[0] = other.views[0];
}

static const struct {
    void (*spoil)(tl_shadow_map *map);
    const char *words[2];
} faults[] = {
    {too_deep, {"texel 5", "1.5"}},
    {slope_of_infinity, {"texel 10", "slope"}},
    {slack_below_0, {"slack", "-1"}},
    {parallel_spot, {"view 0", "projection"}},
};

static void damaged_ones_are_refused(void **state)
{
    char path[512];
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "damaged-shadows.exr");
    for (size_t i = 0; i < COUNT_OF(faults); i++) {
        tl_gbuffer *g = frame_with_maps(), *back = NULL;
        faults[i].spoil(&g->shadows.of[0]);
        ASSERT_OK(tl_gbuffer_write(path, g, NULL, &err), err);
        assert_int_equal(tl_gbuffer_read(path, &back, NULL, NULL, &err), TL_ERR_FORMAT);
        assert_null(back);
        for (size_t w = 0; w < COUNT_OF(faults[i].words); w++)
            if (!strstr(err.message, faults[i].words[w]))
                fail_msg("\"%s\" does not say \"%s\"", err.message, faults[i].words[w]);
        tl_gbuffer_destroy(g);
    }
}

/* A light finds the map that was made of it, and no other. */
static void lights_find_theirs(void **state)
{
    tl_gbuffer *g = frame_with_maps();
    tl_light light = tl_light_default();
    (void)state;
    light.type = TL_LIGHT_SPOT;
    light.outer_cone = 0.7f;
    memcpy(light.position, g->shadows.of[0].position, sizeof light.position);
    memcpy(light.direction, g->shadows.of[0].direction, sizeof light.direction);
    assert_ptr_equal(tl_shadow_map_of(&g->shadows, &light), &g->shadows.of[0]);
    light.outer_cone = 0.71f; /* wider than the map */
    assert_null(tl_shadow_map_of(&g->shadows, &light));
    light.outer_cone = 0.5f;
    light.position[0] = nextafterf(light.position[0], 1.0f);
    assert_null(tl_shadow_map_of(&g->shadows, &light));
    light.type = TL_LIGHT_DIRECTIONAL;
    assert_ptr_equal(tl_shadow_map_of(&g->shadows, &light), &g->shadows.of[1]);
    light.type = TL_LIGHT_POINT;
    memcpy(light.position, g->shadows.of[2].position, sizeof light.position);
    assert_ptr_equal(tl_shadow_map_of(&g->shadows, &light), &g->shadows.of[2]);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_come_back),
        cmocka_unit_test(damaged_ones_are_refused),
        cmocka_unit_test(lights_find_theirs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
