#include "approximation_options.h"

#include "console.h"
#include "values.h"

#define WORD(name, word, traits, off, meaning, source) word,
#define WORD_AND_MEANING(name, word, traits, off, meaning, source) " " word ": " meaning "."

#define WORDS(name, flag, option, usual, rows, kind, kinds, meaning) \
    static const char *const words_of_##name[] = {rows(WORD)};
TL_KNOBS(WORDS)

#define VALUES(name, flag, option, usual, rows, kind, kinds, meaning) \
    [name] = {kind, kinds, words_of_##name, sizeof words_of_##name / sizeof words_of_##name[0]},
static const value_words values[TL_KNOB_COUNT] = {TL_KNOBS(VALUES)};

enum { OPTION_KNOBS = 256 };

static error_t parse(int key, char *text, struct argp_state *state)
{
    tl_approximations *of = state->input;
    char option[64];
    const int knob = key - OPTION_KNOBS;
    if (knob < 0 || knob >= TL_KNOB_COUNT)
        return ARGP_ERR_UNKNOWN;
    snprintf(option, sizeof option, "--%s", tl_knobs[knob].word);
    of->of[knob] = (uint32_t)value_word(state, option, text, &values[knob]);
    return 0;
}

#define OPTION(name, flag, option, usual, rows, kind, kinds, meaning) \
    {option,                                                          \
     OPTION_KNOBS + name,                                             \
     "NAME",                                                          \
     0,                                                               \
     meaning " (default " usual ")." rows(WORD_AND_MEANING),          \
     0},
static const struct argp_option options_table[] = {TL_KNOBS(OPTION){0}};

const struct argp approximation_argp = {.options = options_table, .parser = parse};

json_t *approximations_json(const tl_approximations *of)
{
    json_t *object = json_object();
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        json_object_set_new(object, tl_knobs[knob].word,
                            json_string(tl_knobs[knob].rows[of->of[knob]].word));
    return object;
}

void approximations_tell(const tl_approximations *of)
{
    char lacking[128];
    tl_approximations_lacking(of, TL_KNOB_SAME_BITS, lacking, sizeof lacking);
    if (lacking[0])
        tl_notice(&console_notices,
                  "%s: the last bits of the picture depend on the device, its compiler and "
                  "--width",
                  lacking);
}
