/* Claims of the sources, for people. */
#ifndef TL_STUDY_CLAIMS_TABLE_H
#define TL_STUDY_CLAIMS_TABLE_H

#include "study.h"

#include <stdio.h>

/* Those that are measured, theirs beside ours. */
void study_print_claims(FILE *out, const tl_study *study);

#endif
