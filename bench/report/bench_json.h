/* Records as JSON. Every function returns a new reference, NULL out of memory. */
#ifndef TL_BENCH_JSON_H
#define TL_BENCH_JSON_H

#include "figures.h"
#include "machine.h"

#include <jansson.h>

enum { TL_BENCH_JSON_VERSION = 1 };

/* What every report of the bench begins with: version of the format, machine. */
json_t *tl_bench_json_begin(const tl_machine *machine);

/* Times in ms, or whatever else was sampled. Without an interval worth the name (one sample) that
 * is null. */
json_t *tl_bench_json_summary(const tl_summary *summary);

json_t *tl_bench_json_device(const tl_device_info *device);
json_t *tl_bench_json_peaks(const tl_peaks *peaks);

/* Its words by axis. */
json_t *tl_bench_json_case(const tl_bench_case *of);
json_t *tl_bench_json_record(const tl_bench_record *record);

#endif
