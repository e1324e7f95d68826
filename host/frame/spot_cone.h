/* The cone of a spot light as kernels take it. */
#ifndef TL_SPOT_CONE_H
#define TL_SPOT_CONE_H

#include "frame.h"

#include "tilelight/lights.h"

/* view becomes the unit vector, in view space, against the rays of a directional light or along the axis
 * of a spot: from what is lit towards the light. */
void tl_against_rays(const tl_camera *camera, const tl_light *light, float view[3]);

/* Whether the light is a spot that does not light every direction alike: its inner cone is not the whole
 * of space. */
int tl_spot_has_edge(const tl_light *light);

/* Whether it is a spot that lights nothing: its outer cone is narrower than floats can tell, 2.4e-4. */
int tl_spot_is_empty(const tl_light *light);

/* Of every light; whole_space() (kernels/spot.h) of one without an edge. */
tl_view_spot tl_spot_cone(const tl_camera *camera, const tl_light *light);

#endif
