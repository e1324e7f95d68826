/* The configurations that a promise chooses among: everything that changes the picture, and nothing that does
 * not. The layout is the capture's own. */
#ifndef TL_PROMISE_CANDIDATES_H
#define TL_PROMISE_CANDIDATES_H

#include "prepared.h"

#include "tilelight/lighting.h"

typedef struct tl_candidate {
    tl_precision precision;
    float light_cutoff;               /* lx */
    tl_approximations approximations; /* kernels/knobs.h */
} tl_candidate;

enum { TL_MOST_CANDIDATES = 32 };

/* [tl_candidate_count]. The first is the one that pictures are first judged by; the last is the reference,
 * which all are held against. */
extern const tl_candidate tl_candidates[];
extern const uint32_t tl_candidate_count;

/* Its options, as the command has them. text: [size], NUL-terminated, cut to fit. */
void tl_candidate_name(uint32_t candidate, char *text, size_t size);

/* `base` with what the candidate says in place of its own. */
tl_lighting_options tl_candidate_options(uint32_t candidate, const tl_lighting_options *base);

/* Whether it may give another picture of this frame than those before it in the table, on this device. */
int tl_candidate_suits(uint32_t candidate,
                       const tl_device_info *device,
                       const tl_prepared *prepared);

#endif
