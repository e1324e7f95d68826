/* Pictures that lights and sky name, and where they lie. */
#ifndef TL_LIGHT_IMAGES_H
#define TL_LIGHT_IMAGES_H

#include "light_values.h"

/* set->folder: that of `file`, NULL for none. Fails with TL_ERR_MEMORY. */
tl_status tl_light_images_begin(tl_light_set *set, const char *file, tl_error *err);

/* Reads the picture that a field names, unless the set has it, and makes *out its number in the set. Fails
 * with the status of what is wrong with it, in a sentence that names the field and the file. */
tl_status tl_light_image_read(const tl_place *at,
                              const char *field,
                              const json_t *value,
                              tl_light_set *set,
                              uint32_t *out,
                              tl_error *err);

/* `path` as it is opened: relative to a folder of the set's. The caller frees it. NULL where memory ran
 * out. */
char *tl_light_path(const char *folder, const char *path);

/* How a file that the set names `named` is named in `file`, which the caller frees. NULL where memory ran
 * out. */
char *tl_light_file_name(const tl_light_set *set, const char *named, const char *file);

#endif
