/* `tilelight layouts --bandwidth`: the bytes that layouts move, by the published model, as counted of our
 * passes and as measured. */
#ifndef TL_LAYOUTS_BANDWIDTH_H
#define TL_LAYOUTS_BANDWIDTH_H

#include "tilelight/layouts.h"

#include <jansson.h>

/* The article's tables, and layouts [first, end) by its model and as counted of our passes. */
void bandwidth_print(enum tl_layout_name first, enum tl_layout_name end);

/* NULL where memory ran out. */
json_t *bandwidth_article_json(void);
json_t *bandwidth_layout_json(enum tl_layout_name layout);

#endif
