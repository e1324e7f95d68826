/* Options of what is done after lighting. */
#ifndef TL_POST_OPTIONS_GROUP_H
#define TL_POST_OPTIONS_GROUP_H

#include "tilelight/post.h"

#include <argp.h>

/* Nothing is chosen. */
typedef struct post_choice {
    tl_post_options
        options; /* of bloom the threshold is one of what the exposure makes of radiance */
    /* an option that edges, that bloom has, as it was given; NULL: none */
    const char *edge_detail, *bloom_detail;
} post_choice;

post_choice post_choice_default(void);

/* Its input is a post_choice. */
extern const struct argp post_argp;

#endif
