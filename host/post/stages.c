#include "stage.h"

const tl_post_stage_row tl_post_stage_rows[TL_POST_STAGE_COUNT] = {
#define ROW(name, word, reads, meaning) [name] = {word, reads, meaning},
    TL_POST_STAGES(ROW)
#undef ROW
};
