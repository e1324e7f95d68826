/* cmocka with the headers it needs before it, and what every test uses. */
#ifndef TL_TESTING_H
#define TL_TESTING_H

#include "tilelight/error.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

/* What main returns when a test's needs are not met: CTest reports it as skipped. */
enum { TL_SKIPPED = 77 };

#define ASSERT_OK(step, err)               \
    do {                                   \
        if ((step) != TL_OK)               \
            fail_msg("%s", (err).message); \
    } while (0)

/* Same bits, NaN included. */
static inline int same_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* A path in the scratch folder of the build, in a buffer of the caller's. */
static inline const char *scratch_path(char *buffer, size_t size, const char *name)
{
    const char *folder = getenv("TILELIGHT_SCRATCH");
    snprintf(buffer, size, "%s/%s", folder ? folder : "/tmp", name);
    return buffer;
}

#endif
