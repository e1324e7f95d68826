/* What a study knows of its frames, by their names and configurations. */
#ifndef TL_STUDY_RESULTS_H
#define TL_STUDY_RESULTS_H

#include "study.h"

/* The result of this frame: as it was, or empty where there is none or it is of another frame of that name.
 * *out is the study's. Fails with TL_ERR_ARGUMENT where it has to be there and is not, or TL_ERR_MEMORY. */
tl_status tl_study_result_find(tl_study *study,
                               const tl_study_frame *frame,
                               int has_to_be_there,
                               tl_study_result **out,
                               tl_error *err);

/* NULL: none. */
tl_study_record *tl_study_record_find(const tl_study_result *result,
                                      const tl_study_config *config);

/* In place of the one of its configuration, or behind all. Fails with TL_ERR_MEMORY. */
tl_status tl_study_record_keep(tl_study_result *result,
                               const tl_study_record *record,
                               tl_error *err);

#endif
