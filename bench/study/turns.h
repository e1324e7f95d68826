/* Times by turns: what the machine does meanwhile, it does to both. */
#ifndef TL_STUDY_TURNS_H
#define TL_STUDY_TURNS_H

#include "pictures.h"
#include "sampling.h"
#include "values.h"

/* Work whose time is taken. */
typedef struct tl_turn {
    tl_status (*run)(const void *context, tl_error *err);
    const void *context;
} tl_turn;

/* Runs each once to warm up, then in turns, first and second changing places, in blocks of as long as `rule`
 * says. Fails as the turns do, or with TL_ERR_MEMORY. */
tl_status tl_study_turns_take(const tl_turn *usual,
                              const tl_turn *other,
                              const tl_sampling_rule *rule,
                              tl_study_time *usual_ms,
                              tl_study_time *other_ms,
                              tl_study_time *ratio,
                              tl_error *err);

/* One block of lighting more, of which not all are there: the configuration by turns with the default one.
 * Fills in the times of all blocks so far, and what it moves. Fails as tl_study_gbuffer and
 * tl_frame_ratio_measure do. */
tl_status tl_study_block_take(tl_study_pictures *pictures,
                              const tl_sampling_rule *rule,
                              tl_study_record *record,
                              tl_error *err);

#endif
