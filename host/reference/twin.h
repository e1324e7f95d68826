/* What every twin is called with. */
#ifndef TL_TWIN_H
#define TL_TWIN_H

#include "prepared.h"

/* Lights rows [begin, end). planes: [TL_PLANE_COUNT], NULL where absent, each [rows][pitch];
 * radiance: the three planes of an image with the same pitch. */
typedef void tl_twin_rows(const tl_prepared *prepared,
                          float *const planes[TL_PLANE_COUNT],
                          float *const radiance[3],
                          size_t begin,
                          size_t end);

#endif
