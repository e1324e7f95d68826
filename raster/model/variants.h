/* Variants of materials (KHR_materials_variants): one scene in several liveries. */
#ifndef TL_VARIANTS_H
#define TL_VARIANTS_H

#include "gltf.h"

/* TL_NO_VARIANT: primitives have the materials of the file's core. */
enum { TL_NO_VARIANT = -1 };

/* The variant that `wanted` names, or is the index of; NULL: TL_NO_VARIANT. Fails with TL_ERR_ARGUMENT,
 * saying which there are. */
tl_status tl_find_variant(const tl_gltf *gltf, const char *wanted, int *out, tl_error *err);

/* The material that a primitive has in a variant, an index into those of the file; where it has
 * none, one more than the last, which is the default one. The primitive's own where it says
 * nothing of the variant. Fails with TL_ERR_FORMAT, naming `user`, for a material or a variant
 * that is none. */
tl_status tl_variant_material(const tl_gltf *gltf,
                              const char *user,
                              const tl_gltf_primitive *primitive,
                              int variant,
                              size_t *out,
                              tl_error *err);

#endif
