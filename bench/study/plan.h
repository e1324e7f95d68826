/* Which configurations a study measures. */
#ifndef TL_STUDY_PLAN_H
#define TL_STUDY_PLAN_H

#include "study_knobs.h"

/* All zero is empty. */
typedef struct tl_study_plan {
    tl_study_config *configs; /* [count], no two the same; owned */
    size_t count;
} tl_study_plan;

/* A list of words per knob; NULL: the usual one. */
typedef struct tl_study_lists {
    const char *of
        [TL_STUDY_KNOB_COUNT]; /* "float,merlin", or "all" where the knob has that; borrowed */
} tl_study_lists;

/* Appends the product of the lists, leaving out what is there already. Fails with TL_ERR_ARGUMENT (a word;
 * more than 10000 configurations) or TL_ERR_MEMORY, *plan as before. */
tl_status tl_study_plan_add(tl_study_plan *plan, const tl_study_lists *lists, tl_error *err);

/* Appends the default configuration, every knob alone, and products of promising words. Fails alike. */
tl_status tl_study_plan_usual(tl_study_plan *plan, int is_quick, tl_error *err);

/* Leaves it empty. */
void tl_study_plan_clear(tl_study_plan *plan);

#endif
