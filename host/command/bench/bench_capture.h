/* A frame of a bench from a file, in place of a scene. */
#ifndef TL_BENCH_CAPTURE_H
#define TL_BENCH_CAPTURE_H

#include "bench_frame.h"

/* Fills an empty *frame: what our kernels light is as the file has it, gbuffer the same in full float.
 * Fails as tl_capture_read does, or with TL_ERR_ARGUMENT where the file brings no lights, or others than
 * point lights with a range. */
tl_status bench_capture_frame(const char *path, tl_bench_frame *frame, tl_error *err);

#endif
