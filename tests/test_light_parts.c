/* Do pictures of parts of a frame's light add up to that of the whole, within the roundings that both have?
 * Are lamps alone without ambient light, emission and sky? Have devices the twin's bits, and parts the
 * programs of all lights, whatever theirs call for?
 *
 * Pictures are added up in double. No number is below 0, so a rounding is a share u of what is rounded: of n
 * lights each lobe's sum is rounded n times, in the whole as in the parts together, and what is made of it 5
 * times at most (kernels/pixel.h); a layer blends by 3 more. */
#include "layered_frames.h"
#include "rich_lights.h"

#include "lighting_state.h"

enum { WIDTH = 70, HEIGHT = 41, LAMPS = 30, PARTS = 3 };
static const double u = 0x1p-24;

typedef struct scene {
    const char *name;
    uint32_t material;
    enum tl_shading_model model;
    uint32_t layers;
    bool is_rich; /* lights have shapes, ambient lobes among them */
} scene;

static const uint32_t phong = TL_GROUP_PHONG | TL_GROUP_EMISSIVE | TL_GROUP_OCCLUSION,
                      rough = TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE | TL_GROUP_OCCLUSION;
static const scene scenes[] = {
    {"plain", phong, TL_MODEL_PHONG, 0, false},
    {"shapes", phong, TL_MODEL_PHONG, 0, true},
    {"Fresnel", rough, TL_MODEL_METAL_ROUGH, 0, false},
    {"layers", phong, TL_MODEL_PHONG, 2, true},
};

typedef struct frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    uint8_t lit[PARTS][LAMPS]; /* the last part is more than lamps */
} frame;

/* Of part 0 all lights are spots, and of part 1 none is; the others have no highlights. */
static frame take(const scene *s)
{
    uint32_t seed = 7;
    tl_error err;
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    frame f = {.gbuffer = layered_gbuffer(&camera, TL_GROUP_BASE | s->material, s->layers, 3)};
    for (int i = 0; i < LAMPS; i++) {
        tl_light light = random_light(&camera, &seed, 1.0f, 6.0f);
        const int part = i % PARTS;
        if (part == 0)
            aim_at_random(&light, &seed);
        if (part == PARTS - 1)
            light.specular = 0.0f;
        f.lit[part][i] = 1;
        ASSERT_OK(tl_light_set_add(&f.lights, &light, &err), err);
    }
    if (s->is_rich)
        make_rich(&f.lights);
    f.lights.model = s->model;
    f.lights.ambient[0] = 0.25f;
    f.lights.sky[2] = 0.75f;
    return f;
}

static void release(frame *f)
{
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

static tl_image *lit_part(tl_lighting *lighting, const frame *f, int part)
{
    const tl_light_part of = {f->lit[part], part < PARTS - 1};
    tl_image *image = image_like(f->gbuffer);
    tl_error err;
    ASSERT_OK(tl_lighting_run_part(lighting, f->gbuffer, &f->lights, &of, image, NULL, NULL,
                                   NULL, &err),
              err);
    return image;
}

/* The whole first, then the parts. The caller destroys them. */
static void light_all(tl_device *device,
                      tl_precision precision,
                      const frame *f,
                      tl_image *out[1 + PARTS],
                      char build[1 + PARTS][1024])
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_lighting *lighting = NULL;
    tl_error err;
    options.cull = TL_CULL_NONE; /* of no matter here, and a program less */
    options.precision = precision;
    ASSERT_OK(tl_lighting_create(device, &options, &lighting, &err), err);
    out[0] = image_like(f->gbuffer);
    ASSERT_OK(tl_lighting_run(lighting, f->gbuffer, &f->lights, out[0], NULL, NULL, NULL, &err),
              err);
    tl_lighting_build_options(lighting, build[0], sizeof build[0]);
    for (int part = 0; part < PARTS; part++) {
        out[1 + part] = lit_part(lighting, f, part);
        tl_lighting_build_options(lighting, build[1 + part], sizeof build[0]);
    }
    tl_lighting_destroy(lighting);
}

static void assert_sums(const scene *s, tl_image *const images[1 + PARTS])
{
    const double most = 2.0 * (LAMPS + 5.0) + 6.0 * s->layers;
    double worst = 0.0;
    for (unsigned color = 0; color < 3; color++)
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const size_t at = (size_t)y * images[0]->pitch + x;
                double sum = 0.0;
                for (int part = 1; part <= PARTS; part++)
                    sum += (double)tl_image_plane(images[part], color)[at];
                const double off = fabs((double)tl_image_plane(images[0], color)[at] - sum);
                const double roundings = off <= 0x1p-140 ? 0.0 : off / (u * sum);
                worst = fmax(worst, roundings);
                if (!(roundings <= most * (1.0 + 0x1p-16)))
                    fail_msg("%s: pixel (%u, %u), channel %u: %g roundings", s->name, x, y,
                             color, roundings);
            }
    print_message("%s: %.2f roundings of %g\n", s->name, worst, most);
}

static void parts_add_up_to_the_whole(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        frame f = take(&scenes[i]);
        tl_image *images[1 + PARTS];
        char build[1 + PARTS][1024];
        light_all(NULL, TL_PRECISION_TWIN, &f, images, build);
        assert_sums(&scenes[i], images);
        for (int k = 0; k <= PARTS; k++)
            tl_image_destroy(images[k]);
        release(&f);
    }
}

/* Where nothing was hit, and of surfaces that no lamp reaches. */
static void lamps_alone_are_lamps_alone(void **state)
{
    frame f = take(&scenes[0]);
    tl_image *images[1 + PARTS];
    char build[1 + PARTS][1024];
    (void)state;
    for (size_t i = 0; i < f.lights.count; i++)
        f.lights.lights[i].range = 1e-3f;
    light_all(NULL, TL_PRECISION_TWIN, &f, images, build);
    for (unsigned color = 0; color < 3; color++)
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const size_t at = (size_t)y * images[0]->pitch + x;
                assert_true(tl_image_plane(images[1], color)[at] == 0.0f);
                assert_true(tl_image_plane(images[2], color)[at] == 0.0f);
            }
    assert_same_image(images[PARTS], images[0], "the rest");
    for (int k = 0; k <= PARTS; k++)
        tl_image_destroy(images[k]);
    release(&f);
}

static void devices_have_the_twins_bits_and_few_programs(void **state)
{
    frame f = take(&scenes[0]);
    tl_image *got[1 + PARTS], *want[1 + PARTS];
    char build[1 + PARTS][1024], none[1 + PARTS][1024];
    light_all(*state, TL_PRECISION_FLOAT, &f, got, build);
    light_all(NULL, TL_PRECISION_TWIN, &f, want, none);
    for (int k = 0; k <= PARTS; k++)
        assert_same_image(got[k], want[k], k == 0 ? "the whole" : "a part");
    assert_string_equal(build[1], build[2]);     /* of lamps alone */
    assert_string_equal(build[PARTS], build[0]); /* the rest */
    for (int k = 0; k <= PARTS; k++) {
        tl_image_destroy(got[k]);
        tl_image_destroy(want[k]);
    }
    release(&f);
}

static void kernels_of_users_are_refused(void **state)
{
    frame f = take(&scenes[0]);
    tl_lighting_options options = tl_lighting_options_default();
    const tl_light_part part = {f.lit[0], 1};
    tl_lighting *lighting = NULL;
    tl_image *image = image_like(f.gbuffer);
    tl_error err;
    options.kernel = (tl_user_kernel){"kernel", "entry", TL_ITEMS_TILE, NULL};
    ASSERT_OK(tl_lighting_create(*state, &options, &lighting, &err), err);
    assert_int_equal(tl_lighting_run_part(lighting, f.gbuffer, &f.lights, &part, image, NULL,
                                          NULL, NULL, &err),
                     TL_ERR_UNSUPPORTED);
    assert_non_null(strstr(err.message, "lights frames as it pleases"));
    tl_lighting_destroy(lighting);
    tl_image_destroy(image);
    release(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_add_up_to_the_whole),
        cmocka_unit_test(lamps_alone_are_lamps_alone),
        cmocka_unit_test(devices_have_the_twins_bits_and_few_programs),
        cmocka_unit_test(kernels_of_users_are_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
