/* What a G-buffer's file promises, once everything about it is known to be right. */
#ifndef TL_GBUFFER_HEADER_H
#define TL_GBUFFER_HEADER_H

#include "exr_reader.h"
#include "word_channels.h"

#include "tilelight/camera.h"

typedef struct tl_gbuffer_header {
    tl_camera camera;
    enum tl_layout_name layout;
    uint32_t present; /* planes, as tl_gbuffer has them */
    uint32_t samples; /* as tl_gbuffer has them */
    tl_word_channel channels[TL_MAX_WORDS];
    size_t channel_count;
} tl_gbuffer_header;

/* The channels are there and of their types; layout, planes and camera go together. Fails with
 * TL_ERR_FORMAT or TL_ERR_UNSUPPORTED, naming the channel or attribute. */
tl_status tl_gbuffer_header_read(tl_exr_reader *reader, tl_gbuffer_header *out, tl_error *err);

#endif
