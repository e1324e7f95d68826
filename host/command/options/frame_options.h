/* How a captured frame is lit: the options that `light` and `batch` share. */
#ifndef TL_FRAME_OPTIONS_H
#define TL_FRAME_OPTIONS_H

#include "kernel_options.h"
#include "lighting_options.h"
#include "picture_options.h"
#include "post_options.h"
#include "promise_options.h"
#include "tilelight/gbuffer.h"
#include "tilelight/import.h"

#include <argp.h>

typedef struct frame_options {
    lighting_choice lighting;
    promise_choice promise;
    post_choice post;
    kernel_choice kernel;
    tl_import_options import;
    picture_options pictures;
    tl_region region; /* empty: the whole picture */
} frame_options;

frame_options frame_options_default(void);

/* Its input is a frame_options, the default to begin with. */
extern const struct argp frame_argp;

/* What they own; they are as by default then. */
void frame_options_release(frame_options *options);

#endif
