/* What every twin is called with. */
#ifndef TL_TWIN_H
#define TL_TWIN_H

#include "packing.h"
#include "prepared.h"

/* Lights rows [begin, end). planes: the G-buffer's words, each [rows][pitch]; opacity: the same of a layer,
 * which is blended over what radiance has; else NULL; radiance: planes of an image with the same pitch and as
 * many rows, of the picture and of each term of prepared->needs.split. */
typedef void tl_twin_rows(const tl_prepared *prepared,
                          const tl_word_planes *planes,
                          const float *opacity,
                          float *radiance,
                          size_t begin,
                          size_t end);

#endif
