/* Does `convert` bring a G-buffer from any layout to any other as packing in memory does, with its lights, and
 * say what was lost on the way? */
#define _GNU_SOURCE
#include "program.h"

#include "frames.h"
#include "layout.h"

#include "tilelight/error_bounds.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"

#include <jansson.h>
#include <unistd.h>

/* The scene has metal-rough materials, occlusion, emission, lights. */
static int capture(void **state)
{
    (void)state;
    enter_empty_folder("command-convert");
    expect_run("$T capture $D/hall.gltf --size 61x35 -o g.exr", 0, "", "");
    return 0;
}

static tl_gbuffer *load(const char *path, tl_light_set *lights)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_read(path, &g, lights, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_repair(g, path, false, NULL, &err), err);
    return g;
}

static tl_gbuffer *pack(const tl_gbuffer *from, enum tl_layout_name layout)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_pack(from, layout, &g, NULL, &err), err);
    return g;
}

static void assert_same_words(const char *name, const tl_gbuffer *got, const tl_gbuffer *want)
{
    assert_int_equal(got->layout, want->layout);
    assert_int_equal(got->present, want->present);
    const size_t size = (size_t)want->pitch * want->rows * tl_gbuffer_pixel_size(want);
    if (memcmp(got->planes, want->planes, size) != 0 ||
        !same_bits(got->slack_x, want->slack_x) || !same_bits(got->slack_y, want->slack_y))
        fail_msg("%s: the words of the file are not those in memory", name);
}

/* Positions stored, words of each kind,
 * and depth in few bits are lit too; without a device, by the text that devices run. */
static void convert_then_light_is_pack_then_light(void **state)
{
    static const enum tl_layout_name lit[] = {TL_LAYOUT_DXR, TL_LAYOUT_ISPC,
                                              TL_LAYOUT_COMPACT_12};
    (void)state;
    tl_light_set lights = {0};
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = TL_PRECISION_TWIN;
    tl_gbuffer *full = load("g.exr", &lights);
    for (size_t i = 0; i < COUNT_OF(lit); i++) {
        const char *word = tl_layout_word(lit[i]);
        char command[512];
        tl_error err;
        tl_image *got = NULL;
        snprintf(command, sizeof command,
                 "$T convert g.exr -o p.exr --layout %s --quiet &&"
                 "$T light p.exr -o p.lit.exr --precision twin",
                 word);
        expect_run(command, 0, "", "");
        tl_gbuffer *packed = pack(full, lit[i]);
        tl_image *want = image_like(packed);
        light_frame(NULL, &options, packed, &lights, want);
        ASSERT_OK(tl_image_read("p.lit.exr", &got, NULL, &err), err);
        assert_same_image(got, want, word);
        tl_image_destroy(want);
        tl_image_destroy(got);
        tl_gbuffer_destroy(packed);
    }
    tl_gbuffer_destroy(full);
    tl_light_set_clear(&lights);
}

/* Words, planes and how far positions lie off their rays. */
static void convert_is_pack(void **state)
{
    (void)state;
    char command[1024] = "for l in";
    for (int l = 0; l < TL_LAYOUT_COUNT; l++) {
        strcat(command, " ");
        strcat(command, tl_layout_word((enum tl_layout_name)l));
    }
    strcat(command, "; do $T convert g.exr -o $l.exr --layout $l --quiet || exit 9; done");
    expect_run(command, 0, "", "");
    tl_gbuffer *full = load("g.exr", NULL);
    for (int l = 0; l < TL_LAYOUT_COUNT; l++) {
        const char *word = tl_layout_word((enum tl_layout_name)l);
        char path[64];
        snprintf(path, sizeof path, "%s.exr", word);
        tl_gbuffer *in_memory = pack(full, (enum tl_layout_name)l), *in_file = load(path, NULL);
        assert_same_words(word, in_file, in_memory);
        tl_gbuffer_destroy(in_file);
        tl_gbuffer_destroy(in_memory);
    }
    tl_gbuffer_destroy(full);
}

static tl_gbuffer *unpack(const tl_gbuffer *from)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_unpack(from, &g, &err), err);
    ASSERT_OK(tl_gbuffer_repair(g, "unpacked", false, NULL, &err), err);
    return g;
}

enum { WIDE = 61, HIGH = 35 };

typedef struct vector {
    double of[3];
} vector;

static vector normal_at(const tl_gbuffer *g, size_t at)
{
    vector v;
    for (int i = 0; i < 3; i++)
        v.of[i] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + i))[at];
    return v;
}

static double angle_between(vector a, vector b)
{
    double across2 = 0.0, along = 0.0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double across = a.of[j] * b.of[k] - a.of[k] * b.of[j];
        across2 += across * across;
        along += a.of[i] * b.of[i];
    }
    return atan2(sqrt(across2), along);
}

static void assert_near_depth(enum tl_layout_name layout,
                              const tl_gbuffer *first,
                              const tl_gbuffer *second,
                              uint32_t column,
                              uint32_t row)
{
    const tl_camera *c = &first->camera;
    const size_t at = (size_t)row * first->pitch + column;
    const uint32_t code = tl_layouts[layout].depth.code;
    const float a = tl_gbuffer_plane(first, TL_DEPTH)[at];
    const float b = tl_gbuffer_plane(second, TL_DEPTH)[at];
    const double depth = (double)a;
    const double x =
        (double)c->left + ((double)column + 0.5) / WIDE * ((double)c->right - (double)c->left);
    const double y =
        (double)c->top - ((double)row + 0.5) / HIGH * ((double)c->top - (double)c->bottom);
    const double view[3] = {x * depth, y * depth, -depth};
    double bound[3];
    tl_position_bound(c, layout, view, bound);
    const int is_exact = code == TL_DEPTH_METRES || code == TL_DEPTH_VIEW_POSITION;
    if (is_exact ? !same_bits(a, b) : !(fabs((double)b - depth) <= bound[2]))
        fail_msg("%s: depth at (%u, %u) became %.9g from %.9g, bound %g",
                 tl_layout_word(layout), column, row, (double)b, depth, bound[2]);
}

static void assert_near_normal(enum tl_layout_name layout,
                               const tl_gbuffer *first,
                               const tl_gbuffer *second,
                               size_t at)
{
    const vector normal = normal_at(first, at);
    const double angle = angle_between(normal, normal_at(second, at));
    const double bound = tl_normal_bound(&first->camera, layout, normal.of);
    if (!(angle <= bound))
        fail_msg("%s: the normal of pixel %zu turned by %g, bound %g", tl_layout_word(layout),
                 at, angle, bound);
}

/* What was brought to a layout once and back is what the layout can say: a second time changes no colour,
 * exponent or share, and no depth that is stored as such. Normals of few bits are not unit, so making them
 * unit moves some of them a step; other depths are computed in float. Both stay within what the layout may
 * do to any value. */
static void twice_there_and_back_is_once(void **state)
{
    (void)state;
    tl_gbuffer *full = load("g.exr", NULL);
    for (int l = 0; l < TL_LAYOUT_COUNT; l++) {
        const enum tl_layout_name layout = (enum tl_layout_name)l;
        tl_gbuffer *packed = pack(full, layout), *first = unpack(packed);
        tl_gbuffer *repacked = pack(first, layout), *second = unpack(repacked);
        assert_int_equal(second->present, first->present);
        for (uint32_t i = 0; i < WIDE * HIGH; i++) {
            const size_t at = (size_t)(i / WIDE) * first->pitch + i % WIDE;
            assert_near_depth(layout, first, second, i % WIDE, i / WIDE);
            assert_near_normal(layout, first, second, at);
            for (int p = TL_ALBEDO_R; p < TL_PLANE_COUNT; p++) {
                const float *a = tl_gbuffer_plane(first, (enum tl_plane)p);
                const float *b = tl_gbuffer_plane(second, (enum tl_plane)p);
                if (a && !same_bits(a[at], b[at]))
                    fail_msg("%s: plane %d of pixel %u became %a from %a",
                             tl_layout_word(layout), p, i, (double)b[at], (double)a[at]);
            }
        }
        tl_gbuffer_destroy(second);
        tl_gbuffer_destroy(repacked);
        tl_gbuffer_destroy(first);
        tl_gbuffer_destroy(packed);
    }
    tl_gbuffer_destroy(full);
}

static void from_packed_goes_by_way_of_full_float(void **state)
{
    (void)state;
    expect_run("$T convert g.exr -o a.exr --layout compact-16 -q &&"
               "$T convert a.exr -o b.exr --layout ispc -q &&"
               "$T convert a.exr -o f.exr --layout float -q &&"
               "$T convert f.exr -o c.exr --layout ispc -q && cmp b.exr c.exr",
               0, "", "");
    /* What stays in its layout stays as it is: merlin's normals would move. */
    expect_run("$T convert g.exr -o m.exr --layout merlin -q &&"
               "$T convert m.exr -o n.exr --layout merlin && cmp m.exr n.exr &&"
               "$T convert m.exr -o f.exr --layout float &&"
               "$T convert f.exr -o o.exr --layout merlin && ! cmp -s m.exr o.exr &&"
               "$T convert g.exr -o h.exr --layout float && cmp g.exr h.exr",
               0, "", "");
    /* What reads full float only takes a packed file as such. */
    expect_run("$T scatter m.exr -o m.json && $T scatter f.exr -o f.json && cmp m.json f.json",
               0, "", "");
}

static void lights_go_along(void **state)
{
    (void)state;
    expect_run("$T convert g.exr -o p.exr --layout compact-12 &&"
               "$T convert p.exr -o f.exr --layout float",
               0, "", "");
    tl_light_set before = {0}, after = {0};
    tl_gbuffer_destroy(load("g.exr", &before));
    tl_gbuffer_destroy(load("f.exr", &after));
    assert_true(before.count > 0);
    assert_int_equal(after.count, before.count);
    assert_memory_equal(after.lights, before.lights, before.count * sizeof *before.lights);
    tl_light_set_clear(&before);
    tl_light_set_clear(&after);
    /* A file that brings none still brings none; one that says "dark" still says it. */
    tl_gbuffer *g = load("g.exr", NULL);
    const tl_light_set dark = {0};
    tl_error err;
    ASSERT_OK(tl_gbuffer_write("none.exr", g, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_write("dark.exr", g, &dark, &err), err);
    tl_gbuffer_destroy(g);
    expect_run("$T convert none.exr -o p.exr --layout merlin -q && $T info p.exr", 0,
               "no lights inside", "");
    expect_run("$T convert dark.exr -o p.exr --layout merlin -q && $T info p.exr", 0,
               "lights      0", "");
}

/* Three pixels with emission beyond RGB9E5, and one a million metres away. The eye is `away` from the
 * origin, and looks further away. */
static void write_hard_frame(const char *path, uint32_t present, double away)
{
    static const double up[3] = {0, 1, 0};
    const double eye[3] = {0.0, 0.0, -away}, ahead[3] = {0.0, 0.0, -away - 1.0};
    const tl_camera camera = tl_camera_look_at(eye, ahead, up, 1.0, 8, 8, 0.1, 1e7);
    tl_gbuffer *g = random_gbuffer(&camera, present, 7);
    tl_error err;
    for (size_t x = 0; x < 3; x++) {
        set_pixel(g, TL_DEPTH, x, 4.0f);
        set_pixel(g, TL_NORMAL_Z, x, 1.0f);
        set_pixel(g, TL_EMISSIVE_G, x, 1e6f);
    }
    set_pixel(g, TL_DEPTH, 4, 1e6f);
    set_pixel(g, TL_NORMAL_Z, 4, 1.0f);
    ASSERT_OK(tl_gbuffer_write(path, g, NULL, &err), err);
    tl_gbuffer_destroy(g);
}

static json_int_t count_surfaces(const char *path)
{
    tl_gbuffer *read = load(path, NULL), *full = unpack(read);
    json_int_t count = 0;
    for (size_t i = 0; i < (size_t)full->pitch * full->rows; i++)
        count += isfinite(tl_gbuffer_plane(full, TL_DEPTH)[i]);
    tl_gbuffer_destroy(full);
    tl_gbuffer_destroy(read);
    return count;
}

static json_int_t count_in(const char *report, const char *object, const char *key)
{
    json_error_t where;
    json_t *all = json_loads(report, JSON_REJECT_DUPLICATES, &where);
    if (!all)
        fail_msg("%s\n%s", where.text, report);
    json_t *value =
        object ? json_object_get(json_object_get(all, object), key) : json_object_get(all, key);
    const json_int_t count = json_is_integer(value) ? json_integer_value(value) : -1;
    json_decref(all);
    return count;
}

static void losses_are_said(void **state)
{
    (void)state;
    write_hard_frame("phong.exr",
                     TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
                     0.0);
    write_hard_frame("metal.exr", TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION,
                     0.0);
    write_hard_frame("away.exr", TL_GROUP_BASE, 1e5);

    const program_run *run =
        expect_run("$T convert phong.exr -o p.exr --layout compact-16", 0, "",
                   "pixels cut to what layout compact-16 can say: emissive.G 3\n");
    assert_null(strstr(run->err, "dropped"));
    run = expect_run("$T convert phong.exr -o p.exr --layout compact-16 --json -q", 0, "", "");
    assert_int_equal(count_in(run->out, "cut", "emissive.G"), 3);
    assert_int_equal(count_in(run->out, "to", "bytes_per_pixel"), 20);
    assert_int_equal(count_in(run->out, NULL, "lost"), 0);
    assert_string_equal(run->err, "");

    run = expect_run("$T convert phong.exr -o p.exr --layout shaderx2-160", 0, "",
                     "dropped, for want of a place in layout shaderx2-160: specular and "
                     "shininess, ao, emissive\n");
    assert_null(strstr(run->err, "Phong"));
    expect_run("$T convert metal.exr -o p.exr --layout merlin", 0, "",
               "p.exr: metallic and roughness became a Phong material");
    run = expect_run("$T convert metal.exr -o p.exr --layout merlin", 0, "",
                     "layout merlin: ao\n");
    run = expect_run("$T convert metal.exr -o p.exr --layout merlin --json", 0,
                     "\"became_phong\": true", "");
    /* No half says 1e6 m; and from 1e5 m on, looking away from the origin, the nearest that one can say is
     * behind the eye. */
    expect_run("$T convert metal.exr -o p.exr --layout merlin-position", 0, "", "say: Z 1\n");
    run = expect_run("$T convert away.exr -o p.exr --layout shaderx2-160", 0, "",
                     "pixels that became sky");
    run = expect_run("$T convert away.exr -o p.exr --layout shaderx2-160 --json", 0, "", "");
    assert_int_equal(count_in(run->out, NULL, "lost"), count_surfaces("away.exr"));
    assert_int_equal(count_surfaces("p.exr"), 0);
}

static void what_is_in_a_packed_file_is_said(void **state)
{
    (void)state;
    write_hard_frame("phong.exr", TL_GROUP_BASE | TL_GROUP_PHONG, 0.0);
    expect_run("$T convert phong.exr -o p.exr --layout ispc", 0, "", "");
    expect_run("$T info p.exr", 0, "ispc, 15 bytes per pixel", "");
    expect_run("$T info p.exr", 0, "uint      3", "");
    expect_run("$T info p.exr", 0, "shininess ", "");
    const program_run *run = expect_run("$T info p.exr --json", 0, "\"layout\": \"ispc\"", "");
    assert_int_equal(count_in(run->out, NULL, "bytes_per_pixel"), 15);
    expect_run("$T info phong.exr", 0, "float, 44 bytes per pixel", "");
}

static void what_cannot_be_converted_is_refused(void **state)
{
    static const struct {
        const char *command;
        int exit_status;
        const char *err_word;
    } cases[] = {
        {"$T convert phong.exr -o p.exr --layout dxr", 3,
         "phong.exr: layout dxr holds metallic and roughness"},
        {"$T convert endless.exr -o p.exr --layout tutorial", 3, "infinitely far"},
        {"$T convert endless.exr -o p.exr --layout float-fraction", 3, "choose a layout"},
        {"$T convert nan.exr -o p.exr --layout merlin --strict", 3, "nan.exr: pixel (3, 0)"},
        {"$T convert packed-nan.exr -o p.exr --layout merlin --strict", 3,
         "packed-nan.exr: pixel"},
        {"$T convert phong.exr -o phong.exr --layout float", 2, "the output is the input"},
        {"ln -s phong.exr l.exr; $T convert phong.exr -o l.exr --layout float; r=$?; rm l.exr; "
         "(exit $r)",
         2, "the output is the input"},
        {"$T convert phong.exr -o nowhere/p.exr --layout float", 5, "nowhere/p.exr"},
        {"(trap '' XFSZ; ulimit -f 1; $T convert phong.exr -o p.exr --layout float)", 5,
         "p.exr"},
        {"$T convert cut.exr -o p.exr --layout float", 3, "cut.exr"},
    };
    (void)state;
    tl_error err;
    tl_gbuffer *g;
    write_hard_frame("phong.exr", TL_GROUP_BASE | TL_GROUP_PHONG, 0.0);
    g = load("phong.exr", NULL);
    g->camera.projection = TL_ORTHOGRAPHIC;
    g->camera.far = INFINITY;
    ASSERT_OK(tl_gbuffer_write("endless.exr", g, NULL, &err), err);
    tl_gbuffer_destroy(g);
    g = load("phong.exr", NULL);
    tl_gbuffer_plane(g, TL_DEPTH)[3] = NAN;
    ASSERT_OK(tl_gbuffer_write("nan.exr", g, NULL, &err), err);
    tl_gbuffer_destroy(g);
    expect_run("$T convert phong.exr -o packed-nan.exr --layout compact-16 &&"
               "head -c 900 packed-nan.exr >cut.exr",
               0, "", "");
    g = load("packed-nan.exr", NULL);
    ((uint32_t *)tl_gbuffer_words(g, 0))[3] = 0x7fc00000;
    ASSERT_OK(tl_gbuffer_write("packed-nan.exr", g, NULL, &err), err);
    tl_gbuffer_destroy(g);
    const size_t before = count_files();
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const program_run *run =
            expect_run(cases[i].command, cases[i].exit_status, "", cases[i].err_word);
        const char *end = strchr(run->err, '\n');
        if (!end || end[1])
            fail_msg("%s: not one sentence:\n%s", cases[i].command, run->err);
        if (count_files() != before)
            fail_msg("%s: left a file behind", cases[i].command);
    }
    expect_run("$T convert nan.exr -o p.exr --layout merlin", 0, "", "1 of depth");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(convert_then_light_is_pack_then_light),
        cmocka_unit_test(convert_is_pack),
        cmocka_unit_test(twice_there_and_back_is_once),
        cmocka_unit_test(from_packed_goes_by_way_of_full_float),
        cmocka_unit_test(lights_go_along),
        cmocka_unit_test(losses_are_said),
        cmocka_unit_test(what_is_in_a_packed_file_is_said),
        cmocka_unit_test(what_cannot_be_converted_is_refused),
    };
    return cmocka_run_group_tests(tests, capture, NULL);
}
