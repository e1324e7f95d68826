/* What planes say where a frame shows nothing, from the table of planes. */
#ifndef TL_PLANE_VALUES_H
#define TL_PLANE_VALUES_H

#include "planes.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static const float tl_plane_empty[TL_PLANE_COUNT] = {
#define TL_PLANE_EMPTY(name, channel, empty, meaning) [name] = (empty),
    TL_PLANES(TL_PLANE_EMPTY)
#undef TL_PLANE_EMPTY
};

/* 1 or 0. By its bits: -0 is not what absence means, though it mostly comes to the same. */
static inline uint32_t tl_says_more_than_absence(int plane, float value)
{
    return memcmp(&value, &tl_plane_empty[plane], sizeof value) != 0;
}

#endif
