#define _GNU_SOURCE
/* Are ten panes that overlap and cross (data/panes.gltf) blended as rays through them say in double, whatever
 * their order in the file? Are layers peeled until nothing is left, and is what fewer leave counted?
 *
 * Pixels that rays tell nothing of (pane_scenes.h) are left out, and few. */
#include "pane_scenes.h"

#include "tilelight/layouts.h"

enum { WIDTH = PANES_WIDTH, HEIGHT = PANES_HEIGHT };

static void panes_are_blended_as_rays_say(void **state)
{
    char *path = panes_path();
    edited_gltf file;
    size_t clear = 0, deepest = 0;
    double worst = 0.0;
    (void)state;
    assert_true(read_gltf(path, &file));
    const scene s = scene_of(&file);
    tl_gbuffer *gbuffer = captured(path, 0);
    tl_image *image = lit(gbuffer);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            hit hits[MOST_SHEETS];
            double want[3];
            size_t count;
            if (!look(&s, &gbuffer->camera, x, y, hits, &count))
                continue;
            clear++;
            blend(hits, count, want);
            count -= count > 0 && !hits[count - 1].at->blends;
            deepest = count > deepest ? count : deepest;
            for (unsigned c = 0; c < 3; c++) {
                const double got =
                    (double)tl_image_plane(image, c)[(size_t)y * image->pitch + x];
                worst = fmax(worst, fabs(got - want[c]));
                if (!(fabs(got - want[c]) <= pane_tolerance))
                    fail_msg("pixel (%u, %u), channel %u: %.9g, by rays %.9g", x, y, c, got,
                             want[c]);
            }
        }
    print_message("%zu of %d pixels, off by %.2g at most; %zu panes before one another\n",
                  clear, WIDTH * HEIGHT, worst, deepest);
    assert_true(clear > WIDTH * HEIGHT * 96 / 100);
    assert_int_equal(gbuffer->layers.count, deepest);
    assert_int_equal(gbuffer->layers.left, 0);
    tl_image_destroy(image);
    tl_gbuffer_destroy(gbuffer);
    release_gltf(&file);
    free(path);
}

/* Fewer layers are the nearest ones, and what they leave is counted by the rays too. */
static void fewer_layers_are_the_nearest(void **state)
{
    enum { FEW = 2 };
    char *path = panes_path();
    edited_gltf file;
    size_t more = 0, unclear = 0;
    (void)state;
    assert_true(read_gltf(path, &file));
    const scene s = scene_of(&file);
    tl_gbuffer *all = captured(path, 0), *few = captured(path, FEW);
    assert_int_equal(few->layers.count, FEW);
    for (uint32_t i = 0; i < FEW; i++) {
        const size_t pixels = (size_t)few->pitch * few->rows;
        assert_memory_equal(few->layers.of[i]->planes, all->layers.of[i]->planes,
                            pixels * tl_gbuffer_pixel_size(few));
        assert_memory_equal(few->layers.of[i]->opacity, all->layers.of[i]->opacity,
                            pixels * sizeof(float));
    }
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            hit hits[MOST_SHEETS];
            size_t count;
            unclear += !look(&s, &few->camera, x, y, hits, &count);
            count -= count > 0 && !hits[count - 1].at->blends;
            more += count > FEW;
        }
    print_message("%zu pixels have more, %zu by rays\n", (size_t)few->layers.left, more);
    assert_true(few->layers.left > 0);
    assert_true(fabs((double)few->layers.left - (double)more) <= (double)unclear);
    assert_true(tl_layers_left_share(few) * WIDTH * HEIGHT > (double)few->layers.left - 0.5);
    tl_gbuffer_destroy(few);
    tl_gbuffer_destroy(all);
    release_gltf(&file);
    free(path);
}

static void assert_same_frame(const tl_gbuffer *got, const tl_gbuffer *want)
{
    const size_t pixels = (size_t)want->pitch * want->rows;
    assert_int_equal(got->layers.count, want->layers.count);
    assert_memory_equal(got->planes, want->planes, pixels * tl_gbuffer_pixel_size(want));
    for (uint32_t i = 0; i < want->layers.count; i++) {
        const tl_gbuffer *a = got->layers.of[i], *b = want->layers.of[i];
        assert_memory_equal(a->planes, b->planes, pixels * tl_gbuffer_pixel_size(want));
        assert_memory_equal(a->opacity, b->opacity, pixels * sizeof(float));
    }
}

/* The scene's nodes and materials the other way round. */
static void reverse(const edited_gltf *file)
{
    json_t *nodes = json_object_get(file->json, "nodes");
    json_t *materials = json_object_get(file->json, "materials");
    json_t *meshes = json_object_get(file->json, "meshes");
    const size_t node_count = json_array_size(nodes), count = json_array_size(materials);
    json_t *turned_nodes = json_array(), *turned = json_array();
    size_t i;
    json_t *mesh;
    for (i = node_count; i-- > 0;)
        json_array_append(turned_nodes, json_array_get(nodes, i));
    for (i = count; i-- > 0;)
        json_array_append(turned, json_array_get(materials, i));
    json_array_foreach(meshes, i, mesh)
    {
        json_t *primitive = json_array_get(json_object_get(mesh, "primitives"), 0);
        const json_int_t was = json_integer_value(json_object_get(primitive, "material"));
        json_object_set_new(primitive, "material", json_integer((json_int_t)count - 1 - was));
    }
    json_object_set_new(file->json, "nodes", turned_nodes);
    json_object_set_new(file->json, "materials", turned);
}

static void order_of_the_file_is_of_no_matter(void **state)
{
    char *path = panes_path(), other[512];
    edited_gltf file;
    (void)state;
    assert_true(read_gltf(path, &file));
    tl_gbuffer *want = captured(path, 0);
    reverse(&file);
    write_gltf(&file, "panes-reversed.gltf", other);
    tl_gbuffer *got = captured(other, 0);
    assert_same_frame(got, want);
    tl_gbuffer_destroy(got);
    tl_gbuffer_destroy(want);
    release_gltf(&file);
    free(path);
}

/* Panes at one place are layers one behind the other, in an order that is not the file's. */
static void coincident_panes_are_all_there(void **state)
{
    char *path = panes_path(), one[512], other[512];
    edited_gltf file;
    size_t i;
    json_t *node, *first = NULL;
    uint64_t covered = 0;
    (void)state;
    assert_true(read_gltf(path, &file));
    json_array_foreach(json_object_get(file.json, "nodes"), i, node)
    {
        if (!gltf_blends(gltf_material_of(&file, node)))
            continue;
        if (!first)
            first = node;
        json_object_set(node, "translation", json_object_get(first, "translation"));
        json_object_set(node, "rotation", json_object_get(first, "rotation"));
        json_object_set(node, "scale", json_object_get(first, "scale"));
    }
    write_gltf(&file, "panes-coincident.gltf", one);
    reverse(&file);
    write_gltf(&file, "panes-coincident-reversed.gltf", other);
    tl_gbuffer *want = captured(one, 16), *got = captured(other, 16);
    assert_int_equal(want->layers.count, 10);
    assert_int_equal(want->layers.left, 0);
    for (size_t at = 0; at < (size_t)want->pitch * want->rows; at++) {
        const int is_there = want->layers.of[0]->opacity[at] > 0.0f;
        covered += (uint64_t)is_there;
        for (uint32_t k = 1; k < want->layers.count; k++)
            assert_int_equal(want->layers.of[k]->opacity[at] > 0.0f, is_there);
    }
    assert_true(covered > 500);
    assert_same_frame(got, want);
    tl_gbuffer_destroy(got);
    tl_gbuffer_destroy(want);
    release_gltf(&file);
    free(path);
}

/* The scene with panes of this alpha; the caller destroys it. */
static tl_gbuffer *captured_with(double alpha, const char *name)
{
    char *path = panes_path(), other[512];
    edited_gltf file;
    size_t i;
    json_t *node;
    assert_true(read_gltf(path, &file));
    json_array_foreach(json_object_get(file.json, "nodes"), i, node)
    {
        json_t *material = gltf_material_of(&file, node);
        if (gltf_blends(material))
            json_array_set_new(
                json_object_get(json_object_get(material, "pbrMetallicRoughness"),
                                "baseColorFactor"),
                3, json_real(alpha));
    }
    write_gltf(&file, name, other);
    tl_gbuffer *got = captured(other, 16);
    release_gltf(&file);
    free(path);
    return got;
}

/* A pane that hides all behind it is the last layer of its pixels; one that is not to be seen is none. */
static void panes_that_hide_all_or_nothing(void **state)
{
    (void)state;
    tl_gbuffer *opaque = captured_with(1.0, "panes-opaque.gltf"),
               *clear = captured_with(0.0, "panes-clear.gltf");
    assert_int_equal(opaque->layers.count, 1);
    assert_int_equal(clear->layers.count, 0);
    assert_int_equal(opaque->layers.left + clear->layers.left, 0);
    tl_gbuffer_destroy(clear);
    tl_gbuffer_destroy(opaque);
}

/* In every layout the surfaces of a layer lie where those of full float do, as far as its depth tells. */
static void layers_are_there_in_every_layout(void **state)
{
    char *path = panes_path();
    tl_capture_options options = {.width = 64, .height = 36};
    tl_light_set lights = {0};
    tl_gbuffer *full = NULL;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_capture(path, &options, &full, &lights, NULL, NULL, &err), err);
    for (int l = 0; l < TL_LAYOUT_COUNT; l++) {
        tl_gbuffer *packed = NULL, *got = NULL;
        options.layout = (enum tl_layout_name)l;
        ASSERT_OK(tl_capture(path, &options, &packed, &lights, NULL, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_unpack(packed, &got, &err), err);
        assert_int_equal(got->layers.count, full->layers.count);
        for (uint32_t k = 0; k < full->layers.count; k++) {
            const tl_gbuffer *a = got->layers.of[k], *b = full->layers.of[k];
            const float *x = tl_gbuffer_plane(a, TL_DEPTH), *y = tl_gbuffer_plane(b, TL_DEPTH);
            for (size_t at = 0; at < (size_t)b->pitch * b->rows; at++) {
                assert_true(same_bits(a->opacity[at], b->opacity[at]));
                if (isinf(x[at]) != isinf(y[at]) ||
                    (isfinite(y[at]) && fabsf(x[at] - y[at]) > 4e-3f * y[at]))
                    fail_msg("%s: layer %u is %g m away, not %g",
                             tl_layout_word(options.layout), k, (double)x[at], (double)y[at]);
            }
        }
        tl_gbuffer_destroy(got);
        tl_gbuffer_destroy(packed);
    }
    tl_gbuffer_destroy(full);
    tl_light_set_clear(&lights);
    free(path);
}

/* Samples are pixels of a larger picture. */
static void samples_have_layers(void **state)
{
    char *path = panes_path();
    const tl_capture_options few = {.width = WIDTH / 2, .height = HEIGHT / 2, .samples = 4};
    tl_light_set lights = {0};
    tl_gbuffer *got = NULL, *want = captured(path, 0);
    tl_error err;
    (void)state;
    ASSERT_OK(tl_capture(path, &few, &got, &lights, NULL, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(got, path, true, NULL, &err), err);
    assert_same_frame(got, want);
    for (uint32_t i = 0; i < got->layers.count; i++)
        assert_int_equal(got->layers.of[i]->samples, 4);
    tl_gbuffer_destroy(got);
    tl_gbuffer_destroy(want);
    tl_light_set_clear(&lights);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_are_blended_as_rays_say),
        cmocka_unit_test(fewer_layers_are_the_nearest),
        cmocka_unit_test(order_of_the_file_is_of_no_matter),
        cmocka_unit_test(coincident_panes_are_all_there),
        cmocka_unit_test(panes_that_hide_all_or_nothing),
        cmocka_unit_test(layers_are_there_in_every_layout),
        cmocka_unit_test(samples_have_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
