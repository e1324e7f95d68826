/* Is a picture the sum of the terms that are written beside it: bit for bit where nothing is rounded
 * otherwise, and else within the roundings that kernels/pixel.h counts, in every pixel? Is the picture the
 * same with them as without? Have all paths, widths, bands and the twin the same bits of them, and of fewer
 * terms the same as of all?
 *
 * Terms are added up in double. */
#include "layered_frames.h"

#include "lighting_state.h"
#include "ranges.h"

enum { WIDTH = 70, HEIGHT = 41, LAMPS = 24 };
static const double u = 0x1p-24;

/* What a frame has. */
typedef struct scene {
    const char *name;
    enum tl_layout_name layout;
    uint32_t material; /* planes beside the base */
    enum tl_shading_model model;
    uint32_t layers;
    float specular;     /* of lights; below 0: as chance has it */
    float intensity[2]; /* of lights, of the first half and of the second */
    float emission;     /* that emissive planes are multiplied with */
    double roundings;   /* of sum and picture together; below 0: the same bits */
} scene;

static const uint32_t phong = TL_GROUP_PHONG | TL_GROUP_EMISSIVE | TL_GROUP_OCCLUSION,
                      rough = TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE | TL_GROUP_OCCLUSION;

static const scene scenes[] = {
    {"highlights", TL_LAYOUT_FLOAT, phong, TL_MODEL_PHONG, 0, -1.0f, {1.0f, 1.0f}, 1.0f, 6.0},
    {"no highlights",
     TL_LAYOUT_FLOAT,
     phong,
     TL_MODEL_PHONG,
     0,
     0.0f,
     {1.0f, 1.0f},
     1.0f,
     -1.0},
    {"Fresnel",
     TL_LAYOUT_FLOAT,
     rough,
     TL_MODEL_METAL_ROUGH,
     0,
     -1.0f,
     {1.0f, 1.0f},
     1.0f,
     6.0},
    {"packed", TL_LAYOUT_COMPACT_16, phong, TL_MODEL_PHONG, 0, -1.0f, {1.0f, 1.0f}, 1.0f, 6.0},
    {"one colour",
     TL_LAYOUT_ISPC,
     TL_GROUP_PHONG,
     TL_MODEL_BLINN_PHONG_NORMALIZED,
     0,
     1.0f,
     {1.0f, 1.0f},
     0.0f,
     2.0 * LAMPS + 6.0},
    {"terms 1e30 apart",
     TL_LAYOUT_FLOAT,
     phong,
     TL_MODEL_PHONG,
     0,
     -1.0f,
     {1e-12f, 1e-12f},
     1e18f,
     6.0},
    {"lights 1e30 apart",
     TL_LAYOUT_FLOAT,
     phong,
     TL_MODEL_PHONG,
     0,
     -1.0f,
     {1e18f, 1e-12f},
     1.0f,
     6.0},
    {"beyond the largest float",
     TL_LAYOUT_FLOAT,
     phong,
     TL_MODEL_PHONG,
     0,
     -1.0f,
     {3e38f, 3e38f},
     3e38f,
     6.0},
    {"layers",
     TL_LAYOUT_FLOAT,
     phong,
     TL_MODEL_PHONG,
     3,
     -1.0f,
     {1.0f, 1.0f},
     1.0f,
     6.0 + 3 * 6.0},
    {"layers of one colour",
     TL_LAYOUT_ISPC,
     TL_GROUP_PHONG,
     TL_MODEL_BLINN_PHONG_NORMALIZED,
     2,
     1.0f,
     {1.0f, 1.0f},
     0.0f,
     2.0 * LAMPS + 6.0 + 2 * 6.0},
};

typedef struct frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
} frame;

static void scale_emission(tl_gbuffer *g, float by)
{
    for (enum tl_plane p = TL_EMISSIVE_R; p <= TL_EMISSIVE_B; p++) {
        float *values = tl_gbuffer_plane(g, p);
        for (size_t at = 0; values && at < (size_t)g->pitch * g->rows; at++)
            values[at] *= by;
    }
}

/* Tiles that are sky alone, and blocks of 4 x 4 beside surfaces. */
static void open_the_sky(tl_gbuffer *g)
{
    float *depths = tl_gbuffer_plane(g, TL_DEPTH);
    for (uint32_t y = 0; y < 24; y++)
        for (uint32_t x = 0; x < 24; x++)
            depths[y * g->pitch + x] = INFINITY;
}

static frame take(const scene *s)
{
    uint32_t seed = 7;
    tl_error err;
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    frame f = {.gbuffer = layered_gbuffer(&camera, TL_GROUP_BASE | s->material, s->layers, 3)};
    scale_emission(f.gbuffer, s->emission);
    open_the_sky(f.gbuffer);
    ASSERT_OK(tl_gbuffer_repair(f.gbuffer, s->name, false, NULL, &err), err);
    if (s->layout != TL_LAYOUT_FLOAT) {
        tl_gbuffer *packed = packed_layers(f.gbuffer, s->layout);
        tl_gbuffer_destroy(f.gbuffer);
        f.gbuffer = packed;
    }
    for (int i = 0; i < LAMPS; i++) {
        tl_light light = random_light(&camera, &seed, 1.0f, 6.0f);
        if (i % 4 == 0 && s->layers == 0) /* on devices cones would double the kernel */
            aim_at_random(&light, &seed);
        if (s->specular >= 0.0f)
            light.specular = s->specular;
        light.intensity *= s->intensity[i % 2];
        ASSERT_OK(tl_light_set_add(&f.lights, &light, &err), err);
    }
    f.lights.model = s->model;
    f.lights.ambient[0] = 0.25f;
    f.lights.ambient[1] = 0.125f;
    f.lights.sky[2] = 0.75f;
    return f;
}

static void release(frame *f)
{
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

/* The caller destroys it. device: NULL on the host; counts may be. */
static tl_image *lit(tl_device *device,
                     const tl_lighting_options *options,
                     const frame *f,
                     tl_lighting_counts *counts)
{
    const tl_camera *camera = &f->gbuffer->camera;
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create_parts(camera->width, camera->height, TL_AOVS_IN(options->split),
                                    &image, &err),
              err);
    for (unsigned plane = 0; plane < TL_PICTURE_PLANES(options->split); plane++)
        for (size_t at = 0; at < (size_t)camera->height * image->pitch; at++)
            if (at % image->pitch < camera->width) /* as a picture before may have left it */
                tl_image_plane(image, plane)[at] = NAN;
    const tl_lighting_counts own = light_frame(device, options, f->gbuffer, &f->lights, image);
    if (counts)
        *counts = own;
    return image;
}

static float *term_plane(const tl_image *image, uint32_t split, uint32_t term, unsigned color)
{
    return tl_image_plane(image, TL_AOV_PLANE(split, term) + color);
}

/* How far picture and sum are apart at a place, in roundings of the sum. */
static double apart(const scene *s, const tl_image *image, unsigned color, size_t at)
{
    const float picture = tl_image_plane(image, color)[at];
    double sum = 0.0;
    float in_float = 0.0f;
    for (uint32_t term = 0; term < TL_AOV_COUNT; term++) {
        const float value = term_plane(image, TL_ALL_AOVS, term, color)[at];
        assert_true(value >= 0.0f);
        sum += (double)value;
        in_float += value;
    }
    if (s->roundings < 0.0)
        assert_true(same_bits(picture, in_float));
    const double off = fabs((double)picture - fmin(sum, (double)TL_MOST_FLOAT));
    return off <= 0x1p-146 ? 0.0 : off / (u * sum);
}

static void assert_sums(const scene *s, const tl_image *image, const char *by)
{
    double worst = 0.0;
    for (unsigned color = 0; color < 3; color++)
        for (uint32_t y = 0; y < image->height; y++)
            for (uint32_t x = 0; x < image->width; x++) {
                const size_t at = (size_t)y * image->pitch + x;
                const double off = apart(s, image, color, at);
                worst = fmax(worst, off);
                if (s->roundings >= 0.0 && !(off <= s->roundings * (1.0 + 0x1p-16)))
                    fail_msg("%s, %s: pixel (%u, %u), channel %u: %g roundings", s->name, by, x,
                             y, color, off);
            }
    print_message("%s, %s: %.2f roundings of %g\n", s->name, by, worst,
                  s->roundings < 0.0 ? 0.0 : s->roundings);
}

/* Every term has something, unless the frame lacks it. */
static void assert_terms_say_something(const scene *s, const tl_image *image)
{
    for (uint32_t term = 0; term < TL_AOV_COUNT; term++) {
        const int is_lacking = (term == TL_AOV_SPECULAR && s->specular == 0.0f) ||
                               term == TL_AOV_SKY_DIFFUSE || term == TL_AOV_SKY_SPECULAR ||
                               (term == TL_AOV_EMISSIVE && !(s->material & TL_GROUP_EMISSIVE));
        double sum = 0.0;
        for (unsigned color = 0; color < 3; color++)
            for (size_t at = 0; at < (size_t)image->pitch * image->rows; at++)
                sum += (double)term_plane(image, TL_ALL_AOVS, term, color)[at];
        assert_int_equal(sum > 0.0, !is_lacking);
    }
}

static tl_lighting_options options_of(tl_precision precision, uint32_t split)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.cull = TL_CULL_NONE; /* of no matter here, and a program less */
    options.precision = precision;
    options.split = split;
    return options;
}

static void terms_add_up_to_the_picture(void **state)
{
    static const tl_precision precisions[] = {TL_PRECISION_TWIN, TL_PRECISION_REFERENCE};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        frame f = take(&scenes[i]);
        for (size_t p = 0; p < COUNT_OF(precisions); p++) {
            const tl_lighting_options with = options_of(precisions[p], TL_ALL_AOVS),
                                      without = options_of(precisions[p], 0);
            tl_image *got = lit(NULL, &with, &f, NULL), *alone = lit(NULL, &without, &f, NULL);
            assert_same_image(got, alone, scenes[i].name);
            assert_terms_say_something(&scenes[i], got);
            if (precisions[p] ==
                TL_PRECISION_TWIN) /* the reference rounds each once, to float */
                assert_sums(&scenes[i], got, "float");
            tl_image_destroy(alone);
            tl_image_destroy(got);
        }
        release(&f);
    }
}

static void assert_same_planes(const tl_image *got, const tl_image *want, const char *what)
{
    assert_int_equal(got->part_count, want->part_count);
    for (unsigned plane = 0; plane < tl_image_plane_count(want); plane++)
        for (uint32_t y = 0; y < got->height; y++) {
            const size_t row = (size_t)y * got->pitch;
            if (memcmp(tl_image_plane(got, plane) + row, tl_image_plane(want, plane) + row,
                       got->width * sizeof(float)) != 0)
                fail_msg("%s: plane %u, row %u differs", what, plane, y);
        }
}

static const struct {
    const char *name;
    size_t scene;
    tl_path path;
    uint32_t width, tile;
    uint64_t memory; /* bytes; 0: no limit */
} ways[] = {
    {"layers of one colour", 9, TL_PATH_CPU, 16, 16, 0},
    {"in bands", 9, TL_PATH_CPU, 16, 16, 6000},
    {"gpu", 8, TL_PATH_GPU, 1, 32, 0},
};

static void every_way_has_the_same_bits(void **state)
{
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        frame f = take(&scenes[ways[i].scene]);
        tl_lighting_options options = options_of(TL_PRECISION_TWIN, TL_ALL_AOVS);
        tl_image *want = lit(NULL, &options, &f, NULL);
        options.precision = TL_PRECISION_FLOAT;
        options.path = ways[i].path;
        options.vector_width = ways[i].width;
        options.tile_size = ways[i].tile;
        options.memory_limit = ways[i].memory;
        tl_lighting_counts counts;
        tl_image *got = lit(*state, &options, &f, &counts);
        assert_int_equal(counts.band_count > 1, ways[i].memory > 0);
        assert_same_planes(got, want, ways[i].name);
        tl_image_destroy(got);
        tl_image_destroy(want);
        release(&f);
    }
}

/* Of fewer terms each is what it is among all. */
static void terms_do_not_depend_on_each_other(void **state)
{
    frame f = take(&scenes[0]);
    (void)state;
    const tl_lighting_options all = options_of(TL_PRECISION_TWIN, TL_ALL_AOVS);
    tl_image *want = lit(NULL, &all, &f, NULL);
    for (uint32_t split = 1; split < TL_ALL_AOVS; split++) {
        const tl_lighting_options some = options_of(TL_PRECISION_TWIN, split);
        tl_image *got = lit(NULL, &some, &f, NULL);
        assert_same_image(got, want, "some terms");
        for (uint32_t term = 0; term < TL_AOV_COUNT; term++)
            for (unsigned color = 0; color < 3 && (split >> term & 1u); color++)
                assert_memory_equal(term_plane(got, split, term, color),
                                    term_plane(want, TL_ALL_AOVS, term, color),
                                    (size_t)got->pitch * HEIGHT * sizeof(float));
        tl_image_destroy(got);
    }
    tl_image_destroy(want);
    release(&f);
}

/* Twice, with nothing more the second time. */
static void trace(
    tl_device *device, const frame *f, uint32_t split, char build[1024], uint64_t *bytes)
{
    tl_lighting_options options = options_of(TL_PRECISION_FLOAT, split);
    tl_lighting *lighting = NULL;
    tl_image *image = NULL;
    tl_lighting_counts counts;
    tl_error err;
    options.layers = 0;
    ASSERT_OK(tl_image_create_parts(WIDTH, HEIGHT, TL_AOVS_IN(split), &image, &err), err);
    ASSERT_OK(tl_lighting_create(device, &options, &lighting, &err), err);
    ASSERT_OK(
        tl_lighting_run(lighting, f->gbuffer, &f->lights, image, NULL, NULL, &counts, &err),
        err);
    *bytes = counts.device_bytes;
    ASSERT_OK(
        tl_lighting_run(lighting, f->gbuffer, &f->lights, image, NULL, NULL, &counts, &err),
        err);
    assert_int_equal(counts.device_bytes, *bytes);
    tl_lighting_build_options(lighting, build, 1024);
    tl_lighting_destroy(lighting);
    tl_image_destroy(image);
}

/* Pictures without terms have the program they had, in which nothing is split, and its buffers. */
static void pictures_without_terms_pay_nothing(void **state)
{
    frame f = take(&scenes[9]);
    char none[1024], all[1024];
    uint64_t none_bytes, all_bytes;
    trace(*state, &f, 0, none, &none_bytes);
    trace(*state, &f, TL_ALL_AOVS, all, &all_bytes);
    assert_non_null(strstr(none, "-D TL_SPLIT=0"));
    assert_non_null(strstr(all, "-D TL_SPLIT=127"));
    *strstr(all, "-D TL_SPLIT=127") = '\0'; /* all that differs */
    assert_memory_equal(none, all, strlen(all));
    assert_int_equal(none_bytes, all_bytes); /* beside the image, which is the device's own */
    release(&f);
}

static void what_cannot_be_split_is_refused(void **state)
{
    frame f = take(&scenes[0]);
    tl_lighting_options options = options_of(TL_PRECISION_TWIN, TL_ALL_AOVS);
    tl_lighting *lighting = NULL;
    tl_image *image = image_like(f.gbuffer);
    tl_error err;
    (void)state;
    ASSERT_OK(tl_lighting_create(NULL, &options, &lighting, &err), err);
    assert_int_equal(
        tl_lighting_run(lighting, f.gbuffer, &f.lights, image, NULL, NULL, NULL, &err),
        TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "the image has 0 parts"));
    tl_lighting_destroy(lighting);
    options.kernel.text = "";
    assert_int_equal(tl_lighting_create(NULL, &options, &lighting, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "a kernel of one's own writes the picture alone"));
    options.kernel.text = NULL;
    options.split = TL_ALL_AOVS + 1;
    assert_int_equal(tl_lighting_create(NULL, &options, &lighting, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "terms 0x80"));
    tl_image_destroy(image);
    release(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terms_add_up_to_the_picture),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(terms_do_not_depend_on_each_other),
        cmocka_unit_test(pictures_without_terms_pay_nothing),
        cmocka_unit_test(what_cannot_be_split_is_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
