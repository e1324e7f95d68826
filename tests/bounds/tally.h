/* What trying many cases came to. */
#ifndef TL_TEST_TALLY_H
#define TL_TEST_TALLY_H

#include <stdint.h>

/* Each a number of cases. What a family does not claim stays 0. */
typedef struct tl_tally {
    uint64_t cases;
    uint64_t hits;  /* with something to lose: bounds that are not empty, a pixel that is lit */
    uint64_t lost;  /* lost some of it */
    uint64_t extra; /* kept more than one pixel beyond, on a side and an axis */
    uint64_t falsely_empty;
    uint64_t falsely_kept;
    uint64_t undecided; /* both answers are right: within the slack that is derived */
} tl_tally;

static inline uint64_t tally_violations(const tl_tally *t)
{
    return t->lost + t->extra + t->falsely_empty + t->falsely_kept;
}

static inline void tally_add(tl_tally *to, const tl_tally *more)
{
    to->cases += more->cases;
    to->hits += more->hits;
    to->lost += more->lost;
    to->extra += more->extra;
    to->falsely_empty += more->falsely_empty;
    to->falsely_kept += more->falsely_kept;
    to->undecided += more->undecided;
}

#endif
