/* From a glTF scene to a G-buffer: the half of tilelight that needs OpenGL (OSMesa) and no
 * OpenCL. */
#ifndef TL_CAPTURE_H
#define TL_CAPTURE_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* px; and looks at a texture. */
enum { TL_DEFAULT_WIDTH = 1280, TL_DEFAULT_HEIGHT = 720 };
enum { TL_DEFAULT_ANISOTROPY = 16, TL_MAX_ANISOTROPY = 16 };
#define TL_DEFAULT_SHADOW_MEMORY ((uint64_t)256 << 20) /* bytes */

typedef struct tl_capture_options {
    uint32_t width, height; /* px of the picture; 0: the default ones */
    /* Of each pixel, a square number up to TL_MAX_SAMPLES; 0: 1. Width and height times its root are
     * TL_MAX_EXTENT at most. */
    uint32_t samples;
    const char *camera;  /* name or index; NULL: the first of the default scene, else framed */
    const char *variant; /* of materials, name or index; NULL: the file's own materials */
    enum tl_layout_name layout; /* how pixels are packed; 0 is full float */
    bool materials; /* plane brdf with names; tangent, where anything drawn has one */
    bool ids;       /* which object each pixel shows: its node, counted from 1, and names */
    uint32_t anisotropy; /* where there are mipmaps, 1 (off) to 16; 0: TL_DEFAULT_ANISOTROPY */
    /* When: an animation of the file, by name or index, at a time in s; without both the scene
     * is as the file has it. NULL: the first. Beyond its end it is at its end, which is
     * told. */
    const char *animation;
    double time;
    bool has_time; /* false: time is 0 where an animation is named */
    /* What is done to the scene's own lights, where it has any, before shadow maps are made: such as to switch
     * some off. NULL: nothing. */
    tl_status (*change_lights)(const void *context, tl_light_set *lights, tl_error *err);
    const void *change_context;
    /* Shadow maps: of the lights that ask for them among shadow_lights, NULL: among the scene's own; of all
     * of the scene's own with all_shadows, which then ask for them. shadow_memory: bytes of all maps at most,
     * 0: TL_DEFAULT_SHADOW_MEMORY. shadow_near: m ahead of a light from which on surfaces are in its map, for
     * lamps that would keep their own light in; 0: a 100000th of the scene's extent. */
    const tl_light_set *shadow_lights;
    bool all_shadows;
    uint64_t shadow_memory;
    double shadow_near;
    /* Of surfaces that blend (layers.h), TL_MOST_LAYERS at most; 0: TL_DEFAULT_LAYERS. Without layers they
     * are shown as opaque where their alpha is at least half, which is told. */
    uint32_t layers;
    bool without_layers;
} tl_capture_options;

/* Loads `path` (.gltf, .glb), renders its default scene into a G-buffer, and collects its lights. The caller
 * releases *out with tl_gbuffer_destroy and *lights with tl_light_set_clear; *lights is replaced. timings,
 * notices may be NULL. Pixels have been through no repair. Where the layout has no place for metallic and
 * roughness they become a Phong material (kernels/material.h); what else it has no place for is named in a
 * notice. Fails with TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED (an extension the file requires; a layout
 * whose convention of depth this camera has not; more than TL_MAX_MATERIALS with `materials`; more than 2^24
 * triangles that blend; ids in a layout whose targets are all that OpenGL has), TL_ERR_ARGUMENT (size,
 * samples, layers, camera, anisotropy, time, animation, variant; shadow maps beyond shadow_memory at their
 * smallest), TL_ERR_MEMORY or TL_ERR_DEVICE (OpenGL), naming the file and the node, mesh, accessor, image or
 * extension concerned; and as change_lights does. */
tl_status tl_capture(const char *path,
                     const tl_capture_options *options,
                     tl_gbuffer **out,
                     tl_light_set *lights,
                     tl_timings *timings,
                     const tl_notices *notices,
                     tl_error *err);

/* The OpenGL that captures, for `tilelight devices`: "llvmpipe (LLVM 15...), OpenGL 4.5 ...".
 * Fails with TL_ERR_DEVICE. */
tl_status tl_capture_describe(char *text, size_t size, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
