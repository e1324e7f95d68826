/* PNG and JPEG to texels. */
#ifndef TL_DECODE_H
#define TL_DECODE_H

#include <stddef.h>
#include <stdint.h>

/* Reads the size from the header. Returns 0 where the header is damaged. */
int tl_decode_size(const uint8_t *data, size_t size, uint32_t *width, uint32_t *height);

/* The texels, [height][width][4], top row first; the caller frees them. NULL: damaged, or no memory.
 * May be called from several threads. */
uint8_t *tl_decode_rgba8(const uint8_t *data, size_t size, uint32_t width, uint32_t height);

#endif
