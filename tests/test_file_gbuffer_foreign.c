/* Are G-buffers read that another program has compressed, reduced to half, or put first in a file
 * of several parts? */
#define _POSIX_C_SOURCE 200809L /* pwrite */
#include "file_cases.h"

#include "exr_recipes.h"
#include "plane_channels.h"
#include "tilelight/gbuffer_file.h"

/* 37 rows leave a partial last chunk with chunks of 16 and 32 rows. */
static const struct {
    const char *name;
    exr_recipe recipe;
} cases[] = {
    {"none, float", {.width = 35, .height = 37}},
    {"none, half", {.width = 35, .height = 37, .type = EXR_PIXEL_HALF}},
    {"rle, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_RLE}},
    {"zips, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_ZIPS}},
    {"zip, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_ZIP}},
    {"zip, half",
     {.width = 35, .height = 37, .compression = EXR_COMPRESSION_ZIP, .type = EXR_PIXEL_HALF}},
    {"piz, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_PIZ}},
    {"piz, half",
     {.width = 35, .height = 37, .compression = EXR_COMPRESSION_PIZ, .type = EXR_PIXEL_HALF}},
    /* Pxr24 rounds to 24 bits: 15 of them mantissa. Our values have 14. */
    {"pxr24, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_PXR24}},
    /* B44 packs halves only. */
    {"b44, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_B44}},
    {"b44a, float", {.width = 35, .height = 37, .compression = EXR_COMPRESSION_B44A}},
    {"first of two parts", {.width = 35, .height = 37, .second_part = 1}},
    {"first of two parts, zip",
     {.width = 35, .height = 37, .compression = EXR_COMPRESSION_ZIP, .second_part = 1}},
    {"channels of others ignored",
     {.width = 35,
      .height = 37,
      .compression = EXR_COMPRESSION_ZIP,
      .extra_channels = {"A.object", "Y", "zz"},
      .uint_channel = "A.object"}},
    {"an optional group",
     {.width = 35, .height = 37, .extra_channels = {"metallic", "roughness", "ao"}}},
};

static void values_arrive(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "foreign.exr");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_gbuffer *gbuffer = NULL;
        exr_recipe_write(&cases[i].recipe, path);
        if (tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err) != TL_OK)
            fail_msg("%s: %s", cases[i].name, err.message);
        for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++) {
            const float *plane = tl_gbuffer_plane(gbuffer, p);
            for (int y = 0; plane && y < cases[i].recipe.height; y++)
                for (int x = 0; x < cases[i].recipe.width; x++) {
                    const double wanted = (double)exr_recipe_value(tl_plane_channels[p], x, y);
                    const double got = (double)plane[(size_t)y * gbuffer->pitch + (size_t)x];
                    if (!(fabs(got - wanted) <= 0.0))
                        fail_msg("%s: %s at (%d, %d) is %g, not %g", cases[i].name,
                                 tl_plane_channels[p], x, y, got, wanted);
                }
        }
        tl_gbuffer_destroy(gbuffer);
        remove(path);
    }
}

static void optional_groups_are_found(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *gbuffer = NULL;
    const exr_recipe recipe = {
        .width = 3, .height = 2, .extra_channels = {"metallic", "roughness", "ao"}};
    scratch_path(path, sizeof path, "groups.exr");
    exr_recipe_write(&recipe, path);
    ASSERT_OK(tl_gbuffer_read(path, &gbuffer, NULL, NULL, &err), err);
    assert_int_equal(gbuffer->present,
                     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION);
    tl_gbuffer_destroy(gbuffer);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_arrive),
        cmocka_unit_test(optional_groups_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
