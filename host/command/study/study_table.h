/* What a study found, for people. */
#ifndef TL_STUDY_TABLE_H
#define TL_STUDY_TABLE_H

#include "study.h"

#include <stdio.h>

/* The fronts of a frame, the fastest first, and what they say. */
void study_print(FILE *out, const tl_study_result *result);

/* How many of those that were measured twice came out inside their intervals, and which did not. */
void study_print_again(FILE *out, const tl_study *study);

/* Knobs, causes, built-in frames. */
void study_print_list(FILE *out);

#endif
