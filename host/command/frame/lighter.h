/* What lights frames, one after another: a device, and what is kept from frame to frame. For one thread at a
 * time. */
#ifndef TL_LIGHTER_H
#define TL_LIGHTER_H

#include "tilelight/lighting.h"
#include "tilelight/post.h"

#include <stdbool.h>

/* All zero to begin with; what is NULL was not needed yet. Released with lighter_close. */
typedef struct lighter {
    tl_device *device; /* stays NULL for a precision without one */
    tl_lighting *lighting;
    tl_lighting *groups; /* lights groups of lights by themselves */
    tl_post *post;
    uint64_t
        memory_limit; /* bytes, in place of what options say; 0: nothing has shown a need of it */
} lighter;

/* The memory limit of frames with these options. */
uint64_t lighter_memory(const lighter *with, const tl_lighting_options *options);

/* After the device ran out of memory: frames get half of what they had, the first time of `bytes` where options
 * say no less, and what was kept is let go. False where that is next to nothing. */
bool lighter_shrink(lighter *with, const tl_lighting_options *options, uint64_t bytes);

/* Makes *of, one of the lighter's, where it is not there. As tl_lighting_create. */
tl_status lighter_lighting(lighter *with,
                           tl_lighting **of,
                           const tl_lighting_options *options,
                           tl_error *err);

/* The lighter's post, with these options. As tl_post_create. */
tl_status lighter_post(lighter *with,
                       const tl_lighting_options *lighting,
                       const tl_post_options *options,
                       tl_error *err);

/* After a frame, so that its memory may be freed: nothing is held of it. */
void lighter_let_go(lighter *with);

void lighter_close(lighter *with);

#endif
