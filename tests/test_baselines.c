/* Does every baseline of the bench light the frames that the kernels light, to within the error that
 * it states, and does the hand-written code give the kernels' bits?
 *
 * The yardstick is double, without tiles, lists or volumes. Small frames of odd sizes: there a row
 * of pixels that is missing at the edge of a light shows. */
#define _GNU_SOURCE /* setenv */

#include "frames.h"

#include "baselines.h"
#include "bench_scene.h"

enum { WIDTH = 97, HEIGHT = 61 };

typedef struct frame {
    char name[80];
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    tl_image *want; /* in double */
    double mean;    /* of want */
} frame;

static void add(tl_light_set *lights, const tl_light *light)
{
    tl_error err;
    ASSERT_OK(tl_light_set_add(lights, light, &err), err);
}

/* Places in view space (m) as shares of what the frame has for a scale, and ranges (m). */
static const struct {
    const char *what;
    float position[3], range;
    tl_falloff falloff;
} hard_lights[] = {
    {"around the eye, reaching all", {0.1f, 0.2f, 0.1f}, 60.0f, TL_FALLOFF_LINEAR},
    {"around the eye, reaching little", {0.0f, 0.0f, 0.0f}, 5.0f, TL_FALLOFF_LINEAR},
    {"the eye just inside its rim", {3.0f, 0.0f, -4.0f}, 5.0001f, TL_FALLOFF_LINEAR},
    {"the eye just outside its rim", {-3.0f, 0.0f, -4.0f}, 4.9999f, TL_FALLOFF_LINEAR},
    {"centre behind the eye", {0.5f, -1.0f, 2.0f}, 8.0f, TL_FALLOFF_LINEAR},
    {"wholly behind the eye", {0.0f, 0.0f, 6.0f}, 5.0f, TL_FALLOFF_LINEAR},
    {"across the near plane", {0.3f, -0.9f, -0.2f}, 1.5f, TL_FALLOFF_INVERSE_SQUARE},
    {"beside the view, reaching in", {-9.0f, 0.0f, -5.0f}, 7.0f, TL_FALLOFF_LINEAR},
    {"above the view, reaching in", {1.0f, 7.0f, -6.0f}, 7.0f, TL_FALLOFF_INVERSE_SQUARE},
    {"beyond all surfaces", {0.0f, 0.0f, -500.0f}, 20.0f, TL_FALLOFF_LINEAR},
    {"before all surfaces", {0.0f, 0.0f, -1.0f}, 0.05f, TL_FALLOFF_LINEAR},
    {"far off, with a range beyond all", {0.0f, 30.0f, -300.0f}, 1e6f, TL_FALLOFF_LINEAR},
};

static void add_hard_lights(const tl_camera *camera, tl_light_set *lights)
{
    for (size_t i = 0; i < COUNT_OF(hard_lights); i++) {
        double view[3], world[3];
        tl_light light = tl_light_default();
        for (int axis = 0; axis < 3; axis++)
            view[axis] = (double)hard_lights[i].position[axis];
        tl_camera_world_point(camera, view, world);
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] = (float)world[axis];
        light.range = hard_lights[i].range;
        light.falloff = hard_lights[i].falloff;
        light.color[i % 3] = 0.3f;
        add(lights, &light);
    }
}

/* What reaches everything: a sun, a lamp without a range, ambient light; and a sky. */
static void add_global_lights(tl_light_set *lights)
{
    tl_light sun = tl_light_default(), lamp = tl_light_default();
    sun.type = TL_LIGHT_DIRECTIONAL;
    sun.direction[0] = 0.6f;
    sun.direction[1] = -0.8f;
    sun.direction[2] = 0.0f;
    sun.intensity = 0.3f;
    lamp.position[1] = 3.0f;
    lamp.intensity = 2.0f;
    add(lights, &sun);
    add(lights, &lamp);
    for (int i = 0; i < 3; i++) {
        lights->ambient[i] = 0.05f * (float)i;
        lights->sky[i] = 0.3f;
    }
}

static void finish(frame *f)
{
    const tl_lighting_options double_on_cpu = {.precision = TL_PRECISION_REFERENCE,
                                               .tile_size = 16};
    f->want = image_like(f->gbuffer);
    light_frame(NULL, &double_on_cpu, f->gbuffer, &f->lights, f->want);
    for (unsigned channel = 0; channel < 3; channel++)
        for (uint32_t y = 0; y < f->want->height; y++)
            for (uint32_t x = 0; x < f->want->width; x++)
                f->mean += (double)tl_image_plane(f->want, channel)[y * f->want->pitch + x];
    f->mean /= 3.0 * f->want->width * f->want->height;
}

static void clear(frame *f)
{
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
    tl_image_destroy(f->want);
}

static frame bench_frame(const char *scene, uint32_t light_count, int is_hard)
{
    tl_bench_scene_options options = tl_bench_scene_options_default();
    frame f = {.mean = 0.0};
    tl_error err;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.light_count = light_count;
    options.lights_per_tile = 0.3 * light_count;
    snprintf(f.name, sizeof f.name, "%s, %u lights%s", scene, light_count,
             is_hard ? " and hard ones" : "");
    ASSERT_OK(
        tl_bench_scene_make(tl_bench_scene_find(scene), &options, &f.gbuffer, &f.lights, &err),
        err);
    if (is_hard) {
        add_hard_lights(&f.gbuffer->camera, &f.lights);
        add_global_lights(&f.lights);
    }
    finish(&f);
    return f;
}

/* Half a metre and more before the surfaces of random_gbuffer: nearer, what rounding moves a
 * surface by would show as light, in every float arithmetic. */
static tl_light light_before_noise(const tl_camera *camera, uint32_t *seed)
{
    tl_light light = random_light(camera, seed, 0.8f, 4.0f);
    const double view[3] = {(double)uniform(seed, -4.0f, 4.0f),
                            (double)uniform(seed, -2.5f, 2.5f),
                            (double)uniform(seed, -3.5f, -2.0f)};
    double world[3];
    tl_camera_world_point(camera, view, world);
    for (int axis = 0; axis < 3; axis++)
        light.position[axis] = (float)world[axis];
    return light;
}

/* Noise for a surface, seen by a camera that is turned and moved. */
static frame noisy_frame(uint32_t present, tl_projection projection, const char *name)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, projection);
    uint32_t seed = 20110901;
    frame f = {.gbuffer = random_gbuffer(&camera, present, 1977)};
    snprintf(f.name, sizeof f.name, "%s", name);
    for (int i = 0; i < 40; i++) {
        const tl_light light = light_before_noise(&camera, &seed);
        add(&f.lights, &light);
    }
    add_global_lights(&f.lights);
    finish(&f);
    return f;
}

enum { MAX_FRAMES = 8 };

/* What all tests share. */
typedef struct fixture {
    void *device;
    frame frames[MAX_FRAMES];
    size_t count;
} fixture;

static int make_frames(void **state)
{
    static fixture x;
    open_device(&x.device);
    x.frames[x.count++] = bench_frame("spheres", 0, 0);
    x.frames[x.count++] = bench_frame("spheres", 1, 0);
    x.frames[x.count++] = bench_frame("foliage", 40, 0);
    x.frames[x.count++] = bench_frame("grazing", 40, 1);
    x.frames[x.count++] = noisy_frame(TL_GROUP_BASE | TL_GROUP_METAL_ROUGH |
                                          TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
                                      TL_PERSPECTIVE, "metal-rough noise");
    x.frames[x.count++] = noisy_frame(TL_GROUP_BASE | TL_GROUP_PHONG, TL_ORTHOGRAPHIC,
                                      "Phong noise, parallel rays");
    x.frames[x.count++] = noisy_frame(TL_GROUP_BASE, TL_PERSPECTIVE, "noise without a lobe");
    *state = &x;
    return 0;
}

static int clear_frames(void **state)
{
    fixture *x = *state;
    for (size_t i = 0; i < x->count; i++)
        clear(&x->frames[i]);
    return close_device(&x->device);
}

/* How far a picture is from the reference, over the mean radiance. */
typedef struct distance {
    double rms, largest;
    size_t off_count; /* values off by more than a hundredth of the mean */
} distance;

static distance distance_of(const frame *f, const tl_image *got)
{
    distance d = {0.0, 0.0, 0};
    const double scale = f->mean > 0.0 ? f->mean : 1.0;
    for (unsigned channel = 0; channel < 3; channel++)
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const size_t at = (size_t)y * got->pitch + x;
                const double error = fabs((double)tl_image_plane(got, channel)[at] -
                                          (double)tl_image_plane(f->want, channel)[at]) /
                                     scale;
                d.rms += error * error;
                d.largest = error <= d.largest ? d.largest : error; /* NaN is largest */
                d.off_count += !(error <= 0.01);
            }
    d.rms = sqrt(d.rms / (3.0 * WIDTH * HEIGHT));
    return d;
}

static void check(const frame *f, const tl_baseline *baseline, const tl_image *got)
{
    const distance d = distance_of(f, got);
    if (!(d.rms <= baseline->rms_tolerance) || !(d.largest <= baseline->max_tolerance))
        fail_msg("%s, %s: %.3g RMS and %.3g at most of the mean radiance, %zu values off; "
                 "stated are %.3g and %.3g",
                 baseline->name, f->name, d.rms, d.largest, d.off_count,
                 baseline->rms_tolerance, baseline->max_tolerance);
}

/* All are alive at once and run in turn, as in the bench; each twice, for what is left over from
 * the first frame must not show in the second. */
static void errors_are_as_stated(void **state)
{
    const fixture *x = *state;
    for (size_t i = 0; i < x->count; i++) {
        const frame *f = &x->frames[i];
        const tl_baseline_input input = {x->device, f->gbuffer, &f->lights};
        void *states[16] = {NULL};
        tl_image *got = image_like(f->gbuffer);
        tl_error err;
        assert_in_range(tl_baseline_count, 1, COUNT_OF(states));
        for (int b = 0; b < tl_baseline_count; b++)
            ASSERT_OK(tl_baselines[b]->create(&input, &states[b], &err), err);
        for (int turn = 0; turn < 2; turn++)
            for (int b = 0; b < tl_baseline_count; b++) {
                ASSERT_OK(tl_baselines[b]->run(states[b], got, NULL, &err), err);
                check(f, tl_baselines[b], got);
            }
        for (int b = 0; b < tl_baseline_count; b++)
            tl_baselines[b]->destroy(states[b]);
        tl_image_destroy(got);
    }
}

static void light_by_baseline(const char *name,
                              tl_device *device,
                              const frame *f,
                              tl_image *image)
{
    const tl_baseline *baseline = tl_baseline_find(name);
    const tl_baseline_input input = {device, f->gbuffer, &f->lights};
    void *state = NULL;
    tl_error err;
    ASSERT_OK(baseline->create(&input, &state, &err), err);
    ASSERT_OK(baseline->run(state, image, NULL, &err), err);
    baseline->destroy(state);
}

static void check_hand(tl_device *device, const frame *f, const char *set)
{
    const tl_lighting_options options = tl_lighting_options_default();
    tl_image *want = image_like(f->gbuffer), *got = image_like(f->gbuffer);
    char what[120];
    snprintf(what, sizeof what, "%.80s in %s", f->name, set);
    light_frame(device, &options, f->gbuffer, &f->lights, want);
    light_by_baseline("hand", device, f, got);
    assert_same_image(got, want, what);
    light_by_baseline("hand_relaxed", device, f, got);
    check(f, tl_baseline_find("hand_relaxed"), got);
    tl_image_destroy(want);
    tl_image_destroy(got);
}

/* In every instruction set that this processor has; the relaxed code has its tolerance there. */
static void hand_has_the_kernels_bits(void **state)
{
    static const char *const sets[] = {"avx512", "avx2", "portable"};
    const fixture *x = *state;
    size_t checked = 0;
    for (size_t s = 0; s < COUNT_OF(sets); s++) {
        setenv("TILELIGHT_HAND", sets[s], 1);
        for (size_t i = 0; i < x->count && strcmp(tl_hand_instruction_set(), sets[s]) == 0;
             i++, checked++)
            check_hand(x->device, &x->frames[i], sets[s]);
    }
    unsetenv("TILELIGHT_HAND");
    assert_in_range(checked, x->count, COUNT_OF(sets) * x->count);
}

/* Where lists are of one size, a light too many is an error and no missing light. */
static void classic_refuses_what_its_lists_cannot_hold(void **state)
{
    const fixture *x = *state;
    const tl_baseline *classic = tl_baseline_find("classic");
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    for (uint32_t light_count = 256; light_count <= 257; light_count++) {
        frame f = {.gbuffer = random_gbuffer(&camera, TL_GROUP_BASE, 1977)};
        const tl_baseline_input input = {x->device, f.gbuffer, &f.lights};
        uint32_t seed = 20110901;
        void *made = NULL;
        tl_error err;
        for (uint32_t i = 0; i < light_count; i++) {
            const tl_light light = random_light(&camera, &seed, 50.0f, 60.0f);
            add(&f.lights, &light);
        }
        const tl_status status = classic->create(&input, &made, &err);
        assert_int_equal(status, light_count == 256 ? TL_OK : TL_ERR_UNSUPPORTED);
        if (status != TL_OK)
            assert_non_null(strstr(err.message, "257 lights"));
        classic->destroy(made);
        clear(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_as_stated),
        cmocka_unit_test(hand_has_the_kernels_bits),
        cmocka_unit_test(classic_refuses_what_its_lists_cannot_hold),
    };
    return cmocka_run_group_tests(tests, make_frames, clear_frames);
}
