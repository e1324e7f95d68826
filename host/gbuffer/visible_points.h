/* What a camera sees: the points of its pixels' surfaces, and the box around them. */
#ifndef TL_VISIBLE_POINTS_H
#define TL_VISIBLE_POINTS_H

#include "tilelight/gbuffer.h"

/* at: m, along the rows that were asked for; width: of the pixel there, m. */
typedef void (*tl_point_visitor)(void *context, const double at[3], double width);

/* Hands over the surface of every step-th pixel of every step-th row, row by row, then those of its layers;
 * of a G-buffer of any layout, whose pixels may have been through no repair: those that are not in front of
 * the camera, finite, are left out. rows[3][3]: a rotation from world space. Fails with nothing. */
void tl_visit_visible_points(const tl_gbuffer *gbuffer,
                             const double rows[3][3],
                             uint32_t step,
                             tl_point_visitor visit,
                             void *context);

/* out: least and largest coordinates of all such points. False: there are none, and the box is left alone. */
bool tl_visible_box(const tl_gbuffer *gbuffer, const double rows[3][3], double out[2][3]);

#endif
