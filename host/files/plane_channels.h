/* The channels of a G-buffer file, from the table of planes. */
#ifndef TL_PLANE_CHANNELS_H
#define TL_PLANE_CHANNELS_H

#include "planes.h"

static const char *const tl_plane_channels[TL_PLANE_COUNT] = {
#define TL_PLANE_CHANNEL(name, channel, empty, meaning) [name] = channel,
    TL_PLANES(TL_PLANE_CHANNEL)
#undef TL_PLANE_CHANNEL
};

#endif
