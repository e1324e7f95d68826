/* A user's shading kernel beside ours, on the same frame and the same lists. */
#ifndef TL_KERNEL_RATIO_H
#define TL_KERNEL_RATIO_H

#include "bench_frame.h"
#include "sampling.h"

typedef struct tl_kernel_ratio {
    tl_lighting_counts counts;
    tl_summary ratio; /* theirs over ours, pair by pair: below 1 theirs is faster */
    tl_summary ours_ms, theirs_ms; /* of the shading kernels, from profiling events */
    tl_summary ours_frame_ms, theirs_frame_ms; /* tl_lighting_run, wall time */
    double build_ms;                           /* building or loading the program with theirs */
    double rms_difference, max_difference;     /* of their picture to ours, over our mean */
} tl_kernel_ratio;

/* Lights the case's frame by turns, ours, theirs, ours, theirs, after once each to warm up, until
 * `rule` has enough of the ratio. Fails with TL_ERR_ARGUMENT where the case runs on no device, and as
 * tl_lighting_create and tl_lighting_run do. */
tl_status tl_kernel_ratio_measure(tl_device *device,
                                  const tl_bench_case *of,
                                  const tl_user_kernel *kernel,
                                  tl_bench_frame *frame,
                                  const tl_sampling_rule *rule,
                                  tl_kernel_ratio *out,
                                  tl_error *err);

#endif
