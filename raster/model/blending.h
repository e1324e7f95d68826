/* Surfaces that blend with what lies behind them: glTF's alphaMode BLEND. */
#ifndef TL_BLENDING_H
#define TL_BLENDING_H

#include "model.h"

/* Whether anything that is drawn does. */
bool tl_model_blends(const tl_model *model);

/* Names the materials that do, and that they are shown as opaque. */
void tl_model_tell_of_blending(const tl_model *model, const tl_notices *notices);

/* An order among their triangles, for those that lie at one place: of each draw the rank of its first, with
 * those of the others behind it; ranks: [draw_count], 0 of draws that do not blend. It goes by what the draws
 * are, so the order of a file is of no matter unless two are the same in everything. Fails with
 * TL_ERR_UNSUPPORTED (more than 2^24 triangles) or TL_ERR_MEMORY. */
tl_status tl_blending_ranks(const tl_model *model, uint32_t *ranks, tl_error *err);

#endif
