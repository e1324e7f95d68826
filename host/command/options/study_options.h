/* The options of `tilelight study`. */
#ifndef TL_STUDY_OPTIONS_H
#define TL_STUDY_OPTIONS_H

#include "plan.h"
#include "tilelight/import.h"

#include <argp.h>
#include <stdbool.h>

enum { MOST_SCENES = 64 };

typedef struct study_command {
    const char *scenes[MOST_SCENES]; /* [scene_count]; none: built-in frames */
    int scene_count;
    const char *folder;
    const char *lights, *device, *camera; /* NULL: what the frame brings; the default one */
    uint32_t width, height;               /* 0: not given */
    double seconds;                       /* 0: not given */
    bool quick, claims, anew, again, quiet, list, page;
    tl_import_options import;
    tl_study_lists lists; /* of --knob; their memory is `words`' */
    bool knobs_given;
    char *words[TL_STUDY_KNOB_COUNT];
} study_command;

/* Usage errors end the program with status 2. */
void study_parse(int argc, char **argv, study_command *options);

void study_command_release(study_command *options);

#endif
