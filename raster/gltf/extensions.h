/* Which glTF extensions are understood. */
#ifndef TL_GLTF_EXTENSIONS_H
#define TL_GLTF_EXTENSIONS_H

#include "gltf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fails with TL_ERR_UNSUPPORTED at a required extension that is not supported, unless a picture is the same without
 * it; tells once, of each used one, what the picture lacks for want of it (the tables of extensions.c). */
tl_status tl_gltf_check_extensions(const char *path,
                                   size_t required_count,
                                   const char *const *required,
                                   size_t used_count,
                                   const char *const *used,
                                   const tl_notices *notices,
                                   tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
