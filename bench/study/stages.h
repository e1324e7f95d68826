/* The times of a configuration that follow from others: of lighting that is the default's, and of the job
 * that the stages make up. */
#ifndef TL_STUDY_STAGES_H
#define TL_STUDY_STAGES_H

#include "values.h"

/* Whether the default configuration's lighting is this one's by definition, and so is not measured: only
 * files differ. */
int tl_study_lighting_is_known(const tl_study_config *config);

/* Fills them in. usual: the default configuration's record, whose medians weigh the stages of a job; may be
 * `record`. A job needs the times of files. */
void tl_study_stages_sum(tl_study_record *record, const tl_study_record *usual);

#endif
