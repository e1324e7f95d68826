/* Records as CSV (RFC 4180, ends of lines as in Unix files): a line of names, then a line each. */
#ifndef TL_BENCH_CSV_H
#define TL_BENCH_CSV_H

#include "figures.h"

/* The whole text; the caller frees *out. Times are in ms. Fails with TL_ERR_MEMORY. */
tl_status tl_bench_csv(const tl_bench_record *records, size_t count, char **out, tl_error *err);

#endif
