/* What a G-buffer's file shows to programs that look for a picture in it. */
#ifndef TL_GBUFFER_PREVIEW_H
#define TL_GBUFFER_PREVIEW_H

#include "packing.h"

enum { TL_PREVIEW_COUNT = 4 }; /* R, G, B, A */

/* Row y of the frame under a lamp at the camera; rows: [width] each. Cannot fail. */
void tl_preview_row(const tl_unpacking *from, uint32_t y, float *const rows[TL_PREVIEW_COUNT]);

#endif
