/* What fuzzers share. A fuzzer is a function of bytes that must not crash, whatever they are, and checks what
 * its reader promises. libFuzzer calls it with bytes it makes up; replay.c with those of files. */
#ifndef TL_FUZZ_H
#define TL_FUZZ_H

#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* By libFuzzer's names. Both return 0. */
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the process with a sentence unless `condition` holds. */
void fuzz_must(bool condition, const char *format, ...) TL_PRINTF_LIKE(2, 3);

/* The path of a file with these bytes, in memory: the same file with every call. */
const char *fuzz_file(const void *data, size_t size);

/* A reader's promise: a failure comes with its status, and a sentence that names `path`. */
void fuzz_must_tell(tl_status status, const tl_error *err, const char *path);

/* Numbers from an input, from its start on; 0 where it has ended. */
typedef struct fuzz_bytes {
    const uint8_t *at;
    size_t left;
} fuzz_bytes;

uint8_t fuzz_byte(fuzz_bytes *from);
float fuzz_float(fuzz_bytes *from); /* of any bits */

#endif
