/* Filters that pictures are scaled by, as weights along one axis. */
#ifndef TL_FILTERS_H
#define TL_FILTERS_H

#include "tilelight/post.h"

#include <stddef.h>
#include <stdint.h>

/* How pixels 0 to count - 1 of an axis are made of those of another: a table of kernels/scale.h. All zero is
 * valid to clear. */
typedef struct tl_taps {
    uint32_t count, padded; /* pixels that are made; up to a multiple of 64 */
    uint32_t taps;          /* that each is made of */
    /* First tap [padded], tap with the largest weight [padded], both whole numbers of 32 bits; weights
     * [taps][padded], 0 where fewer are meant. Owned. */
    float *numbers;
} tl_taps;

/* From `from` pixels to `to`, 1 to TL_MAX_EXTENT each: both axes end at the same two edges, so that the
 * centre of pixel i is seen at (i + 1/2) from/to. The filter is widened to a pixel of the coarser axis.
 * Weights of what would lie beyond the edges are left out and the rest add up to 1, rounded from double.
 * Pixels seen from either end have the same weights, bit for bit. *out is to be cleared whatever happened.
 * Fails with TL_ERR_MEMORY. */
tl_status tl_taps_make(
    tl_filter filter, uint32_t from, uint32_t to, tl_taps *out, tl_error *err);

void tl_taps_clear(tl_taps *taps);

/* Numbers of a table. */
size_t tl_taps_size(const tl_taps *taps);

/* Pixel i: its first tap, and what weighs most. */
uint32_t tl_taps_first(const tl_taps *taps, uint32_t i);
uint32_t tl_taps_middle(const tl_taps *taps, uint32_t i);

#endif
