/* What is asked of a frame's lighting: how far its picture may be off, or how long it may take. */
#ifndef TL_PROMISE_GOAL_H
#define TL_PROMISE_GOAL_H

#include "tilelight/image.h"

/* X(name, word, what is measured, margin): what a candidate is expected to have must be within the limit this
 * many times over, for frames of a kind differ */
#define TL_GOALS(X)                                                                      \
    X(TL_GOAL_RMS, "rms", "RMS error, of the mean radiance", 1.5)                        \
    X(TL_GOAL_CODES, "8bit", "codes that any channel is off by after the tone curve", 1) \
    X(TL_GOAL_FLIP, "flip", "mean FLIP of the picture on a screen", 1.5)                 \
    X(TL_GOAL_TIME, "time", "ms that lighting the frame takes", 1)

typedef enum tl_goal_kind {
#define TL_GOAL_NAME(name, word, meaning, margin) name,
    TL_GOALS(TL_GOAL_NAME)
#undef TL_GOAL_NAME
        TL_GOAL_COUNT
} tl_goal_kind;

typedef struct tl_goal {
    tl_goal_kind kind;
    double limit;     /* what is measured may be this much, at most */
    tl_look look;     /* how radiance becomes codes, for CODES and FLIP */
    float exposure;   /* stops */
    int is_automatic; /* exposure: that of the picture */
} tl_goal;

typedef struct tl_goal_row {
    const char *word, *meaning;
    double margin;
} tl_goal_row;

extern const tl_goal_row tl_goal_rows[TL_GOAL_COUNT];

/* The stops at which the goal shows a picture. */
float tl_goal_exposure(const tl_goal *goal, const tl_image *image);

#endif
