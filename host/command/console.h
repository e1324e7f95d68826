/* What the program says on standard error: errors, notices, and the stage it is in. One process,
 * one standard error, so the state is the module's. Any thread may call. */
#ifndef TL_CONSOLE_H
#define TL_CONSOLE_H

#include "tilelight/report.h"

#include <stdbool.h>

/* Silences notices and progress; errors stay. */
void console_quiet(bool quiet);

/* Shows the stage on a line of its own that the next one overwrites; nothing unless standard error
 * is a terminal. NULL clears the line. */
void console_stage(const char *stage);

/* Until it is called with NULL, notices go to `to` and stages are not shown: where many frames are under way.
 * Where notices were silenced none go. */
void console_lend(const tl_notices *to);

/* A line like that of a stage, whoever has the notices. NULL clears it. */
void console_progress(const char *line);

/* A sentence, as notices are said, whoever has them. */
void console_say(const char *sentence);

/* The same where notices are silenced, too: for what failed. */
void console_complain(const char *sentence);

/* For functions that take tl_notices: each sentence on a line, "tilelight: " in front, without
 * what would steer the terminal. */
extern const tl_notices console_notices;

/* Says err->message likewise and returns the exit status of `status`. TL_OK says nothing. */
int console_finish(tl_status status, const tl_error *err);

/* Ends standard output: TL_ERR_WRITE where something written to it did not arrive. */
tl_status console_flush(tl_error *err);

#endif
