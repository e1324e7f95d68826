/* The page of a study: one HTML file that needs neither another file nor a network. */
#ifndef TL_STUDY_PAGE_H
#define TL_STUDY_PAGE_H

#include "tilelight/error.h"

/* Writes FOLDER/study.html of what FOLDER/study.json says and of the PNG files that it names; one that is not
 * there, or is no PNG file, is left out. The page shows what the file has, whichever program wrote it. Fails
 * with TL_ERR_READ, TL_ERR_FORMAT (no JSON, or no study), TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_study_page_write(const char *folder, tl_error *err);

#endif
