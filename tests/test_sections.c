/* Do sections stand behind lights and cones in whole rows, where the frame says, and keep what is in them as
 * the buffer grows? */
#include "frames.h"

#include "sections.h"

enum { LIGHTS = 5 };

static tl_prepared prepared_lights(void)
{
    const tl_camera camera = camera_of(8, 8, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 1);
    tl_light_set lights = {0};
    tl_prepared p = {0};
    uint32_t seed = 3;
    tl_error err;
    for (int i = 0; i < LIGHTS; i++) {
        const tl_light light = random_light(&camera, &seed, 1.0f, 2.0f);
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    }
    ASSERT_OK(tl_prepare(g, &lights, &(tl_prepare_options){.tile_size = 16}, NULL, &p, &err),
              err);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
    return p;
}

/* Of several sizes, whole rows and not; each filled with a byte of its own, then all looked at. */
static void sections_keep_what_is_in_them(void **state)
{
    static const size_t sizes[] = {1, 16, 17, 4096, 100000, 48};
    tl_u32 at[COUNT_OF(sizes)];
    tl_prepared p = prepared_lights();
    tl_error err;
    (void)state;
    assert_int_equal(tl_prepared_lights_size(&p), LIGHTS * sizeof(tl_view_light));
    const tl_view_light first = p.lights[0];
    const tl_view_spot last = p.spots[LIGHTS - 1];
    size_t row = LIGHTS * (sizeof(tl_view_light) + sizeof(tl_view_spot)) / 16;
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        unsigned char *memory = NULL;
        ASSERT_OK(tl_section_add(&p, sizes[i], &at[i], (void **)&memory, &err), err);
        assert_int_equal(at[i], row);
        assert_ptr_equal(memory, tl_section_at(&p, at[i]));
        row += (sizes[i] + 15) / 16;
        assert_int_equal(tl_prepared_lights_size(&p), 16 * row);
        for (size_t b = 0; b < (sizes[i] + 15) / 16 * 16; b++)
            assert_int_equal(memory[b], 0);
        memset(memory, (int)i + 1, sizes[i]);
    }
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        const unsigned char *memory = tl_section_at(&p, at[i]);
        for (size_t b = 0; b < sizes[i]; b++)
            assert_int_equal(memory[b], i + 1);
    }
    assert_ptr_equal(p.spots, p.lights + LIGHTS);
    assert_memory_equal(&p.lights[0], &first, sizeof first);
    assert_memory_equal(&p.spots[LIGHTS - 1], &last, sizeof last);
    tl_prepared_clear(&p);
}

static void rows_that_no_field_could_name_are_refused(void **state)
{
    tl_prepared p = prepared_lights();
    tl_u32 at = 7;
    tl_error err;
    (void)state;
    assert_int_equal(tl_section_add(&p, (size_t)16 << 32, &at, NULL, &err), TL_ERR_ARGUMENT);
    assert_int_equal(at, 7);
    assert_int_equal(p.sections_size, 0);
    tl_prepared_clear(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sections_keep_what_is_in_them),
        cmocka_unit_test(rows_that_no_field_could_name_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
