/* Bytes as text (RFC 4648, section 4). */
#ifndef TL_BASE64_H
#define TL_BASE64_H

#include <stddef.h>

/* Four characters for every three bytes begun, padded with '=', and a NUL. The caller frees them. NULL: out
 * of memory. */
char *tl_base64(const void *bytes, size_t size);

#endif
