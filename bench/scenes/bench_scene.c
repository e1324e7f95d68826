#include "bench_scene.h"

#include "ray_cast.h"
#include "scene_lights.h"
#include "try.h"

#include <string.h>

const tl_bench_scene tl_bench_scenes[] = {
    {.name = "spheres",
     .meaning = "60 bumped spheres on a floor, a quarter of the picture sky",
     .sphere_count = 60,
     .least_radius = 0.25,
     .most_radius = 1.1,
     .low = {-8.0, 0.2, -20.0},
     .high = {8.0, 3.2, -4.0},
     .floor_end = 40.0,
     .bump = 0.3},
    {.name = "wall",
     .meaning = "one bumped wall across the view: every tile alike, no depth to speak of",
     .wall = 6.0,
     .bump = 0.3},
    {.name = "foliage",
     .meaning =
         "4000 small spheres near the eye before a wall far off: depth breaks in most tiles",
     .sphere_count = 4000,
     .least_radius = 0.02,
     .most_radius = 0.08,
     .low = {-5.0, -1.5, -6.0},
     .high = {5.0, 4.9, -2.0},
     .wall = 24.0,
     .bump = 0.3},
    {.name = "grazing",
     .meaning = "a floor to the horizon, no spheres: tiles from near to far in one column",
     .floor_end = 200.0,
     .bump = 0.3},
};
const int tl_bench_scene_count = sizeof tl_bench_scenes / sizeof tl_bench_scenes[0];

const tl_bench_material tl_bench_materials[] = {
    {"phong", "specular colour and exponent", TL_GROUP_BASE | TL_GROUP_PHONG},
    {"diffuse", "no highlights", TL_GROUP_BASE},
    {"metal-rough", "metallic and roughness", TL_GROUP_BASE | TL_GROUP_METAL_ROUGH},
    {"full", "metallic, roughness, ambient light and its occlusion, emission",
     TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE},
};
const int tl_bench_material_count = sizeof tl_bench_materials / sizeof tl_bench_materials[0];

const tl_bench_scene *tl_bench_scene_find(const char *name)
{
    for (int i = 0; i < tl_bench_scene_count; i++)
        if (strcmp(tl_bench_scenes[i].name, name) == 0)
            return &tl_bench_scenes[i];
    return NULL;
}

tl_bench_scene_options tl_bench_scene_options_default(void)
{
    return (tl_bench_scene_options){.width = 1920,
                                    .height = 1080,
                                    .material = &tl_bench_materials[0],
                                    .layer_part = 1,
                                    .light_count = 1024,
                                    .seed = 1,
                                    .lights_per_tile = 27.0};
}

/* Occlusion is of ambient light: without any it would not be read, and not all of the material lit. */
static void call_for_occlusion(const tl_bench_material *material, tl_light_set *lights)
{
    for (int i = 0; i < 3 && (material->present & TL_GROUP_OCCLUSION); i++)
        lights->ambient[i] = 0.02f;
}

tl_status tl_bench_scene_make(const tl_bench_scene *scene,
                              const tl_bench_scene_options *options,
                              tl_gbuffer **gbuffer,
                              tl_light_set *lights,
                              tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;
    TRY(tl_ray_cast(scene, options->material->present, options->width, options->height, &made,
                    err));
    TRY(tl_scene_lights(made, options, lights, err));
    call_for_occlusion(options->material, lights);
    *gbuffer = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}
