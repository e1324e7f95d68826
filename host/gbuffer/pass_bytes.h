/* Bytes that our passes move, counted from the table of layouts and from what a frame has. */
#ifndef TL_PASS_BYTES_H
#define TL_PASS_BYTES_H

#include "tilelight/gbuffer.h"

/* Words of a pixel that a pass needs, bits 1 << word. */
typedef struct tl_pass_words {
    uint32_t positions; /* culling: where the surface is */
    uint32_t surfaces;  /* shading, before the lights: position, normal, how it reflects */
    uint32_t colors;    /* shading, after them: what light is multiplied by, and emission */
} tl_pass_words;

/* specular: whether the frame has lights and materials with highlights. */
tl_pass_words tl_pass_words_of(enum tl_layout_name layout, uint32_t present, bool specular);

/* Bytes per pixel of a set of words. */
uint32_t tl_words_size(enum tl_layout_name layout, uint32_t words);

/* What a frame comes to, as tl_lighting_counts has it. */
typedef struct tl_frame_extent {
    enum tl_layout_name layout;
    uint32_t present;
    bool specular;
    double pixels; /* of all tiles: those at the picture's edges are whole */
    double tiles, lights, list_entries;
} tl_frame_extent;

/* Bytes of a frame, read and written ones alike, each as often as a pass must have it from memory: what
 * is asked for again a few rows later is in a cache by then (a tile's words, a light of a list). */
typedef struct tl_pass_bytes {
    double words;    /* read */
    double lights;   /* read, with their rectangles */
    double tiles;    /* boxes, bits, counts, places of lists: written and read */
    double lists;    /* culling writes them, shading reads them */
    double radiance; /* written */
} tl_pass_bytes;

tl_pass_bytes tl_culling_bytes(const tl_frame_extent *of);

/* On the path for CPUs, which asks for every word of the next tile ahead. */
tl_pass_bytes tl_shading_bytes(const tl_frame_extent *of);

double tl_pass_bytes_sum(const tl_pass_bytes *bytes);

#endif
