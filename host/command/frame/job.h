/* One frame on its way: a G-buffer captured or read, repaired, lit, written. What `render`,
 * `capture`, `light`, `scatter` and `convert` share; they differ in the steps they take. */
#ifndef TL_JOB_H
#define TL_JOB_H

#include "report_options.h"
#include "tilelight/gbuffer.h"
#include "tilelight/image.h"
#include "tilelight/import.h"
#include "tilelight/lights.h"
#include "tilelight/post.h"
#include "tilelight/report.h"

#include <jansson.h>
#include <stdbool.h>

/* Layers of a picture, as it was lit: before any stage but the mean of samples. */
typedef struct job_aovs {
    tl_image_layer *layers; /* [count] */
    tl_image *
        *images; /* [count], what they show, owned; NULL where they share that of another */
    size_t count;
} job_aovs;

/* All zero to begin with; released with job_release. */
typedef struct job {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    bool lights_given; /* by a file or an option: they are kept, even where there are none */
    bool
        lights_are_lent; /* by another job, as it would light by them: they stay, and stay its own */
    bool lights_controlled; /* what is off or scaled of them is so already */
    bool lights_are_chosen; /* what the command line asks of them is done */
    bool lights_inside; /* the file of the G-buffer brought lights, even where there are none */
    bool has_look;      /* the capture asks for a look of its pictures */
    tl_look look;
    tl_repairs repairs;
    tl_image *image;
    void *codes; /* what PNGs hold: [height][width][3] of uint8_t or uint16_t; NULL: not made */
    job_aovs aovs;       /* what is written beside it in EXRs */
    tl_post_counts post; /* what the stages after lighting came to */
    tl_timings timings;
    double start_s;          /* when the process began, on tl_seconds' clock */
    double first_kernel_ms;  /* after that; 0: no kernel ran */
    double shade_processors; /* busy in the mean while shading; 0: not measured */
    json_t *report;          /* what --json prints; NULL without it */
} job;

/* Starts the report if it is asked for. */
tl_status job_begin(job *j, const report_options *options, tl_error *err);

/* Takes the lights from a file, before the work that they are needed for; NULL: does nothing. */
tl_status job_read_lights(job *j, const char *path, tl_error *err);

/* A G-buffer from a capture, repaired; with its lights where none were given. path may be NULL where
 * `import` maps every plane. */
tl_status job_read(
    job *j, const char *path, const tl_import_options *import, bool strict, tl_error *err);

/* The G-buffer in full float, where it is packed. */
tl_status job_unpack(job *j, tl_error *err);

/* A G-buffer that was just captured, repaired. `name` is what messages call it. */
tl_status job_repair(job *j, const char *name, bool strict, tl_error *err);

/* Whether lights that a capture found say anything: any light, ambient light, sky. */
bool job_has_lights(const job *j);

/* Adds `value` to the report; releases it either way. */
void job_report(job *j, const char *key, json_t *value);

/* The end of a successful job: timings and the report. */
tl_status job_finish(job *j, const report_options *options, tl_error *err);

/* What was lit, so that it can be lit once more. */
void job_drop_pictures(job *j);

void job_release(job *j);

#endif
