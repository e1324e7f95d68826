/* The times of a configuration, stage by stage, and of the job that they make up. */
#ifndef TL_STUDY_STAGES_H
#define TL_STUDY_STAGES_H

#include "file_times.h"

/* Fills in all times of `record`, and bytes. usual: the default configuration's record, whose medians weigh the
 * stages of a job; where its lighting is this one's by definition, its times are. NULL or record itself: it is
 * the default's that is measured. folder: for files that are timed; NULL: none are, and no job. seconds: that
 * lighting is sampled, and each kind of file. Fails as tl_study_time_lighting and tl_study_time_files do. */
tl_status tl_study_stages_take(tl_study_pictures *pictures,
                               tl_study_file_times *files,
                               const char *folder,
                               double seconds,
                               const tl_study_record *usual,
                               tl_study_record *record,
                               tl_error *err);

#endif
