/* "materials" of a lights file. */
#ifndef TL_MATERIAL_ROWS_READ_H
#define TL_MATERIAL_ROWS_READ_H

#include "light_values.h"

/* Adds the rows of an array to the set, whose own model is known: that of rows that name none. An object
 * with a "model" stands for that model alone. Ranges are tl_light_set_check's affair. Fails with
 * TL_ERR_FORMAT or TL_ERR_MEMORY. */
tl_status tl_read_materials(const tl_place *at,
                            json_t *materials,
                            tl_light_set *set,
                            tl_error *err);

#endif
