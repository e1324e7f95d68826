/* Scenes for benchmarks, computed and not captured: no OpenGL and no files, the same floats on every
 * machine, any size.
 *
 * A scene is bumped spheres before planes, seen by one camera. A family, one const struct each; the
 * bench and the tests loop over the table. */
#ifndef TL_BENCH_SCENE_H
#define TL_BENCH_SCENE_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* World space: y up, the camera at (0, 1.7, 0) m looking along -z. */
typedef struct tl_bench_scene {
    const char *name;    /* a word: a value of --scene */
    const char *meaning; /* a sentence */
    uint32_t sphere_count;
    double least_radius, most_radius; /* m */
    double low[3], high[3];           /* m; centres of the spheres lie in this box */
    double floor_end; /* m; the floor y = 0 reaches from the eye to here; 0: none */
    double wall;      /* m; distance of a wall across the view; 0: none */
    double bump;      /* how far normals lean, as a tangent at most */
} tl_bench_scene;

/* [tl_bench_scene_count]; the first is the default. */
extern const tl_bench_scene tl_bench_scenes[];
extern const int tl_bench_scene_count;

/* NULL where none has that name. */
const tl_bench_scene *tl_bench_scene_find(const char *name);

/* What surfaces are made of: the planes of the G-buffer. */
typedef struct tl_bench_material {
    const char *name;    /* a word: a value of --material */
    const char *meaning; /* a phrase */
    uint32_t present;    /* planes, bits 1 << plane */
} tl_bench_material;

/* [tl_bench_material_count]; the first is the default. */
extern const tl_bench_material tl_bench_materials[];
extern const int tl_bench_material_count;

typedef struct tl_bench_scene_options {
    uint32_t width, height; /* px */
    const tl_bench_material *material;
    uint32_t layer_count; /* that blend, before the scene: bench_layers.h */
    uint32_t layer_part;  /* of the picture that each is of: 1 all of it, 2 half, ... */
    uint32_t light_count; /* 0 to TL_MAX_SCATTERED */
    uint32_t seed;
    double lights_per_tile; /* on average of 16 px tiles, sky included, as TL_CULL_DEPTH lists
                                them; sets the range */
    double range;           /* m; 0: from lights_per_tile */
} tl_bench_scene_options;

/* 1920x1080, Phong, 1024 lights, seed 1, 27 per tile. */
tl_bench_scene_options tl_bench_scene_options_default(void);

/* The frame and its lights: point lights, linear falloff, spread evenly over what is visible. The caller
 * releases *gbuffer with tl_gbuffer_destroy and clears *lights, which is empty before. Fails with
 * TL_ERR_ARGUMENT (sizes out of range) or TL_ERR_MEMORY. */
tl_status tl_bench_scene_make(const tl_bench_scene *scene,
                              const tl_bench_scene_options *options,
                              tl_gbuffer **gbuffer,
                              tl_light_set *lights,
                              tl_error *err);

#endif
