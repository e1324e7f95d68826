/* A batch cut into chunks, each a command of its own, for a scheduler to hand to workers. */
#ifndef TL_FARM_PLAN_H
#define TL_FARM_PLAN_H

#include "frame_set.h"

#include <stdint.h>

/* What a worker asks of the machine it runs on; 0 or NULL: nothing. */
typedef struct tl_farm_needs {
    uint32_t processors;
    uint64_t memory_mib;
    uint64_t seconds; /* it is ended after */
    const char *partition;
} tl_farm_needs;

/* Each chunk is the option that `tilelight batch` takes for it: "--frames=1-25", "--shard=2/4". The gather is
 * the same for all of them: run behind, it does what workers left undone, and ends with the list of what
 * failed. None of these options has anything that a shell would read. */
typedef struct tl_farm_plan {
    const char *folder;  /* absolute: relative names are in it, and workers run there */
    const char *program; /* that workers run */
    const char *const *arguments;    /* [argument_count] of batch; borrowed */
    size_t argument_count, chunk_at; /* before which of them the chunk goes */
    size_t frame_count;
    char **chunks; /* [chunk_count] */
    size_t chunk_count;
    char *gather;
    tl_farm_needs needs;
} tl_farm_plan;

/* Chunks of at most `chunk` frames, 1 or more, in the order of the set, which must not be empty. Fills
 * frame_count, chunks and gather; released with tl_farm_plan_release. Fails with TL_ERR_MEMORY. */
tl_status tl_farm_cut_frames(tl_farm_plan *plan,
                             const tl_frames *frames,
                             size_t chunk,
                             tl_error *err);

/* As many shares of `count` items, 1 or more, as chunks of at most `chunk` of them are. Otherwise likewise. */
tl_status tl_farm_cut_shards(tl_farm_plan *plan, size_t count, size_t chunk, tl_error *err);

/* Accepts a plan without chunks. */
void tl_farm_plan_release(tl_farm_plan *plan);

#endif
