/* How many texels a shadow map gets: as many as the pixels it is for are fine. */
#ifndef TL_SHADOW_SIZE_H
#define TL_SHADOW_SIZE_H

#include "shadow_budget.h"

#include "tilelight/gbuffer.h"

/* Some of the points that a camera sees, evenly over the picture. All zero is none. */
typedef struct tl_seen_points {
    size_t count;
    struct tl_seen_point {
        double at[3], width; /* m, in world space; of the pixel there */
    } * of;                  /* owned */
} tl_seen_points;

/* *out is released with tl_seen_points_clear. Fails with TL_ERR_MEMORY. */
tl_status tl_seen_points_of(const tl_gbuffer *gbuffer, tl_seen_points *out, tl_error *err);

void tl_seen_points_clear(tl_seen_points *points);

/* Into *need, whose views are known: texels each way, within the limits of `kind`, of a map of this light,
 * about as few as give nine in ten of the points that the light may reach a texel there that is no wider than
 * their pixel; and how many these are. A map of a position is 2 tangent wide at 1 m along its view, a
 * directional light's is `span` m wide. */
void tl_shadow_need_of(const tl_seen_points *points,
                       const tl_light *light,
                       uint32_t kind,
                       double tangent,
                       double span,
                       tl_shadow_need *need);

#endif
