/* Which glTF extensions are understood. */
#ifndef TL_GLTF_EXTENSIONS_H
#define TL_GLTF_EXTENSIONS_H

#include "gltf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fails with TL_ERR_UNSUPPORTED at a required extension that is not in the table of
 * extensions.c; tells of each used one that is not. */
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
