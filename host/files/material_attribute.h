/* The names of materials inside a G-buffer's file: attribute "tilelight:materials", a JSON array. */
#ifndef TL_MATERIAL_ATTRIBUTE_H
#define TL_MATERIAL_ATTRIBUTE_H

#include "exr_reader.h"

#include "tilelight/gbuffer.h"

/* Nothing where there are none. Fails with TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_material_attribute_write(tl_exr_stream *stream,
                                      const tl_material_names *names,
                                      tl_error *err);

/* *out, none to begin with, stays so where the file has none. Fails with TL_ERR_FORMAT or TL_ERR_MEMORY;
 * what was read until then is the caller's to clear. */
tl_status tl_material_attribute_read(tl_exr_reader *reader,
                                     tl_material_names *out,
                                     tl_error *err);

#endif
