/* Which frames of a sequence are there. */
#ifndef TL_SEQUENCE_H
#define TL_SEQUENCE_H

#include "frame_set.h"
#include "pattern.h"

/* Every frame whose file or folder has exactly the name that the pattern gives it, from the lowest on; none
 * is no failure. The pattern has a number. *out is replaced on success. Fails with TL_ERR_READ, naming the
 * folder that cannot be read, TL_ERR_ARGUMENT for more than TL_MOST_FRAMES, or TL_ERR_MEMORY. */
tl_status tl_sequence_find(const tl_pattern *pattern, tl_frames *out, tl_error *err);

#endif
