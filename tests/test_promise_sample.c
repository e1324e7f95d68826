/* Is a sample what it says it is: the reference's own bits, every pixel that hangs on rounding, whole tiles
 * where the risk is, some of every other? */
#include "promise_frames.h"

#include "check_frames.h"
#include "packed_frames.h"
#include "reference.h"
#include "rich_lights.h"
#include "sample.h"

/* Every pixel, in groups of a row of a tile, against the whole picture. */
static void expect_bits(const char *name, const tl_gbuffer *g, const tl_light_set *lights)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_image *want = image_like(g);
    tl_prepared prepared = {0};
    tl_error err;
    const uint32_t width = g->camera.width, height = g->camera.height;
    const size_t pixels = (size_t)width * height;
    tl_pixel_at *at = malloc(pixels * sizeof *at);
    size_t *begins = malloc((pixels + 1) * sizeof *begins), groups = 0;
    float(*got)[3] = malloc(pixels * sizeof *got);
    options.precision = TL_PRECISION_REFERENCE;
    light_frame(NULL, &options, g, lights, want);
    ASSERT_OK(
        tl_prepare(g, lights, &(tl_prepare_options){.tile_size = 16}, NULL, &prepared, &err),
        err);
    for (size_t i = 0; i < pixels; i++) {
        at[i] = (tl_pixel_at){(uint32_t)(i % width), (uint32_t)(i / width)};
        if (at[i].x % 16 == 0)
            begins[groups++] = i;
    }
    begins[groups] = pixels;
    tl_reference_some(&prepared, g, &(tl_pixel_groups){at, begins, groups}, got);
    for (size_t i = 0; i < pixels; i++)
        for (unsigned c = 0; c < 3; c++)
            if (!same_bits(got[i][c],
                           tl_image_plane(want, c)[(size_t)at[i].y * g->pitch + at[i].x]))
                fail_msg("%s: pixel (%u, %u) has other bits", name, at[i].x, at[i].y);
    tl_prepared_clear(&prepared);
    tl_image_destroy(want);
    free(at);
    free(begins);
    free(got);
}

static void bits_of_the_reference(void **state)
{
    (void)state;
    for (int i = 0; i < tl_check_frame_count; i++) {
        tl_checked_frame frame = {0};
        tl_error err;
        ASSERT_OK(tl_check_frame_make(i, &frame, &err), err);
        expect_bits(tl_check_frame_name(i), frame.gbuffer, &frame.lights);
        tl_checked_frame_clear(&frame);
    }
}

static void bits_in_every_layout(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++) {
        const tl_camera camera =
            camera_of(67, 41, layout % 2 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE);
        uint32_t seed = 11;
        tl_gbuffer *g = packed_gbuffer(&camera, (enum tl_layout_name)layout, 5);
        tl_light_set lights = {0};
        tl_error err;
        for (int i = 0; i < 40; i++) {
            tl_light light = random_light(&camera, &seed, 0.3f, 2.0f);
            if (i % 4 == 0)
                aim_at_random(&light, &seed);
            ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
        }
        make_rich(&lights);
        expect_bits(tl_layout_word((enum tl_layout_name)layout), g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* Lights in the planes of surfaces, so that n.l is 0 but for rounding: one for every pixel (x, y) with x + y
 * even. They are wide enough to reach others, too. */
static void add_lights_in_planes(const tl_gbuffer *g, tl_light_set *lights)
{
    tl_prepared prepared = {0};
    tl_error err;
    uint32_t seed = 3;
    ASSERT_OK(
        tl_prepare(g, lights, &(tl_prepare_options){.tile_size = 16}, NULL, &prepared, &err),
        err);
    const tl_rays rays = prepared.frame.rays;
    for (uint32_t i = 0; i < g->camera.width * g->camera.height; i++) {
        const uint32_t x = i % g->camera.width, y = i / g->camera.width;
        const size_t at = (size_t)y * g->pitch + x;
        const double depth = (double)tl_gbuffer_plane(g, TL_DEPTH)[at];
        if ((x + y) % 2 || !(depth < 1e30))
            continue;
        const double view[3] = {depth * ((double)rays.x0 + x * (double)rays.dx),
                                depth * ((double)rays.y0 + y * (double)rays.dy), -depth};
        double world[3], away[3], n[3], along = 0.0;
        tl_light light = tl_light_default();
        tl_camera_world_point(&g->camera, view, world);
        random_direction(&seed, away);
        for (int k = 0; k < 3; k++) {
            n[k] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + k))[at];
            along += n[k] * away[k];
        }
        const double scale = 0.2 / sqrt(1.0 - along * along);
        for (int k = 0; k < 3; k++)
            light.position[k] = (float)(world[k] + scale * (away[k] - along * n[k]));
        light.range = 0.4f;
        light.specular = 1.0f;
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
    tl_prepared_clear(&prepared);
}

static tl_gbuffer *glossy_frame(void)
{
    const tl_camera camera = camera_of(61, 45, TL_PERSPECTIVE);
    tl_error err;
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, 9);
    for (uint32_t i = 0; i < g->pitch * g->rows; i++)
        if (tl_gbuffer_plane(g, TL_DEPTH)[i] < 1e30f)
            set_pixel(g, TL_SHININESS, i, 1.0f);
    ASSERT_OK(tl_gbuffer_repair(g, "glossy", false, NULL, &err), err);
    return g;
}

/* Float decides otherwise than double in some of these pixels, and is then off by what a light adds. Each of
 * them is known to be at a rim, and few others are. */
static void every_pixel_that_hangs_on_rounding(void **state)
{
    (void)state;
    promise_frame f = {.gbuffer = glossy_frame()};
    tl_prepared prepared = {0};
    tl_error err;
    add_lights_in_planes(f.gbuffer, &f.lights);
    light_both(&f);
    const uint32_t width = f.gbuffer->camera.width, height = f.gbuffer->camera.height;
    tl_rim_tile *tiles = malloc(((width + 15) / 16) * ((height + 15) / 16) * sizeof *tiles);
    uint8_t *at_rim = malloc((size_t)width * height);
    ASSERT_OK(tl_prepare(f.gbuffer, &f.lights, &(tl_prepare_options){.tile_size = 16}, NULL,
                         &prepared, &err),
              err);
    tl_rims_find(&prepared, f.gbuffer, tiles, at_rim);
    int far_off = 0, rims = 0, unlit = 0;
    for (uint32_t i = 0; i < width * height; i++) {
        const uint32_t x = i % width, y = i / width;
        const size_t at = (size_t)y * f.gbuffer->pitch + x;
        const double got = (double)tl_image_plane(f.picture, 0)[at];
        const double want = (double)tl_image_plane(f.reference, 0)[at];
        const int is_off = fabs(got - want) > 1e-4 * (1.0 + want);
        const int has_own =
            (x + y) % 2 == 0 && tl_gbuffer_plane(f.gbuffer, TL_DEPTH)[at] < 1e30f;
        far_off += is_off;
        rims += at_rim[i];
        unlit += !has_own && at_rim[i];
        if ((is_off || has_own) && !at_rim[i])
            fail_msg("pixel (%u, %u) is at a rim and is not found: off by %g", x, y,
                     got - want);
    }
    print_message(
        "%d of %u pixels off by what a light adds; %d at rims, %d of them by chance\n", far_off,
        width * height, rims, unlit);
    assert_true(far_off > 20);
    assert_true(unlit < (int)(width * height) / 20);
    tl_prepared_clear(&prepared);
    free(tiles);
    free(at_rim);
    promise_frame_clear(&f);
}

/* Where the lobe is multiplied by n.l, nothing hangs on it: what is found has a light near. */
static void no_rims_under_a_cosine(void **state)
{
    (void)state;
    promise_frame f = {.gbuffer = glossy_frame()};
    tl_prepared prepared = {0};
    tl_error err;
    add_lights_in_planes(f.gbuffer, &f.lights);
    f.lights.model = TL_MODEL_BLINN_PHONG_NORMALIZED;
    light_both(&f);
    const uint32_t width = f.gbuffer->camera.width, height = f.gbuffer->camera.height;
    tl_rim_tile *tiles = malloc(((width + 15) / 16) * ((height + 15) / 16) * sizeof *tiles);
    uint8_t *at_rim = malloc((size_t)width * height);
    ASSERT_OK(tl_prepare(f.gbuffer, &f.lights, &(tl_prepare_options){.tile_size = 16}, NULL,
                         &prepared, &err),
              err);
    tl_rims_find(&prepared, f.gbuffer, tiles, at_rim);
    int found = 0;
    for (uint32_t i = 0; i < width * height; i++) {
        const size_t at = (size_t)(i / width) * f.gbuffer->pitch + i % width;
        const double got = (double)tl_image_plane(f.picture, 0)[at];
        const double want = (double)tl_image_plane(f.reference, 0)[at];
        found += at_rim[i];
        assert_true(fabs(got - want) <= 1e-4 * (1.0 + want));
    }
    print_message("%d of %u pixels have a light near\n", found, width * height);
    assert_true(found < (int)(width * height) / 50);
    tl_prepared_clear(&prepared);
    free(tiles);
    free(at_rim);
    promise_frame_clear(&f);
}

/* Each pixel once, as many of each stratum as it says, at least one of every tile; all pixels at rims. */
static void strata_are_what_they_say(void **state)
{
    (void)state;
    promise_frame f = bench_frame("foliage", 330, 210, 64);
    tl_sample *sample = NULL;
    tl_sample_options options = tl_sample_options_default();
    tl_error err;
    options.pairs = 3e4;
    ASSERT_OK(tl_sample_draw(f.gbuffer, &f.lights, f.picture, &options, &sample, &err), err);
    uint8_t *times = calloc(330 * 210, 1);
    uint32_t *drawn = calloc(sample->stratum_count, sizeof *drawn);
    size_t size = 0, whole = 0;
    for (size_t i = 0; i < sample->count; i++) {
        const tl_pixel_at at = sample->at[i];
        const uint32_t s = sample->stratum[i];
        assert_true(s == sample->stratum_count - 1 ||
                    s == at.y / 16 * sample->tiles_x + at.x / 16);
        assert_int_equal(times[at.y * 330 + at.x]++, 0);
        drawn[s]++;
        for (unsigned c = 0; c < 3; c++)
            assert_true(same_bits(
                sample->reference[i][c],
                tl_image_plane(f.reference, c)[(size_t)at.y * f.reference->pitch + at.x]));
    }
    for (uint32_t s = 0; s < sample->stratum_count; s++) {
        assert_int_equal(drawn[s], sample->strata[s].drawn);
        assert_true(drawn[s] > 0 || sample->strata[s].size == 0);
        size += sample->strata[s].size;
        whole += drawn[s] > 0 && drawn[s] == sample->strata[s].size;
    }
    const tl_stratum rims = sample->strata[sample->stratum_count - 1];
    assert_int_equal(size, 330 * 210);
    assert_int_equal(rims.drawn, rims.size);
    assert_true(whole >= 2); /* of three kinds of risk, and they may be one tile; and rims */
    print_message("%zu of %d pixels, %zu strata whole, %u pixels at rims\n", sample->count,
                  330 * 210, whole, rims.size);
    assert_true(sample->count < 330 * 210 / 4);
    free(times);
    free(drawn);
    tl_sample_destroy(sample);
    promise_frame_clear(&f);
}

/* The same seed draws the same, another one something else. */
static void seeds(void **state)
{
    static const uint64_t of[] = {1, 1, 2};
    tl_sample *samples[3] = {NULL};
    (void)state;
    promise_frame f = bench_frame("foliage", 330, 210, 64);
    for (int i = 0; i < 3; i++) {
        tl_sample_options options = tl_sample_options_default();
        tl_error err;
        options.pairs = 3e4;
        options.seed = of[i];
        ASSERT_OK(tl_sample_draw(f.gbuffer, &f.lights, f.picture, &options, &samples[i], &err),
                  err);
    }
    const size_t size = samples[0]->count * sizeof samples[0]->at[0];
    assert_int_equal(samples[0]->count, samples[1]->count);
    assert_memory_equal(samples[0]->at, samples[1]->at, size);
    assert_true(memcmp(samples[0]->at, samples[2]->at, size) != 0);
    for (int i = 0; i < 3; i++)
        tl_sample_destroy(samples[i]);
    promise_frame_clear(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_of_the_reference),
        cmocka_unit_test(bits_in_every_layout),
        cmocka_unit_test(every_pixel_that_hangs_on_rounding),
        cmocka_unit_test(no_rims_under_a_cosine),
        cmocka_unit_test(strata_are_what_they_say),
        cmocka_unit_test(seeds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
