/* A study as CSV: a line of names, then a line per frame and configuration. */
#ifndef TL_STUDY_CSV_H
#define TL_STUDY_CSV_H

#include "study.h"

/* What is not known is empty. Fails with TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_study_csv_write(const tl_study *study, const char *path, tl_error *err);

#endif
