/* Options of what is done after lighting. */
#ifndef TL_POST_OPTIONS_GROUP_H
#define TL_POST_OPTIONS_GROUP_H

#include "tilelight/post.h"

#include <argp.h>

/* All zero to begin with: nothing. */
typedef struct post_choice {
    tl_post_options options;
    const char *edge_detail; /* an option that edges have, as it was given; NULL: none */
} post_choice;

/* Its input is a post_choice. */
extern const struct argp post_argp;

#endif
