/* Numbers and files of JSON. */
#ifndef TL_JSON_VALUES_H
#define TL_JSON_VALUES_H

#include "tilelight/error.h"

#include <jansson.h>

/* JSON has no infinity and no NaN: they are null. */
json_t *tl_json_number(double value);

/* A number of each of [count]. */
json_t *tl_json_numbers(const float *values, size_t count);

/* Writes `report` atomically, or on standard output for "-", and releases it either way. Fails with
 * TL_ERR_WRITE, or TL_ERR_MEMORY for a NULL. */
tl_status tl_json_write(const char *path, json_t *report, tl_error *err);

/* An object from a file. The caller releases *out. Fails with TL_ERR_READ, TL_ERR_FORMAT (no JSON,
 * or no object, naming the line) or TL_ERR_MEMORY. */
tl_status tl_json_read(const char *path, json_t **out, tl_error *err);

#endif
