/* JSON on standard output. */
#ifndef TL_NUMBER_JSON_H
#define TL_NUMBER_JSON_H

#include "tilelight/error.h"

#include <jansson.h>

/* JSON has no infinity and no NaN: they are null. */
json_t *number_json(double value);

/* A number of each of [count]. */
json_t *number_json_array(const float *values, size_t count);

/* Prints `report` on standard output, and releases it either way. Fails with TL_ERR_WRITE, or
 * TL_ERR_MEMORY for a NULL. */
tl_status number_json_print(json_t *report, tl_error *err);

#endif
