/* What tiles choose for themselves (kernels/choices.h): whether there is a choice, and what each light calls
 * for. */
#ifndef TL_TILE_CHOICES_H
#define TL_TILE_CHOICES_H

#include "prepared.h"

/* What a light as kernels take it calls for, bits of tl_choice. */
tl_u32 tl_calls_of_light(const tl_view_light *light, const tl_view_spot *cone);

/* Opens the choices that some lights call for and others do not, among the effects that are on: sets
 * needs.choices, and frame.calls_at where there is one. To be called once lights and effects are decided.
 * Fails as tl_section_add does. */
tl_status tl_choices_open(tl_prepared *prepared, tl_error *err);

#endif
