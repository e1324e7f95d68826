/* Where a frame shows surfaces, by tiles. */
#ifndef TL_SURFACE_PIXELS_H
#define TL_SURFACE_PIXELS_H

#include "tilelight/gbuffer.h"

/* Of every tile, how many of its pixels show a surface: 0 is sky alone. For a G-buffer of any layout
 * that tl_gbuffer_repair has been through. counts: [tiles_y][tiles_x], whole tiles that cover the image.
 * On all threads. Cannot fail. */
void tl_surface_pixels(const tl_gbuffer *gbuffer, uint32_t tile_size, uint32_t *counts);

/* Of every tile, the planes that say more in one of its pixels than their absence would, bits 1 << plane:
 * what colours say counts channel by channel. For a G-buffer in full float that tl_gbuffer_repair has been
 * through. planes: as counts above. On all threads. Cannot fail. */
void tl_surface_planes(const tl_gbuffer *gbuffer, uint32_t tile_size, uint32_t *planes);

#endif
