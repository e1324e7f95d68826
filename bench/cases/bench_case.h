/* Cases of the bench: points on axes.
 *
 * An axis is one const struct: what it is called on the command line, and how one word of its list
 * becomes part of a case. A further layout, model or effect to measure is a name below and a row of
 * the table: command line, help, reports and comparison loop over it. */
#ifndef TL_BENCH_CASE_H
#define TL_BENCH_CASE_H

#include "bench_scene.h"
#include "tilelight/lighting.h"

/* The earlier ones change most slowly from case to case. */
typedef enum tl_bench_axis_name {
    TL_AXIS_DEVICE, /* its word is a selector for tl_device_open; "default" opens the default */
    TL_AXIS_SCENE,
    TL_AXIS_SIZE,
    TL_AXIS_MATERIAL,
    TL_AXIS_LAYERS,
    TL_AXIS_LIGHTS,
    TL_AXIS_PER_TILE,
    TL_AXIS_RANGE,
    TL_AXIS_AGAINST,
    TL_AXIS_LAYOUT,
    TL_AXIS_TILE,
    TL_AXIS_CULL,
    TL_AXIS_PRECISION,
    TL_AXIS_WIDTH,
    TL_AXIS_PATH,
    TL_AXIS_KNOBS, /* one for each of kernels/knobs.h, from here on */
    TL_AXIS_COUNT = TL_AXIS_KNOBS + TL_KNOB_COUNT
} tl_bench_axis_name;

enum { TL_BENCH_WORD_SIZE = 64 }; /* bytes */

typedef struct tl_bench_case {
    const tl_bench_scene *scene;
    tl_bench_scene_options scene_options;
    /* How its pixels are packed, and in what other layout the same frame is lit by turns with it;
     * where both are one, it is lit alone, but for a frame with layers: by turns with it without. */
    enum tl_layout_name layout, against;
    tl_lighting_options lighting;
    char words[TL_AXIS_COUNT][TL_BENCH_WORD_SIZE]; /* as given: what it is called */
} tl_bench_case;

typedef struct tl_bench_axis {
    const char *name;    /* of the option, without dashes; the key in JSON, the column in CSV */
    const char *values;  /* what the option takes, for the help */
    const char *meaning; /* a sentence, without its full stop unless it has several */
    const char *usual;   /* the word it has unless told otherwise */
    const char *all; /* what the word "all" stands for, a list; NULL: there is no such word */
    /* Fails with TL_ERR_ARGUMENT, naming the option and what it accepts. */
    tl_status (*set)(tl_bench_case *of, const char *word, tl_error *err);
} tl_bench_axis;

extern const tl_bench_axis tl_bench_axes[TL_AXIS_COUNT];

/* A list of words per axis; NULL: the usual one. */
typedef struct tl_bench_lists {
    const char *of[TL_AXIS_COUNT]; /* "27,54"; borrowed */
} tl_bench_lists;

/* Sets of cases that have names: what runs unless axes are given. A name may have several rows. */
typedef struct tl_bench_set {
    const char *name, *meaning;
    int only_if_named; /* 1: it takes minutes */
    tl_bench_lists lists;
} tl_bench_set;
extern const tl_bench_set tl_bench_sets[];
extern const int tl_bench_set_count;

typedef struct tl_bench_cases {
    tl_bench_case *cases; /* [count]; owned */
    size_t count;
} tl_bench_cases;

/* Appends the product of the lists, leaving out cases that are there already, and those of "all"
 * layouts whose layout has no place for a plane of the scene. Fails with
 * TL_ERR_ARGUMENT (a word; more than 10000 cases) or TL_ERR_MEMORY, *cases as before. */
tl_status tl_bench_cases_add(tl_bench_cases *cases, const tl_bench_lists *lists, tl_error *err);

/* Leaves it empty. */
void tl_bench_cases_clear(tl_bench_cases *cases);

/* Whether both have the same G-buffer but for its layout (scene, size, material); and the same lights in
 * it. */
int tl_bench_case_same_gbuffer(const tl_bench_case *a, const tl_bench_case *b);
int tl_bench_case_same_frame(const tl_bench_case *a, const tl_bench_case *b);

#endif
