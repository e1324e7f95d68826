/* Does a capture of the ISPC project's deferred example give what its README says, whatever the order and
 * alignment of its planes, and is a file that does not keep its promises refused? */
#include "ispc_captures.h"

#include "capture_read.h"
#include "tilelight/layouts.h"

static unsigned char bytes[ISPC_MOST];

static tl_status read_bytes(size_t size, tl_captured *out, tl_error *err)
{
    char path[512];
    const tl_capture_request request = {
        .path = scratch_path(path, sizeof path, "capture-of-ispc.bin")};
    save_bytes(path, bytes, size);
    const tl_status status = tl_capture_read(&request, out, err);
    remove(path);
    return status;
}

static double depth_of(const ispc_capture *c, float z)
{
    return (double)c->proj[3][2] / ((double)z - (double)c->proj[2][2]);
}

/* Lighting reads the words as they are. */
static void assert_words(const ispc_capture *c, const tl_gbuffer *g)
{
    for (int y = 0; y < c->height; y++)
        for (int x = 0; x < c->width; x++) {
            const size_t at = (size_t)y * g->pitch + (size_t)x;
            const ispc_pixel *p = &c->pixels[y * c->width + x];
            assert_true(same_bits(((float *)tl_gbuffer_words(g, 0))[at], p->z));
            assert_int_equal(((uint16_t *)tl_gbuffer_words(g, 1))[at], p->normal[0]);
            assert_int_equal(((uint16_t *)tl_gbuffer_words(g, 2))[at], p->normal[1]);
            assert_int_equal(((uint16_t *)tl_gbuffer_words(g, 3))[at], p->amount);
            assert_int_equal(((uint16_t *)tl_gbuffer_words(g, 4))[at], p->power);
            for (uint32_t k = 0; k < 3; k++)
                assert_int_equal(((uint8_t *)tl_gbuffer_words(g, 5 + k))[at], p->albedo[k]);
        }
}

static void assert_near(const char *what, double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance))
        fail_msg("%s is %.9g, not %.9g", what, got, want);
}

/* What the words mean, to the rounding of float: the spheremap of the README, its z turned to ours. */
static void assert_meaning(const ispc_capture *c, const tl_gbuffer *unpacked)
{
    for (int i = 0; i < c->width * c->height; i++) {
        const size_t at = (size_t)(i / c->width) * unpacked->pitch + (size_t)(i % c->width);
        const ispc_pixel *p = &c->pixels[i];
        const double ex = half_value(p->normal[0]), ey = half_value(p->normal[1]);
        const double f = (ex - ex * ex) + (ey - ey * ey), m = sqrt(4 * f - 1);
        const double normal[3] = {m * (4 * ex - 2), m * (4 * ey - 2), -(3 - 8 * f)};
        const double depth = depth_of(c, p->z);
        assert_near("depth", (double)tl_gbuffer_plane(unpacked, TL_DEPTH)[at], depth,
                    1e-6 * depth * (1.0 + depth / (double)c->near * 0.1));
        for (int k = 0; k < 3; k++) {
            const float *n = tl_gbuffer_plane(unpacked, (enum tl_plane)(TL_NORMAL_X + k));
            const float *a = tl_gbuffer_plane(unpacked, (enum tl_plane)(TL_ALBEDO_R + k));
            const float *s = tl_gbuffer_plane(unpacked, (enum tl_plane)(TL_SPECULAR_R + k));
            assert_near("normal", (double)n[at], normal[k], 1e-6);
            assert_near("albedo", (double)a[at], p->albedo[k] / 255.0, 1e-7);
            assert_near("specular", (double)s[at], half_value(p->amount), 0.0);
        }
        assert_near("exponent", (double)tl_gbuffer_plane(unpacked, TL_SHININESS)[at],
                    half_value(p->power), 0.0);
    }
}

static void assert_lights(const ispc_capture *c, const tl_light_set *set)
{
    assert_int_equal(set->model, TL_MODEL_BLINN_PHONG_NORMALIZED);
    assert_int_equal(set->count, c->light_count);
    for (size_t i = 0; i < set->count; i++) {
        const tl_light *got = &set->lights[i];
        const ispc_light *want = &c->lights[i];
        assert_int_equal(got->type, TL_LIGHT_POINT);
        assert_int_equal(got->falloff, TL_FALLOFF_LINEAR);
        assert_true(same_bits(got->position[0], want->position[0]));
        assert_true(same_bits(got->position[1], want->position[1]));
        assert_true(same_bits(got->position[2], -want->position[2]));
        assert_memory_equal(got->color, want->color, sizeof got->color);
        assert_true(same_bits(got->begin, want->begin) && same_bits(got->range, want->end));
        assert_true(got->intensity == 1.0f && got->diffuse == 1.0f && got->specular == 1.0f);
    }
    for (int i = 0; i < 3; i++)
        assert_true(set->ambient[i] == 0.0f && set->sky[i] == 0.0f);
}

static void what_the_readme_says(void **state)
{
    (void)state;
    for (int reversed = 0; reversed < 2; reversed++) {
        const ispc_capture c = ispc_example(37, 21, reversed);
        tl_captured read = {0};
        tl_gbuffer *unpacked = NULL;
        tl_repairs repairs;
        tl_error err;
        ASSERT_OK(read_bytes(ispc_bytes(&c, bytes), &read, &err), err);
        const tl_camera *camera = &read.gbuffer->camera;
        assert_int_equal(read.gbuffer->layout,
                         reversed ? TL_LAYOUT_ISPC_REVERSED : TL_LAYOUT_ISPC);
        assert_near("right", (double)camera->right, 1 / (double)c.proj[0][0], 1e-7);
        assert_near("top", (double)camera->top, 1 / (double)c.proj[1][1], 1e-7);
        assert_true(camera->left == -camera->right && camera->bottom == -camera->top);
        assert_near("near", (double)camera->near, 0.5, 1e-5);
        assert_near("far", (double)camera->far, 100.0, 1e-2);
        assert_words(&c, read.gbuffer);
        assert_true(read.has_lights && read.has_look);
        assert_lights(&c, &read.lights);
        ASSERT_OK(tl_gbuffer_repair(read.gbuffer, "capture", true, &repairs, &err), err);
        assert_words(&c, read.gbuffer);
        ASSERT_OK(tl_gbuffer_unpack(read.gbuffer, &unpacked, &err), err);
        assert_meaning(&c, unpacked);
        tl_gbuffer_destroy(unpacked);
        tl_captured_clear(&read);
    }
}

/* near <= view z < far, by the header's planes, which may be narrower than the matrix'. */
static void pixels_that_do_not_count(void **state)
{
    (void)state;
    for (int reversed = 0; reversed < 2; reversed++) {
        ispc_capture c = ispc_example(8, 1, reversed);
        tl_captured read = {0};
        tl_gbuffer *unpacked = NULL;
        tl_error err;
        c.near = (float)depth_of(&c, c.pixels[1].z) * 1.000001f;
        c.pixels[2].z = c.pixels[1].z;
        c.far = 11.5f;
        c.pixels[3].z = reversed ? 0.0f : 1.0f;
        c.pixels[4].z = (float)((double)c.proj[2][2] + (double)c.proj[3][2] / 11.4999);
        c.pixels[5].z = (float)((double)c.proj[2][2] + (double)c.proj[3][2] / 11.5001);
        ASSERT_OK(read_bytes(ispc_bytes(&c, bytes), &read, &err), err);
        ASSERT_OK(tl_gbuffer_repair(read.gbuffer, "capture", true, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_unpack(read.gbuffer, &unpacked, &err), err);
        for (int i = 0; i < c.width; i++) {
            const double depth = depth_of(&c, c.pixels[i].z);
            const int counts = depth >= (double)c.near && depth < (double)c.far;
            if (isfinite(tl_gbuffer_plane(unpacked, TL_DEPTH)[i]) != counts)
                fail_msg("pixel %d, %.6f m away, %s", i, depth, counts ? "is sky" : "counts");
        }
        tl_gbuffer_destroy(unpacked);
        tl_captured_clear(&read);
    }
}

/* A light that ends at 0 reaches nothing; others cannot be made of it. */
static void lights_that_are_off(void **state)
{
    ispc_capture c = ispc_example(4, 3, 1);
    tl_captured read = {0};
    tl_error err;
    (void)state;
    c.lights[1].begin = c.lights[1].end = 0.0f;
    ASSERT_OK(read_bytes(ispc_bytes(&c, bytes), &read, &err), err);
    assert_int_equal(read.lights.count, c.light_count - 1);
    assert_true(same_bits(read.lights.lights[1].range, c.lights[2].end));
    tl_captured_clear(&read);
    c.light_count = 0;
    ASSERT_OK(read_bytes(ispc_bytes(&c, bytes), &read, &err), err);
    assert_true(read.has_lights && read.lights.count == 0);
    tl_captured_clear(&read);
}

static void every_truncation_is_refused(void **state)
{
    const ispc_capture c = ispc_example(5, 3, 0);
    const size_t size = ispc_bytes(&c, bytes);
    (void)state;
    for (size_t cut = 0; cut < size; cut++) {
        static const char *const header[] = {"is no capture", NULL};
        static const char *const rest[] = {"cut short", "promises", NULL};
        tl_captured read = {0};
        tl_error err = {.message = ""};
        assert_refused("cut", read_bytes(cut, &read, &err), TL_ERR_FORMAT, &err,
                       cut < ISPC_HEADER ? header : rest);
        assert_null(read.gbuffer);
    }
}

static void put_int(size_t at, int32_t value)
{
    memcpy(bytes + at, &value, sizeof value);
}

static void put_float(size_t at, float value)
{
    memcpy(bytes + at, &value, sizeof value);
}

static const struct {
    const char *name;
    size_t at;
    float number;  /* put there, unless */
    int32_t whole; /* this is not 0 */
    tl_status status;
    const char *words[4]; /* ends with NULL */
} refusals[] = {
    {"width", 72, 0.0f, -5, TL_ERR_FORMAT, {"no capture", "OpenEXR"}},
    {"too wide", 72, 0.0f, 16385, TL_ERR_FORMAT, {"no capture"}},
    {"wider than its planes", 72, 0.0f, 16384, TL_ERR_FORMAT, {"plane", "not within"}},
    {"height", 76, 0.0f, 0x7fffffff, TL_ERR_FORMAT, {"no capture"}},
    {"light count", 80, 0.0f, -1, TL_ERR_FORMAT, {"no capture"}},
    {"more lights than their planes", 80, 0.0f, 0x7fffffff, TL_ERR_FORMAT, {"plane 8"}},
    {"chunk size", 84, 0.0f, 7, TL_ERR_FORMAT, {"bytes behind"}},
    {"offset below", 88 + 4 * 3, 0.0f, -1, TL_ERR_FORMAT, {"plane 3", "not within"}},
    {"offset beyond", 88 + 4 * 15, 0.0f, 0x7ffffff0, TL_ERR_FORMAT, {"plane 15"}},
    {"near", 64, -1.0f, 0, TL_ERR_FORMAT, {"no capture"}},
    {"far", 68, INFINITY, 0, TL_ERR_FORMAT, {"no capture"}},
    {"far before near", 68, 0.25f, 0, TL_ERR_FORMAT, {"no capture"}},
    {"not a number", 0, NAN, 0, TL_ERR_FORMAT, {"no capture"}},
    {"mirrored", 0, -1.4f, 0, TL_ERR_FORMAT, {"-1.4", "above 0"}},
    {"off centre", 32, 0.25f, 0, TL_ERR_UNSUPPORTED, {"row 2, column 0", "0.25", "centred"}},
    {"right-handed", 44, -1.0f, 0, TL_ERR_UNSUPPORTED, {"row 2, column 3", "left-handed"}},
    {"infinite far plane", 40, 1.0f, 0, TL_ERR_UNSUPPORTED, {"finite distances"}},
    {"planes behind the camera", 56, 0.0f, 0, TL_ERR_UNSUPPORTED, {"before the camera"}},
};

static void broken_promises_are_named(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(refusals); i++) {
        const ispc_capture c = ispc_example(5, 3, 0);
        const size_t size = ispc_bytes(&c, bytes);
        tl_captured read = {0};
        tl_error err = {.message = ""};
        if (refusals[i].whole)
            put_int(refusals[i].at, refusals[i].whole);
        else
            put_float(refusals[i].at, refusals[i].number);
        assert_refused(refusals[i].name, read_bytes(size, &read, &err), refusals[i].status,
                       &err, refusals[i].words);
        assert_null(read.gbuffer);
    }
}

static void bad_lights_are_named(void **state)
{
    static const struct {
        float begin, end, color, x;
        const char *word;
    } cases[] = {
        {1.0f, NAN, 1.0f, 0.0f, "range"},       {3.0f, 2.0f, 1.0f, 0.0f, "begin"},
        {-1.0f, 2.0f, 1.0f, 0.0f, "begin"},     {1.0f, -2.0f, 1.0f, 0.0f, "range"},
        {1.0f, INFINITY, 1.0f, 0.0f, "range"},  {1.0f, 2.0f, -1.0f, 0.0f, "color"},
        {1.0f, 2.0f, 1.0f, NAN, "position[0]"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        ispc_capture c = ispc_example(2, 2, 1);
        const char *const words[] = {"lights[7]", cases[i].word, NULL};
        tl_captured read = {0};
        tl_error err = {.message = ""};
        c.lights[7] = (ispc_light){.begin = cases[i].begin,
                                   .end = cases[i].end,
                                   .color = {cases[i].color, 1.0f, 1.0f},
                                   .position = {cases[i].x, 0.0f, 1.0f}};
        assert_refused(cases[i].word, read_bytes(ispc_bytes(&c, bytes), &read, &err),
                       TL_ERR_FORMAT, &err, words);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_the_readme_says),
        cmocka_unit_test(pixels_that_do_not_count),
        cmocka_unit_test(lights_that_are_off),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(broken_promises_are_named),
        cmocka_unit_test(bad_lights_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
