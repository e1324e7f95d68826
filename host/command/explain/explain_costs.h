/* What effects cost, and what tiles do, measured on the frame that was lit. */
#ifndef TL_EXPLAIN_COSTS_H
#define TL_EXPLAIN_COSTS_H

#include "explain.h"

/* Frames of each kind that medians are of. */
enum { COST_RUNS = 7 };

/* Fills e->costs and e->shade_ms: for each effect that is on, the frame is shaded with and without it by
 * turns. Fails as tl_lighting_shade_without does. */
tl_status explain_measure_costs(const job *j,
                                tl_lighting *lighting,
                                explained *e,
                                tl_error *err);

/* Fills e->tile_us with the median of each tile's times. Fails as tl_lighting_time_tiles does. */
tl_status explain_time_tiles(const job *j, tl_lighting *lighting, explained *e, tl_error *err);

#endif
