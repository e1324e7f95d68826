/* What of a frame calls for effects: causes (tilelight/effects.h) found, and turned into tl_needs. */
#ifndef TL_SCENE_CAUSES_H
#define TL_SCENE_CAUSES_H

#include "brdf_table.h"
#include "frame.h"
#include "needs.h"

#include "tilelight/effects.h"
#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* Causes of the planes and of the frame; lights are still to come. */
tl_explanation tl_causes_of_frame(const tl_gbuffer *gbuffer,
                                  const tl_light_set *lights,
                                  const tl_brdf_table *table,
                                  tl_effects_mode mode);

/* Whether light `index` of the set, `from`, as kernels would take it, adds exactly nothing; notes why.
 * is_global: it reaches everything. */
int tl_light_is_idle(tl_explanation *explanation,
                     const tl_light *from,
                     const tl_view_light *light,
                     const tl_view_spot *spot,
                     uint32_t index,
                     int is_global);

/* Notes that light `index` of the set, which is lit, is such a one. */
void tl_cause_found(tl_explanation *explanation, tl_cause cause, uint32_t index);

/* Notes what a light that is lit calls for; light.falloff is a row, not yet a shape. */
void tl_causes_of_light(tl_explanation *explanation,
                        const tl_light *from,
                        const tl_view_light *light,
                        uint32_t index,
                        int is_global);

/* Adds what a layer of the frame calls for, which is lit by itself: *explanation becomes that of the whole.
 * */
void tl_causes_of_layer(tl_explanation *explanation, const tl_explanation *layer);

/* What kernels are built for by planes, layout and models; no effect is switched on. */
tl_needs tl_needs_of_surfaces(const tl_gbuffer *gbuffer, const tl_brdf_table *table);

/* Sets the switches of effects, by the table, once all causes are there. Decides explanation->effects and
 * ->idle. */
void tl_needs_by_causes(tl_explanation *explanation, tl_needs *needs);

#endif
