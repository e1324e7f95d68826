/* What a configuration came to on a frame: times and numbers, a row of a table each, over which JSON, CSV and
 * tests loop. */
#ifndef TL_STUDY_VALUES_H
#define TL_STUDY_VALUES_H

#include "statistics.h"
#include "study_knobs.h"

/* A time is taken in blocks, each by turns with the default configuration: what a block says is the median of
 * its samples. Those of lighting have kernels' buffers of their own in each, and lie apart: a block of every
 * configuration makes a round, so that what a machine does for a minute is in one block or two. */
enum { TL_STUDY_BLOCK_COUNT = 11 };

typedef struct tl_study_time {
    double median;    /* of the blocks'; NAN: not measured */
    double low, high; /* the least and the largest of the blocks': see tl_study_time_of */
    size_t samples;   /* of all blocks; 0 with numbers: known without measuring */
    int is_unstable; /* 1: it drifted while it was measured, or measured again it came out elsewhere */
} tl_study_time;

/* Of the blocks' medians, [count], in the order in which they were measured; count: 1 to
 * TL_STUDY_BLOCK_COUNT, which all have that are done.
 *
 * [low, high] is where another run's median lies, with the same number n = 2k + 1 of blocks, in 98.76 of 100.
 * For if the blocks of both runs are exchangeable, each of the C(2n, n) ways in which they may lie among each
 * other is as likely, whatever their distribution. The other run's median is above all of this run's blocks
 * where the k + 1 largest of all are the other's, and the remaining k of it anywhere among the 2n - k - 1 =
 * 3k + 1 smaller: in C(3k + 1, k) of them. So it is outside, above or below, with
 *
 *     2 C(3k + 1, k) / C(4k + 2, 2k + 1) = 2 * 4368 / 705432 = 0.0124 of k = 5
 *
 * (the largest case of Fligner and Wolfe, "Nonparametric prediction intervals for a future sample median",
 * Journal of the American Statistical Association 74, 1979). An interval for the median that this run knows
 * would be narrower, and miss another run's more often than it says.
 *
 * What drifts is not exchangeable: where the first k blocks are all below or all above the last k, it is
 * unstable, which by chance alone is so in 2 / C(2k, k) = 0.8 of 100. */
tl_study_time tl_study_time_of(const double *blocks, int count, size_t samples);

/* The probability derived above. */
double tl_study_interval_coverage(void);

/* Known without measuring. */
tl_study_time tl_study_time_known(double value);

/* X(name, word, meaning). Times are wall times in ms, ratios those of the default's, sample by sample. */
#define TL_STUDY_TIMES(X)                                                                     \
    X(TL_TIME_READ, "read_ms", "reading the G-buffer's file, which the system has in memory") \
    X(TL_TIME_CULL, "cull_ms", "the culling kernels, from profiling events")                  \
    X(TL_TIME_SHADE, "shade_ms", "the shading kernel, from profiling events")                 \
    X(TL_TIME_LIGHT, "light_ms", "from a G-buffer and lights to radiance, in memory")         \
    X(TL_TIME_TONE, "tone_ms", "of writing: exposure, tone curve and 8 bits")                 \
    X(TL_TIME_WRITE, "write_ms", "from radiance to a file that is synced")                    \
    X(TL_TIME_JOB, "job_ms", "reading, lighting and writing")                                 \
    X(TL_TIME_READ_RATIO, "read_ratio", "reading over the default's")                         \
    X(TL_TIME_LIGHT_RATIO, "light_ratio", "lighting over the default's")                      \
    X(TL_TIME_WRITE_RATIO, "write_ratio", "writing over the default's")                       \
    X(TL_TIME_JOB_RATIO, "job_ratio",                                                         \
      "the job over the default's: the ratios of its stages, weighed by the default's "       \
      "medians")

typedef enum tl_study_time_name {
#define TL_STUDY_TIME_NAME(name, word, meaning) name,
    TL_STUDY_TIMES(TL_STUDY_TIME_NAME)
#undef TL_STUDY_TIME_NAME
        TL_STUDY_TIME_COUNT
} tl_study_time_name;

/* X(name, word, unit, meaning). Errors are against the reference; those of radiance are relative to its mean.
 * Where the output is for a screen, all of error_, rms_, most_ and worst_ are of what the screen shows, 0 to
 * 1, against the reference's before rounding; screen_ is of the 8 bits that either output would show. */
#define TL_STUDY_VALUES(X)                                                                     \
    X(TL_VALUE_STORED, "bytes_stored", "bytes", "of a pixel of the G-buffer in memory")        \
    X(TL_VALUE_FILE, "bytes_file", "bytes", "of its file, per pixel")                          \
    X(TL_VALUE_MOVED, "bytes_moved", "bytes",                                                  \
      "per pixel that lighting must move: planes and "                                         \
      "picture once, positions and lists twice")                                               \
    X(TL_VALUE_PICTURE, "bytes_picture", "bytes", "of the picture's file, per pixel")          \
    X(TL_VALUE_ERROR_RMS, "error_rms", "", "root of the mean square")                          \
    X(TL_VALUE_ERROR_MEAN, "error_mean", "", "mean of absolute values")                        \
    X(TL_VALUE_ERROR_P999, "error_p999", "", "99.9 % of values are at most this far off")      \
    X(TL_VALUE_ERROR_MAX, "error_max", "", "the largest")                                      \
    X(TL_VALUE_PSNR, "psnr", "dB", "against the largest value; null where nothing differs")    \
    X(TL_VALUE_DIFFERING, "differing", "", "share of values whose bits differ")                \
    X(TL_VALUE_FLIP, "flip", "",                                                               \
      "mean FLIP, of radiance; where the output is for a screen of that")                      \
    X(TL_VALUE_FLIP_MAX, "flip_max", "", "its largest")                                        \
    X(TL_VALUE_SCREEN_MAX, "screen_max", "codes",                                              \
      "of 255, that a channel of the screen is off")                                           \
    X(TL_VALUE_SCREEN_BEYOND, "screen_beyond", "",                                             \
      "share of channels that are off by more than 1")                                         \
    X(TL_VALUE_RMS_STORAGE, "rms_storage", "", "of storage alone")                             \
    X(TL_VALUE_RMS_ARITHMETIC, "rms_arithmetic", "", "of arithmetic alone")                    \
    X(TL_VALUE_RMS_APPROXIMATION, "rms_approximation", "", "of approximation alone")           \
    X(TL_VALUE_RMS_CULLING, "rms_culling", "", "of culling alone")                             \
    X(TL_VALUE_RMS_OUTPUT, "rms_output", "", "of the output alone")                            \
    X(TL_VALUE_MOST_STORAGE, "most_storage", "", "the largest of storage alone")               \
    X(TL_VALUE_MOST_ARITHMETIC, "most_arithmetic", "", "the largest of arithmetic alone")      \
    X(TL_VALUE_MOST_APPROXIMATION, "most_approximation", "",                                   \
      "the largest of approximation alone")                                                    \
    X(TL_VALUE_MOST_CULLING, "most_culling", "", "the largest of culling alone")               \
    X(TL_VALUE_MOST_OUTPUT, "most_output", "", "the largest of the output alone")              \
    X(TL_VALUE_CULLING_DIFFERING, "culling_differing", "values", "whose bits culling changes") \
    X(TL_VALUE_WORST_X, "worst_x", "px", "of the largest error")                               \
    X(TL_VALUE_WORST_Y, "worst_y", "px", "the same")                                           \
    X(TL_VALUE_WORST_CHANNEL, "worst_channel", "", "0 red, 1 green, 2 blue")                   \
    X(TL_VALUE_WORST_GOT, "worst_got", "", "the value there")                                  \
    X(TL_VALUE_WORST_EXPECTED, "worst_expected", "", "the reference's")                        \
    X(TL_VALUE_WORST_STORAGE, "worst_storage", "", "that storage adds there")                  \
    X(TL_VALUE_WORST_ARITHMETIC, "worst_arithmetic", "", "that arithmetic adds there")         \
    X(TL_VALUE_WORST_APPROXIMATION, "worst_approximation", "",                                 \
      "that approximation adds there")                                                         \
    X(TL_VALUE_WORST_CULLING, "worst_culling", "", "that culling adds there")                  \
    X(TL_VALUE_WORST_OUTPUT, "worst_output", "", "that the output adds there")                 \
    X(TL_VALUE_WORST_HIGHLIGHT, "worst_highlight", "",                                         \
      "share of the reference there that is highlight")                                        \
    X(TL_VALUE_FRONT_LIGHT, "front_light", "", "1: none lights faster with as small an error") \
    X(TL_VALUE_FRONT_JOB, "front_job", "",                                                     \
      "1: no job from file to file is faster with as small an error")

typedef enum tl_study_value_name {
#define TL_STUDY_VALUE_NAME(name, word, unit, meaning) name,
    TL_STUDY_VALUES(TL_STUDY_VALUE_NAME)
#undef TL_STUDY_VALUE_NAME
        TL_STUDY_VALUE_COUNT
} tl_study_value_name;

/* What blocks of lighting say. */
enum { TL_STUDY_LIT_COUNT = 4 };
extern const tl_study_time_name tl_study_lit_times[TL_STUDY_LIT_COUNT];

/* Of lighting, so far. */
typedef struct tl_study_blocks {
    double medians[TL_STUDY_LIT_COUNT]
                  [TL_STUDY_BLOCK_COUNT]; /* [..][count]; by tl_study_lit_times */
    int count;
    size_t samples;
} tl_study_blocks;

typedef struct tl_study_record {
    tl_study_config config;
    tl_study_blocks lit;
    double seconds; /* that its lighting was sampled at most */
    tl_study_time times[TL_STUDY_TIME_COUNT];
    double values[TL_STUDY_VALUE_COUNT]; /* NAN: not known, or not of this configuration */
    char worst_cause[32];  /* a word of TL_STUDY_CAUSES; empty where nothing differs */
    char worst_detail[64]; /* of storage the attribute, else the knob; may be empty */
    char map[128]; /* picture of the errors, a file in the study's folder; may be empty */
    tl_study_time
        again; /* the time that tl_study_judged names, of a second run; NAN: there was none */
} tl_study_record;

/* Of a record's times the one that a second run is held against: of lighting where it was measured, else of
 * the job; each over the default's. */
tl_study_time_name tl_study_judged(const tl_study_record *record);

/* Whether a second run came out inside the interval of the first: 1 or 0; -1: there was none. */
int tl_study_stays(const tl_study_record *record);

/* Notes the times of a second run, and marks the first one's unstable where they are outside. */
void tl_study_note_again(tl_study_record *record,
                         const tl_study_time times[TL_STUDY_TIME_COUNT]);

/* Fills in the times of lighting from its blocks; there is one at least. */
void tl_study_note_blocks(tl_study_record *record);

/* All not measured. */
tl_study_record tl_study_record_empty(const tl_study_config *config, double seconds);

typedef struct tl_study_row {
    const char *name, *unit, *meaning;
} tl_study_row;
extern const tl_study_row tl_study_time_rows[TL_STUDY_TIME_COUNT];
extern const tl_study_row tl_study_value_rows[TL_STUDY_VALUE_COUNT];

/* Whether the picture's numbers are for a screen. */
int tl_study_is_for_screen(const tl_study_config *config);

#endif
