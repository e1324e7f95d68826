#include "study_frame.h"

#include "bench_scene.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* Together they have a place for every layout: Phong pixels, metal-rough ones with all that goes with them,
 * and those without highlights; depths near and far; lights with a range and without. */
const tl_study_built_in tl_study_built_ins[] = {
    {"spheres", "bumped spheres on a floor, with highlights, under many lamps with a range",
     "spheres", "phong", 1024, 27.0, 0},
    {"grazing", "a floor to the horizon, metal-rough, with ambient light and emission",
     "grazing", "full", 1024, 27.0, 0},
    {"foliage", "leaves before a wall, no highlights, under lamps that reach everything",
     "foliage", "diffuse", 32, 27.0, 1},
};
const int tl_study_built_in_count = sizeof tl_study_built_ins / sizeof tl_study_built_ins[0];

/* So bright that half of its range away it gives what it gave. */
static void make_endless(tl_light *light)
{
    const float half_range = 0.5f * light->range;
    light->falloff = TL_FALLOFF_INVERSE_SQUARE;
    light->intensity *= 0.5f * half_range * half_range;
    light->range = INFINITY;
}

tl_status tl_study_built_in_make(const tl_study_built_in *row,
                                 uint32_t width,
                                 uint32_t height,
                                 tl_study_frame *out,
                                 tl_error *err)
{
    tl_bench_scene_options options = tl_bench_scene_options_default();
    tl_study_frame made = {.source = row->meaning};
    tl_status status = TL_OK;
    options.width = width;
    options.height = height;
    options.light_count = row->light_count;
    options.lights_per_tile = row->lights_per_tile;
    for (int i = 0; i < tl_bench_material_count; i++)
        if (strcmp(tl_bench_materials[i].name, row->material) == 0)
            options.material = &tl_bench_materials[i];
    TRY(tl_bench_scene_make(tl_bench_scene_find(row->scene), &options, &made.gbuffer,
                            &made.lights, err));
    TRY(tl_gbuffer_repair(made.gbuffer, row->name, false, NULL, err));
    for (size_t i = 0; i < made.lights.count && row->is_endless; i++)
        make_endless(&made.lights.lights[i]);
    snprintf(made.name, sizeof made.name, "%s", row->name);
    *out = made;
    made = (tl_study_frame){0};
done:
    tl_study_frame_clear(&made);
    return status;
}

tl_status tl_study_frame_identify(const tl_study_frame *frame,
                                  char text[TL_STUDY_IDENTITY_SIZE],
                                  tl_error *err)
{
    const tl_gbuffer *g = frame->gbuffer;
    const size_t size = (size_t)g->rows * g->pitch * tl_gbuffer_pixel_size(g);
    tl_status status = TL_OK;
    char *lights = NULL;
    XXH3_state_t *state = XXH3_createState();
    if (!state)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a study"));
    TRY(tl_lights_format(&frame->lights, NULL, &lights, err));
    XXH3_128bits_reset(state);
    XXH3_128bits_update(state, &g->camera, sizeof g->camera);
    XXH3_128bits_update(state, &g->present, sizeof g->present);
    XXH3_128bits_update(state, g->planes, size);
    XXH3_128bits_update(state, lights, strlen(lights));
    const XXH128_hash_t hash = XXH3_128bits_digest(state);
    snprintf(text, TL_STUDY_IDENTITY_SIZE, "%016llx%016llx", (unsigned long long)hash.high64,
             (unsigned long long)hash.low64);
done:
    XXH3_freeState(state);
    free(lights);
    return status;
}

void tl_study_frame_clear(tl_study_frame *frame)
{
    tl_gbuffer_destroy(frame->gbuffer);
    tl_light_set_clear(&frame->lights);
    *frame = (tl_study_frame){0};
}
