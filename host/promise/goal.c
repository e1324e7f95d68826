#include "goal.h"

const tl_goal_row tl_goal_rows[TL_GOAL_COUNT] = {
#define GOAL_ROW(name, word, meaning, margin) [name] = {word, meaning, margin},
    TL_GOALS(GOAL_ROW)
#undef GOAL_ROW
};

float tl_goal_exposure(const tl_goal *goal, const tl_image *image)
{
    return goal->is_automatic ? tl_image_auto_exposure(image) : goal->exposure;
}
