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

/* What floats are for. The attributes of vertices come first, in the order of gltf.h; then,
 * X(name, word in the file, components at least, at most). */
#define TL_ACCESSOR_USES(X)                               \
    X(TL_USE_MORPH_POSITION, "POSITION", 3, 3)            \
    X(TL_USE_MORPH_NORMAL, "NORMAL", 3, 3)                \
    X(TL_USE_MORPH_TANGENT, "TANGENT", 3, 3)              \
    X(TL_USE_JOINTS, "JOINTS", 4, 4)                      \
    X(TL_USE_WEIGHTS, "WEIGHTS", 4, 4)                    \
    X(TL_USE_INVERSE_BIND, "inverseBindMatrices", 16, 16) \
    X(TL_USE_KEY_TIMES, "input", 1, 1)                    \
    X(TL_USE_KEY_VECTORS, "output", 3, 3)                 \
    X(TL_USE_KEY_ROTATIONS, "output", 4, 4)               \
    X(TL_USE_KEY_WEIGHTS, "output", 1, 1)                 \
    X(TL_USE_INSTANCE_TRANSLATION, "TRANSLATION", 3, 3)   \
    X(TL_USE_INSTANCE_ROTATION, "ROTATION", 4, 4)         \
    X(TL_USE_INSTANCE_SCALE, "SCALE", 3, 3)

enum tl_accessor_use {
    TL_USE_BEFORE_FIRST = TL_GLTF_ATTRIBUTE_COUNT - 1,
#define TL_ACCESSOR_USE_NAME(name, word, least, most) name,
    TL_ACCESSOR_USES(TL_ACCESSOR_USE_NAME)
#undef TL_ACCESSOR_USE_NAME
        TL_USE_COUNT
};

/* Reads an accessor for `use`, an enum tl_gltf_attribute or tl_accessor_use: *out is
 * [count][tl_accessor_width], owned by the caller. Integers become what the file means by them;
 * colours without alpha get 1. Fails with TL_ERR_FORMAT, naming `user` and the accessor: an
 * index or a range outside, a type that this use may not have, a value that is not finite; and
 * as tl_budget_take. */
tl_status tl_accessor_read(const tl_gltf *gltf,
                           const char *user,
                           int accessor,
                           int use,
                           tl_budget *budget,
                           float **out,
                           size_t *count,
                           tl_error *err);

/* Floats per element in memory: the most components that the use may have. */
int tl_accessor_width(int use);

/* Reads an accessor as vertex indices below `vertex_count`: *out is [count], owned by the caller.
 * Fails as tl_accessor_read does. */
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
