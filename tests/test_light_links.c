/* Does a light that is linked to objects light those alone, bit for bit as if it were there for them and not
 * for others, by every path and width, in bands, through layers, and within what `check` allows? By any
 * number of links, and ids that floats would round? Do ids, names and links come back from files, and is what
 * does not fit refused in a sentence that says what there is?
 *
 * The oracle lights the frame once for each object, by the lights that are for it, which are linked to
 * nothing. */
#include "device.h"
#include "layered_frames.h"

#include "lighting_state.h"

#include "tilelight/check.h"
#include "tilelight/gbuffer_file.h"

enum { WIDTH = 70, HEIGHT = 41, LAMPS = 40, LAYERS = 2 };
static const uint32_t present = TL_GROUP_BASE | TL_GROUP_PHONG;

/* The second and the third are one number to a float. */
static const struct {
    uint32_t id;
    const char *name;
} objects[] = {{7, "Lamp 1"},           {16777216, "Lamp 2"}, {16777217, "Wall*"},
               {2147483649u, "Wall 2"}, {4294967295u, NULL},  {0, NULL}};

typedef struct frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    uint8_t lit[LAMPS][COUNT_OF(objects)]; /* whether lamp i is for object k */
} frame;

static void add_ids(tl_gbuffer *g, uint32_t seed)
{
    tl_error err;
    ASSERT_OK(tl_ids_add(g, &err), err);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            g->ids[(size_t)y * g->pitch + x] =
                objects[(uint32_t)uniform(&seed, 0.0f, (float)COUNT_OF(objects) - 0.01f)].id;
}

static void name_objects(tl_gbuffer *g)
{
    tl_error err;
    for (size_t k = 0; k < COUNT_OF(objects); k++)
        if (objects[k].name)
            ASSERT_OK(tl_objects_add(&g->objects, objects[k].id, objects[k].name, &err), err);
}

/* Links by names, patterns and ids; and one for each lamp from the eighth on, so that there are more than
 * a word has bits. */
static const struct {
    int except;
    size_t count;
    tl_link_object of[2];
    uint32_t which; /* bits 1 << object that it lights */
} links[] = {
    {0, 1, {{0, "Lamp*"}}, 1u << 0 | 1u << 1},
    {1, 1, {{0, "Lamp ?"}}, ~(1u << 0 | 1u << 1)},
    {0, 1, {{0, "Wall*"}}, 1u << 2}, /* it is called so, and another fits */
    {0, 2, {{16777217, ""}, {0, "Wall 2"}}, 1u << 2 | 1u << 3},
    {1, 1, {{4294967295u, ""}}, ~(1u << 4)},
    {0, 1, {{0, ""}}, 1u << 5},
    {0, 2, {{12345, ""}, {16777216, ""}}, 1u << 1},
};

static void link_lamp(frame *f, int i, tl_light *light)
{
    tl_error err;
    uint32_t which = ~0u;
    if (i == 7)
        goto done; /* to all */
    if (i < 8) {
        const size_t k = (size_t)i % COUNT_OF(links);
        tl_link_object of[2] = {links[k].of[0], links[k].of[1]};
        const tl_light_link link = {links[k].except, links[k].count, of};
        ASSERT_OK(tl_light_set_add_link(&f->lights, &link, &light->link, &err), err);
        which = links[k].which;
    } else {
        tl_link_object of[2] = {{(uint32_t)(1000 + i), ""}, {objects[i % 5].id, ""}};
        const tl_light_link link = {i % 2, 2, of};
        ASSERT_OK(tl_light_set_add_link(&f->lights, &link, &light->link, &err), err);
        which = i % 2 ? ~(1u << (i % 5)) : 1u << (i % 5);
    }
done:
    for (size_t k = 0; k < COUNT_OF(objects); k++)
        f->lit[i][k] = which >> k & 1u;
}

static frame take(uint32_t layers)
{
    uint32_t seed = 5;
    tl_error err;
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    frame f = {.gbuffer = layered_gbuffer(&camera, present, layers, 11)};
    add_ids(f.gbuffer, 3);
    name_objects(f.gbuffer);
    for (uint32_t i = 0; i < layers; i++)
        add_ids(f.gbuffer->layers.of[i], 17 + i);
    for (int i = 0; i < LAMPS; i++) {
        tl_light light = random_light(&camera, &seed, 3.0f, 9.0f);
        if (i % 9 == 0)
            light.range = INFINITY, light.falloff = TL_FALLOFF_INVERSE_SQUARE;
        snprintf(light.name, sizeof light.name, "lamp %d", i);
        link_lamp(&f, i, &light);
        ASSERT_OK(tl_light_set_add(&f.lights, &light, &err), err);
    }
    f.lights.ambient[1] = 0.125f;
    return f;
}

static void release(frame *f)
{
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

static tl_lighting_options options_of(tl_precision precision)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.cull = TL_CULL_NONE; /* a program less */
    options.precision = precision;
    return options;
}

static tl_image *lit(tl_device *device,
                     const tl_lighting_options *options,
                     const frame *f,
                     const tl_light_set *lights)
{
    tl_image *image = image_like(f->gbuffer);
    light_frame(device, options, f->gbuffer, lights, image);
    return image;
}

/* The lights that are for object k, linked to nothing; their memory is the caller's to free. */
static tl_light_set lights_for(const frame *f, size_t k)
{
    tl_light_set some = f->lights;
    some.lights = malloc(LAMPS * sizeof *some.lights);
    assert_non_null(some.lights);
    some.count = 0;
    for (int i = 0; i < LAMPS; i++)
        if (f->lit[i][k]) {
            some.lights[some.count] = f->lights.lights[i];
            some.lights[some.count++].link = 0;
        }
    return some;
}

static void each_object_has_its_lights(void **state)
{
    static const tl_precision precisions[] = {TL_PRECISION_TWIN, TL_PRECISION_REFERENCE};
    frame f = take(0);
    (void)state;
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        const tl_lighting_options options = options_of(precisions[p]);
        tl_image *got = lit(NULL, &options, &f, &f.lights);
        size_t seen = 0;
        for (size_t k = 0; k < COUNT_OF(objects); k++) {
            tl_light_set some = lights_for(&f, k);
            tl_image *want = lit(NULL, &options, &f, &some);
            for (uint32_t y = 0; y < HEIGHT; y++)
                for (uint32_t x = 0; x < WIDTH; x++) {
                    const size_t at = (size_t)y * got->pitch + x;
                    if (f.gbuffer->ids[at] != objects[k].id)
                        continue;
                    seen++;
                    for (unsigned c = 0; c < 3; c++)
                        if (!same_bits(tl_image_plane(got, c)[at], tl_image_plane(want, c)[at]))
                            fail_msg("object %u at (%u, %u): %a, want %a", objects[k].id, x, y,
                                     (double)tl_image_plane(got, c)[at],
                                     (double)tl_image_plane(want, c)[at]);
                }
            tl_image_destroy(want);
            free(some.lights);
        }
        assert_int_equal(seen, WIDTH * HEIGHT);
        tl_image_destroy(got);
    }
    release(&f);
}

static const struct {
    tl_path path;
    uint32_t width, tile;
    uint64_t memory; /* bytes; 0: no limit */
} ways[] = {
    {TL_PATH_CPU, 16, 16, 0},
    {TL_PATH_CPU, 16, 16, 78000},
    {TL_PATH_GPU, 1, 32, 0},
};

static void every_way_has_the_same_bits(void **state)
{
    frame f = take(LAYERS);
    tl_lighting_options options = options_of(TL_PRECISION_TWIN);
    tl_image *want = lit(NULL, &options, &f, &f.lights);
    options.precision = TL_PRECISION_FLOAT;
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        options.path = ways[i].path;
        options.vector_width = ways[i].width;
        options.tile_size = ways[i].tile;
        options.memory_limit = ways[i].memory;
        tl_image *got = image_like(f.gbuffer);
        const tl_lighting_counts counts =
            light_frame(*state, &options, f.gbuffer, &f.lights, got);
        assert_int_equal(counts.band_count > 1, ways[i].memory > 0);
        assert_same_image(got, want, i == 1 ? "bands" : i == 2 ? "gpu" : "cpu");
        tl_image_destroy(got);
    }
    tl_image_destroy(want);
    release(&f);
}

/* A device with memory of its own has a band's rows alone, but the bits of all pixels. */
static void bands_that_are_copied_have_the_same_bits(void **state)
{
    tl_device *device = *state;
    const int shared = device->shares_memory;
    frame f = take(LAYERS);
    tl_lighting_options options = options_of(TL_PRECISION_TWIN);
    tl_image *want = lit(NULL, &options, &f, &f.lights), *got = image_like(f.gbuffer);
    options.precision = TL_PRECISION_FLOAT;
    options.path = TL_PATH_CPU;
    options.vector_width = 16;
    device->shares_memory = 0;
    const tl_lighting_counts whole = light_frame(device, &options, f.gbuffer, &f.lights, got);
    options.memory_limit = whole.device_bytes / (LAYERS + 2);
    const tl_lighting_counts parts = light_frame(device, &options, f.gbuffer, &f.lights, got);
    device->shares_memory = shared;
    assert_true(parts.band_count > 1);
    assert_same_image(got, want, "copied bands");
    tl_image_destroy(got);
    tl_image_destroy(want);
    release(&f);
}

static void a_check_follows_links(void **state)
{
    frame f = take(LAYERS);
    const tl_lighting_options options = options_of(TL_PRECISION_TWIN);
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_check_create(f.gbuffer, &f.lights, 0.0f, TL_COSINE_STABLE, &check, &err), err);
    tl_image *got = lit(NULL, &options, &f, &f.lights);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    assert_int_equal(report.failed_count, 0);
    tl_image_destroy(got);
    for (size_t i = 0; i < f.lights.count; i++)
        f.lights.lights[i].link = 0;
    got = lit(NULL, &options, &f, &f.lights);
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    assert_true(report.failed_count > WIDTH * HEIGHT / 4);
    tl_image_destroy(got);
    tl_check_destroy(check);
    release(&f);
}

static void lights_without_links_pay_nothing(void **state)
{
    frame f = take(0);
    tl_prepared with = {0}, without = {0}, none = {0};
    const tl_prepare_options options = {.tile_size = 16};
    tl_error err;
    (void)state;
    ASSERT_OK(tl_prepare(f.gbuffer, &f.lights, &options, NULL, &with, &err), err);
    for (size_t i = 0; i < f.lights.count; i++)
        f.lights.lights[i].link = 0;
    ASSERT_OK(tl_prepare(f.gbuffer, &f.lights, &options, NULL, &without, &err), err);
    free(f.gbuffer->ids);
    f.gbuffer->ids = NULL;
    ASSERT_OK(tl_prepare(f.gbuffer, &f.lights, &options, NULL, &none, &err), err);
    assert_int_equal(with.needs.shapes, TL_SHAPE_LINK);
    assert_true((with.explanation.effects & TL_ON(TL_EFFECT_LINKS)) != 0);
    assert_memory_equal(&without.needs, &none.needs, sizeof none.needs);
    assert_int_equal(without.needs.shapes, 0);
    assert_int_equal(without.sections_size, 0);
    assert_int_equal(tl_prepared_buffer_size(&without), tl_prepared_buffer_size(&none));
    tl_prepared_clear(&with);
    tl_prepared_clear(&without);
    tl_prepared_clear(&none);
    release(&f);
}

static void ids_and_links_come_back_from_files(void **state)
{
    frame f = take(LAYERS);
    char path[512], *text = NULL;
    tl_gbuffer *read = NULL;
    tl_light_set brought = {0};
    bool has = false;
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "links.exr");
    ASSERT_OK(tl_gbuffer_write(path, f.gbuffer, &f.lights, &err), err);
    ASSERT_OK(tl_gbuffer_read(path, &read, &brought, &has, &err), err);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        const size_t row = (size_t)y * read->pitch;
        assert_memory_equal(read->ids + row, f.gbuffer->ids + row, WIDTH * sizeof(uint32_t));
        assert_memory_equal(read->layers.of[1]->ids + row, f.gbuffer->layers.of[1]->ids + row,
                            WIDTH * sizeof(uint32_t));
    }
    assert_int_equal(read->objects.count, f.gbuffer->objects.count);
    for (uint32_t i = 0; i < read->objects.count; i++) {
        assert_int_equal(read->objects.of[i].id, f.gbuffer->objects.of[i].id);
        assert_string_equal(read->objects.of[i].name, f.gbuffer->objects.of[i].name);
    }
    assert_int_equal(brought.link_count, f.lights.link_count);
    for (size_t i = 0; i < brought.count; i++)
        assert_int_equal(brought.lights[i].link, f.lights.lights[i].link);
    for (size_t i = 0; i < brought.link_count; i++) {
        assert_int_equal(brought.links[i].except, f.lights.links[i].except);
        assert_memory_equal(brought.links[i].of, f.lights.links[i].of,
                            brought.links[i].count * sizeof *brought.links[i].of);
    }
    ASSERT_OK(tl_lights_format(&brought, NULL, &text, &err), err);
    assert_non_null(strstr(text, "\"link\": { \"only\": [16777217, \"Wall 2\"] }"));
    free(text);
    tl_gbuffer_destroy(read);
    tl_light_set_clear(&brought);
    remove(path);
    release(&f);
}

static void what_does_not_fit_is_refused(void **state)
{
    static const struct {
        const char *link, *sentence;
    } cases[] = {
        {"7", "\"link\" must be an object with one of \"only\" and \"except\""},
        {"{}", "\"link\" must be an object with one of"},
        {"{\"only\": [1], \"except\": [2]}", "\"link\" must be an object with one of"},
        {"{\"exept\": [1]}", "unknown field \"exept\""},
        {"{\"only\": []}", "\"only\" must list 1 to 1000000 objects"},
        {"{\"only\": 3}", "\"only\" must list 1 to 1000000 objects"},
        {"{\"only\": [-1]}", "must list names and ids, whole numbers from 0 to 4294967295"},
        {"{\"only\": [4294967296]}", "must list names and ids"},
        {"{\"only\": [1.5]}", "must list names and ids"},
        {"{\"except\": [\"\"]}", "a name of an object has 1 to 127 bytes"},
    };
    tl_light_set set = {0};
    frame f = take(0);
    tl_prepared prepared = {0};
    const tl_prepare_options options = {.tile_size = 16};
    tl_link_object of = {0, "Lampe 1"};
    const tl_light_link link = {0, 1, &of};
    tl_error err;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char text[512];
        snprintf(
            text, sizeof text,
            "{\"tilelight\": 1, \"lights\": [{\"type\": \"point\", \"position\": [0, 0, 0], "
            "\"link\": %s}]}",
            cases[i].link);
        assert_int_equal(tl_lights_parse(text, strlen(text), "l.json", NULL, &set, &err),
                         TL_ERR_FORMAT);
        if (!strstr(err.message, cases[i].sentence))
            fail_msg("%s: %s", cases[i].link, err.message);
    }
    ASSERT_OK(tl_light_set_add_link(&f.lights, &link, &f.lights.lights[5].link, &err), err);
    assert_int_equal(tl_prepare(f.gbuffer, &f.lights, &options, NULL, &prepared, &err),
                     TL_ERR_FORMAT);
    assert_non_null(strstr(err.message,
                           "light \"lamp 5\" is linked to \"Lampe 1\", and the capture "
                           "has no such object: did you mean \"Lamp 1\"?; it has Lamp 1 "
                           "(7), Lamp 2 (16777216)"));
    free(f.gbuffer->ids);
    f.gbuffer->ids = NULL;
    assert_int_equal(tl_prepare(f.gbuffer, &f.lights, &options, NULL, &prepared, &err),
                     TL_ERR_FORMAT);
    assert_non_null(
        strstr(err.message, "does not tell any apart: capture the scene with --ids"));
    tl_prepared_clear(&prepared);
    release(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_object_has_its_lights),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(bands_that_are_copied_have_the_same_bits),
        cmocka_unit_test(a_check_follows_links),
        cmocka_unit_test(lights_without_links_pay_nothing),
        cmocka_unit_test(ids_and_links_come_back_from_files),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
