/* PNG and JPEG to linear pixels. */
#ifndef TL_DECODE_H
#define TL_DECODE_H

#include <stddef.h>
#include <stdint.h>

/* Reads the size from the header. Returns 0 where the header is damaged, or the file shorter than it says.
 * To be asked before tl_decode_rgba16. */
int tl_decode_size(const uint8_t *data, size_t size, uint32_t *width, uint32_t *height);

/* Writes the pixels to `out`, [height][width][4], top row first, linear: 65535 is 1. With `srgb`,
 * red, green and blue are decoded by the exact curve (IEC 61966-2-1), off by half a step of 65535 at
 * most. 16 bits, because a driver's own curve may be a polynomial (2.5 % off in the dark) and its
 * filter for 8-bit textures may round to 8 bits, which shows as steps where a normal map is
 * magnified. Returns 0 where the file is damaged or memory runs out. May be called from several
 * threads. */
int tl_decode_rgba16(
    const uint8_t *data, size_t size, uint32_t width, uint32_t height, int srgb, uint16_t *out);

#endif
