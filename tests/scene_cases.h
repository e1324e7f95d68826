/* Made by tests/tools/make_scene_cases.py of the scenes in data/. */
#ifndef TL_SCENE_CASES_H
#define TL_SCENE_CASES_H

#include "tilelight/scene_info.h"

static const struct {
    const char *file;
    tl_scene_meshes meshes;
    tl_scene_materials materials;
    tl_scene_images images;
    double low[3], high[3];
    size_t camera_count, file_camera_count, light_count, animation_count, curve_count;
    double longest; /* s, of its animations */
} scene_cases[] = {
    {"hall.gltf",
     {14, 14, 29, 12570, 8507, 489, 408646, 0, 0, 0, 0, 0, 0},
     {13, 13, false, {0, 0, 0, 0, 8, 3}},
     {8, 8, 256, 256, 524288},
     {-7.599999904632568, -4.2915344167226976e-08, -42.60000002384186},
     {7.599999904632568, 11.019999980926514, 2.600000023841858},
     3, 3, 418, 0, 0, 0.0},
    {"nine-lights.gltf",
     {9, 9, 9, 12814, 7187, 9, 12814, 0, 0, 0, 0, 0, 0},
     {9, 9, false, {0, 0, 0, 1, 0, 0}},
     {0, 0, 0, 0, 0},
     {-7.0, -7.152557379708213e-09, -7.0},
     {7.0, 1.799999976158142, 7.0},
     1, 1, 9, 0, 0, 0.0},
    {"fair.glb",
     {12, 12, 12, 7466, 4572, 17, 7626, 0, 0, 1, 2, 1, 5},
     {12, 12, false, {0, 0, 0, 1, 6, 0}},
     {0, 0, 0, 0, 0},
     {-8.0, 0.0, -8.0},
     {8.0, 2.5, 8.0},
     2, 2, 7, 1, 8, 4.0},
    {"hard-cases.glb",
     {25, 25, 25, 7953, 5136, 30, 8133, 0, 0, 0, 0, 0, 0},
     {15, 15, false, {0, 1, 0, 3, 1, 2}},
     {2, 2, 32, 32, 1280},
     {-12.0, -1.1920928910669204e-08, -60.0},
     {12.0, 9.0, 6.0},
     3, 3, 19, 0, 0, 0.0},
};

#endif
