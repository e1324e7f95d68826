/* Compiled once per instruction set: TL_TWIN is the name it then has. What the kernel show_codes computes, as
 * rows of C. */
#include "show.h"

tl_show_rows_twin TL_TWIN;

static void show_pixel(const tl_show_job *job, size_t x, size_t y)
{
    const tl_show *show = job->show;
    const size_t at = y * job->pitch + x;
    const vec3 radiance = {job->from[0][at], job->from[1][at], job->from[2][at]};
    const vec3 shown = shown_of(radiance, &show->look);
    const real added =
        show->numbers[TL_SHOW_TILE + y % TL_DITHER_SIDE * TL_DITHER_SIDE + x % TL_DITHER_SIDE];
    const tl_numbers thresholds = show->numbers + TL_SHOW_THRESHOLDS;
    uint8_t *rgb = job->rgb + 3 * (y * job->width + x);
    rgb[0] = (uint8_t)code_of(shown.x, added, radiance.x, &show->look, thresholds);
    rgb[1] = (uint8_t)code_of(shown.y, added, radiance.y, &show->look, thresholds);
    rgb[2] = (uint8_t)code_of(shown.z, added, radiance.z, &show->look, thresholds);
}

void TL_TWIN(void *context, size_t begin, size_t end)
{
    const tl_show_job *job = context;
    for (size_t y = begin; y < end; y++)
        for (size_t x = 0; x < job->width; x++)
            show_pixel(job, x, y);
}
