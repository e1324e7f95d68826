/* The largest numbers that are stored. */
#ifndef TL_RANGES_H
#define TL_RANGES_H

#include "dialect.h"

#ifndef TL_GLSL
#    define TL_MOST_FLOAT R(0x1.fffffep127)
#endif
#define TL_MOST_HALF R(65504.0)
#define TL_MOST_SHARED R(65408.0) /* RGB9E5: 511/512 2^16 */
#define TL_MOST_SHININESS R(10000.0)
#define TL_LOG2_MOST_LOBE R(13.287856641840545) /* log2(1 + 10000) */

#endif
