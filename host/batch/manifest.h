/* Lists of frames in a file. */
#ifndef TL_MANIFEST_H
#define TL_MANIFEST_H

#include "items.h"

/* Adds the items of a manifest (item_list.h), with the outputs and lights that it has. `given`: outputs
 * were asked for outside; an item must then have none, else some. Fails with TL_ERR_READ, TL_ERR_FORMAT
 * (naming the line; or of more than 256 MiB) or TL_ERR_MEMORY. */
tl_status tl_manifest_read(const char *path, bool given, tl_item_list *list, tl_error *err);

#endif
