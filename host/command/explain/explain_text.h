/* The words and numbers of an explanation. */
#ifndef TL_EXPLAIN_TEXT_H
#define TL_EXPLAIN_TEXT_H

#include "explain.h"

/* On standard error. */
void explain_print(const job *j, const explained *e);

/* The same; the caller releases it. */
json_t *explain_as_json(const job *j, const explained *e);

/* A word for each attribute beside depth, normal and albedo; NULL where it has none of `planes`. */
enum { EXPLAIN_PLANE_WORDS = 8 };
const char *explain_plane_word(int index, uint32_t planes);

/* Those of these planes, ", " between. text: [size]. */
void explain_planes(uint32_t planes, char *text, size_t size);

#endif
