/* The program itself, started to be measured: with files of its own in a folder that goes away again, and compiled
 * programs kept in there and nowhere else. */
#ifndef TL_BENCH_CHILD_H
#define TL_BENCH_CHILD_H

#include "tilelight/error.h"

enum { BENCH_PATH_SIZE = 256 };

/* Makes an empty folder. Fails with TL_ERR_WRITE; *folder is "" then. `wanted_by` is an option, for messages. */
tl_status bench_folder_make(const char *wanted_by, char folder[BENCH_PATH_SIZE], tl_error *err);

/* With all that is in it. Accepts "". */
void bench_folder_remove(const char *folder);

/* Runs the program with these arguments, NULL-terminated, from the name on; standard output goes to the file
 * `report`, compiled programs to the folder `cache`. Fails with TL_ERR_DIFFERENT where it does, and with
 * TL_ERR_ARGUMENT. For one thread. */
tl_status bench_child_run(char *const *arguments,
                          const char *cache,
                          const char *report,
                          tl_error *err);

#endif
