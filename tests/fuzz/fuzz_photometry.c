/* IES files: does any text do more than be refused? What is taken is as bright as its peak in no direction
 * more, and its grid is as far from it as it says. */
#include "fuzz.h"

#include "tilelight/photometry.h"

#include <math.h>
#include <stdlib.h>

static const char source[] = "lamp.ies";

/* In directions of the file's own angles, of those between, and of the edges. */
static void must_shine(const tl_photometry *p, const tl_light_profile *grid)
{
    static const double around[] = {0.0, 45.0, 90.0, 179.99, 180.0, 270.0, 359.99, 360.0};
    static const double down[] = {0.0, 30.0, 89.99, 90.0, 90.01, 180.0};
    for (size_t i = 0; i < sizeof around / sizeof around[0]; i++)
        for (size_t j = 0; j < sizeof down / sizeof down[0]; j++) {
            const double candela = tl_photometry_at(p, around[i], down[j]);
            fuzz_must(candela >= 0.0 && candela <= grid->peak * (1.0 + 1e-12),
                      "%g cd at %g, %g, of %g at most", candela, around[i], down[j],
                      grid->peak);
        }
    for (size_t i = 0; i < (size_t)grid->columns * grid->rows; i++)
        fuzz_must(grid->shares[i] >= 0.0f && grid->shares[i] <= 1.0f, "a share of %g",
                  (double)grid->shares[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tl_error err = {.status = TL_OK};
    tl_photometry photometry = {0};
    tl_light_profile grid;
    const tl_status status =
        tl_photometry_parse((const char *)data, size, source, &photometry, &err);
    fuzz_must_tell(status, &err, source);
    if (status == TL_OK && tl_photometry_resample(&photometry, &grid, &err) == TL_OK) {
        fuzz_must((size_t)grid.columns * grid.rows <= TL_MOST_PROFILE_SAMPLES,
                  "%u x %u samples", grid.columns, grid.rows);
        fuzz_must(isfinite(grid.flux) && grid.flux >= 0.0 && isfinite(grid.off),
                  "%g lm, off by %g", grid.flux, grid.off);
        must_shine(&photometry, &grid);
        free(grid.shares);
    }
    tl_photometry_clear(&photometry);
    return 0;
}
