#include "allowance_blend.h"

#include "blend.h"
#include "rough.h"

/* Difference, product and sum of numbers that are not negative: kernels/blend.h. */
static const double blend_roundings = 3.0;

tl_allowance tl_allowance_blended(float opacity,
                                  const tl_allowance *lit,
                                  const tl_allowance *behind)
{
    const double share = (double)opacity;
    tl_allowance out = {.certain = lit->certain && behind->certain};
    for (int c = 0; c < 3; c++) {
        const interval exact = {blended(share, lit->low[c], behind->low[c]),
                                blended(share, lit->high[c], behind->high[c])};
        const interval allowed = rounded(exact, blend_roundings);
        out.expected[c] = blended(share, lit->expected[c], behind->expected[c]);
        out.low[c] = allowed.low;
        out.high[c] = fmin(allowed.high, (double)TL_MOST_FLOAT);
    }
    return out;
}
