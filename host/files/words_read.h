/* The words of a surface from its part of a G-buffer's file. */
#ifndef TL_WORDS_READ_H
#define TL_WORDS_READ_H

#include "gbuffer_header.h"

#include "tilelight/gbuffer.h"

/* Reads the channels of the header, which the part has, into *out, which was made for them. Fails with
 * TL_ERR_FORMAT (a number of more bits than its words), TL_ERR_READ, TL_ERR_UNSUPPORTED or TL_ERR_MEMORY. */
tl_status tl_words_read(const tl_exr_part *part,
                        const tl_gbuffer_header *of,
                        tl_gbuffer *out,
                        tl_error *err);

#endif
