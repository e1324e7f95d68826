/* What stb_image trusts of the parts of a picture, and must not: looked at before it sees them. */
#ifndef TL_PICTURE_PARTS_H
#define TL_PICTURE_PARTS_H

#include <stddef.h>
#include <stdint.h>

/* Whether
 *   - the chunks of a PNG are within the file: as much memory is taken as a chunk says it has bytes, up to
 *     2 GiB, before it is seen how many there are;
 *   - each table of codes of a JPEG has 256 codes at most: as many as it says are written to arrays of 256.
 * Of other files nothing is asked. Cannot fail. */
int tl_picture_is_sound(const uint8_t *data, size_t size);

#endif
