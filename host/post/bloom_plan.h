/* How a width becomes passes of seven taps. */
#ifndef TL_BLOOM_PLAN_H
#define TL_BLOOM_PLAN_H

#include <stdint.h>

enum { TL_MOST_BLOOM_PASSES = 64 };

typedef struct tl_bloom_plan {
    uint32_t passes; /* across and down, each */
    float taps[4];   /* in the middle, and 1, 2, 3 away; with both sides they add up to 1 */
} tl_bloom_plan;

/* width: within tl_least_bloom_width and tl_most_bloom_width (tilelight/post.h). Cannot fail. */
tl_bloom_plan tl_bloom_plan_for(double width, uint32_t side);

#endif
