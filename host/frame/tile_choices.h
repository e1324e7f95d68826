/* What tiles choose for themselves (kernels/choices.h): whether there is a choice, and what each light calls
 * for. */
#ifndef TL_TILE_CHOICES_H
#define TL_TILE_CHOICES_H

#include "prepared.h"

/* Bits of tl_choice: of the effects that are on those that tiles can do without. */
tl_u32 tl_choosable(const tl_needs *needs);

/* Notes what a light calls for that may be lit, for tl_choices_open. has_shape: kernels will have one of
 * it. */
void tl_choices_note(tl_prepared *prepared,
                     const tl_view_light *light,
                     const tl_view_spot *cone,
                     int has_shape);

/* Opens the choices that some lights call for and others do not, among the effects that are on: sets
 * needs.choices and frame.calls_at, which stay 0 where there is none. To be called once lights and effects
 * are decided. Fails as tl_section_add does. */
tl_status tl_choices_open(tl_prepared *prepared, tl_error *err);

#endif
