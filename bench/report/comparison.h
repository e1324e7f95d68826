/* Whether a case became faster or slower since a report was written. */
#ifndef TL_COMPARISON_H
#define TL_COMPARISON_H

#include "bench_record.h"

#include <jansson.h>

/* X(name, word, meaning) */
#define TL_VERDICTS(X)                                                              \
    X(TL_FASTER, "faster", "all of the interval is below 1 / (1 + threshold)")      \
    X(TL_SLOWER, "slower", "all of it is above 1 + threshold")                      \
    X(TL_SAME, "same", "all of it lies between the two")                            \
    X(TL_UNDECIDED, "undecided", "it reaches over a bound, or one has no interval") \
    X(TL_NEW, "new", "the report has no such case")

typedef enum tl_verdict {
#define TL_VERDICT_NAME(name, word, meaning) name,
    TL_VERDICTS(TL_VERDICT_NAME)
#undef TL_VERDICT_NAME
        TL_VERDICT_COUNT
} tl_verdict;

extern const char *const tl_verdict_words[TL_VERDICT_COUNT];

typedef struct tl_comparison {
    tl_verdict verdict;
    double before_ms, now_ms; /* medians */
    double ratio;             /* now over before */
    double low, high;         /* of the ratio: now's low over before's high, and the reverse */
} tl_comparison;

/* From two medians with their intervals. Each interval holds its median at 95 %, so both do at 90 %
 * at least, and the ratio then lies in the quotient of the two. threshold: above 0; 0.05 is 5 %. */
tl_comparison tl_compare_times(const tl_summary *before,
                               const tl_summary *now,
                               double threshold);

/* A report of `tilelight bench` with records. The caller releases *out. Fails with TL_ERR_READ,
 * TL_ERR_FORMAT (it is not one, or of another version) or TL_ERR_MEMORY. */
tl_status tl_bench_report_read(const char *path, json_t **out, tl_error *err);

/* The record's frame time against that of the report's record with the same words on each axis.
 * Fails with TL_ERR_FORMAT, naming `path`, where that has no times. */
tl_status tl_compare_record(const json_t *report,
                            const char *path,
                            const tl_bench_record *record,
                            double threshold,
                            tl_comparison *out,
                            tl_error *err);

/* A new reference, NULL out of memory. */
json_t *tl_comparison_json(const tl_comparison *comparison);

#endif
