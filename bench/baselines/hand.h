/* What the hand-written baselines share: a frame, a thread's memory, and the code for one
 * instruction set. hand.c runs them; hand_tiles.c is compiled once per set and arithmetic. */
#ifndef TL_HAND_H
#define TL_HAND_H

#include "falloff.h"
#include "prepared.h"

#include <stdbool.h>

enum { HAND_TILE = 16 }; /* px */

/* Holds every computed position of a tile; low > high where all is sky. m, view space. */
typedef struct hand_box {
    float low[3], high[3];
} hand_box;

typedef struct hand_frame {
    const tl_prepared *prepared;         /* tiles of HAND_TILE */
    const float *planes[TL_PLANE_COUNT]; /* [rows][pitch]; NULL where absent */
    float *radiance[3];                  /* [rows][pitch] */
    hand_box *boxes;                     /* [tiles_y][tiles_x] */
    const tl_tile_rect *rects;           /* [light_count], set from global_count on */
    /* The lobe is as diffuse light is, times one number a pixel: the model is blinn-phong-normalized,
     * specular colours are grey, and both lobes of a light have one colour. Relaxed code alone. */
    bool has_one_color;
} hand_frame;

/* The lights whose rectangles meet a row of tiles, as arrays [capacity]; count is followed by
 * lights that reach nothing, up to a whole vector. */
typedef struct hand_candidates {
    size_t count;
    float *x, *y, *z, *range2; /* view space, m */
    float *first, *end;        /* tiles of the row */
    const tl_view_light **lights;
} hand_candidates;

/* Code for one instruction set. A list holds the lights of a tile in index order. */
typedef struct hand_code {
    const char *name;
    bool (*is_supported)(void);
    void (*bound_tile)(const hand_frame *frame, uint32_t tile_x, uint32_t tile_y);
    /* Returns how many lights it wrote to list, at most candidates->count. */
    size_t (*list_tile)(const hand_frame *frame,
                        const hand_candidates *candidates,
                        uint32_t tile_x,
                        uint32_t tile_y,
                        const tl_view_light **list);
    void (*shade_tile)(const hand_frame *frame,
                       uint32_t tile_x,
                       uint32_t tile_y,
                       const tl_view_light *const *list,
                       size_t count);
} hand_code;

extern const hand_code hand_exact_portable, hand_relaxed_portable;
#ifdef TL_HAS_X86_HAND
extern const hand_code hand_exact_avx2, hand_relaxed_avx2;
extern const hand_code hand_exact_avx512, hand_relaxed_avx512;
#endif

#endif
