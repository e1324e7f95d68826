/* Does a capture in any layout hold what the capture in full float shows, within the layout's bounds?
 *
 * Both are read as lighting reads them, after repair. Bounds are those of storing
 * (tilelight/error_bounds.h); what OpenGL adds is stated here. A depth buffer of its own decides anew
 * which of two surfaces within its steps of each other is seen: there, and there only, what is seen may
 * be another surface, though no depth may be farther off. */
#include "gltf_scene.h"
#include "gltf_textures.h"
#include "golden_scenes.h"
#include "packing.h"

#include "tilelight/error_bounds.h"

enum { WIDTH = 96, HEIGHT = 54 };

/* Captured in every layout, or from layout `first` on in one of `step`: textures and layouts are texts side
 * by side, and each pair of them takes the compiler as long as ten frames. */
static const struct {
    const char *scene, *camera;
    int first, step;
} views[] = {
    {"hall.gltf", "nave", 1, 3},       {"nine-lights.gltf", NULL, 2, 3},
    {"hard-cases.glb", "front", 1, 1}, {"hard-cases.glb", "endless", 1, 2}, /* no far plane */
    {"hard-cases.glb", "above", 2, 2},                                      /* orthographic */
};

/* 1 % of WIDTH x HEIGHT: surfaces that lie in one plane. */
enum { MOST_OTHER = 51 };

/* What position, normal and values are off when the shader computes them in float, beside their own size,
 * and the base-2 logarithm, which OpenGL holds to no bound, within its 8 bits. */
static const double shader_slack = 16 * 0x1p-24;

/* What a depth buffer is off: the matrix's two entries, 2 roundings on the way to clip space, the division
 * by w and the plane that is laid through three such depths, all of numbers up to 1. */
static const double buffer_slack = 16 * 0x1p-24;

/* One picture in one layout, and the same in full float. */
typedef struct pair {
    const char *name;
    enum tl_layout_name layout;
    const tl_gbuffer *seen;
    tl_gbuffer *stored, *read; /* read: stored, in full float */
    tl_word_planes words;      /* of stored */
    tl_frame frame;
    bool has_own_depth;
    uint32_t other; /* pixels that show another surface */
} pair;

static double at(const tl_gbuffer *g, int plane, size_t where)
{
    const float *const values = tl_gbuffer_plane(g, (enum tl_plane)plane);
    if (!values)
        return plane == TL_OCCLUSION ? 1.0 : 0.0;
    return (double)values[where];
}

static void three_at(const tl_gbuffer *g, int plane, size_t where, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = at(g, plane + i, where);
}

/* --- where it is ------------------------------------------------------------------------------------ */

/* How far a depth is off where the depth buffer is by buffer_slack. */
static double depth_slack(const pair *p, double depth)
{
    const tl_camera *const c = &p->seen->camera;
    const double near = (double)c->near, far = (double)c->far;
    if (!p->has_own_depth)
        return 0.0;
    if (c->projection == TL_ORTHOGRAPHIC)
        return buffer_slack * (far - near);
    const double moved = 1.0 / depth - buffer_slack * (1.0 / near - 1.0 / far);
    return moved > 0.0 ? 1.0 / moved - depth : (double)INFINITY;
}

static bool is_within_range(const pair *p, const vec3 view)
{
    const tl_camera *const c = &p->seen->camera;
    double low, high, world[3];
    tl_layout_range(c, p->layout, TL_DEPTH, &low, &high);
    if (!TL_IS_POSITION(tl_layouts[p->layout].depth.code))
        return true;
    tl_camera_world_point(c, (double[3]){(double)view.x, (double)view.y, (double)view.z},
                          world);
    for (int i = 0; i < 3; i++)
        if (fabs(world[i]) > high)
            return false;
    return fabs((double)view.x) <= high && fabs((double)view.y) <= high &&
           fabs((double)view.z) <= high;
}

/* Returns whether the pixel shows a surface in both. */
static bool check_position(const pair *p, size_t where, uint32_t x, uint32_t y)
{
    const tl_needs needs = {.present = p->stored->present,
                            .orthographic = p->seen->camera.projection == TL_ORTHOGRAPHIC,
                            .layout = p->layout};
    const float depth = tl_gbuffer_plane(p->seen, TL_DEPTH)[where];
    const tl_words words = tl_words_at(&p->words, where);
    const vec3 got = position_of(&p->frame, needs, p->words.layout, &words, (float)x, (float)y);
    const vec3 want = view_position(p->frame.rays, needs, (float)x, (float)y, depth);
    if (!isinf(depth) != !isinf(got.z))
        fail_msg("%s, %s, pixel (%u, %u): depth %g, where full float has %g", p->name,
                 tl_layout_word(p->layout), x, y, (double)-got.z, (double)depth);
    if (isinf(depth))
        return false;
    if (!is_within_range(p, want))
        return true;
    const double view[3] = {(double)want.x, (double)want.y, (double)want.z};
    const double is[3] = {(double)got.x, (double)got.y, (double)got.z};
    double bound[3], eye[3];
    tl_position_bound(&p->seen->camera, p->layout, view, bound);
    tl_camera_world_point(&p->seen->camera, (double[3]){0.0, 0.0, 0.0}, eye);
    const double length = sqrt(view[0] * view[0] + view[1] * view[1] + view[2] * view[2]) +
                          fabs(eye[0]) + fabs(eye[1]) + fabs(eye[2]);
    const double farther = depth_slack(p, (double)depth);
    for (int i = 0; i < 3; i++) {
        const double ray = needs.orthographic ? 0.0 : fabs(view[i] / view[2]);
        const double along = i == 2 ? 1.0 : ray;
        const double allowed = bound[i] + farther * along + shader_slack * length;
        if (!(fabs(is[i] - view[i]) <= allowed))
            fail_msg("%s, %s, pixel (%u, %u): position[%d] %.9g, want %.9g within %.3g",
                     p->name, tl_layout_word(p->layout), x, y, i, is[i], view[i], allowed);
    }
    return true;
}

/* --- what it is made of ------------------------------------------------------------------------------ */

/* In words of the first thing that is off; NULL: nothing is. */
static const char *fault_of_normal(const pair *p, size_t where)
{
    double want[3], got[3], across = 0.0, along = 0.0;
    three_at(p->seen, TL_NORMAL_X, where, want);
    three_at(p->read, TL_NORMAL_X, where, got);
    const bool is_none = want[0] == 0.0 && want[1] == 0.0 && want[2] == 0.0;
    if (is_none || (got[0] == 0.0 && got[1] == 0.0 && got[2] == 0.0))
        return is_none == (got[0] == 0.0 && got[1] == 0.0 && got[2] == 0.0) ? NULL
                                                                            : "no normal";
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across += pow(want[j] * got[k] - want[k] * got[j], 2.0);
        along += want[i] * got[i];
    }
    const double bound = tl_normal_bound(&p->seen->camera, p->layout, want);
    return atan2(sqrt(across), along) <= bound + shader_slack ? NULL : "normal";
}

/* As kernels/material.h says, in double. */
static void phong_of(
    const pair *p, size_t where, double albedo[3], double specular[3], double *exponent)
{
    const double metallic = at(p->seen, TL_METALLIC, where);
    const double roughness = at(p->seen, TL_ROUGHNESS, where);
    three_at(p->seen, TL_ALBEDO_R, where, albedo);
    for (int i = 0; i < 3; i++) {
        specular[i] = 0.04 + metallic * (albedo[i] - 0.04);
        if (!(p->stored->present & TL_GROUP_METAL_ROUGH))
            albedo[i] *= 1.0 - metallic;
    }
    *exponent = fmin(2.0 / pow(roughness, 4.0) - 2.0, 10000.0);
}

/* want: [3], of the planes from `plane` on, of which `count` are compared. */
static bool is_off(const pair *p, size_t where, int plane, int count, const double *want)
{
    double cut[3] = {0.0};
    if (!(p->stored->present & TL_HAS(plane)))
        return false;
    for (int i = 0; i < count; i++) {
        double low, high;
        tl_layout_range(&p->seen->camera, p->layout, (enum tl_plane)(plane + i), &low, &high);
        cut[i] = fmin(want[i], high);
    }
    for (int i = 0; i < count; i++) {
        const double bound = tl_value_bound(p->layout, (enum tl_plane)(plane + i), cut);
        const double slack = shader_slack * fmax(1.0, cut[i]);
        if (!(fabs(at(p->read, plane + i, where) - cut[i]) <= bound + slack))
            return true;
    }
    return false;
}

static const char *fault_of_values(const pair *p, size_t where)
{
    static const char *const names[] = {
#define CHANNEL_NAME(name, channel, empty, meaning) channel,
        TL_PLANES(CHANNEL_NAME)
#undef CHANNEL_NAME
    };
    double albedo[3], specular[3], emissive[3], exponent;
    phong_of(p, where, albedo, specular, &exponent);
    three_at(p->seen, TL_EMISSIVE_R, where, emissive);
    const double metallic = at(p->seen, TL_METALLIC, where),
                 roughness = at(p->seen, TL_ROUGHNESS, where),
                 occlusion = at(p->seen, TL_OCCLUSION, where);
    const struct {
        int plane, count;
        const double *want;
    } values[] = {
        {TL_ALBEDO_R, 3, albedo},      {TL_SPECULAR_R, 3, specular},
        {TL_SHININESS, 1, &exponent},  {TL_METALLIC, 1, &metallic},
        {TL_ROUGHNESS, 1, &roughness}, {TL_OCCLUSION, 1, &occlusion},
        {TL_EMISSIVE_R, 3, emissive},
    };
    for (size_t i = 0; i < COUNT_OF(values); i++)
        if (is_off(p, where, values[i].plane, values[i].count, values[i].want))
            return names[values[i].plane];
    return NULL;
}

/* --- pictures --------------------------------------------------------------------------------------- */

static void check_pixels(pair *p)
{
    for (uint32_t y = 0; y < p->seen->camera.height; y++)
        for (uint32_t x = 0; x < p->seen->camera.width; x++) {
            const size_t where = (size_t)y * p->seen->pitch + x;
            if (!check_position(p, where, x, y))
                continue;
            const char *const normal = fault_of_normal(p, where);
            const char *const fault = normal ? normal : fault_of_values(p, where);
            if (fault && !p->has_own_depth)
                fail_msg("%s, %s, pixel (%u, %u): %s", p->name, tl_layout_word(p->layout), x, y,
                         fault);
            p->other += fault != NULL;
        }
}

/* Pixels of the sky, and of padding, have the words that packing writes there. */
static void check_sky(const pair *p)
{
    const tl_words sky = tl_sky_words(&p->stored->camera, p->layout, p->stored->present);
    for (size_t where = 0; where < (size_t)p->stored->rows * p->stored->pitch; where++) {
        const tl_words words = tl_words_at(&p->words, where);
        if (isinf(tl_gbuffer_plane(p->seen, TL_DEPTH)[where]))
            assert_memory_equal(&words, &sky, sizeof sky);
    }
}

static tl_gbuffer *capture(const char *path, const char *camera, enum tl_layout_name layout)
{
    const tl_capture_options options = {
        .width = WIDTH, .height = HEIGHT, .camera = camera, .layout = layout};
    shot taken;
    ASSERT_OK(shoot(path, &options, &taken), taken.err);
    tl_light_set_clear(&taken.lights);
    ASSERT_OK(tl_gbuffer_repair(taken.gbuffer, path, false, NULL, &taken.err), taken.err);
    return taken.gbuffer;
}

/* Checks the view in one layout; returns the pixels that show another surface. */
static uint32_t check_layout(const char *path,
                             const char *camera,
                             const tl_gbuffer *seen,
                             enum tl_layout_name layout)
{
    tl_error err;
    pair p = {.name = camera ? camera : path, .layout = layout, .seen = seen};
    const tl_layout_info *const info = tl_layout_describe(layout);
    p.stored = capture(path, camera, layout);
    p.words = tl_word_planes_of(p.stored);
    ASSERT_OK(tl_gbuffer_unpack(p.stored, &p.read, &err), err);
    tl_view_set(&p.stored->camera, layout, &p.frame);
    for (uint32_t i = 0; i < info->target_count; i++)
        p.has_own_depth |= info->targets[i].format == TL_FORMAT_D24 ||
                           info->targets[i].format == TL_FORMAT_D32F;
    check_pixels(&p);
    check_sky(&p);
    tl_gbuffer_destroy(p.read);
    tl_gbuffer_destroy(p.stored);
    return p.other;
}

static bool suits(const tl_gbuffer *seen, enum tl_layout_name layout)
{
    tl_error err;
    return tl_layout_suits(&seen->camera, layout, &err) == TL_OK;
}

/* The view in full float against it in every `step`-th layout from `first` on. */
static void check_layouts(const char *path, const char *camera, int first, int step)
{
    tl_gbuffer *const seen = capture(path, camera, TL_LAYOUT_FLOAT);
    for (int i = first; i < TL_LAYOUT_COUNT; i += step) {
        const enum tl_layout_name layout = (enum tl_layout_name)i;
        const uint32_t other =
            suits(seen, layout) ? check_layout(path, camera, seen, layout) : 0;
        if (other > MOST_OTHER)
            fail_msg("%s, %s: %u pixels show another surface", path, tl_layout_word(layout),
                     other);
    }
    tl_gbuffer_destroy(seen);
}

static void captures_are_what_full_float_shows(void **state)
{
    (void)state;
    for (size_t v = 0; v < COUNT_OF(views); v++) {
        char path[4096];
        source_path(path, sizeof path, "data", views[v].scene, "");
        check_layouts(path, views[v].camera, views[v].first, views[v].step);
    }
}

/* Pixels of the picture where plane `plane` is `value`. */
static uint32_t count_of(const tl_gbuffer *g, enum tl_plane plane, float value)
{
    const float *const values = tl_gbuffer_plane(g, plane);
    uint32_t count = 0;
    for (uint32_t i = 0; i < g->camera.width * g->camera.height; i++)
        count += (uint32_t)same_bits(
            values[i / g->camera.width * g->pitch + i % g->camera.width], value);
    return count;
}

/* Writes the scene and checks it in every layout; the caller destroys what it shows in full float. */
static tl_gbuffer *check_text(char *text)
{
    char path[512];
    write_file(scratch_path(path, sizeof path, "layouts.gltf"), text, strlen(text));
    free(text);
    check_layouts(path, NULL, 1, 1);
    return capture(path, NULL, TL_LAYOUT_FLOAT);
}

/* So far away that no depth buffer tells it from infinity. */
static void distance_is_no_sky(void **state)
{
    (void)state;
    char *text = edited(square_scene(&square), ",\"zfar\":100", "");
    text = edited(text, "[0,0,4]", "[0,0,4e8]");
    tl_gbuffer *const seen =
        check_text(edited(text, "\"mesh\":0", "\"mesh\":0,\"scale\":[1e8,1e8,1]"));
    assert_in_range(count_of(seen, TL_DEPTH, INFINITY), 500, WIDTH * HEIGHT - 500);
    tl_gbuffer_destroy(seen);
}

/* Exactly there, for all numbers of both projections are whole. Neither normals nor tangents have a length,
 * so what a normal map makes of them is not a number. */
static void the_far_plane_is_no_sky_and_no_normal_stays_none(void **state)
{
    static const uint8_t texel[4] = {128, 128, 255, 255};
    square_data data = square;
    char extra[1024];
    (void)state;
    memset(data.normals, 0, sizeof data.normals);
    char *const texture = texture_json(texel, 1, 1);
    snprintf(extra, sizeof extra, "%s\"materials\"", texture);
    char *text = edited(square_scene(&data), "\"materials\"", extra);
    text = edited(text, "\"name\":\"paint\"",
                  "\"normalTexture\":{\"index\":0},\"name\":\"paint\"");
    text = edited(text, "\"znear\":0.1,\"zfar\":100", "\"znear\":1,\"zfar\":2");
    text = edited(text, "[0,0,4]", "[0,0,2]");
    tl_gbuffer *const seen = check_text(with_tangents(text, 0.0f, 1.0f));
    const uint32_t far_off = count_of(seen, TL_DEPTH, 2.0f);
    assert_int_equal(count_of(seen, TL_NORMAL_Z, 0.0f), WIDTH * HEIGHT);
    assert_in_range(far_off, 500, WIDTH * HEIGHT - 500);
    assert_int_equal(count_of(seen, TL_DEPTH, INFINITY), WIDTH * HEIGHT - far_off);
    tl_gbuffer_destroy(seen);
    free(texture);
}

/* One layout has no place for two attributes of the hall, the other has for all. */
static void what_is_dropped_is_told(void **state)
{
    static const struct {
        enum tl_layout_name layout;
        const char *told;
    } cases[] = {{TL_LAYOUT_MERLIN, "layout merlin: ao, emissive"}, {TL_LAYOUT_DXR, NULL}};
    char path[4096];
    (void)state;
    source_path(path, sizeof path, "data", "hall.gltf", "");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_capture_options options = {
            .width = WIDTH, .height = HEIGHT, .layout = cases[i].layout};
        shot taken;
        ASSERT_OK(shoot(path, &options, &taken), taken.err);
        if (cases[i].told)
            assert_non_null(strstr(taken.notices.text, cases[i].told));
        else
            assert_int_equal(taken.notices.count, 0);
        shot_clear(&taken);
    }
}

static void depth_without_a_meaning_is_refused(void **state)
{
    const tl_capture_options options = {.width = WIDTH,
                                        .height = HEIGHT,
                                        .camera = "endless",
                                        .layout = TL_LAYOUT_FLOAT_FRACTION};
    char path[4096];
    shot taken;
    (void)state;
    source_path(path, sizeof path, "data", "hard-cases.glb", "");
    assert_int_equal(shoot(path, &options, &taken), TL_ERR_UNSUPPORTED);
    assert_non_null(strstr(taken.err.message, "float-fraction"));
    shot_clear(&taken);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(captures_are_what_full_float_shows),
        cmocka_unit_test(the_far_plane_is_no_sky_and_no_normal_stays_none),
        cmocka_unit_test(distance_is_no_sky),
        cmocka_unit_test(what_is_dropped_is_told),
        cmocka_unit_test(depth_without_a_meaning_is_refused),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
