/* Layers of surfaces that blend as parts of a G-buffer's file, a part a layer; docs/file-formats.md describes
 * them. What a part is made of is that of its surface's part, with an opacity beside it. */
#ifndef TL_LAYER_PARTS_H
#define TL_LAYER_PARTS_H

#include "gbuffer_header.h"

#include "tilelight/gbuffer.h"

#define TL_OPACITY_CHANNEL "opacity" /* FLOAT */

/* Of the first part: how many layers there are, and what is left. Nothing where there are none. Fails as the
 * writer does. */
tl_status tl_layer_counts_write(tl_exr_stream *stream, const tl_layers *layers, tl_error *err);

/* Of the part of layer `index`. */
tl_status tl_layer_attribute_write(tl_exr_stream *stream,
                                   int part,
                                   uint32_t index,
                                   tl_error *err);

/* Reads all layers of an open file into *out, whose surface is read and is of this header; what is no layer
 * is left alone. On failure some may be there. Fails with TL_ERR_FORMAT, naming part and attribute or
 * channel, TL_ERR_READ, TL_ERR_UNSUPPORTED or TL_ERR_MEMORY. */
tl_status tl_layer_parts_read(tl_exr_reader *reader,
                              const tl_gbuffer_header *header,
                              tl_gbuffer *out,
                              tl_error *err);

#endif
