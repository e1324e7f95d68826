/* Of a light's pixels, as many lie within a texel of a shadow's edge as texels are wide: with `pixels` in its
 * reach and `wanted` texels each way, with which one is as wide as a pixel, a share of them that goes with
 * wanted/size. The sum of pixels wanted/size over all maps, under a sum of views size^2 that is the memory,
 * is least where
 *
 *     size^3 = scale (pixels wanted / views),
 *
 * with one scale for all maps; and no map gets more than wanted. */
#include "shadow_budget.h"

#include "tilelight/shadows.h"

#include <math.h>

enum { TEXEL_BYTES = 8 };

/* Below what any scale gives, and beyond what any map can use. */
static const double least_octave = -64.0, most_octave = 64.0;

static uint32_t size_with(const tl_shadow_need *need, double octave)
{
    const double size = exp2(octave) * cbrt(need->pixels * need->size / need->views);
    return (uint32_t)fmin(fmax(size, TL_LEAST_SHADOW_SIZE), need->size);
}

static uint64_t bytes_with(const tl_shadow_need *needs, size_t count, double octave)
{
    uint64_t bytes = 0;
    for (size_t i = 0; i < count; i++) {
        const uint64_t size = size_with(&needs[i], octave);
        bytes += TEXEL_BYTES * needs[i].views * size * size;
    }
    return bytes;
}

/* The largest scale with which all fit, where the least does: its logarithm to base 2. */
static double octave_within(uint64_t memory, const tl_shadow_need *needs, size_t count)
{
    double fits = least_octave, exceeds = most_octave;
    for (int i = 0; i < 48; i++) {
        const double middle = 0.5 * (fits + exceeds);
        if (bytes_with(needs, count, middle) <= memory)
            fits = middle;
        else
            exceeds = middle;
    }
    return fits;
}

tl_status tl_shadow_budget(uint64_t memory,
                           tl_shadow_need *needs,
                           size_t count,
                           const tl_notices *notices,
                           tl_error *err)
{
    const uint64_t least = bytes_with(needs, count, least_octave);
    const uint64_t wanted = bytes_with(needs, count, most_octave);
    if (wanted <= memory)
        return TL_OK;
    if (least > memory)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "shadow maps of %zu lights take %llu KiB at their smallest, more than "
                       "the %llu that they may; allow more, or let fewer lights cast shadows",
                       count, (unsigned long long)(least >> 10),
                       (unsigned long long)(memory >> 10));
    tl_notice(
        notices,
        "shadow maps of %zu lights would take %llu MiB: they are made smaller, to take %llu",
        count, (unsigned long long)(wanted >> 20), (unsigned long long)(memory >> 20));
    const double octave = octave_within(memory, needs, count);
    for (size_t i = 0; i < count; i++)
        needs[i].size = size_with(&needs[i], octave);
    return TL_OK;
}
