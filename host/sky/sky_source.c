#include "sky_source.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

static void set_rows(const tl_light_set *set, float (*rows)[3])
{
    for (int row = 0; row < TL_GRADIENT_ROWS; row++) {
        const double above = cos(pi * row / TL_GRADIENT_ROWS),
                     below = cos(pi * (row + 1) / TL_GRADIENT_ROWS);
        const double sine = 0.5 * (above + below), share = fabs(sine);
        const float *far = sine > 0.0 ? set->zenith : set->ground;
        for (int c = 0; c < 3; c++) {
            const double level = (double)set->sky[c];
            rows[row][c] = (float)(set->sky_type == TL_SKY_GRADIENT
                                       ? level + share * ((double)far[c] - level)
                                       : level);
        }
    }
}

tl_status tl_sky_source_of(const tl_light_set *set, tl_sky_source *out, tl_error *err)
{
    if (set->sky_type == TL_SKY_IMAGE) {
        const tl_light_image *image = &set->images[set->sky_image - 1];
        *out = (tl_sky_source){
            .width = image->width, .height = image->height, .pixels = image->pixels};
        return TL_OK;
    }
    float(*rows)[3] = malloc(TL_GRADIENT_ROWS * sizeof *rows);
    if (!rows)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the map of a sky");
    set_rows(set, rows);
    *out = (tl_sky_source){
        .width = 1, .height = TL_GRADIENT_ROWS, .pixels = rows[0], .own = rows[0]};
    return TL_OK;
}

void tl_sky_source_clear(tl_sky_source *source)
{
    free(source->own);
    *source = (tl_sky_source){0};
}
