#include "tilelight/approximations.h"

#include <stdio.h>

#define TL_OFF(log2, exp2, cosine, root, quotient) \
    {                                              \
        log2, exp2, cosine, root, quotient         \
    }
#define ROW(name, word, traits, off, meaning, source) \
    [name] = {word, meaning, source, (uint32_t)(traits), off},
#define ROWS(name, flag, word, usual, rows, kind, kinds, meaning) \
    static const tl_knob_row rows_of_##name[] = {rows(ROW)};
TL_KNOBS(ROWS)
#undef ROWS

#define KNOB(name, flag, word, usual, rows, kind, kinds, meaning) \
    [name] = {word, meaning, rows_of_##name,                      \
              (uint32_t)(sizeof rows_of_##name / sizeof(tl_knob_row))},
const tl_knob tl_knobs[TL_KNOB_COUNT] = {TL_KNOBS(KNOB)};

static const tl_knob_row *row_of(const tl_approximations *of, int knob)
{
    return &tl_knobs[knob].rows[of->of[knob]];
}

bool tl_approximations_are_default(const tl_approximations *of)
{
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        if (of->of[knob] != 0)
            return false;
    return true;
}

static bool has(const tl_knob_row *row, enum tl_knob_trait traits)
{
    return (row->traits & (uint32_t)traits) == (uint32_t)traits;
}

bool tl_approximations_have(const tl_approximations *of, enum tl_knob_trait traits)
{
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        if (!has(row_of(of, knob), traits))
            return false;
    return true;
}

void tl_approximations_lacking(const tl_approximations *of,
                               enum tl_knob_trait traits,
                               char *text,
                               size_t size)
{
    snprintf(text, size, "%s", "");
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        if (!has(row_of(of, knob), traits)) {
            snprintf(text, size, "--%s %s", tl_knobs[knob].word, row_of(of, knob)->word);
            return;
        }
}

tl_off tl_approximations_off(const tl_approximations *of)
{
    tl_off sum = {0};
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++) {
        const tl_off *off = &row_of(of, knob)->off;
        sum.log2 += off->log2;
        sum.exp2 += off->exp2;
        sum.cosine += off->cosine;
        sum.root += off->root;
        sum.quotient += off->quotient;
    }
    return sum;
}

tl_status tl_approximations_check(const tl_approximations *of, tl_error *err)
{
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        if (of->of[knob] >= tl_knobs[knob].count)
            return tl_fail(err, TL_ERR_ARGUMENT, "row %u of the knob %s: it has %u",
                           of->of[knob], tl_knobs[knob].word, tl_knobs[knob].count);
    return TL_OK;
}
