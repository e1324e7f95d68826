/* What few lights have beside the rest (tl_view_shape), and the sky, as sections behind the lights. */
#ifndef TL_SHAPES_H
#define TL_SHAPES_H

#include "prepared.h"

/* Whether the light has any of it: a falloff table, a texture, a profile, an ambient lobe, a shadow map, a
 * link to objects. */
int tl_light_has_shape(const tl_gbuffer *gbuffer, const tl_light *light);

/* Once all lights of the frame are there: gives those that call for it their shapes, and adds tables,
 * textures, profiles and shadow maps, which are looked up with a filter as wide. Fails as tl_section_add
 * does. */
tl_status tl_shapes_add(const tl_gbuffer *gbuffer,
                        const tl_light_set *lights,
                        uint32_t shadow_filter,
                        tl_prepared *prepared,
                        tl_error *err);

/* Right, up and ahead of the sky's map in world space: upright, its middle towards -z, turned about the
 * vertical by `rotation`, rad. */
void tl_sky_axes(double rotation, double axes[3][3]);

/* The sky's section, where it is not of one colour. Fails alike. */
tl_status tl_sky_add(const tl_camera *camera,
                     const tl_light_set *lights,
                     tl_prepared *prepared,
                     tl_error *err);

/* Colour, intensity and the scale of a lobe, multiplied out.
 *
 * Kernels compute pi times what a surface reflects, so that white under 1 lx is 1. A model with units of
 * its own has lights scaled for all of a frame's surfaces, whatever model some of them have. */
void tl_lobe_color(const tl_light_set *set, const tl_light *light, float lobe, float out[3]);

#endif
