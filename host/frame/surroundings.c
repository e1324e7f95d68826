#include "surroundings.h"

#include "occlusion.h"
#include "place_slack.h"
#include "sections.h"
#include "try.h"

#include "tilelight/occlusion.h"

#include <math.h>
#include <string.h>

static const tl_occlusion_slices rows[] = {
#define ROW(samples, slices, steps, halvings) {samples, slices, steps, halvings},
    TL_OCCLUSION_SAMPLES(ROW)
#undef ROW
};

const tl_occlusion_slices *tl_occlusion_slices_of(uint32_t samples)
{
    const uint32_t wanted = samples ? samples : TL_DEFAULT_OCCLUSION_SAMPLES;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].samples == wanted)
            return &rows[i];
    return NULL;
}

/* Which of TL_PATTERN_CELLS directions a cell begins with, and which quarter of a step: each direction
 * once, and each quarter once in every row, column and square of 2 x 2 (Jimenez et al. 2016, "spatial
 * directions" and "offsets"). */
static unsigned direction_of_cell(unsigned x, unsigned y)
{
    return (x + y) % TL_PATTERN * TL_PATTERN + x;
}

static unsigned offset_of_cell(unsigned x, unsigned y)
{
    return (TL_PATTERN + y - x) % TL_PATTERN;
}

/* down_per_right: px down of what is as long as one px across. */
static void set_directions(const tl_occlusion_slices *of, double down_per_right, float *out)
{
    const double turn = acos(-1.0);
    for (unsigned slice = 0; slice < of->slices; slice++) {
        for (unsigned cell = 0; cell < TL_PATTERN_CELLS; cell++) {
            const unsigned at = direction_of_cell(cell % TL_PATTERN, cell / TL_PATTERN);
            const double angle =
                turn * (slice + (at + 0.5) / TL_PATTERN_CELLS) / (double)of->slices;
            out[cell] = (float)cos(angle);
            out[TL_PATTERN_CELLS + cell] = (float)(sin(angle) * down_per_right);
        }
        out += 2 * TL_PATTERN_CELLS;
    }
}

/* Squares, so that steps are short where a pixel's contacts are. */
static void set_steps(const tl_occlusion_slices *of, float *out)
{
    for (unsigned slice = 0; slice < of->slices; slice++) {
        for (unsigned step = 0; step < of->steps; step++) {
            for (unsigned cell = 0; cell < TL_PATTERN_CELLS; cell++) {
                const unsigned at = offset_of_cell(cell % TL_PATTERN, cell / TL_PATTERN);
                const double offset = (at + (slice + 0.5) / of->slices) / TL_PATTERN;
                const double share = (step + offset) / of->steps;
                out[cell] = (float)(share * share);
            }
            out += TL_PATTERN_CELLS;
        }
    }
}

static tl_view_surroundings view_of(const tl_gbuffer *gbuffer,
                                    float radius,
                                    const tl_occlusion_slices *of,
                                    const tl_rays *rays,
                                    double down_per_right)
{
    tl_view_surroundings view = {
        .radius = radius,
        .reach = (float)((double)radius / (double)rays->dx),
        .most_reach = (float)(TL_MOST_OCCLUSION_REACH / fmax(1.0, down_per_right)),
        .slices = of->slices,
        .steps = of->steps,
        .halvings = of->halvings,
        .rows = gbuffer->rows};
    float slack[3];
    tl_place_slack(gbuffer, 0.0, slack);
    view.slack = slack[0];
    view.slack_per_depth = slack[1];
    view.slack_per_depth2 = slack[2];
    return view;
}

/* Behind what is uploaded. */
static tl_status reserve_planes(const tl_gbuffer *gbuffer,
                                tl_prepared *prepared,
                                tl_u32 *at,
                                tl_error *err)
{
    const size_t plane = (size_t)gbuffer->pitch * gbuffer->rows;
    const size_t before = tl_prepared_lights_size(prepared);
    *at = (tl_u32)(before / TL_SECTION_ROW);
    prepared->planes_size =
        (TL_AROUND_COUNT * plane + 2 * TL_AROUND_MARGIN(gbuffer->pitch)) * sizeof(float);
    return tl_sections_reserve(prepared, before + prepared->planes_size, err);
}

tl_status tl_surroundings_add(const tl_gbuffer *gbuffer,
                              const tl_light_set *lights,
                              uint32_t samples,
                              tl_prepared *prepared,
                              tl_error *err)
{
    const tl_occlusion_slices *of = tl_occlusion_slices_of(samples);
    const tl_rays rays = prepared->frame.rays;
    const double down_per_right = (double)rays.dx / -(double)rays.dy;
    tl_status status = TL_OK;
    void *memory = NULL;
    if (!of)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "%u samples of ambient occlusion: it must be a power of 2 from 8 to 256",
                    samples));
    tl_view_surroundings view =
        view_of(gbuffer, lights->occlusion_radius, of, &rays, down_per_right);
    const size_t directions = (size_t)2 * of->slices * TL_PATTERN_CELLS,
                 steps = (size_t)of->slices * of->steps * TL_PATTERN_CELLS;
    TRY(tl_section_add(prepared, (directions + steps) * sizeof(float), &view.table_at, &memory,
                       err));
    set_directions(of, down_per_right, memory);
    set_steps(of, (float *)memory + directions);
    TRY(tl_section_add(prepared, sizeof view, &prepared->frame.surroundings_at, NULL, err));
    TRY(reserve_planes(gbuffer, prepared, &view.planes_at, err));
    memcpy(tl_section_at(prepared, prepared->frame.surroundings_at), &view, sizeof view);
done:
    return status;
}
