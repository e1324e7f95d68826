/* Following an index of a glTF file, checked; and how messages name what it points at. */
#ifndef TL_LOOKUP_H
#define TL_LOOKUP_H

#include "gltf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* "node 3 (\"wheel\")" or "node 3"; without a kind "3 (\"wheel\")" or "3". Unprintable characters of
 * the name become '?'. */
typedef struct tl_label {
    char text[96];
} tl_label;

tl_label tl_label_of(const char *kind, size_t index, const char *name);

/* Adds to a list of a sentence: "0 (\"day\"), 1 (\"night\")". False once it is full, which it then says
 * itself; list: [size], NUL-terminated. */
bool tl_list_add(char *list, size_t size, const char *item);

/* The index that a text is, in decimal; false where it is none of `count` things. */
bool tl_index_of(const char *text, size_t count, size_t *out);

/* Whether `index` is one of `count` things of this kind. Fails with TL_ERR_FORMAT, naming the file,
 * `user` (what refers to it, such as "mesh 2, primitive 0") and the index. */
tl_status tl_gltf_check_index(const tl_gltf *gltf,
                              const char *user,
                              const char *kind,
                              int index,
                              size_t count,
                              tl_error *err);

/* The bytes of a buffer view. Fails with TL_ERR_FORMAT for an index or a range outside. */
tl_status tl_gltf_view_bytes(
    const tl_gltf *gltf, const char *user, int view, tl_gltf_bytes *out, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
