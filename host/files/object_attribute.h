/* Which object each pixel shows, inside a G-buffer's file: a channel "id" of every surface, and names of ids
 * as attribute "tilelight:objects", a JSON object of names by ids. */
#ifndef TL_OBJECT_ATTRIBUTE_H
#define TL_OBJECT_ATTRIBUTE_H

#include "exr_reader.h"

#include "tilelight/gbuffer.h"

#define TL_ID_CHANNEL "id" /* UINT */

/* Nothing where there are no names. Fails with TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_object_attribute_write(tl_exr_stream *stream,
                                    const tl_objects *objects,
                                    tl_error *err);

/* The channel of a part, where it has one, to gbuffer->ids. Fails with TL_ERR_FORMAT (it is of another type),
 * as tl_exr_part_pixels does, or with TL_ERR_MEMORY. */
tl_status tl_ids_read(const tl_exr_part *part, tl_gbuffer *gbuffer, tl_error *err);

/* *out, none to begin with, stays so where the file has none. Fails with TL_ERR_FORMAT or TL_ERR_MEMORY. */
tl_status tl_object_attribute_read(tl_exr_reader *reader, tl_objects *out, tl_error *err);

#endif
