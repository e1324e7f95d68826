#define _GNU_SOURCE
/* Which lights get shadow maps, how large, and within which memory? */
#include "testing.h"

#include "tilelight/capture.h"

#include <string.h>

static const char scene[] = "data/nine-lights.gltf";

typedef struct capture {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    char said[512];
} capture;

static void keep(void *context, const char *text)
{
    capture *const c = context;
    strncat(c->said, text, sizeof c->said - strlen(c->said) - 1);
}

static tl_status take(capture *c, const tl_capture_options *options, tl_error *err)
{
    const char *source = getenv("TILELIGHT_SOURCE");
    char *path = NULL;
    assert_true(asprintf(&path, "%s/%s", source ? source : ".", scene) > 0);
    *c = (capture){.gbuffer = NULL};
    const tl_notices notices = {keep, c};
    const tl_status status =
        tl_capture(path, options, &c->gbuffer, &c->lights, NULL, &notices, err);
    free(path);
    return status;
}

static void release(capture *c)
{
    tl_light_set_clear(&c->lights);
    tl_gbuffer_destroy(c->gbuffer);
}

static uint64_t bytes_of(const capture *c)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < c->gbuffer->shadows.count; i++)
        bytes += tl_shadow_map_size(&c->gbuffer->shadows.of[i]);
    return bytes;
}

static const tl_capture_options with_shadows = {
    .width = 320, .height = 180, .all_shadows = true};

static void askers_that_shine_get_maps(void **state)
{
    capture all, none, some;
    tl_error err;
    (void)state;
    tl_capture_options options = with_shadows;
    ASSERT_OK(take(&all, &options, &err), err);
    assert_int_equal(all.gbuffer->shadows.count, all.lights.count);
    options.all_shadows = false;
    ASSERT_OK(take(&none, &options, &err), err);
    assert_int_equal(none.gbuffer->shadows.count, 0);
    all.lights.lights[0].casts_shadow = 0;
    all.lights.lights[1].intensity = 0.0f;
    options.shadow_lights = &all.lights;
    ASSERT_OK(take(&some, &options, &err), err);
    assert_int_equal(some.gbuffer->shadows.count, all.lights.count - 2);
    for (size_t i = 0; i < all.lights.count; i++)
        assert_int_equal(
            tl_shadow_map_of(&some.gbuffer->shadows, &all.lights.lights[i]) != NULL, i > 1);
    release(&all);
    release(&none);
    release(&some);
}

/* Twice as many pixels each way ask for twice as many texels, up to an eighth of an octave. */
static void pixels_ask_for_texels(void **state)
{
    capture small, large;
    tl_error err;
    (void)state;
    tl_capture_options options = with_shadows;
    ASSERT_OK(take(&small, &options, &err), err);
    options.width *= 2;
    options.height *= 2;
    ASSERT_OK(take(&large, &options, &err), err);
    for (uint32_t i = 0; i < small.gbuffer->shadows.count; i++) {
        const tl_shadow_map *const a = &small.gbuffer->shadows.of[i];
        const tl_shadow_map *const b = &large.gbuffer->shadows.of[i];
        if (a->size == TL_LEAST_SHADOW_SIZE)
            continue;
        assert_in_range(b->size, (uint32_t)(1.8 * a->size), (uint32_t)(2.2 * a->size));
    }
    release(&small);
    release(&large);
}

/* A sun straight above the floor's middle: a texel is as wide as the pixel there, as pixels go. */
static void a_texel_is_no_wider_than_most_pixels(void **state)
{
    capture c;
    tl_error err;
    (void)state;
    tl_light sun = tl_light_default();
    tl_light_set lights = {0};
    sun.type = TL_LIGHT_DIRECTIONAL;
    sun.casts_shadow = 1;
    sun.direction[1] = -1.0f;
    sun.direction[2] = 0.0f;
    ASSERT_OK(tl_light_set_add(&lights, &sun, &err), err);
    tl_capture_options options = with_shadows;
    options.shadow_lights = &lights;
    ASSERT_OK(take(&c, &options, &err), err);
    const tl_camera *const camera = &c.gbuffer->camera;
    const double texel = tl_shadow_texel_width(&c.gbuffer->shadows.of[0], 1.0);
    const double pixel = ((double)camera->top - (double)camera->bottom) / camera->height;
    const float *const depth = tl_gbuffer_plane(c.gbuffer, TL_DEPTH);
    size_t seen = 0, finer = 0;
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++) {
            const double d = (double)depth[(size_t)y * c.gbuffer->pitch + x];
            seen += isfinite(d);
            finer += isfinite(d) && pixel * d < texel;
        }
    assert_true(seen > 0);
    assert_in_range(finer, seen / 40, seen / 8);
    tl_light_set_clear(&lights);
    release(&c);
}

static void memory_is_kept(void **state)
{
    capture c;
    tl_error err;
    (void)state;
    tl_capture_options options = with_shadows;
    ASSERT_OK(take(&c, &options, &err), err);
    const uint64_t wanted = bytes_of(&c);
    assert_string_equal(c.said, "");
    release(&c);
    for (uint64_t memory = wanted; memory >= wanted / 8; memory /= 2) {
        options.shadow_memory = memory;
        ASSERT_OK(take(&c, &options, &err), err);
        assert_in_range(bytes_of(&c), memory / 2, memory);
        assert_true((c.said[0] != '\0') == (memory < wanted));
        release(&c);
    }
    options.shadow_memory = 1000;
    assert_int_equal(take(&c, &options, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "let fewer lights cast shadows"));
    release(&c);
}

static void what_is_nearer_is_not_in_a_map(void **state)
{
    capture c;
    tl_error err;
    (void)state;
    tl_capture_options options = with_shadows;
    options.shadow_near = 0.75;
    ASSERT_OK(take(&c, &options, &err), err);
    for (uint32_t i = 0; i < c.gbuffer->shadows.count; i++)
        for (uint32_t k = 0; k < tl_shadow_view_count(&c.gbuffer->shadows.of[i]); k++)
            assert_true(c.gbuffer->shadows.of[i].views[k].near == 0.75f);
    release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(askers_that_shine_get_maps),
        cmocka_unit_test(pixels_ask_for_texels),
        cmocka_unit_test(a_texel_is_no_wider_than_most_pixels),
        cmocka_unit_test(memory_is_kept),
        cmocka_unit_test(what_is_nearer_is_not_in_a_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
