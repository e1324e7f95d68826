/* PFM files: "PF" (three numbers a pixel) or "Pf" (one), width, height, a scale whose sign says the order
 * of bytes (negative: the lowest first), then float rows from the bottom up. Described by Paul Debevec,
 * "PFM portable floatmap image format", 2003. The size of the scale is not applied: writers put anything
 * there. */
#ifndef TL_PFM_H
#define TL_PFM_H

#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A file in memory. All zero is valid to clear. */
typedef struct tl_pfm {
    char *bytes;            /* the whole file, owned */
    size_t pixels_at;       /* where the numbers begin */
    uint32_t width, height; /* px */
    size_t numbers;         /* per pixel: 1 or 3 */
    bool is_little;
} tl_pfm;

/* Whether a file that begins so is one. */
bool tl_pfm_recognises(const unsigned char *bytes, size_t size);

/* Reads it whole: extents are 1 to TL_MAX_EXTENT, and it has exactly the bytes that its header promises.
 * Fails with TL_ERR_READ, TL_ERR_FORMAT or TL_ERR_MEMORY; *out is to be cleared whatever happened. */
tl_status tl_pfm_read(const char *path, tl_pfm *out, tl_error *err);

/* Number c of the pixel in column x of row y, counted from the top. */
float tl_pfm_number(const tl_pfm *of, size_t x, size_t y, size_t c);

void tl_pfm_clear(tl_pfm *of);

#endif
