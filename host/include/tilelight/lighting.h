/* Lights G-buffers on an OpenCL device: bounds per tile, light lists per tile, shading. */
#ifndef TL_LIGHTING_H
#define TL_LIGHTING_H

#include "aovs.h"
#include "approximations.h"
#include "effects.h"
#include "gbuffer.h"
#include "image.h"
#include "lights.h"
#include "report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled kernels, and skies prepared to light, are kept on disk: in the folder TILELIGHT_CACHE, else tilelight in XDG_CACHE_HOME or
 * in .cache in HOME. The first call that looks for devices sets POCL_CACHE_DIR in the environment for
 * as long as it runs, unless it is set: no other thread may read or change the environment then. */

/* An opened OpenCL device: one context, one in-order profiling queue. */
typedef struct tl_device tl_device;

/* selector: NULL or "" (PoCL by name, else any CPU, else any device), "cpu", "gpu", an index into
 * tl_device_list, or part of a device's or platform's name, letter case ignored. device is released
 * with tl_device_close. Fails with TL_ERR_NO_DEVICE, saying which devices there are. */
tl_status tl_device_open(const char *selector, tl_device **out, tl_error *err);

/* Accepts NULL. */
void tl_device_close(tl_device *device);

typedef struct tl_device_info {
    char name[128], platform[128], driver[128]; /* as OpenCL reports them */
    char kind[16];                              /* "cpu", "gpu" or "other" */
    uint32_t compute_units;
    uint32_t vector_width; /* the lanes kernels are built with: 16, 8, 4 or 1 */
    uint64_t memory_size;  /* bytes */
    int has_double;
    int is_default; /* what an empty selector opens */
} tl_device_info;

/* Every device of every platform. The caller frees *out, [*count]. No device is a count of 0, not
 * a failure. Fails with TL_ERR_MEMORY. */
tl_status tl_device_list(tl_device_info **out, size_t *count, tl_error *err);

/* What `device` is. */
tl_device_info tl_device_describe(const tl_device *device);

/* X(name, word on the command line, meaning) */
#define TL_CULLS(X)                                                                      \
    X(TL_CULL_SPLIT, "split", "as depth, a box each for what is near and far in a tile") \
    X(TL_CULL_DEPTH, "depth", "rectangles, then the box of each tile's surfaces")        \
    X(TL_CULL_RECT, "rect", "rectangles of the lights' spheres on the screen")           \
    X(TL_CULL_NONE, "none", "every light on every tile")

typedef enum tl_cull {
#define TL_CULL_NAME(name, word, meaning) name,
    TL_CULLS(TL_CULL_NAME)
#undef TL_CULL_NAME
        TL_CULL_COUNT
} tl_cull;

/* How a frame is cut into work-items. The bits do not depend on it.
 * X(name, word on the command line, meaning) */
#define TL_PATHS(X)                                                                     \
    X(TL_PATH_AUTO, "auto", "gpu on devices of that kind, cpu on all others")           \
    X(TL_PATH_CPU, "cpu", "vectors; a work-item culls a row of tiles or shades a tile") \
    X(TL_PATH_GPU, "gpu", "a work-group culls a tile, a work-item shades a pixel")

typedef enum tl_path {
#define TL_PATH_NAME(name, word, meaning) name,
    TL_PATHS(TL_PATH_NAME)
#undef TL_PATH_NAME
        TL_PATH_COUNT
} tl_path;

/* X(name, word on the command line, meaning) */
#define TL_PRECISIONS(X)                                                             \
    X(TL_PRECISION_FLOAT, "float", "single precision on the device")                 \
    X(TL_PRECISION_DOUBLE, "double", "double precision on the device")               \
    X(TL_PRECISION_REFERENCE, "reference", "double on the CPU, no tiles, no OpenCL") \
    X(TL_PRECISION_TWIN, "twin", "the float kernels' text as C on the CPU, no OpenCL")

typedef enum tl_precision {
#define TL_PRECISION_NAME(name, word, meaning) name,
    TL_PRECISIONS(TL_PRECISION_NAME)
#undef TL_PRECISION_NAME
        TL_PRECISION_COUNT
} tl_precision;

/* What one work-item of a user's kernel stands for.
 * X(name, word on the command line, meaning) */
#define TL_KERNEL_ITEMS(X)                                 \
    X(TL_ITEMS_TILE, "tile", "a tile; work-groups of one") \
    X(TL_ITEMS_PIXEL, "pixel", "a pixel; one work-group per tile, tile x tile items")

typedef enum tl_kernel_items {
#define TL_KERNEL_ITEMS_NAME(name, word, meaning) name,
    TL_KERNEL_ITEMS(TL_KERNEL_ITEMS_NAME)
#undef TL_KERNEL_ITEMS_NAME
        TL_KERNEL_ITEMS_COUNT
} tl_kernel_items;

/* A shading kernel of the user's in place of ours; docs/your-kernel.md describes its arguments. */
typedef struct tl_user_kernel {
    const char *text;  /* OpenCL C, NUL-terminated, after all headers of kernels/. NULL: ours */
    const char *entry; /* the kernel's name */
    tl_kernel_items items;
    const char *file; /* what messages call the text; may be NULL */
} tl_user_kernel;

/* The contents of `file` as the text of a tl_user_kernel: compilers then report its own lines under
 * its name, and its includes of files of kernels/ are blank, for the text follows them already. The
 * caller frees *out. Fails with TL_ERR_FORMAT where it includes anything else, or TL_ERR_MEMORY. */
tl_status tl_user_kernel_text(const char *file, const char *source, char **out, tl_error *err);

typedef struct tl_lighting_options {
    tl_cull cull;
    tl_precision precision;
    tl_path path;
    uint32_t tile_size; /* px: 8, 16, 32 or 64 */
    /* lanes: 1, 4, 8 or 16; 0: what suits the device; the gpu path has 1 */
    uint32_t vector_width;
    int keeps_tile_lights;   /* 1: for tl_lighting_tile_lights, tl_lighting_effect_use */
    tl_effects_mode effects; /* the picture is the same bit for bit */
    /* another picture, in another time; TL_PRECISION_REFERENCE has none, TL_PRECISION_TWIN those that are the
     * same bit for bit everywhere */
    tl_approximations approximations;
    /* Width of what the light that arrives is a mean over, in texels of a shadow map: 1 to
     * TL_MOST_SHADOW_FILTER, 0: TL_DEFAULT_SHADOW_FILTER. Another picture where there are shadows */
    uint32_t shadow_filter;
    /* Of a pixel whose surroundings keep ambient light from it: a row of TL_OCCLUSION_SAMPLES
     * (occlusion.h), 0: TL_DEFAULT_OCCLUSION_SAMPLES. Another picture where there is ambient occlusion */
    uint32_t occlusion_samples;
    /* Of the frame's layers, at most so many are lit and blended, the nearest; another picture where it has
     * more */
    uint32_t layers;
    /* terms of the radiance that are written by themselves too, bits 1 << tl_aov: as parts of the image, in
     * their order; TL_ALL_AOVS: all. The picture is the same bit for bit. Not with a kernel of the user's */
    uint32_t split;
    float light_cutoff; /* a light without a range ends where it gives this (lx); 0: never */
    uint64_t
        memory_limit; /* bytes of device memory beside shared ones; 0: what the device has */
    tl_user_kernel
        kernel; /* its strings are the caller's, who keeps them while the tl_lighting lives */
} tl_lighting_options;

/* split, float, tile 16, path and width by device, all layers, no cutoff. */
tl_lighting_options tl_lighting_options_default(void);

/* What a frame came to. */
typedef struct tl_lighting_counts {
    uint32_t tile_count, global_light_count, ranged_light_count;
    uint64_t list_length; /* (tile, light) pairs of all lists; global lights are not listed */
    /* pixels in which light added up beyond the largest float: they have that */
    uint64_t cut_count;
    uint32_t layer_count;       /* that were lit beside the surfaces behind them */
    uint64_t layer_list_length; /* of their lists; list_length is of the surfaces' */
    uint64_t pair_count;   /* (pixel, light) pairs that the lists stand for, padding included */
    uint32_t band_count;   /* the frame was lit in this many parts, to fit memory_limit */
    uint64_t device_bytes; /* of the device's own buffers, at their largest */
    /* from profiling events; 0 on the CPU paths; of layers too */
    double device_cull_ms, device_shade_ms;
    double device_occlusion_ms; /* the same, of ambient occlusion; shading apart */
    double first_kernel_s; /* when the first kernel began, on tl_seconds' clock; 0: none ran */
    double shade_wall_ms;  /* shading as the host saw it */
    double shade_processor_ms; /* processor time that the process took meanwhile: over
                                * shade_wall_ms, how many processors it kept busy */
} tl_lighting_counts;

/* Holds programs and buffers from frame to frame. */
typedef struct tl_lighting tl_lighting;

/* device may be NULL if options->precision needs none, and outlives *out, which the caller
 * releases with tl_lighting_destroy. Fails with TL_ERR_ARGUMENT or TL_ERR_MEMORY. */
tl_status tl_lighting_create(tl_device *device,
                             const tl_lighting_options *options,
                             tl_lighting **out,
                             tl_error *err);

/* Accepts NULL. */
void tl_lighting_destroy(tl_lighting *lighting);

/* Lights one frame, of any layout, that tl_gbuffer_repair has been through: its surfaces, then its layers
 * over them, from the farthest to the nearest. *image has the G-buffer's size, and a part for each term of
 * options.split, and is written in full. A user's kernel is given full float: for it a packed frame is
 * unpacked first, anew for every frame. Compiles kernels where the scene needs ones it has not needed before;
 * allocates only where a frame is larger, or has more lights, than every one before. A frame that does not
 * fit memory_limit is lit in bands of tile rows, with the same bits. timings, notices, counts may be NULL.
 * Fails with TL_ERR_ARGUMENT (sizes or parts differ; one row of tiles is beyond memory_limit), TL_ERR_FORMAT
 * (a row of materials leads nowhere, an index has none; a user's kernel does not compile), TL_ERR_DEVICE or
 * TL_ERR_MEMORY. */
tl_status tl_lighting_run(tl_lighting *lighting,
                          const tl_gbuffer *gbuffer,
                          const tl_light_set *lights,
                          tl_image *image,
                          tl_timings *timings,
                          const tl_notices *notices,
                          tl_lighting_counts *counts,
                          tl_error *err);

/* Of the last frame: the caller may then free its G-buffer and image; nothing that is asked of the last frame
 * is to be asked any more. Buffers of the device's own stay. Accepts NULL. */
void tl_lighting_let_go(tl_lighting *lighting);

/* A part of a frame's light. */
typedef struct tl_light_part {
    const uint8_t *lit; /* [lights of the set]: 1: the light is lit */
    int alone;          /* 1: of lamps alone, without ambient light, emission and sky */
} tl_light_part;

/* As tl_lighting_run, of this part of the light alone: with parts that have every light once, and are all but
 * one of lamps alone, pictures add up to that of the whole, but for rounding (docs/compositing.md). Whatever
 * lights are lit, programs are those of all. Fails likewise, and with TL_ERR_UNSUPPORTED for a kernel of the
 * user's. */
tl_status tl_lighting_run_part(tl_lighting *lighting,
                               const tl_gbuffer *gbuffer,
                               const tl_light_set *lights,
                               const tl_light_part *part,
                               tl_image *image,
                               tl_timings *timings,
                               const tl_notices *notices,
                               tl_lighting_counts *counts,
                               tl_error *err);

/* What the last frame called for, its layers included, and why. *out is all zero before the first. Cannot
 * fail. */
void tl_lighting_explain(const tl_lighting *lighting, tl_explanation *out);

/* Of each tile of the last frame, layers left out, how many lights with a range it lists: [tiles_y][tiles_x],
 * until the next frame; on the CPU paths, which have no lists, all of them. NULL unless the
 * options ask to keep it. */
const uint32_t *tl_lighting_tile_lights(const tl_lighting *lighting);

/* What of the last frame called for effects, tile by tile: kept as the number of lights is. */
typedef struct tl_effect_use {
    /* [tiles_y][tiles_x]: effects that listed lights call for, bits TL_ON(effect) */
    const uint64_t *tiles;
    /* of a tile and a listed light that calls for the effect */
    uint64_t pairs[TL_EFFECT_COUNT];
    uint32_t global_lights[TL_EFFECT_COUNT]; /* that reach everything, and call for it */
} tl_effect_use;

/* Until the next frame. NULL unless the options ask to keep tiles' lights. */
const tl_effect_use *tl_lighting_effect_use(const tl_lighting *lighting);

/* Shades the last frame once more, without its layers, from the lists that are there, by kernels that lack
 * some of its effects (bits TL_ON(effect)): *ms is the device's time for that. *image, of the frame's size,
 * becomes what they give, another picture where the frame has such an effect. gbuffer: that of the last
 * frame. Fails with TL_ERR_UNSUPPORTED on the CPU paths and where the frame was lit in bands, TL_ERR_DEVICE
 * or TL_ERR_MEMORY. */
tl_status tl_lighting_shade_without(tl_lighting *lighting,
                                    const tl_gbuffer *gbuffer,
                                    uint64_t effects,
                                    tl_image *image,
                                    double *ms,
                                    tl_error *err);

/* Shades the last frame once more, as it was, by kernels that look at a clock before and after each tile:
 * us[tile] becomes how long a thread was at it, in microseconds. us: [tiles_y][tiles_x]. *image as above.
 * Fails alike, and with TL_ERR_UNSUPPORTED where kernels cannot read a clock, or do not shade tiles (the gpu
 * path, a user's kernel). */
tl_status tl_lighting_time_tiles(tl_lighting *lighting,
                                 const tl_gbuffer *gbuffer,
                                 tl_image *image,
                                 double *us,
                                 tl_error *err);

/* What the kernels of the last frame were built with, as the OpenCL compiler was given it; empty where
 * they were none, as on the CPU paths. text: [size], NUL-terminated, cut to fit. Cannot fail. */
void tl_lighting_build_options(const tl_lighting *lighting, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
