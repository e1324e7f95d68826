/* Lights per tile as a picture. */
#ifndef TL_EXPLAIN_MAP_H
#define TL_EXPLAIN_MAP_H

#include "explain.h"

/* Counts of lights that are shown alike. */
typedef struct map_class {
    uint32_t from, to; /* lights listed, both included */
    uint8_t color[3];  /* sRGB */
    uint32_t tiles;
} map_class;

enum { MOST_MAP_CLASSES = 8 };

typedef struct map_scale {
    map_class of[MOST_MAP_CLASSES + 1]; /* [count]: the first is no light at all, black */
    int count;
    uint8_t sky[3]; /* tiles of sky alone: grey, which no class is */
    uint32_t sky_tiles;
} map_scale;

/* Even classes up to the most lights of any tile that shows a surface. Cannot fail. */
map_scale explain_map_scale(const explained *e);

/* A picture of the job's size, tile by tile in the colours of the scale. Fails with TL_ERR_WRITE or
 * TL_ERR_MEMORY. */
tl_status explain_map_write(
    const job *j, const explained *e, const map_scale *scale, const char *path, tl_error *err);

#endif
