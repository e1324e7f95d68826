/* One process a frame: of all that are at one list, on one machine or on several that share a folder, one
 * makes an item's outputs. */
#ifndef TL_FRAME_CLAIM_H
#define TL_FRAME_CLAIM_H

#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct tl_frame_claim tl_frame_claim;

/* Takes the item with these outputs ([count], at least 1) for the calling thread: *out, which it ends with
 * tl_frame_claim_end; NULL where another process or thread is at one of them: come back to it later. Until
 * it is ended, files of these names that this process writes have their temporary names from the claim, so
 * that a killed process leaves nothing that the next claim does not take over.
 *
 * Look whether the outputs are up to date after taking it: another may have made them meanwhile.
 * Fails with TL_ERR_WRITE, naming the output and the reason, or TL_ERR_MEMORY. */
tl_status tl_frame_claim_take(char *const *outputs,
                              size_t count,
                              tl_frame_claim **out,
                              tl_error *err);

/* Removes what was begun and not committed. Accepts NULL. */
void tl_frame_claim_end(tl_frame_claim *claim);

/* Removes what a killed process left of an item that is up to date, so that no one takes it any more. Cheap
 * where there is nothing. Cannot fail: what is locked is another's, who removes it. */
void tl_frame_claim_sweep(char *const *outputs, size_t count);

#endif
