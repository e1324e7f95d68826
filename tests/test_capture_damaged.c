/* Does every model that the assimp library is tested with, many of them malformed on purpose, give a
 * picture or a refusal in one sentence that names it?
 *
 * Debian's package assimp-testmodels; without it the test reports itself skipped. */
#define _XOPEN_SOURCE 700
#include "gltf_scene.h"

#include <ftw.h>
#include <sys/stat.h>

static const tl_capture_options options = {.width = 64, .height = 48};

enum { MAX_MODELS = 1024 };
static char *models[MAX_MODELS];
static size_t model_count;

static int collect(const char *path, const struct stat *facts, int kind, struct FTW *place)
{
    const char *const dot = strrchr(path, '.');
    (void)facts;
    (void)place;
    if (kind == FTW_F && dot && (!strcmp(dot, ".gltf") || !strcmp(dot, ".glb")) &&
        model_count < MAX_MODELS)
        models[model_count++] = strdup(path);
    return 0;
}

/* Every model below the folder; false: there is no such folder. */
static int collect_below(const char *folder)
{
    struct stat facts;
    model_count = 0;
    if (stat(folder, &facts) != 0)
        return 0;
    return nftw(folder, collect, 16, FTW_PHYS) == 0;
}

static void release_models(void)
{
    for (size_t i = 0; i < model_count; i++)
        free(models[i]);
    model_count = 0;
}

static void malformed_models_are_survived(void **state)
{
    static const tl_status refused[] = {TL_ERR_FORMAT, TL_ERR_READ, TL_ERR_UNSUPPORTED};
    size_t captured = 0;
    (void)state;
    for (size_t i = 0; i < model_count; i++) {
        shot taken;
        const tl_status status = shoot(models[i], &options, &taken);
        captured += status == TL_OK;
        if (status != TL_OK && status != refused[0] && status != refused[1] &&
            status != refused[2])
            fail_msg("%s: status %d: %s", models[i], (int)status, taken.err.message);
        if (status != TL_OK &&
            (!strstr(taken.err.message, models[i]) || strchr(taken.err.message, '\n')))
            fail_msg("%s: a sentence without its name: %s", models[i], taken.err.message);
        shot_clear(&taken);
    }
    assert_in_range(captured, 1, model_count - 1); /* some of either kind are there */
    release_models();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(malformed_models_are_survived),
    };
    if (!can_capture())
        return TL_SKIPPED;
    if (!collect_below("/usr/share/assimp/models") || model_count == 0) {
        printf("skipped: no models, which assimp-testmodels would bring\n");
        return TL_SKIPPED;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
