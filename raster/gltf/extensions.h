/* Which glTF extensions are understood. */
#ifndef TL_GLTF_EXTENSIONS_H
#define TL_GLTF_EXTENSIONS_H

#include "gltf.h"

#include "tilelight/scene_info.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fails with TL_ERR_UNSUPPORTED at a required extension that is not supported, unless a picture
 * is the same without it; tells once, of each used one, what the picture lacks for want of it
 * (the tables of extensions.c). */
tl_status tl_gltf_check_extensions(const char *path,
                                   size_t required_count,
                                   const char *const *required,
                                   size_t used_count,
                                   const char *const *used,
                                   const tl_notices *notices,
                                   tl_error *err);

/* What becomes of an extension where a file uses it, as tl_scene_extension says it; *effect is
 * a literal. */
tl_extension_fate tl_gltf_extension_fate(const char *name, const char **effect);

#ifdef __cplusplus
}
#endif

#endif
