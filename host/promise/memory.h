/* What pilots and checks found, kept from run to run: a JSON file for each kind of frame, in the folder of
 * compiled kernels (program_cache.h).
 *
 * A file says which kind it is for, and by which version of the program it was written; one of another
 * version, of another kind, or damaged counts as missing, and the next write replaces it. Files appear whole
 * or not at all. */
#ifndef TL_PROMISE_MEMORY_H
#define TL_PROMISE_MEMORY_H

#include "candidates.h"
#include "choose.h"

#include <jansson.h>

/* The kind of a frame, new: device and driver, what lighting is asked to do, layout, planes, models, effects,
 * light counts to the nearest power of two, pixels to the nearest power of two, the goal's terms without its
 * limit. NULL if memory ran out. */
json_t *tl_memory_kind(const tl_device_info *device,
                       const tl_lighting_options *base,
                       const tl_goal *goal,
                       const tl_gbuffer *gbuffer,
                       const tl_prepared *prepared);

/* Whether there is something for this kind: candidates, [tl_candidate_count], are then what is remembered.
 * folder: NULL or missing: nothing is. Says in a notice why a file that is there is of no use. */
int tl_memory_read(const char *folder,
                   const json_t *kind,
                   tl_expectation *candidates,
                   const tl_notices *notices);

/* Puts it in place of what was remembered. Whether it did is all that comes of it: what cannot be remembered
 * is found again. */
int tl_memory_write(const char *folder, const json_t *kind, const tl_expectation *candidates);

#endif
