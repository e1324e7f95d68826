#include "light_values.h"

#include "light_words.h"
#include "suggest.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

tl_place tl_place_in(
    const char *source, const char *list, size_t index, const json_t *item, const char *name)
{
    tl_place at = {.source = source};
    const char *given = json_string_value(json_object_get(item, name));
    if (given && given[0])
        snprintf(at.inside, sizeof at.inside, " %.10s[%zu] \"%.60s\":", list, index, given);
    else
        snprintf(at.inside, sizeof at.inside, " %.10s[%zu]:", list, index);
    return at;
}

tl_status tl_unknown_field(const tl_place *at,
                           const char *key,
                           const char *const *words,
                           size_t word_count,
                           tl_error *err)
{
    const char *meant = tl_suggest(key, words, word_count);
    return tl_fail(err, TL_ERR_FORMAT, "%s:%s unknown field \"%.64s\"%s%s%s", at->source,
                   at->inside, key, meant ? "; did you mean \"" : "", meant ? meant : "",
                   meant ? "\"?" : "");
}

tl_status tl_read_number(
    const tl_place *at, const char *field, const json_t *value, float *out, tl_error *err)
{
    if (!json_is_number(value))
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be a number", at->source,
                       at->inside, field);
    const float number = (float)json_number_value(value);
    if (!isfinite(number))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"%s\" is %g: larger than a float holds (3.4e38)", at->source,
                       at->inside, field, json_number_value(value));
    *out = number;
    return TL_OK;
}

tl_status tl_read_vector(
    const tl_place *at, const char *field, const json_t *value, float out[3], tl_error *err)
{
    tl_status status = TL_OK;
    float read[3];
    if (!json_is_array(value) || json_array_size(value) != 3)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be an array of three numbers",
                    at->source, at->inside, field));
    for (size_t i = 0; i < 3; i++)
        TRY(tl_read_number(at, field, json_array_get(value, i), &read[i], err));
    memcpy(out, read, sizeof read);
done:
    return status;
}

tl_status tl_read_unit(
    const tl_place *at, const char *field, const json_t *value, float out[3], tl_error *err)
{
    static const double rounding = 1e-6;
    tl_status status = TL_OK;
    float read[3];
    TRY(tl_read_vector(at, field, value, read, err));
    const double x = (double)read[0], y = (double)read[1], z = (double)read[2];
    const double length2 = x * x + y * y + z * z;
    if (!(length2 > 0.0))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" has no length: it points nowhere",
                    at->source, at->inside, field));
    const double scale = fabs(length2 - 1.0) <= rounding ? 1.0 : 1.0 / sqrt(length2);
    for (int i = 0; i < 3; i++)
        out[i] = (float)((double)read[i] * scale);
done:
    return status;
}

tl_status tl_read_word(const tl_place *at,
                       const char *field,
                       const json_t *value,
                       const char *const *words,
                       int word_count,
                       int *out,
                       tl_error *err)
{
    const char *word = json_string_value(value);
    char known[1024] = "";
    for (int i = 0; i < word_count; i++) {
        if (word && strcmp(word, words[i]) == 0) {
            *out = i;
            return TL_OK;
        }
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s\"%s\"", i == 0 ? "" : ", ", words[i]);
    }
    if (!word)
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be one of %s", at->source,
                       at->inside, field, known);
    return tl_fail(err, TL_ERR_FORMAT, "%s:%s unknown %s \"%.64s\"; it must be one of %s",
                   at->source, at->inside, field, word, known);
}

tl_status tl_read_model(const tl_place *at,
                        const json_t *value,
                        enum tl_shading_model *out,
                        tl_error *err)
{
    int index = 0;
    const tl_status status =
        tl_read_word(at, "model", value, tl_model_words, TL_MODEL_COUNT, &index, err);
    if (status == TL_OK)
        *out = (enum tl_shading_model)index;
    return status;
}
