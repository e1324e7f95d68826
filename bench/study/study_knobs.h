/* What trades accuracy for time: every knob is a row of one table, and a configuration is a word of each.
 *
 * A further one is a name below and its row: plan, help, chain of causes, JSON, CSV and tests loop over the
 * table. */
#ifndef TL_STUDY_KNOBS_H
#define TL_STUDY_KNOBS_H

#include "bench_case.h"
#include "tilelight/gbuffer_file.h"

/* Where an error comes from, in the order in which a picture comes to be: each is what the picture differs
 * by from the one before, in which this knob and those of later causes are exact.
 * X(name, word, meaning) */
#define TL_STUDY_CAUSES(X)                                                                    \
    X(TL_STUDY_STORAGE, "storage", "what the bits of the G-buffer do not hold")               \
    X(TL_STUDY_ARITHMETIC, "arithmetic", "rounding, in the exact forms of all formulas")      \
    X(TL_STUDY_APPROXIMATION, "approximation",                                                \
      "forms that are not exact, lights that end early")                                      \
    X(TL_STUDY_CULLING, "culling", "which lights a tile computes; nothing, or it is a fault") \
    X(TL_STUDY_OUTPUT, "output", "what the numbers of the picture's file do not hold")

typedef enum tl_study_cause {
#define TL_STUDY_CAUSE_NAME(name, word, meaning) name,
    TL_STUDY_CAUSES(TL_STUDY_CAUSE_NAME)
#undef TL_STUDY_CAUSE_NAME
        TL_STUDY_CAUSE_COUNT
} tl_study_cause;

extern const char *const tl_study_cause_words[TL_STUDY_CAUSE_COUNT];
extern const char *const tl_study_cause_meanings[TL_STUDY_CAUSE_COUNT];

/* What the picture is written as.
 * X(name, word, meaning) */
#define TL_STUDY_OUTPUTS(X)                                        \
    X(TL_STUDY_FLOAT, "float", "OpenEXR in float, not compressed") \
    X(TL_STUDY_HALF, "half", "OpenEXR in half float, zip")         \
    X(TL_STUDY_PNG, "png", "PNG, 8 bits after exposure, tone curve and curve of the codes")

typedef enum tl_study_output {
#define TL_STUDY_OUTPUT_NAME(name, word, meaning) name,
    TL_STUDY_OUTPUTS(TL_STUDY_OUTPUT_NAME)
#undef TL_STUDY_OUTPUT_NAME
        TL_STUDY_OUTPUT_COUNT
} tl_study_output;

typedef enum tl_study_knob_name {
    TL_STUDY_KNOB_LAYOUT,
    TL_STUDY_KNOB_COMPRESSION,
    TL_STUDY_KNOB_PRECISION,
    TL_STUDY_KNOB_WIDTH,
    TL_STUDY_KNOB_CUTOFF,
    TL_STUDY_KNOB_FILTER,
    TL_STUDY_KNOB_OCCLUSION,
    TL_STUDY_KNOB_LAYERS,
    TL_STUDY_KNOB_APPROXIMATIONS, /* one for each of kernels/knobs.h, from here on */
    TL_STUDY_KNOB_CULL = TL_STUDY_KNOB_APPROXIMATIONS + TL_KNOB_COUNT,
    TL_STUDY_KNOB_TILE,
    TL_STUDY_KNOB_OUTPUT,
    TL_STUDY_KNOB_COUNT
} tl_study_knob_name;

/* Words are shorter than TL_BENCH_WORD_SIZE. */
typedef struct tl_study_config {
    tl_bench_case of; /* its layout, and how it is lit but for the cut-off; no scene */
    double
        cutoff; /* light that lights end at, over the mean radiance of the frame; 0: they do not */
    tl_compression compression; /* of the G-buffer's file */
    tl_study_output output;
    char words[TL_STUDY_KNOB_COUNT][TL_BENCH_WORD_SIZE];
} tl_study_config;

/* What a frame has, as far as knobs ask. */
typedef struct tl_study_needs {
    uint32_t present;   /* planes, bits 1 << plane */
    int has_endless;    /* some light has no range, and is no directional one */
    int has_highlights; /* some light and some material */
    int has_shadows;    /* maps of lights that cast some */
    int has_layers;
    int has_occlusion; /* ambient light, and a radius within which surfaces keep it from others */
    int has_double;    /* the device can */
} tl_study_needs;

typedef struct tl_study_knob {
    const char *name; /* a word: --knob NAME=...; the key in JSON, the column in CSV */
    const char *meaning, *trades;
    tl_study_cause cause;
    int is_of_files;   /* 1: a frame in memory is lit the same whatever it is */
    const char *usual; /* word of the default configuration */
    /* what adds no error of this cause. Of culling it is what computes every light for every pixel, or where
     * that takes too long all that a rectangle meets */
    const char *exact;
    const char *
        alone; /* list of words that are tried with all else as usual; "all" stands for `all` */
    const char *quick; /* the same with --quick; NULL: none */
    const char *all;   /* every word there is, for the help; NULL: numbers */
    int axis;          /* of the bench, which sets it; -1: `set` does */
    /* Fails with TL_ERR_ARGUMENT. NULL with an axis. */
    tl_status (*set)(tl_study_config *config, const char *word, tl_error *err);
    /* Whether a frame has a use for the configuration, by this knob's word. NULL: always. */
    int (*fits)(const tl_study_needs *needs, const tl_study_config *config);
} tl_study_knob;

extern const tl_study_knob tl_study_knobs[TL_STUDY_KNOB_COUNT];

/* Every knob at its usual word. */
tl_study_config tl_study_config_default(void);

/* Sets a knob. Fails with TL_ERR_ARGUMENT, naming the knob and what it accepts, *config as before. */
tl_status tl_study_config_set(tl_study_config *config,
                              tl_study_knob_name knob,
                              const char *word,
                              tl_error *err);

int tl_study_config_is_same(const tl_study_config *a, const tl_study_config *b);

/* Whether all knobs fit. */
int tl_study_config_fits(const tl_study_config *config, const tl_study_needs *needs);

/* Whether all knobs that are of files, or all that are not, have their usual words. */
int tl_study_config_is_usual(const tl_study_config *config, int is_of_files);

/* "layout=merlin tile=32": what is not usual; "default" where all is. text: [size], cut to fit. */
void tl_study_config_title(const tl_study_config *config, char *text, size_t size);

#endif
