/* What the documents claim that layouts and formulas come from, measured again: theirs beside ours.
 *
 * A claim is a row of one table; command, JSON and tests loop over it. */
#ifndef TL_STUDY_CLAIMS_H
#define TL_STUDY_CLAIMS_H

#include "tilelight/error.h"
#include "tilelight/lighting.h"

#include <stddef.h>

/* One line: what they say, and what we find. */
typedef struct tl_claim_figure {
    char what[160], unit[32]; /* for people */
    double theirs
        [2]; /* from, to; the same twice where they give one number; NAN: they give none */
    double ours, low,
        high; /* of several measurements the median, least and largest; computed: alike */
} tl_claim_figure;

enum { TL_CLAIM_MOST_FIGURES = 24 };

typedef struct tl_claim_figures {
    tl_claim_figure of[TL_CLAIM_MOST_FIGURES];
    size_t count; /* 0: not measured */
} tl_claim_figures;

/* How it is measured. */
typedef struct tl_claim_options {
    tl_device *device;
    uint32_t width, height; /* px, of frames whose size the claim does not say */
    double seconds;         /* that each time is sampled */
} tl_claim_options;

typedef struct tl_claim {
    const char *name; /* a word */
    const char *claim, *source;
    const char *method; /* how ours came to be */
    tl_status (*find)(const tl_claim_options *options, tl_claim_figures *out, tl_error *err);
} tl_claim;

enum { TL_CLAIM_COUNT = 5 };
extern const tl_claim tl_claims[TL_CLAIM_COUNT];

/* A further line, computed. what: cut to fit. */
tl_claim_figure *tl_claim_add(tl_claim_figures *figures,
                              const char *unit,
                              double theirs_from,
                              double theirs_to,
                              double ours,
                              const char *what,
                              ...) __attribute__((format(printf, 6, 7)));

/* Of the rows; each replaces *out when it is done. Those that light frames fail as tl_lighting_run and
 * tl_bench_scene_make do, all with TL_ERR_MEMORY. */
tl_status tl_claim_position_buffer(const tl_claim_options *options,
                                   tl_claim_figures *out,
                                   tl_error *err);
tl_status tl_claim_scissors(const tl_claim_options *options,
                            tl_claim_figures *out,
                            tl_error *err);
tl_status tl_claim_bandwidth(const tl_claim_options *options,
                             tl_claim_figures *out,
                             tl_error *err);
tl_status tl_claim_operations(const tl_claim_options *options,
                              tl_claim_figures *out,
                              tl_error *err);
tl_status tl_claim_half_positions(const tl_claim_options *options,
                                  tl_claim_figures *out,
                                  tl_error *err);

/* What view_position and depth_of (kernels/position.h, depth_code.h) compute for a pixel under a perspective
 * camera, by what is stored. tests/test_position_operations.cpp counts them. */
typedef struct tl_position_operations {
    const char *stored;              /* "forward": a convention of depth_code.h */
    int of_depth[4], of_position[4]; /* additions, multiplications, fused ones, divisions */
} tl_position_operations;

enum { TL_POSITION_OPERATION_ROWS = 4 };
extern const tl_position_operations tl_position_operations_of[TL_POSITION_OPERATION_ROWS];

#endif
