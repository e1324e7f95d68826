#include "claims_json.h"

#include "json_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static json_t *figure_json(const tl_claim_figure *f)
{
    return json_pack("{ss ss so so so so}", "what", f->what, "unit", f->unit, "theirs",
                     isnan(f->theirs[0]) ? json_null()
                                         : json_pack("[oo]", tl_json_number(f->theirs[0]),
                                                     tl_json_number(f->theirs[1])),
                     "ours", tl_json_number(f->ours), "low", tl_json_number(f->low), "high",
                     tl_json_number(f->high));
}

json_t *tl_claims_json(const tl_claim_figures claims[TL_CLAIM_COUNT])
{
    json_t *array = json_array();
    for (int i = 0; i < TL_CLAIM_COUNT; i++) {
        json_t *figures = json_array();
        for (size_t k = 0; k < claims[i].count; k++)
            json_array_append_new(figures, figure_json(&claims[i].of[k]));
        if (claims[i].count > 0)
            json_array_append_new(
                array, json_pack("{ss ss ss ss sO}", "name", tl_claims[i].name, "claim",
                                 tl_claims[i].claim, "source", tl_claims[i].source, "method",
                                 tl_claims[i].method, "figures", figures));
        json_decref(figures);
    }
    return array;
}

/* NAN where it is no number. */
static double number_of(const json_t *value)
{
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

static void read_text(const json_t *value, char *out, size_t size)
{
    snprintf(out, size, "%s", json_is_string(value) ? json_string_value(value) : "");
}

static tl_claim_figure figure_of(const json_t *object)
{
    const json_t *theirs = json_object_get(object, "theirs");
    tl_claim_figure f = {
        .theirs = {number_of(json_array_get(theirs, 0)), number_of(json_array_get(theirs, 1))},
        .ours = number_of(json_object_get(object, "ours")),
        .low = number_of(json_object_get(object, "low")),
        .high = number_of(json_object_get(object, "high"))};
    read_text(json_object_get(object, "what"), f.what, sizeof f.what);
    read_text(json_object_get(object, "unit"), f.unit, sizeof f.unit);
    return f;
}

static void read_claim(const json_t *object, tl_claim_figures claims[TL_CLAIM_COUNT])
{
    const char *name = json_string_value(json_object_get(object, "name"));
    const json_t *figures = json_object_get(object, "figures");
    for (int i = 0; i < TL_CLAIM_COUNT && name; i++) {
        if (strcmp(tl_claims[i].name, name) != 0)
            continue;
        claims[i].count = 0;
        for (size_t k = 0; k < json_array_size(figures) && k < TL_CLAIM_MOST_FIGURES; k++)
            claims[i].of[claims[i].count++] = figure_of(json_array_get(figures, k));
    }
}

void tl_claims_of_json(const json_t *array, tl_claim_figures claims[TL_CLAIM_COUNT])
{
    for (int i = 0; i < TL_CLAIM_COUNT; i++)
        claims[i].count = 0;
    for (size_t i = 0; i < json_array_size(array); i++)
        read_claim(json_array_get(array, i), claims);
}
