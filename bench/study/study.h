/* Accuracy against time: every configuration of a plan on frames, each measured once; and once more, to see
 * whether the intervals that are stated hold.
 *
 * What was measured stands in FOLDER/study.json after every configuration of the first round, and after every
 * further round, so a study that ends early goes on where it ended. */
#ifndef TL_STUDY_H
#define TL_STUDY_H

#include "claims.h"
#include "front.h"
#include "machine.h"
#include "plan.h"
#include "study_frame.h"
#include "values.h"

/* What is known of a frame. */
typedef struct tl_study_result {
    char name[64], identity[TL_STUDY_IDENTITY_SIZE], source[256];
    uint32_t width, height; /* px */
    uint32_t present;       /* planes, bits 1 << plane */
    size_t light_count;
    double mean, exposure;    /* of the reference: mean of all values; stops */
    char reference[128];      /* its words, as a title has them: what every error is against */
    char picture[128];        /* of the reference, a file in the study's folder */
    tl_study_record *records; /* [count]; owned */
    size_t count;
} tl_study_result;

/* All zero but for machine and device to begin with; released with tl_study_clear. */
typedef struct tl_study {
    tl_machine machine;
    tl_device_info device;
    char command[1024];       /* that does it again; may be empty */
    tl_study_result *results; /* [count]; owned */
    size_t count;
    tl_claim_figures claims[TL_CLAIM_COUNT]; /* by tl_claims; of those that are measured */
} tl_study;

void tl_study_clear(tl_study *study);

/* A configuration is about to be measured: all of it but for blocks of lighting in round 0, and one block in
 * every round. */
typedef struct tl_study_step {
    const char *frame;
    int round;           /* of TL_STUDY_BLOCK_COUNT, from 0 on */
    size_t index, count; /* of the frame's configurations */
    const tl_study_config *config;
} tl_study_step;

/* Who looks on. */
typedef struct tl_study_watch {
    void (*begins)(void *context, const tl_study_step *step); /* NULL: nobody */
    int (*stops)(void *context); /* 1: end after this step. NULL: never */
    void *context;
} tl_study_watch;

typedef struct tl_study_options {
    const char
        *folder; /* exists; NULL: nothing is written, and nothing read or written is timed */
    double
        seconds; /* that a configuration's lighting is sampled, and each kind of file; 2 pairs a block
                  * at least */
    /* 1: take the times of what is measured once more, and nothing else */
    int again;
    tl_study_watch watch;
} tl_study_options;

/* 2 s. */
tl_study_options tl_study_options_default(void);

/* Measures what is not in *study yet of the frame under these options, the default configuration always:
 * what does not fit the frame is left out. *was_stopped: whether the watcher ended it. *measured: how many
 * configurations were, or have blocks more. Fails as tl_study_steps_find, tl_study_time_files and
 * tl_study_block_take do, and with TL_ERR_ARGUMENT where nothing is measured that could be again. What was
 * measured before a failure or an end is in *study, but for a second run's, which is there whole or not. */
tl_status tl_study_run(tl_study *study,
                       tl_device *device,
                       const tl_study_frame *frame,
                       const tl_study_plan *plan,
                       const tl_study_options *options,
                       size_t *measured,
                       int *was_stopped,
                       tl_error *err);

/* Measures the claims that *study has no figures of. Fails as they do; what was measured before is there. */
tl_status tl_study_claims_find(tl_study *study, const tl_claim_options *options, tl_error *err);

/* Finds the fronts and writes FOLDER/study.json and FOLDER/study.csv. Fails with TL_ERR_WRITE or
 * TL_ERR_MEMORY. */
tl_status tl_study_write(tl_study *study, const char *folder, tl_error *err);

/* Adds what FOLDER/study.json holds, if it is there, to an empty *study of this machine and device; its
 * command only where *study has none. Fails
 * with TL_ERR_ARGUMENT where that is of another machine or device, TL_ERR_FORMAT (no study, or of another
 * version), TL_ERR_READ or TL_ERR_MEMORY. */
tl_status tl_study_resume(tl_study *study, const char *folder, tl_error *err);

/* Removes the maps of configurations that are on no front. */
void tl_study_drop_maps(tl_study *study, const char *folder);

/* Of all frames: how many configurations were measured twice, and of how many the second run came out inside
 * the interval of the first. */
void tl_study_count_again(const tl_study *study, size_t *twice, size_t *stay);

/* The cause that adds most to a record's error, a word of TL_STUDY_CAUSES; "none" where nothing does. */
const char *tl_study_main_cause(const tl_study_record *record);

#endif
