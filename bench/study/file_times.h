/* What it takes to read a configuration's G-buffer and to write its picture: once per kind of file. */
#ifndef TL_STUDY_FILE_TIMES_H
#define TL_STUDY_FILE_TIMES_H

#include "turns.h"

typedef struct tl_study_reading {
    enum tl_layout_name layout;
    tl_compression compression;
    tl_study_time ms, ratio;
    double file_bytes; /* per pixel */
} tl_study_reading;

typedef struct tl_study_writing {
    int is_known;
    tl_study_time ms, tone_ms, ratio; /* tone: NAN but for PNG */
    double file_bytes;                /* per pixel */
} tl_study_writing;

/* All zero to begin with; released with tl_study_file_times_clear. */
typedef struct tl_study_file_times {
    tl_study_reading *readings; /* [count]; owned */
    size_t count;
    tl_study_writing writings[TL_STUDY_OUTPUT_COUNT];
} tl_study_file_times;

/* Fills in the times of reading and writing, by turns with the default configuration's, unless they are known
 * from another configuration; and bytes. Files stand in `folder` meanwhile. Fails as tl_gbuffer_write,
 * tl_gbuffer_read, tl_image_write_exr, tl_png_write and tl_study_picture do. */
tl_status tl_study_time_files(tl_study_file_times *files,
                              tl_study_pictures *pictures,
                              const char *folder,
                              const tl_sampling_rule *rule,
                              tl_study_record *record,
                              tl_error *err);

void tl_study_file_times_clear(tl_study_file_times *files);

#endif
