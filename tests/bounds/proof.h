/* All families of cases, by group, and the trying of many. */
#ifndef TL_TEST_PROOF_H
#define TL_TEST_PROOF_H

#include "bounds/tally.h"

typedef struct tl_bound_group {
    const char *name;
    const char *hit; /* what tl_tally.hits counts */
    unsigned one_of; /* it gets one of so many cases that spheres get */
    int family_count;
    const char *(*family_name)(int family);
    /* Tries one case; adds it to the tally. The same for the same seed, family and index. */
    void (*attempt)(uint64_t seed, int family, uint64_t index, tl_tally *tally);
} tl_bound_group;

enum { TL_BOUND_GROUPS = 3 }; /* spheres, tiles, cones */
extern const tl_bound_group tl_bound_groups[TL_BOUND_GROUPS];

/* Tries cases 0 to count - 1 of a family, on as many threads as tl_parallel takes; the tally does not depend
 * on how many. *first becomes the least index that breaks the claim, UINT64_MAX if none does. */
tl_tally tl_try_family(
    const tl_bound_group *group, int family, uint64_t seed, uint64_t count, uint64_t *first);

#endif
