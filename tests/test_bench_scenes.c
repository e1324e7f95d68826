/* Are scenes the same on every run, as crowded as asked for, lit in full, and are their pairs counted
 * right? */
#define _GNU_SOURCE
#include "frames.h"

#include "bench_frame.h"
#include "prepared.h"

/* FNV-1a, 64 bits: Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm", RFC 9923. */
static uint64_t checksum(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

static uint64_t checksum_of(const tl_gbuffer *g, const tl_light_set *lights)
{
    uint64_t hash = 0xcbf29ce484222325u;
    const size_t planes = (size_t)__builtin_popcount(g->present);
    hash = checksum(hash, &g->camera, sizeof g->camera);
    hash = checksum(hash, g->planes, planes * g->rows * g->pitch * sizeof(float));
    for (size_t i = 0; i < lights->count; i++) {
        hash = checksum(hash, lights->lights[i].position, sizeof lights->lights[i].position);
        hash = checksum(hash, lights->lights[i].color, sizeof lights->lights[i].color);
        hash = checksum(hash, &lights->lights[i].range, sizeof lights->lights[i].range);
    }
    return hash;
}

static void make(const tl_bench_scene *scene,
                 const tl_bench_scene_options *options,
                 tl_gbuffer **g,
                 tl_light_set *lights)
{
    tl_error err;
    ASSERT_OK(tl_bench_scene_make(scene, options, g, lights, &err), err);
}

/* On one thread and on three. */
static void threads_do_not_show(void **state)
{
    tl_bench_scene_options options = tl_bench_scene_options_default();
    options.width = 150;
    options.height = 83;
    options.light_count = 60;
    (void)state;
    for (int i = 0; i < tl_bench_scene_count; i++) {
        uint64_t sums[2];
        for (int run = 0; run < 2; run++) {
            tl_gbuffer *g = NULL;
            tl_light_set lights = {0};
            setenv("TILELIGHT_THREADS", run ? "3" : "1", 1);
            make(&tl_bench_scenes[i], &options, &g, &lights);
            assert_int_equal(lights.count, options.light_count);
            sums[run] = checksum_of(g, &lights);
            tl_light_set_clear(&lights);
            tl_gbuffer_destroy(g);
        }
        unsetenv("TILELIGHT_THREADS");
        if (sums[0] != sums[1])
            fail_msg("%s differs from run to run", tl_bench_scenes[i].name);
    }
}

/* Within 5 %, as lighting itself lists them with one box per tile, in every scene. */
static void tiles_list_what_was_asked_for(void **state)
{
    static const double wanted[] = {3.0, 27.0};
    tl_bench_scene_options options = tl_bench_scene_options_default();
    tl_lighting_options lighting = tl_lighting_options_default();
    lighting.cull = TL_CULL_DEPTH;
    options.width = 640;
    options.height = 360;
    for (int i = 0; i < tl_bench_scene_count; i++)
        for (size_t w = 0; w < COUNT_OF(wanted); w++) {
            tl_gbuffer *g = NULL;
            tl_light_set lights = {0};
            options.lights_per_tile = wanted[w];
            make(&tl_bench_scenes[i], &options, &g, &lights);
            tl_image *image = image_like(g);
            const tl_lighting_counts c = light_frame(*state, &lighting, g, &lights, image);
            const double got = (double)c.list_length / c.tile_count;
            if (fabs(got - wanted[w]) > 0.05 * wanted[w])
                fail_msg("%s: %g lights per tile, want %g", tl_bench_scenes[i].name, got,
                         wanted[w]);
            tl_image_destroy(image);
            tl_light_set_clear(&lights);
            tl_gbuffer_destroy(g);
        }
}

/* Every pixel with every light, from the formulas of docs/conventions.md. */
static tl_pair_counts count_all(const tl_gbuffer *g, const tl_light_set *lights)
{
    const tl_camera *c = &g->camera;
    tl_pair_counts counts = {0};
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            const double depth = (double)tl_gbuffer_plane(g, TL_DEPTH)[at];
            const double right = ((double)c->right - (double)c->left) / c->width;
            const double down = ((double)c->bottom - (double)c->top) / c->height;
            const double view[3] = {((double)c->left + (x + 0.5) * right) * depth,
                                    ((double)c->top + (y + 0.5) * down) * depth, -depth};
            double world[3];
            if (isinf(depth))
                continue;
            tl_camera_world_point(c, view, world);
            for (size_t i = 0; i < lights->count; i++) {
                double distance2 = 0.0, facing = 0.0;
                for (int k = 0; k < 3; k++) {
                    const double off = (double)lights->lights[i].position[k] - world[k];
                    distance2 += off * off;
                    facing +=
                        off * (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + k))[at];
                }
                const double range = (double)lights->lights[i].range;
                counts.in_range += sqrt(distance2) < range;
                counts.lit += sqrt(distance2) < range && facing > 0.0;
            }
        }
    return counts;
}

static void pairs_are_counted(void **state)
{
    tl_bench_scene_options options = tl_bench_scene_options_default();
    options.width = 83;
    options.height = 50;
    options.light_count = 40;
    options.lights_per_tile = 9.0;
    (void)state;
    for (int i = 0; i < tl_bench_scene_count; i++) {
        tl_gbuffer *g = NULL;
        tl_light_set lights = {0};
        tl_pair_counts got;
        tl_error err;
        make(&tl_bench_scenes[i], &options, &g, &lights);
        ASSERT_OK(tl_pair_counts_take(g, &lights, &got, &err), err);
        const tl_pair_counts want = count_all(g, &lights);
        assert_true(want.lit > 0 && want.lit < want.in_range);
        assert_int_equal(got.in_range, want.in_range);
        assert_int_equal(got.lit, want.lit);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* A plane that a frame does not call for would be stored, and not timed. */
static void every_plane_is_called_for(void **state)
{
    (void)state;
    for (int i = 0; i < tl_bench_material_count; i++) {
        tl_bench_scene_options options = tl_bench_scene_options_default();
        tl_prepared prepared = {0};
        tl_gbuffer *g = NULL;
        tl_light_set lights = {0};
        tl_error err;
        options.width = 40;
        options.height = 30;
        options.light_count = 4;
        options.material = &tl_bench_materials[i];
        make(&tl_bench_scenes[0], &options, &g, &lights);
        ASSERT_OK(tl_gbuffer_repair(g, options.material->name, false, NULL, &err), err);
        ASSERT_OK(tl_prepare(g, &lights, &(tl_prepare_options){.tile_size = 16}, NULL,
                             &prepared, &err),
                  err);
        if (prepared.needs.idle)
            fail_msg("%s: planes %x are not read", options.material->name, prepared.needs.idle);
        tl_prepared_clear(&prepared);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(tiles_list_what_was_asked_for),
        cmocka_unit_test(pairs_are_counted),
        cmocka_unit_test(every_plane_is_called_for),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
