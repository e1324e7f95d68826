/* What accuracy is given away for time: knobs of the kernels that change the picture. Their tables, with what
 * each row may be off by and where that comes from, are those of kernels/knobs.h. */
#ifndef TL_APPROXIMATIONS_H
#define TL_APPROXIMATIONS_H

#include "error.h"
#include "knobs.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The row of each knob. All zero: what is exact as far as float is, and the same bit for bit everywhere. */
typedef struct tl_approximations {
    uint32_t of[TL_KNOB_COUNT];
} tl_approximations;

/* How far a choice may be off beside what float is allowed anyway: kernels/knobs.h, whose columns of
 * TL_OFF these are. */
typedef struct tl_off {
    double log2, exp2, cosine, root, quotient;
} tl_off;

typedef struct tl_knob_row {
    const char *word, *meaning, *source;
    uint32_t traits; /* bits of tl_knob_trait */
    tl_off off;
} tl_knob_row;

typedef struct tl_knob {
    const char *word, *meaning;
    const tl_knob_row *rows; /* [count] */
    uint32_t count;
} tl_knob;

extern const tl_knob tl_knobs[TL_KNOB_COUNT];

bool tl_approximations_are_default(const tl_approximations *of);

/* Whether all that was chosen has these traits. */
bool tl_approximations_have(const tl_approximations *of, enum tl_knob_trait traits);

/* The first choice that lacks them, as the command has it: "--power native". text: [size], NUL-terminated,
 * cut to fit; empty where there is none. */
void tl_approximations_lacking(const tl_approximations *of,
                               enum tl_knob_trait traits,
                               char *text,
                               size_t size);

/* Of all choices together, to first order. */
tl_off tl_approximations_off(const tl_approximations *of);

/* Fails with TL_ERR_ARGUMENT where a knob has no such row. */
tl_status tl_approximations_check(const tl_approximations *of, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
