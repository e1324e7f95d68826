#define _GNU_SOURCE
/* Is a scene whose surfaces blend what its surfaces are one by one, put together in double?
 *
 * The oracle captures what does not blend, and each surface that does alone and opaque, lights each in
 * double, and blends them pixel by pixel in the order of their depths. How opaque a surface is it learns of a
 * capture of that alone, too, and holds that against what alphaMode MASK leaves of it. */
#include "assets.h"
#include "edited_gltf.h"
#include "frames.h"

#include "tilelight/capture.h"

enum { WIDTH = 320, HEIGHT = 180, MOST_SURFACES = 16 };

static const double tolerance = 1e-5;  /* of the brightest pixel, or of 1 */
static const double near_depth = 2e-6; /* of a depth: nearer ones may lie the other way round */

typedef struct shot {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
} shot;

/* A capture, lit; where: the file is written to. */
static shot taken(const edited_gltf *of, const char *name, bool shadows)
{
    const tl_capture_options options = {
        .width = WIDTH, .height = HEIGHT, .all_shadows = shadows, .layers = TL_MOST_LAYERS};
    char path[512];
    shot s = {.gbuffer = NULL};
    tl_error err;
    write_gltf(of, name, path);
    ASSERT_OK(tl_capture(path, &options, &s.gbuffer, &s.lights, NULL, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(s.gbuffer, path, false, NULL, &err), err);
    return s;
}

static void release(shot *s)
{
    tl_light_set_clear(&s->lights);
    tl_gbuffer_destroy(s->gbuffer);
}

static tl_image *lit(const tl_gbuffer *gbuffer, const tl_light_set *lights, tl_precision by)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_image *image = image_like(gbuffer);
    options.precision = by;
    light_frame(NULL, &options, gbuffer, lights, image);
    return image;
}

/* --- the scene in pieces --------------------------------------------------------------------------- */

/* A copy whose JSON is its own; the file's bytes are shared. */
static edited_gltf copy_of(const edited_gltf *of)
{
    edited_gltf copy = *of;
    copy.json = json_deep_copy(of->json);
    return copy;
}

/* Takes the meshes of nodes that blend away, but for node `but`; and all others, too. */
static void leave_out(edited_gltf *of, bool others, size_t but)
{
    size_t i;
    json_t *node;
    json_array_foreach(json_object_get(of->json, "nodes"), i, node)
    {
        const json_t *material = gltf_material_of(of, node);
        if (material && i != but && (others || gltf_blends(material)))
            json_object_del(node, "mesh");
    }
}

static void set_mode(const edited_gltf *of, size_t node, const char *mode, double cutoff)
{
    json_t *material =
        gltf_material_of(of, json_array_get(json_object_get(of->json, "nodes"), node));
    json_object_set_new(material, "alphaMode", json_string(mode));
    if (cutoff > 0.0)
        json_object_set_new(material, "alphaCutoff", json_real(cutoff));
}

/* A surface that blends, alone. */
typedef struct piece {
    float *depth;   /* [rows][pitch], owned; INFINITY: nothing is there */
    float *opacity; /* the same */
    tl_image *image;
} piece;

static float *copied(const float *plane, const tl_gbuffer *like)
{
    const size_t size = (size_t)like->pitch * like->rows * sizeof *plane;
    float *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, plane, size);
    return copy;
}

static shot alone(const edited_gltf *scene, size_t node, const char *mode, double cutoff)
{
    edited_gltf one = copy_of(scene);
    leave_out(&one, true, node);
    set_mode(&one, node, mode, cutoff);
    shot s = taken(&one, "layers-alone.gltf", false);
    json_decref(one.json);
    return s;
}

/* Of opacities that lie apart from a cutoff by more than rounding. */
static void hold_against_masks(const edited_gltf *scene, size_t node, const piece *p)
{
    static const double cutoffs[] = {0.25, 0.75};
    for (size_t k = 0; k < COUNT_OF(cutoffs); k++) {
        shot s = alone(scene, node, "MASK", cutoffs[k]);
        const float *depth = tl_gbuffer_plane(s.gbuffer, TL_DEPTH);
        for (size_t at = 0; at < (size_t)s.gbuffer->pitch * s.gbuffer->rows; at++) {
            const double a = (double)p->opacity[at];
            if (fabs(a - cutoffs[k]) > 1e-6 && (a > cutoffs[k]) != isfinite(depth[at]))
                fail_msg("node %zu, pixel %zu: opacity %.7g, but %s at a cutoff of %g", node,
                         at, a, isfinite(depth[at]) ? "there" : "a hole", cutoffs[k]);
        }
        release(&s);
    }
}

static piece piece_of(const edited_gltf *scene, size_t node, const shot *whole)
{
    piece p;
    tl_error err;
    shot blended = alone(scene, node, "BLEND", 0.0), opaque = alone(scene, node, "OPAQUE", 0.0);
    assert_int_equal(blended.gbuffer->layers.count, 1);
    p.opacity = copied(blended.gbuffer->layers.of[0]->opacity, blended.gbuffer);
    p.depth = copied(tl_gbuffer_plane(opaque.gbuffer, TL_DEPTH), opaque.gbuffer);
    tl_shadow_maps_clear(&opaque.gbuffer->shadows);
    ASSERT_OK(tl_shadow_maps_copy(&whole->gbuffer->shadows, &opaque.gbuffer->shadows, &err),
              err);
    p.image = lit(opaque.gbuffer, &whole->lights, TL_PRECISION_REFERENCE);
    hold_against_masks(scene, node, &p);
    release(&opaque);
    release(&blended);
    return p;
}

static void release_piece(piece *p)
{
    free(p->depth);
    free(p->opacity);
    tl_image_destroy(p->image);
}

/* --- put together ------------------------------------------------------------------------------------ */

typedef struct fragment {
    double depth, opacity;
    size_t piece;
} fragment;

static int nearer(const void *a, const void *b)
{
    const double x = ((const fragment *)a)->depth, y = ((const fragment *)b)->depth;
    return (x > y) - (x < y);
}

/* Those at a pixel that a surface of this depth does not hide, nearest first; 0: two of them may lie the
 * other way round. */
static int gather(
    const piece *pieces, size_t count, size_t at, double behind, fragment *out, size_t *found)
{
    int is_clear = 1;
    *found = 0;
    for (size_t i = 0; i < count; i++) {
        const double depth = (double)pieces[i].depth[at];
        if (!isfinite(depth) || !(pieces[i].opacity[at] > 0.0f))
            continue;
        is_clear &= fabs(depth - behind) > near_depth * depth;
        if (depth < behind)
            out[(*found)++] = (fragment){depth, (double)pieces[i].opacity[at], i};
    }
    qsort(out, *found, sizeof *out, nearer);
    for (size_t i = 0; i + 1 < *found; i++)
        is_clear &= out[i + 1].depth - out[i].depth > near_depth * out[i].depth;
    return is_clear;
}

static double brightest(const tl_image *image)
{
    double most = 1.0;
    for (size_t at = 0; at < 3 * (size_t)image->pitch * image->rows; at++)
        most = fmax(most, (double)image->planes[at]);
    return most;
}

typedef struct tally {
    size_t clear, blended, deepest;
    double worst;
} tally;

static void compare_pixel(const tl_image *got,
                          const tl_image *behind,
                          const piece *pieces,
                          const fragment *f,
                          size_t count,
                          size_t at,
                          double most,
                          tally *t)
{
    const size_t pixels = (size_t)got->pitch * got->rows;
    t->clear++;
    t->blended += count > 0;
    t->deepest = count > t->deepest ? count : t->deepest;
    for (unsigned c = 0; c < 3; c++) {
        double want = (double)behind->planes[c * pixels + at];
        for (size_t i = count; i-- > 0;)
            want = f[i].opacity * (double)pieces[f[i].piece].image->planes[c * pixels + at] +
                   (1.0 - f[i].opacity) * want;
        const double off = fabs((double)got->planes[c * pixels + at] - want) / most;
        t->worst = fmax(t->worst, off);
        if (!(off <= tolerance))
            fail_msg("pixel (%zu, %zu), channel %u: %.9g, put together %.9g", at % got->pitch,
                     at / got->pitch, c, (double)got->planes[c * pixels + at], want);
    }
}

static tally compare(const shot *whole, const shot *back, const piece *pieces, size_t count)
{
    const tl_gbuffer *g = whole->gbuffer;
    const float *depth = tl_gbuffer_plane(back->gbuffer, TL_DEPTH);
    tl_image *got = lit(g, &whole->lights, TL_PRECISION_TWIN);
    tl_image *behind = lit(back->gbuffer, &whole->lights, TL_PRECISION_REFERENCE);
    const double most = brightest(got);
    tally t = {0};
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            fragment found[MOST_SURFACES];
            size_t found_count;
            if (gather(pieces, count, at, (double)depth[at], found, &found_count))
                compare_pixel(got, behind, pieces, found, found_count, at, most, &t);
        }
    tl_image_destroy(behind);
    tl_image_destroy(got);
    return t;
}

static void assert_is_its_parts(const edited_gltf *scene, bool shadows)
{
    piece pieces[MOST_SURFACES];
    size_t count = 0, i;
    json_t *node;
    tl_error err;
    edited_gltf others = copy_of(scene);
    shot whole = taken(scene, "layers-whole.gltf", shadows);
    leave_out(&others, false, SIZE_MAX);
    shot back = taken(&others, "layers-back.gltf", false);
    if (whole.lights.count == 0)
        ASSERT_OK(tl_light_set_add_rig(&whole.lights, &whole.gbuffer->camera, &err), err);
    tl_shadow_maps_clear(&back.gbuffer->shadows);
    ASSERT_OK(tl_shadow_maps_copy(&whole.gbuffer->shadows, &back.gbuffer->shadows, &err), err);
    json_array_foreach(json_object_get(scene->json, "nodes"), i,
                       node) if (gltf_blends(gltf_material_of(scene, node)))
    {
        assert_true(count < MOST_SURFACES);
        pieces[count++] = piece_of(scene, i, &whole);
    }
    const tally t = compare(&whole, &back, pieces, count);
    print_message("%zu surfaces blend, up to %zu in a pixel; %zu of %zu pixels, off by %.2g\n",
                  count, t.deepest, t.blended, t.clear, t.worst);
    assert_int_equal(whole.gbuffer->layers.count, t.deepest);
    assert_int_equal(whole.gbuffer->layers.left, 0);
    assert_true(t.clear > WIDTH * HEIGHT * 98 / 100);
    assert_true(t.blended > WIDTH * HEIGHT / 100);
    while (count > 0)
        release_piece(&pieces[--count]);
    json_decref(others.json);
    release(&back);
    release(&whole);
}

/* --- scenes ------------------------------------------------------------------------------------------ */

static void read_own(const char *name, edited_gltf *out)
{
    const char *source = getenv("TILELIGHT_SOURCE");
    char *path = NULL;
    assert_true(asprintf(&path, "%s/data/%s", source ? source : ".", name) > 0);
    assert_true(read_gltf(path, out));
    free(path);
}

/* Bodies that no ray enters twice become glass; lights cast shadows, on the glass as well. */
static void glass_in_lamplight_is_its_parts(void **state)
{
    static const char *const glass[] = {"middle sphere", "cone", "cylinder", "box",
                                        "small sphere"};
    edited_gltf scene;
    size_t i;
    json_t *material;
    (void)state;
    read_own("nine-lights.gltf", &scene);
    json_array_foreach(
        json_object_get(scene.json, "materials"), i,
        material) for (size_t k = 0; k < COUNT_OF(glass);
                       k++) if (strcmp(json_string_value(json_object_get(material, "name")),
                                       glass[k]) == 0)
    {
        json_t *color = json_object_get(json_object_get(material, "pbrMetallicRoughness"),
                                        "baseColorFactor");
        json_object_set_new(material, "alphaMode", json_string("BLEND"));
        json_array_set_new(color, 3, json_real(0.25 + 0.15 * (double)k));
    }
    assert_is_its_parts(&scene, true);
    release_gltf(&scene);
}

/* The file has no camera, and one that shows all would move with what is left out. */
static void add_camera(edited_gltf *scene)
{
    const json_t *first = json_object_get(scene->json, "scene");
    json_t *nodes = json_object_get(scene->json, "nodes");
    json_t *roots = json_object_get(json_array_get(json_object_get(scene->json, "scenes"),
                                                   (size_t)json_integer_value(first)),
                                    "nodes");
    json_object_set_new(scene->json, "cameras",
                        json_pack("[{s s s {s f s f s f}}]", "type", "perspective",
                                  "perspective", "yfov", 0.8, "znear", 0.1, "zfar", 50.0));
    json_array_append_new(roots, json_integer((json_int_t)json_array_size(nodes)));
    json_array_append_new(nodes,
                          json_pack("{s i s [fff] s [ffff]}", "camera", 0, "translation", -0.4,
                                    1.9, 4.5, "rotation", -0.1305, -0.0, 0.0, 0.9914));
}

static void alpha_blend_mode_test_is_its_parts(void **state)
{
    char *path = asset_path("AlphaBlendModeTest/glTF-Binary/AlphaBlendModeTest.glb");
    edited_gltf scene;
    (void)state;
    if (!read_gltf(path, &scene)) {
        free(path);
        skip();
    }
    add_camera(&scene);
    assert_is_its_parts(&scene, false);
    release_gltf(&scene);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glass_in_lamplight_is_its_parts),
        cmocka_unit_test(alpha_blend_mode_test_is_its_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
