/* Does every shading model in float stay within what is derived for it, at the limits of float too, and is
 * what is a little off refused? */
#include "hard_pixels.h"

#include "prepared.h"
#include "reference.h"

#include "tilelight/check.h"

static const uint32_t planes[] = {TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_EMISSIVE,
                                  TL_GROUP_BASE | TL_GROUP_METAL_ROUGH};

static const char *const words[TL_MODEL_COUNT] = {
#define WORD(name, word, traits, parameters, source) [name] = word,
    TL_MODELS(WORD)
#undef WORD
};

/* Every eighth of the many random lights is enough for one model of many. */
static void thin(tl_light_set *lights)
{
    size_t kept = 0;
    for (size_t i = 0; i < lights->count; i++)
        if (i % 8 == 0 || i + 3 >= lights->count)
            lights->lights[kept++] = lights->lights[i];
    lights->count = kept;
}

static tl_check_report report_of(const tl_gbuffer *g,
                                 const tl_gbuffer *lit,
                                 const tl_light_set *lights,
                                 tl_cosine cosine)
{
    tl_prepared prepared = {0};
    tl_check *check = NULL;
    tl_check_report report;
    tl_image *image = image_like(g);
    tl_error err;
    ASSERT_OK(
        tl_prepare(lit, lights, &(tl_prepare_options){.tile_size = 16}, NULL, &prepared, &err),
        err);
    tl_reference_light(&prepared, lit, TL_TWIN_FLOAT, image);
    ASSERT_OK(tl_check_create(g, lights, 0.0f, cosine, &check, &err), err);
    ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
    tl_check_destroy(check);
    tl_image_destroy(image);
    tl_prepared_clear(&prepared);
    return report;
}

static void floats_are_within(void **state)
{
    (void)state;
    for (int model = 0; model < TL_MODEL_COUNT; model++)
        for (size_t p = 0; p < COUNT_OF(planes); p++) {
            const tl_projection projection =
                (model + (int)p) % 2 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
            tl_light_set lights = {0};
            tl_error err;
            tl_gbuffer *g = hard_frame(projection, planes[p], &lights);
            ASSERT_OK(tl_gbuffer_repair(g, "hard", false, NULL, &err), err);
            thin(&lights);
            lights.model = (enum tl_shading_model)model;
            const tl_check_report r = report_of(g, g, &lights, TL_COSINE_STABLE);
            const tl_check_value *worst = &r.worst;
            print_message(
                "%-24s %zu: rounding takes %.3f of the tolerance, with decisions %.3f\n",
                words[model], p, r.rounding_ratio, worst->ratio);
            if (r.failed_count > 0)
                fail_msg("%s: %u pixels outside; (%u, %u) %u: got %.9g, want %.9g, allowed "
                         "%.9g to %.9g",
                         words[model], (unsigned)r.failed_count, worst->x, worst->y,
                         worst->channel, (double)worst->got, worst->expected, worst->low,
                         worst->high);
            tl_light_set_clear(&lights);
            tl_gbuffer_destroy(g);
        }
}

/* One step of 2^-10 of what a model takes: rows of it, of one frame each. */
static const struct {
    enum tl_plane plane;
    uint32_t traits; /* of models that must notice: any of these; 0: all */
} steps[] = {
    {TL_ALBEDO_G, 0},
    {TL_NORMAL_X, 0},
    {TL_SPECULAR_G, TL_LOBE_SPECULAR},
    {TL_SHININESS, TL_LOBE_SPECULAR | TL_LOBE_WIDTH},
    {TL_ROUGHNESS, TL_LOBE_SPECULAR | TL_LOBE_WIDTH},
    {TL_METALLIC, 0},
};

static tl_gbuffer *small_frame(uint32_t present, tl_light_set *lights)
{
    const tl_camera camera = camera_of(12, 8, TL_PERSPECTIVE);
    uint32_t seed = 5;
    tl_error err;
    tl_gbuffer *g = random_gbuffer(&camera, present, 1977);
    for (int i = 0; i < 12; i++) {
        const tl_light light = random_light(&camera, &seed, 3.0f, 9.0f);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "small", false, NULL, &err), err);
    return g;
}

static void what_is_off_a_little_is_refused(void **state)
{
    (void)state;
    for (int model = 0; model < TL_MODEL_COUNT; model++)
        for (size_t i = 0; i < COUNT_OF(steps); i++)
            for (size_t p = 0; p < COUNT_OF(planes); p++) {
                tl_light_set lights = {0};
                const uint32_t traits = traits_of((tl_u32)model);
                if (!(planes[p] >> steps[i].plane & 1u) ||
                    (steps[i].traits && !(traits & steps[i].traits)))
                    continue;
                tl_gbuffer *g = small_frame(planes[p], &lights);
                tl_gbuffer *off = small_frame(planes[p], &lights);
                lights.model = (enum tl_shading_model)model;
                float *values = tl_gbuffer_plane(off, steps[i].plane);
                for (size_t at = 0; at < (size_t)off->pitch * off->rows; at++)
                    values[at] *= 1.0f - 0x1p-10f;
                if (report_of(g, off, &lights, TL_COSINE_STABLE).failed_count == 0)
                    fail_msg("%s: plane %d may be off", words[model], steps[i].plane);
                tl_light_set_clear(&lights);
                tl_gbuffer_destroy(off);
                tl_gbuffer_destroy(g);
            }
}

static tl_image *twin_of(const tl_gbuffer *g, const tl_light_set *lights)
{
    tl_prepared prepared = {0};
    tl_image *image = image_like(g);
    tl_error err;
    ASSERT_OK(
        tl_prepare(g, lights, &(tl_prepare_options){.tile_size = 16}, NULL, &prepared, &err),
        err);
    tl_reference_light(&prepared, g, TL_TWIN_FLOAT, image);
    tl_prepared_clear(&prepared);
    return image;
}

/* Bit for bit, whatever the pixels' own are. */
static void one_exponent_for_all_is_that_of_every_pixel(void **state)
{
    (void)state;
    for (int model = 0; model < TL_MODEL_COUNT; model++) {
        tl_light_set lights = {0};
        tl_gbuffer *g = small_frame(planes[0], &lights);
        lights.model = (enum tl_shading_model)model;
        lights.has_shininess = 1;
        lights.shininess = 37.5f;
        tl_image *all = twin_of(g, &lights);
        lights.has_shininess = 0;
        tl_image *own = twin_of(g, &lights);
        for (size_t at = 0; at < (size_t)g->pitch * g->rows; at++)
            set_pixel(g, TL_SHININESS, at, 37.5f);
        tl_image *each = twin_of(g, &lights);
        assert_same_image(all, each, words[model]);
        const int counts = (traits_of((tl_u32)model) & (TL_LOBE_SPECULAR | TL_LOBE_WIDTH)) != 0;
        assert_int_equal(memcmp(tl_image_plane(all, 0), tl_image_plane(own, 0),
                                (size_t)g->pitch * g->rows * sizeof(float)) != 0,
                         counts);
        tl_image_destroy(each);
        tl_image_destroy(own);
        tl_image_destroy(all);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_within),
        cmocka_unit_test(what_is_off_a_little_is_refused),
        cmocka_unit_test(one_exponent_for_all_is_that_of_every_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
