/* What each tile has of something, as a picture: lights that it lists, or time that it takes. */
#ifndef TL_EXPLAIN_MAP_H
#define TL_EXPLAIN_MAP_H

#include "explain.h"

/* Values that are shown alike: those above `above`, up to `to`. */
typedef struct map_class {
    double above, to;
    uint8_t color[3]; /* sRGB */
    uint32_t tiles;
} map_class;

enum { MOST_MAP_CLASSES = 8 };

typedef struct map_scale {
    const uint32_t *lights; /* what is shown, [tiles]: one of the two */
    const double *us;
    map_class
        of[MOST_MAP_CLASSES + 1]; /* [count]; of lights the first is no light at all, black */
    int count;
    uint8_t sky[3]; /* of lights, tiles of sky alone: grey, which no class is */
    uint32_t sky_tiles;
} map_scale;

/* Lights listed: even classes up to the most lights of any tile that shows a surface. Cannot fail. */
map_scale explain_map_scale(const explained *e);

/* Time per tile: even classes up to what one tile in a hundred exceeds, and those with the last; sky too.
 * Fails with TL_ERR_MEMORY. */
tl_status explain_cost_scale(const explained *e, map_scale *out, tl_error *err);

/* A picture of the job's size, tile by tile in the colours of the scale. Fails with TL_ERR_WRITE or
 * TL_ERR_MEMORY. */
tl_status explain_map_write(
    const job *j, const explained *e, const map_scale *scale, const char *path, tl_error *err);

/* What its colours mean: on standard error, and as JSON, a new reference. */
void explain_map_print(const map_scale *scale, const char *path);
json_t *explain_map_json(const map_scale *scale, const char *path);

#endif
