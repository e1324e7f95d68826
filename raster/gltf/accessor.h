/* Accessors of a glTF file, checked and converted: to floats, or to indices.
 *
 * Everything that the specification demands of an accessor's place in its buffer is checked with
 * arithmetic that cannot wrap; sparse accessors are applied. */
#ifndef TL_ACCESSOR_H
#define TL_ACCESSOR_H

#include "gltf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes that may still be allocated for geometry. */
typedef struct tl_budget {
    uint64_t left;
} tl_budget;

/* Allocates `count` zeroed elements of `size` bytes; the caller frees *out. `user` is for the message.
 * Fails with TL_ERR_UNSUPPORTED (over budget) or TL_ERR_MEMORY. */
tl_status tl_budget_take(tl_budget *budget,
                         const tl_gltf *gltf,
                         const char *user,
                         size_t count,
                         size_t size,
                         void **out,
                         tl_error *err);

/* Reads an accessor as attribute `attribute`: *out is [count][tl_attribute_width], owned by the
 * caller. Integers become what the file means by them; colours without alpha get 1. Fails with
 * TL_ERR_FORMAT, naming `user` and the accessor: an index or a range outside, a type that this
 * attribute may not have, a value that is not finite; and as tl_budget_take. */
tl_status tl_accessor_read_attribute(const tl_gltf *gltf,
                                     const char *user,
                                     int accessor,
                                     enum tl_gltf_attribute attribute,
                                     tl_budget *budget,
                                     float **out,
                                     size_t *count,
                                     tl_error *err);

/* Floats per element in memory: the most components that the attribute may have. */
int tl_attribute_width(enum tl_gltf_attribute attribute);

/* Reads an accessor as vertex indices below `vertex_count`: *out is [count], owned by the caller.
 * Fails as tl_accessor_read_attribute does. */
tl_status tl_accessor_read_indices(const tl_gltf *gltf,
                                   const char *user,
                                   int accessor,
                                   size_t vertex_count,
                                   tl_budget *budget,
                                   uint32_t **out,
                                   size_t *count,
                                   tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
