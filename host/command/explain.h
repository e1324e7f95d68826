/* What a frame called for, and what that came to: `--explain` and `--explain-map' of render and light. */
#ifndef TL_EXPLAIN_H
#define TL_EXPLAIN_H

#include "job.h"
#include "tilelight/lighting.h"

#include <argp.h>

typedef struct explain_options {
    bool text;       /* --explain */
    const char *map; /* a PNG; NULL: none */
} explain_options;

/* Its input is an explain_options, all zero to begin with. */
extern const struct argp explain_argp;

/* A frame that was lit. All zero to begin with; released with explained_clear. */
typedef struct explained {
    tl_explanation of;
    tl_lighting_counts counts;
    char build[1024]; /* what kernels were built with; empty where there were none */
    uint32_t tile_size, tiles_x, tiles_y;
    uint32_t *lights;   /* [tiles_y][tiles_x], listed by each tile */
    uint32_t *surfaces; /* [tiles_y][tiles_x], pixels that show a surface */
} explained;

/* Fails where the map could not be written later, before any work is done for it. */
tl_status explain_check(const explain_options *options, const char *input, tl_error *err);

/* Whether lighting has to keep what is told of. */
bool explain_wanted(const explain_options *options);

/* Takes from lighting that has just lit the job's G-buffer what is to be told. Fails with TL_ERR_MEMORY. */
tl_status explain_take(const job *j,
                       const tl_lighting *lighting,
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
