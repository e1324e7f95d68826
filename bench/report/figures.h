/* What follows from a record: one row a figure, which table, CSV and JSON loop over. */
#ifndef TL_FIGURES_H
#define TL_FIGURES_H

#include "bench_record.h"

/* Of the times of a record, those that every case has. */
typedef struct tl_bench_time {
    const char *name;
    size_t offset; /* of a tl_summary in tl_bench_record, ms or a ratio */
    const char *meaning;
} tl_bench_time;
extern const tl_bench_time tl_bench_times[];
extern const int tl_bench_time_count;

/* Of two layouts by turns, the case's time over the other's; summaries of count 0 where it was lit
 * alone. */
extern const tl_bench_time tl_bench_ratios[];
extern const int tl_bench_ratio_count;

const tl_summary *tl_bench_time_of(const tl_bench_time *time, const tl_bench_record *record);

typedef struct tl_figure {
    const char *name, *meaning;
    int is_share; /* of a measured peak: above 1 the unit is wrong somewhere */
    /* NAN where the case has no such figure. */
    double (*of)(const tl_bench_record *record);
} tl_figure;
extern const tl_figure tl_figures[];
extern const int tl_figure_count;

/* 0 for a share above 1. The peak is itself a measurement, so a few per cent more are allowed. */
int tl_figure_is_possible(const tl_figure *figure, double value);

#endif
