/* Are the channels of files that V-Ray wrote found, the angle of its camera, and that one of them is cut
 * short? Of the whole one every pixel is 0, so that the frame is sky.
 *
 * The files are in the folder TILELIGHT_ASSETS, or ../shared/assets beside the sources; without either the
 * test reports itself skipped. */
#define _XOPEN_SOURCE 700
#include "testing.h"

#include "foreign_exr.h"
#include "foreign_frame.h"
#include "plan.h"

#include <unistd.h>

static const char *asset(char *path, size_t size, const char *name)
{
    const char *assets = getenv("TILELIGHT_ASSETS"), *source = getenv("TILELIGHT_SOURCE");
    snprintf(path, size, "%s%s/aov/synthesis-ai/images/%s",
             assets   ? assets
             : source ? source
                      : ".",
             assets ? "" : "/../shared/assets", name);
    return path;
}

static void channels_are_found(void **state)
{
    static const struct {
        tl_import_plane plane;
        const char *first; /* NULL: not there */
    } wanted[] = {
        {TL_IMPORT_DEPTH, "Z"},          {TL_IMPORT_POSITION, NULL},
        {TL_IMPORT_NORMAL, "normals.X"}, {TL_IMPORT_ALBEDO, "diffuse.R"},
        {TL_IMPORT_SPECULAR, NULL},      {TL_IMPORT_ROUGHNESS, NULL},
        {TL_IMPORT_ALPHA, "A"},
    };
    (void)state;
    char path[4096];
    tl_error err;
    tl_import_plan plan = {0};
    const tl_import_options options = tl_import_options_default();
    ASSERT_OK(
        tl_import_plan_open(&plan, asset(path, sizeof path, "0.out.exr"), &options, NULL, &err),
        err);
    assert_int_equal(plan.width, 1780);
    assert_int_equal(plan.height, 1335);
    assert_string_equal(plan.missing, "");
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        const tl_binding *b = &plan.bindings[wanted[i].plane];
        assert_int_equal(b->is_bound, wanted[i].first != NULL);
        if (b->is_bound)
            assert_string_equal(plan.sources[0].channels[b->channels[0]].name, wanted[i].first);
    }
    assert_int_equal(plan.bindings[TL_IMPORT_NORMAL].alias->space, TL_SPACE_VIEW);
    /* Its header says 29.6108 degrees across. */
    assert_true(fabs(2.0 * atan((double)plan.camera.camera.right) * 57.29577951308232 -
                     29.6108) < 1e-4);
    assert_false(plan.camera.is_placed);
    tl_import_plan_close(&plan);
}

static void pixels_are_read(void **state)
{
    (void)state;
    char path[4096];
    tl_error err;
    tl_gbuffer *g = NULL;
    tl_import_counts counts;
    foreign_notices said = {""};
    const tl_notices notices = {foreign_say, &said};
    const tl_import_options options = tl_import_options_default();
    ASSERT_OK(tl_import_read(asset(path, sizeof path, "0.out.exr"), &options, &notices, &g,
                             &counts, &err),
              err);
    assert_int_equal(counts.sky, 1780 * 1335);
    assert_int_equal(counts.partial, 0);
    assert_non_null(strstr(said.text, "the whole frame is sky"));
    tl_gbuffer_destroy(g);
}

static void the_short_one_is_refused(void **state)
{
    static const char *const words[] = {"2.out.exr", "cut short: 6562 bytes", NULL};
    (void)state;
    char path[4096];
    tl_error err;
    tl_gbuffer *g = NULL;
    const tl_import_options options = tl_import_options_default();
    assert_refused(
        "2.out.exr",
        tl_import_read(asset(path, sizeof path, "2.out.exr"), &options, NULL, &g, NULL, &err),
        TL_ERR_UNSUPPORTED, &err, words);
    assert_null(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(channels_are_found),
        cmocka_unit_test(pixels_are_read),
        cmocka_unit_test(the_short_one_is_refused),
    };
    char path[4096];
    if (access(asset(path, sizeof path, "0.out.exr"), R_OK) != 0)
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
