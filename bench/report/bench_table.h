/* Records as lines for people. */
#ifndef TL_BENCH_TABLE_H
#define TL_BENCH_TABLE_H

#include "figures.h"

#include <stdio.h>

void tl_bench_table_heading(FILE *out);

/* A line, and one more for each figure that cannot be. */
void tl_bench_table_line(FILE *out, const tl_bench_record *record);

/* The case by the words that are not the usual ones, behind the scene: "spheres cull=rect". */
void tl_bench_case_title(const tl_bench_case *of, char *text, size_t size);

#endif
