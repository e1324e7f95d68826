/* Values of a lights file: each read with a sentence for what is wrong, which names where it stands. */
#ifndef TL_LIGHT_VALUES_H
#define TL_LIGHT_VALUES_H

#include "tilelight/lights.h"

#include <jansson.h>

/* Where a value stands, for sentences: "lights.json: lights[3] "key":" or the file alone. */
typedef struct tl_place {
    const char *source;
    char inside[112]; /* " lights[3] "key":"; "" outside lists */
} tl_place;

/* Of an item of a list, with its name where its field `name` has one. */
tl_place tl_place_in(
    const char *source, const char *list, size_t index, const json_t *item, const char *name);

/* All fail with TL_ERR_FORMAT, and leave *out as it is. */

/* word_count words that `key` may have been meant as. Always fails. */
tl_status tl_unknown_field(const tl_place *at,
                           const char *key,
                           const char *const *words,
                           size_t word_count,
                           tl_error *err);

tl_status tl_read_number(
    const tl_place *at, const char *field, const json_t *value, float *out, tl_error *err);
tl_status tl_read_vector(
    const tl_place *at, const char *field, const json_t *value, float out[3], tl_error *err);

/* A direction that was of length 1 before it was rounded to float is kept as it is, so that what
 * tl_lights_format wrote reads back bit for bit: rounding, and normalising in float, move the
 * squared length by less than 16 * 2^-24. */
tl_status tl_read_unit(
    const tl_place *at, const char *field, const json_t *value, float out[3], tl_error *err);

/* The index of a word among `words`. */
tl_status tl_read_word(const tl_place *at,
                       const char *field,
                       const json_t *value,
                       const char *const *words,
                       int word_count,
                       int *out,
                       tl_error *err);

tl_status tl_read_model(const tl_place *at,
                        const json_t *value,
                        enum tl_shading_model *out,
                        tl_error *err);

#endif
