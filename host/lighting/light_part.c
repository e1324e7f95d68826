/* Frames lit by a part of their light. */
#include "lighting_state.h"

#include <string.h>

/* What is not of lamps taken away. Its lights and tables are those of `from`. */
static tl_light_set lamps_of(const tl_light_set *from)
{
    tl_light_set lamps = *from;
    memset(lamps.ambient, 0, sizeof lamps.ambient);
    lamps.sky_light = 0.0f;
    memset(lamps.sky, 0, sizeof lamps.sky);
    lamps.sky_type = TL_SKY_CONSTANT;
    return lamps;
}

tl_status tl_lighting_run_part(tl_lighting *lighting,
                               const tl_gbuffer *gbuffer,
                               const tl_light_set *lights,
                               const tl_light_part *part,
                               tl_image *image,
                               tl_timings *timings,
                               const tl_notices *notices,
                               tl_lighting_counts *counts,
                               tl_error *err)
{
    const tl_light_set lamps = lamps_of(lights);
    if (lighting->options.kernel.text)
        return tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "a kernel of one's own lights frames as it pleases, and not by a part of "
            "their light: leave groups out, or the kernel");
    lighting->part = part;
    const tl_status status = tl_lighting_run(lighting, gbuffer, part->alone ? &lamps : lights,
                                             image, timings, notices, counts, err);
    lighting->part = NULL;
    return status;
}
