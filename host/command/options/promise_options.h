/* Options of what lighting is to keep: an error, or a time. */
#ifndef TL_PROMISE_OPTIONS_H
#define TL_PROMISE_OPTIONS_H

#include "goal.h"
#include "lighting_options.h"
#include "picture_options.h"

#include <argp.h>

typedef struct promise_choice {
    const char *option; /* the one that was given; NULL: none, and the rest is of no meaning */
    tl_goal goal;       /* its kind and limit */
} promise_choice;

/* Its input is a promise_choice, all zero to begin with. */
extern const struct argp promise_argp;

/* A usage error where options say what a promise chooses itself, or would break it. */
void promise_check_together(const promise_choice *promise,
                            const lighting_choice *lighting,
                            const picture_options *pictures,
                            struct argp_state *state);

/* The goal, shown as pictures are written; look: what the capture asks for, or NULL. NULL where there is
 * none; *goal is written to. */
const tl_goal *promise_goal(const promise_choice *promise,
                            const picture_options *pictures,
                            const tl_look *look,
                            tl_goal *goal);

#endif
