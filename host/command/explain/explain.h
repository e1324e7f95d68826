/* What a frame called for, and what that came to: `--explain`, `--explain-costs`, `--explain-map` and
 * `--explain-map-costs` of render and light. */
#ifndef TL_EXPLAIN_H
#define TL_EXPLAIN_H

#include "job.h"
#include "tilelight/lighting.h"

#include <argp.h>

typedef struct explain_options {
    bool text;            /* --explain */
    bool costs;           /* --explain-costs, which brings the text too */
    const char *map;      /* a PNG; NULL: none */
    const char *cost_map; /* the same, of --explain-map-costs */
} explain_options;

/* Its input is an explain_options, all zero to begin with. */
extern const struct argp explain_argp;

/* Where an effect is used. */
typedef struct effect_use {
    uint32_t tiles; /* with a pixel, or a light on a pixel, that calls for it */
    double pairs;   /* of a tile that shows a surface and a light on it that calls for it */
} effect_use;

enum { MOST_WHY = 128 };

/* What an effect costs: shading without it against shading with it, by turns. */
typedef struct effect_cost {
    bool is_known;
    char why[MOST_WHY]; /* it is not */
    double ms; /* the median of pairs' differences; below 0 where it saves more than it takes */
    double low, high; /* ms; the 95 % interval of that */
    double share;     /* of shading with it */
} effect_cost;

/* A frame that was lit. All zero but for what is asked to begin with; released with explained_clear. */
typedef struct explained {
    const explain_options *asked; /* before explain_take */
    tl_explanation of;
    tl_lighting_counts counts;
    char build[1024]; /* what kernels were built with; empty where there were none */
    uint32_t tile_size, tiles_x, tiles_y;
    effect_use use[TL_EFFECT_COUNT];
    bool has_costs;
    effect_cost costs[TL_EFFECT_COUNT];
    double shade_ms;    /* with all that is on: what costs are shares of */
    uint32_t *lights;   /* [tiles_y][tiles_x], listed by each tile */
    uint32_t *surfaces; /* [tiles_y][tiles_x], pixels that show a surface */
    double *tile_us;    /* the same, how long a thread was at each tile; NULL: not asked for */
} explained;

/* Fails where the map could not be written later, before any work is done for it. */
tl_status explain_check(const explain_options *options, const char *input, tl_error *err);

/* Whether lighting has to keep what is told of. */
bool explain_wanted(const explain_options *options);

/* Takes from lighting that has just lit the job's G-buffer what is to be told, and measures what costs
 * are asked for. Fails with TL_ERR_MEMORY, and where those cannot be measured as tl_lighting_shade_without
 * and tl_lighting_time_tiles do. */
tl_status explain_take(const job *j,
                       tl_lighting *lighting,
                       const tl_lighting_options *options,
                       const tl_lighting_counts *counts,
                       explained *out,
                       tl_error *err);

/* Writes the map, and tells all: into the job's report, or on standard error where it has none. */
tl_status explain_tell(job *j,
                       const explain_options *options,
                       const explained *e,
                       tl_error *err);

void explained_clear(explained *e);

#endif
