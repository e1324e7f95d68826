/* How EXRs are written, as the library counts compressions. */
#ifndef TL_EXR_COMPRESSION_H
#define TL_EXR_COMPRESSION_H

#include "tilelight/image.h"

#include <openexr.h>

/* TL_EXR_USUAL is what its kind of numbers has. */
exr_compression_t tl_exr_compression_of(tl_exr_form form);

exr_pixel_type_t tl_exr_type_of(tl_exr_form form);

#endif
