/* Does anisotropic filtering keep what a texture seen aslant shows across its slant, to the degree that was
 * asked for, and leave alone what it should?
 *
 * The square fills the picture under an orthographic camera, 64 pixels a side. A pixel's footprint on the
 * texture is 1 texel by `slant`, and the texture the same all along the slant, so that what is right is known:
 * its stripes, blurred no more than the degree of anisotropy calls for. */
#include "gltf_textures.h"

enum { SIZE = 64, STRIPES = 8, LENGTH = 64 };

static const uint8_t stripes[STRIPES] = {40, 40, 200, 200, 120, 10, 250, 60};

enum { NEAREST = 9728, LINEAR = 9729, LINEAR_MIPMAP_LINEAR = 9987 };

/* A texture of stripes, green: roughness. across: they follow each other along u, else along v. */
static char *stripes_json(int across)
{
    uint8_t rgba[4 * STRIPES * LENGTH];
    for (size_t i = 0; i < STRIPES * LENGTH; i++) {
        const uint8_t pixel[4] = {0, stripes[across ? i % STRIPES : i / LENGTH], 0, 255};
        memcpy(rgba + 4 * i, pixel, 4);
    }
    return texture_json(rgba, across ? STRIPES : LENGTH, across ? LENGTH : STRIPES);
}

/* Where the coordinates of the square lie on the texture. */
typedef struct lie {
    const char *name;
    int across;
    double u[2], v[2]; /* texels by pixel column and row */
} lie;

/* The square's texture coordinates run from 0 to 1 over the picture's columns and rows. */
static char *striped_scene(const lie *at, int min_filter)
{
    const double width = at->across ? STRIPES : LENGTH, height = at->across ? LENGTH : STRIPES;
    square_data data = square;
    char part[128];
    for (int k = 0; k < 4; k++) {
        const double column = SIZE * (double)square.coordinates[k][0];
        const double row = SIZE * (double)square.coordinates[k][1];
        data.coordinates[k][0] = (float)((at->u[0] * column + at->u[1] * row) / width);
        data.coordinates[k][1] = (float)((at->v[0] * column + at->v[1] * row) / height);
    }
    char *const json = stripes_json(at->across);
    char *const extra = malloc(strlen(json) + 64);
    assert_non_null(extra);
    sprintf(extra, "%s\"materials\"", json);
    char *text = square_scene(&data);
    text = edited(
        text, "\"perspective\",\n \"perspective\":{\"yfov\":1.0,\"znear\":0.1,\"zfar\":100}",
        "\"orthographic\",\n \"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0,"
        "\"zfar\":10}");
    text = edited(text, "\"materials\"", extra);
    snprintf(part, sizeof part, "\"magFilter\":%d,\"minFilter\":%d", LINEAR, min_filter);
    text = edited(text, "\"magFilter\":9728,\"minFilter\":9728", part);
    text = edited(text, "\"wrapS\":33071", "\"wrapS\":10497");
    text = edited(text, "\"roughnessFactor\":0.625",
                  "\"roughnessFactor\":1,\"metallicRoughnessTexture\":{\"index\":0}");
    free(extra);
    free(json);
    return text;
}

static void capture_ok(const char *text, uint32_t anisotropy, shot *taken)
{
    const tl_capture_options options = {
        .width = SIZE, .height = SIZE, .anisotropy = anisotropy};
    ASSERT_OK(shoot_text("filtering", text, &options, taken), taken->err);
}

/* --- oracle ------------------------------------------------------------------------------------ */

/* The stripes at mip level `level`, between texels: `place` in texels of level 0. */
static double stripe_at(int level, double place)
{
    double values[STRIPES];
    int count = STRIPES;
    for (int i = 0; i < STRIPES; i++)
        values[i] = stripes[i] / 255.0;
    for (; level > 0 && count > 1; level--, count /= 2, place /= 2)
        for (int i = 0; i < count / 2; i++)
            values[i] = 0.5 * (values[2 * i] + values[2 * i + 1]);
    const double from = place - 0.5, first = floor(from);
    const int left = (int)first % count + (first < 0 ? count : 0);
    return values[left % count] +
           (from - first) * (values[(left + 1) % count] - values[left % count]);
}

/* The level whose texels are as wide as the footprint, or as its length over the looks: EXT_texture_filter_
 * anisotropic, for footprints and degrees that are powers of two. */
static int level_of(int slant, int anisotropy)
{
    int level = 0;
    for (int width = slant / anisotropy; width > 1; width /= 2)
        level++;
    return level;
}

/* --- questions --------------------------------------------------------------------------------- */

/* Half a step of 65535 for each level that is made; float's roundings of coordinates of up to 1024 texels, by
 * the steepest slope between stripes. */
static const double bound = 7 * 0.5 / 65535 + 1024 * 4 * 0x1p-24 * 250 / 255;

static const double half_turn_8th = 0.70710678118654752;

static void stripes_stay_as_sharp_as_asked(void **state)
{
    static const int slants[] = {1, 2, 8, 16}, degrees[] = {1, 4, 16};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(slants) * COUNT_OF(degrees) * 3; i++) {
        const int slant = slants[i % COUNT_OF(slants)];
        const int degree = degrees[i / COUNT_OF(slants) % COUNT_OF(degrees)];
        const double s = slant, c = half_turn_8th;
        const lie lies[3] = {{"down", 1, {1, 0}, {0, s}},
                             {"across", 0, {s, 0}, {0, 1}},
                             {"oblique", 1, {c, -c}, {s * c, s * c}}};
        const lie *const at = &lies[i / COUNT_OF(slants) / COUNT_OF(degrees)];
        /* Without anisotropy the level is the driver's, which takes the larger of |du| and |dv| alone. */
        if (degree == 1 && at == &lies[2])
            continue;
        char *const text = striped_scene(at, LINEAR_MIPMAP_LINEAR);
        shot taken;
        capture_ok(text, (uint32_t)degree, &taken);
        for (uint32_t y = 3; y < SIZE; y += 29)
            for (uint32_t x = 0; x < SIZE; x++) {
                const double *const axis = at->across ? at->u : at->v;
                const double place = axis[0] * (x + 0.5) + axis[1] * (y + 0.5);
                const double want = stripe_at(level_of(slant, degree), place);
                const double got = (double)shown_at(&taken, TL_ROUGHNESS, x, y);
                if (!(fabs(got - want) <= bound))
                    fail_msg("%s, slant %d, degree %d, pixel %u, %u: got %.7f, want %.7f",
                             at->name, slant, degree, x, y, got, want);
            }
        shot_clear(&taken);
        free(text);
    }
}

static void assert_same_shots(const char *name, const shot *a, const shot *b)
{
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++)
            if (!same_bits(shown_at(a, TL_ROUGHNESS, x, y), shown_at(b, TL_ROUGHNESS, x, y)))
                fail_msg("%s: pixel %u, %u: %.9g without, %.9g with", name, x, y,
                         (double)shown_at(a, TL_ROUGHNESS, x, y),
                         (double)shown_at(b, TL_ROUGHNESS, x, y));
}

/* Textures without mipmaps, and those whose texels are larger than pixels. */
static const struct {
    const char *name;
    int min_filter;
    lie at;
} alone[] = {
    {"nearest", NEAREST, {"", 1, {2.7, 0}, {0, 1}}},
    {"linear", LINEAR, {"", 1, {2.7, 0}, {0, 1}}},
    {"magnified", LINEAR_MIPMAP_LINEAR, {"", 1, {0.25, 0}, {0, 0.25}}},
    {"magnified aslant", LINEAR_MIPMAP_LINEAR, {"", 1, {0.0625, 0}, {0, 0.5}}},
    {"magnified, nearest mipmap", 9984, {"", 1, {0.25, 0}, {0, 0.25}}},
    {"a texel to a pixel", LINEAR_MIPMAP_LINEAR, {"", 1, {1, 0}, {0, 1}}},
};

static void what_has_no_slant_is_left_alone(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(alone); i++) {
        char *const text = striped_scene(&alone[i].at, alone[i].min_filter);
        shot without, with;
        capture_ok(text, 1, &without);
        capture_ok(text, 16, &with);
        assert_same_shots(alone[i].name, &without, &with);
        shot_clear(&without);
        shot_clear(&with);
        free(text);
    }
}

static void the_default_is_the_highest(void **state)
{
    const lie at = {"", 1, {1, 0}, {0, 16}};
    char *const text = striped_scene(&at, LINEAR_MIPMAP_LINEAR);
    shot named, default_one;
    (void)state;
    capture_ok(text, TL_MAX_ANISOTROPY, &named);
    capture_ok(text, 0, &default_one);
    assert_same_shots("default", &named, &default_one);
    shot_clear(&named);
    shot_clear(&default_one);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stripes_stay_as_sharp_as_asked),
        cmocka_unit_test(what_has_no_slant_is_left_alone),
        cmocka_unit_test(the_default_is_the_highest),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
