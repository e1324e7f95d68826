/* The box around what a camera sees. */
#ifndef TL_VISIBLE_BOX_H
#define TL_VISIBLE_BOX_H

#include "tilelight/gbuffer.h"

/* out: least and largest coordinates of all surfaces along rows[3][3], a rotation from world space, m; of a
 * G-buffer of any layout, whose pixels may have been through no repair: those that are not in front of the
 * camera, finite, are left out. False: there are none, and the box is left alone. Fails with nothing. */
bool tl_visible_box(const tl_gbuffer *gbuffer, const double rows[3][3], double out[2][3]);

#endif
