/* What a case came to. */
#ifndef TL_BENCH_RECORD_H
#define TL_BENCH_RECORD_H

#include "bench_frame.h"
#include "peaks.h"
#include "sampling.h"
#include "storage_error.h"

/* The same frame in two layouts, or with its layers and without, by turns: times of one over those of the
 * other, pair by pair. */
typedef struct tl_bench_turns {
    uint32_t pixel_bytes;          /* of the other */
    tl_summary frame_ms;           /* of the other */
    tl_summary frame, cull, shade; /* ratios; count 0: the case was lit alone */
} tl_bench_turns;

/* The device of a case without one (a precision on the CPU) has an empty name. */
typedef struct tl_bench_record {
    tl_bench_case of;
    tl_device_info device;
    tl_peaks peaks;           /* of the device; all zero where none were measured */
    uint32_t plane_count;     /* of the frame in full float */
    uint32_t pixel_bytes;     /* of the G-buffer as it is packed */
    uint32_t depth_bytes;     /* of those, what positions are read from */
    uint32_t pitch, rows;     /* px */
    double range;             /* m, of every light */
    char build_options[1024]; /* of the kernels, as the OpenCL compiler was given them */
    tl_lighting_counts counts;
    tl_pair_counts pairs;
    tl_bench_turns turns;
    tl_storage_error error; /* of the case's layout */

    double first_ms; /* the first frame: programs are built or loaded, buffers made */
    double build_ms; /* of that, building or loading the programs */

    tl_summary frame_ms;                    /* tl_lighting_run, wall time */
    tl_summary kernel_cull_ms;              /* from profiling events */
    tl_summary kernel_shade_ms;             /* the same */
    tl_summary post_ms;                     /* from radiance to 8 bits, wall time */
    tl_summary shade_processors;            /* how many shading kept busy */
    int stage_count;                        /* of tl_lighting_run, wall time */
    const char *stage_names[TL_MAX_STAGES]; /* string literals */
    tl_summary stage_ms[TL_MAX_STAGES];
} tl_bench_record;

/* Lights the case's frame: once to warm up, then until `rule` has enough, the pictures dropped. A case
 * of two layouts lights by turns, and `rule` is of their frames' ratio; its error is found on the way.
 * device may be NULL where the precision needs none, peaks where shares do not matter. Fails as
 * tl_lighting_create, tl_lighting_run and tl_gbuffer_pack do. */
tl_status tl_bench_measure(tl_device *device,
                           const tl_peaks *peaks,
                           const tl_bench_case *of,
                           tl_bench_frame *frame,
                           const tl_sampling_rule *rule,
                           tl_bench_record *out,
                           tl_error *err);

#endif
