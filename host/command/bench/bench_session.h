/* What the modes of `tilelight bench` share: the device that cases are measured on, with its peaks,
 * and the frame that they light. */
#ifndef TL_BENCH_SESSION_H
#define TL_BENCH_SESSION_H

#include "bench_options.h"
#include "bench_record.h"
#include "machine.h"

#include <stdio.h>

/* Begun with bench_session_begin, released with bench_session_end. */
typedef struct bench_session {
    const bench_options *options;
    tl_machine machine;
    FILE *table; /* where lines for people go; NULL: nowhere */
    tl_bench_cases cases;
    tl_device *device;
    char device_word[TL_BENCH_WORD_SIZE]; /* what it was opened by */
    tl_peaks peaks;
    tl_bench_frame frame;
} bench_session;

/* Refuses outputs that could not be written. Fails with TL_ERR_WRITE. */
tl_status bench_session_begin(bench_session *session,
                              const bench_options *options,
                              tl_error *err);
void bench_session_end(bench_session *session);

/* The device of the case, opened unless it is open already. Fails as tl_device_open does. */
tl_status bench_session_device(bench_session *session, const tl_bench_case *of, tl_error *err);

/* And its peaks, measured unless they are known. */
tl_status bench_session_peaks(bench_session *session, tl_error *err);

/* The modes, each to its end. */
tl_status bench_run_cases(bench_session *session, tl_error *err);
tl_status bench_run_batch(bench_session *session, tl_error *err);
tl_status bench_run_startup(bench_session *session, tl_error *err);
tl_status bench_run_growth(bench_session *session, tl_error *err);
tl_status bench_run_baselines(bench_session *session, tl_error *err);
tl_status bench_run_effects(bench_session *session, tl_error *err);
tl_status bench_run_sky(bench_session *session, tl_error *err);
tl_status bench_run_kernel(bench_session *session, tl_error *err);

#endif
