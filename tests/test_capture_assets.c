/* Does every model made by others give a G-buffer with a surface in it, but for the ones that need
 * what we lack?
 *
 * The models are in the folder TILELIGHT_ASSETS, or ../shared/assets beside the sources; without
 * either the test reports itself skipped. */
#define _XOPEN_SOURCE 700
#include "testing.h"

#include "tilelight/capture.h"

#include <ftw.h>
#include <sys/stat.h>

/* What is refused, and the word its sentence must have. */
static const struct {
    const char *path, *word;
} refused[] = {{"/Box/glTF-Draco/Box.gltf", "KHR_draco_mesh_compression"}};

enum { MAX_MODELS = 256 };
static char *models[MAX_MODELS];
static int model_count;

static int ends_with(const char *text, const char *ending)
{
    const size_t length = strlen(text), tail = strlen(ending);
    return length >= tail && strcmp(text + length - tail, ending) == 0;
}

static int note_model(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info;
    (void)place;
    if (kind == FTW_F && (ends_with(path, ".gltf") || ends_with(path, ".glb")) &&
        model_count < MAX_MODELS)
        models[model_count++] = strdup(path);
    return 0;
}

/* Fills `models`; 0 where there is no such folder. */
static int find_models(void)
{
    const char *assets = getenv("TILELIGHT_ASSETS"), *source = getenv("TILELIGHT_SOURCE");
    char beside[4096];
    struct stat info;
    snprintf(beside, sizeof beside, "%s/../shared/assets", source ? source : ".");
    if (!assets)
        assets = beside;
    if (stat(assets, &info) != 0)
        return 0;
    nftw(assets, note_model, 16, FTW_PHYS);
    return model_count > 0;
}

static const char *word_of_refusal(const char *path)
{
    for (size_t i = 0; i < COUNT_OF(refused); i++)
        if (ends_with(path, refused[i].path))
            return refused[i].word;
    return NULL;
}

static size_t surface_pixels(const tl_gbuffer *g)
{
    size_t count = 0;
    for (size_t row = 0; row < g->camera.height; row++)
        for (size_t column = 0; column < g->camera.width; column++)
            count += isfinite(tl_gbuffer_plane(g, TL_DEPTH)[row * g->pitch + column]) != 0;
    return count;
}

/* Whatever is left out of a model is told with what that means. */
static void expect_explained(void *context, const char *sentence)
{
    (void)context;
    if (strstr(sentence, "nothing is known of it"))
        fail_msg("%s", sentence);
}

static void every_model_is_captured_or_refused_by_name(void **state)
{
    (void)state;
    for (int i = 0; i < model_count; i++) {
        const tl_capture_options options = {.width = 64, .height = 36};
        const char *word = word_of_refusal(models[i]);
        tl_gbuffer *g = NULL;
        tl_light_set lights = {0};
        tl_repairs repairs;
        tl_error err = {.message = ""};
        const tl_notices notices = {expect_explained, NULL};
        const tl_status status =
            tl_capture(models[i], &options, &g, &lights, NULL, &notices, &err);
        if (word) {
            assert_int_equal(status, TL_ERR_UNSUPPORTED);
            assert_non_null(strstr(err.message, word));
            continue;
        }
        if (status != TL_OK)
            fail_msg("%s", err.message);
        ASSERT_OK(tl_gbuffer_repair(g, models[i], true, &repairs, &err), err);
        ASSERT_OK(tl_light_set_check(&lights, models[i], &err), err);
        if (surface_pixels(g) < 20)
            fail_msg("%s: %zu pixels of 2304 show a surface", models[i], surface_pixels(g));
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
    print_message("%d models\n", model_count);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_model_is_captured_or_refused_by_name)};
    if (!find_models()) {
        fprintf(stderr, "skipped: no folder of models (TILELIGHT_ASSETS)\n");
        return TL_SKIPPED;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (int i = 0; i < model_count; i++)
        free(models[i]);
    return failed;
}
