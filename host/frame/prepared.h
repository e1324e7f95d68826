/* A frame as the kernels take it, before any device is involved: view-space lights, what the scene
 * calls for, the constants of the frame. The device and the reference light the same one. */
#ifndef TL_PREPARED_H
#define TL_PREPARED_H

#include "frame.h"
#include "needs.h"
#include "sky_map.h"
#include "tile_rect.h"

#include "tilelight/approximations.h"
#include "tilelight/effects.h"
#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

typedef struct tl_prepared {
    tl_frame frame;
    tl_needs needs;
    tl_view_light *lights; /* [frame.light_count]; owned */
    /* [frame.light_count], behind the lights in their memory; sections behind them */
    tl_view_spot *spots;
    uint32_t *sources;      /* [frame.light_count], of each its index in the light set; owned */
    uint64_t *light_causes; /* [frame.light_count], of each the causes that it is; owned */
    size_t capacity;        /* lights that there is room for in all of these */
    size_t memory_size;     /* bytes at `lights` */
    size_t sections_size;   /* bytes of the sections behind the cones: sections.h */
    /* bytes of the planes of surroundings behind those, which are computed and not uploaded; 0: none */
    size_t planes_size;
    /* [images of the set], row of each that is in a section, else 0; owned */
    tl_u32 *images_at;
    size_t image_capacity;
    tl_sky_map *sky_map;   /* that lit the last frame; shared; NULL: none did */
    double brightness;     /* of all lights: the sum of the largest numbers of their colours */
    float brightest_texel; /* of pictures that are shown, and 1 at least */
    /* 0: whatever lobes make of it, light does not add up beyond the largest float (largest.h); else pixels
     * may have been cut */
    int may_be_cut;
    uint32_t two_colored_count; /* lights that add something, with lobes of different colours */
    /* of those that may be lit, what some and what all call for: bits of tl_choice */
    tl_u32 some_call, all_call;
    /* of frame.brdfs_at, by the index of a pixel; NULL where the frame has none */
    const tl_brdf *rows;
    tl_explanation explanation;       /* where `needs` comes from */
    tl_approximations approximations; /* of the kernels; tl_prepare leaves them as they are */
} tl_prepared;

typedef struct tl_prepare_options {
    uint32_t tile_size; /* px */
    uint32_t box_count; /* tl_frame.box_count */
    float light_cutoff; /* tl_lighting_options.light_cutoff */
    tl_effects_mode effects;
    uint32_t shadow_filter; /* tl_lighting_options.shadow_filter; 0: TL_DEFAULT_SHADOW_FILTER */
    uint32_t occlusion_samples; /* tl_lighting_options.occlusion_samples; 0: the default */
    uint32_t split;             /* tl_lighting_options.split */
    /* [lights of the set]: 1: the light is lit. Of others is taken what kernels are built for. NULL: all
     * are */
    const uint8_t *lit;
    uint64_t without; /* effects that are taken out, bits TL_ON(effect): another picture */
    uint32_t layers;  /* of those of the frame, how many are lit, each prepared by itself */
} tl_prepare_options;

/* Fills *prepared, growing its lights where they do not fit; all zero is a valid start. Lights that add
 * exactly nothing are not among them (explanation.idle_lights), unless all effects are asked for. Names spots
 * that light nothing, materials and ambient occlusion that are for nothing, and lights that cast shadows of
 * which there is no map, in a notice. Fails as tl_brdf_table_make and tl_links_add do, with TL_ERR_ARGUMENT
 * (more than 2^31 lights, or sections that rows do not count) or TL_ERR_MEMORY. */
tl_status tl_prepare(const tl_gbuffer *gbuffer,
                     const tl_light_set *lights,
                     const tl_prepare_options *options,
                     const tl_notices *notices,
                     tl_prepared *prepared,
                     tl_error *err);

/* Bytes of prepared->lights that a device is given: the lights, and where there are spots or sections the
 * cones behind them, and the sections. */
size_t tl_prepared_lights_size(const tl_prepared *prepared);

/* Bytes that the device's buffer of them has: those, and room for planes of surroundings. */
size_t tl_prepared_buffer_size(const tl_prepared *prepared);

/* Leaves it all zero. */
void tl_prepared_clear(tl_prepared *prepared);

#endif
