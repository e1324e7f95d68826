/* What is read of the files of a capture, gathered first, so that every part is decoded once. */
#ifndef TL_IMPORT_READING_H
#define TL_IMPORT_READING_H

#include "aliases.h"

/* All zero is empty. */
typedef struct tl_reading {
    size_t count;
    struct {
        uint32_t source, channel;
        float *plane; /* [height][pitch] of the frame */
        bool is_done;
    } items[TL_MAX_READ];
} tl_reading;

/* Adds the channels of a binding: `numbers` of them, each into a plane of its own. */
void tl_reading_add(tl_reading *reading,
                    const tl_binding *binding,
                    unsigned numbers,
                    float *const *planes);

/* Reads everything that was added. Fails as the formats' read does. */
tl_status tl_reading_run(tl_reading *reading, tl_source *sources, size_t pitch, tl_error *err);

#endif
