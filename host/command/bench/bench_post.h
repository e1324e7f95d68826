/* What each stage after lighting costs, against what it has to read and write. */
#ifndef TL_BENCH_POST_H
#define TL_BENCH_POST_H

#include "bench_session.h"

#include <jansson.h>

/* Appends a row a stage to `rows`, and prints it where the session has a table; then keep(context) is called.
 * Behind them, rows of what makes codes for a file, on the device and on the host. of: size, and how it is
 * computed. The session's device is open. Fails as tl_post_run and keep do. */
tl_status bench_post_stages(bench_session *session,
                            const tl_bench_case *of,
                            const tl_sampling_rule *rule,
                            json_t *rows,
                            tl_status (*keep)(void *context, tl_error *err),
                            void *context,
                            tl_error *err);

#endif
