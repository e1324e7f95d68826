/* Where a name that is written to ends. */
#ifndef TL_TARGET_H
#define TL_TARGET_H

#include <stdbool.h>

/* The part of a path before its last name, with the slash: "" for a name alone. The caller frees it; NULL:
 * out of memory. */
char *tl_target_folder(const char *path);

/* Follows links to the name that a rename must replace. *in_place: what is there has to be written into
 * instead, for it is no regular file, or stands under /proc for an open one. Returns 0 or an errno; the
 * caller frees *out. */
int tl_target_resolve(const char *target, char **out, bool *in_place);

#endif
