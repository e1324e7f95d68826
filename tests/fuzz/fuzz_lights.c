/* Lights files: does any text do more than be refused? What is read is what is written, and lights a frame
 * without a value that is no number. FUZZ_FOLDER has the pictures that texts may name. */
#include "fuzz.h"
#include "fuzz_frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SOURCE "input"
static const char file[] = FUZZ_FOLDER "/lights.json";

/* A wall 4 m away, whose every pixel faces the eye. */
static tl_gbuffer *wall(uint32_t groups)
{
    static const double eye[3] = {0.0, 1.0, 4.0}, target[3] = {0.0, 1.0, 0.0};
    static const double up[3] = {0.0, 1.0, 0.0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 5, 3, 0.1, 100.0);
    tl_gbuffer *made = NULL;
    tl_error err = {.status = TL_OK};
    fuzz_must(tl_gbuffer_create(&camera, groups, &made, &err) == TL_OK, "%s", err.message);
    for (int i = 0; i < 7; i++)
        fuzz_must(tl_material_names_add(&made->materials, i % 2 ? "steel" : "wood", &err) ==
                      TL_OK,
                  "%s", err.message);
    for (uint32_t y = 0; y < camera.height; y++)
        for (uint32_t x = 0; x < camera.width; x++) {
            const size_t at = (size_t)y * made->pitch + x;
            tl_gbuffer_plane(made, TL_DEPTH)[at] = x == y ? INFINITY : 4.0f;
            tl_gbuffer_plane(made, TL_NORMAL_Z)[at] = 1.0f;
            tl_gbuffer_plane(made, TL_ALBEDO_R)[at] = 0.5f;
            if (groups & TL_GROUP_METAL_ROUGH) {
                tl_gbuffer_plane(made, TL_METALLIC)[at] = 0.25f * (float)y;
                tl_gbuffer_plane(made, TL_ROUGHNESS)[at] = 0.25f * (float)x;
                tl_gbuffer_plane(made, TL_BRDF)[at] = (float)(x + y);
            }
        }
    fuzz_repair(made);
    return made;
}

/* The set as text, read and written again, is the same text. */
static void must_survive(const tl_light_set *lights)
{
    tl_error err = {.status = TL_OK};
    tl_light_set again = {.count = 0};
    char *first = NULL, *second = NULL;
    fuzz_must(tl_lights_format(lights, file, &first, &err) == TL_OK, "%s", err.message);
    fuzz_must(tl_lights_parse(first, strlen(first), SOURCE, file, &again, &err) == TL_OK,
              "written text is refused: %s", err.message);
    fuzz_must(tl_lights_format(&again, file, &second, &err) == TL_OK, "%s", err.message);
    fuzz_must(strcmp(first, second) == 0, "written:\n%s\nread and written:\n%s", first, second);
    free(first);
    free(second);
    tl_light_set_clear(&again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static tl_gbuffer *shiny, *matt;
    tl_error err = {.status = TL_OK};
    tl_light_set lights = {.count = 0};
    if (!shiny) {
        shiny = wall(TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_BRDF);
        matt = wall(TL_GROUP_BASE);
    }
    const tl_status status =
        tl_lights_parse((const char *)data, size, SOURCE, file, &lights, &err);
    fuzz_must_tell(status, &err, SOURCE);
    if (status == TL_OK) {
        fuzz_must(tl_light_set_check(&lights, SOURCE, &err) == TL_OK, "%s", err.message);
        must_survive(&lights);
        /* A sky that surfaces mirror takes half a minute to prepare with all that fuzzers check. */
        fuzz_light(tl_light_set_is_lit_by_sky(&lights) ? matt : shiny, &lights);
    }
    tl_light_set_clear(&lights);
    return 0;
}
