/* Captures of the ISPC project's deferred shading example: a G-buffer, its camera and its lights in one
 * file, to be lit by the example's own model. docs/file-formats.md describes the bytes. */
#ifndef TL_ISPC_READ_H
#define TL_ISPC_READ_H

#include "capture_read.h"

/* The file has no magic number: its header has to make sense as one. Of a file that is cut short that
 * much is still said. */
bool tl_ispc_recognises(const tl_capture_start *start);

/* The header is held against the size of the file before anything is allocated by it. The
 * G-buffer's words are those of the file, but for pixels outside of the header's near and far,
 * which become sky. Fails with TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or
 * TL_ERR_MEMORY. */
tl_status tl_ispc_read(const tl_capture_request *request, tl_captured *out, tl_error *err);

#endif
