/* A study as JSON. */
#ifndef TL_STUDY_JSON_H
#define TL_STUDY_JSON_H

#include "study.h"

enum { TL_STUDY_JSON_VERSION = 1 };

/* Fails with TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_study_json_write(const tl_study *study, const char *path, tl_error *err);

/* What was written. Knobs that the file has no word of had their usual ones. *study is empty before. Fails
 * with TL_ERR_READ, TL_ERR_FORMAT (naming what is missing) or TL_ERR_MEMORY. */
tl_status tl_study_json_read(const char *path, tl_study *study, tl_error *err);

#endif
