#include "aov_options.h"

#include "output.h"
#include "values.h"

#include <stdio.h>
#include <string.h>

enum { OPTION_AOV = 256 };
enum { GROUPS = TL_AOV_COUNT, ALL, WORD_COUNT };

#define WORD(name, word, meaning) [name] = word,
#define WORD_AND_MEANING(name, word, meaning) " " word ": " meaning "."
static const char *const aov_words[WORD_COUNT] = {TL_AOVS(WORD)[GROUPS] = "groups", [ALL] =
                                                                                        "all"};
static const value_words words = {"layer", "layers", aov_words, WORD_COUNT};

static void add(lighting_choice *choice, unsigned word)
{
    if (word < TL_AOV_COUNT)
        choice->options.split |= 1u << word;
    if (word == ALL)
        choice->options.split = TL_ALL_AOVS;
    choice->groups |= word == GROUPS || word == ALL;
}

/* Words with commas between them. */
static void add_list(lighting_choice *choice, const char *list, struct argp_state *state)
{
    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at, ","), at);
        add(choice, value_word(state, "--aov", word, &words));
    }
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    if (key != OPTION_AOV)
        return ARGP_ERR_UNKNOWN;
    add_list(state->input, text, state);
    return 0;
}

static const struct argp_option options_table[] = {
    {"aov", OPTION_AOV, "LAYER[,LAYER...]", 0,
     "Layers for compositing in EXR outputs, NAME.R, NAME.G, NAME.B each, which the picture is "
     "the "
     "sum of (docs/compositing.md)." TL_AOVS(
         WORD_AND_MEANING) " groups: light_GROUP for each group of lights, and rest, all that "
                           "no group gives. all: "
                           "every one of these",
     0},
    {0},
};

const struct argp aov_argp = {.options = options_table, .parser = parse};

void aov_check_together(const lighting_choice *choice,
                        const picture_options *pictures,
                        struct argp_state *state)
{
    if (choice->options.split == 0 && !choice->groups)
        return;
    if (pictures->width > 0)
        argp_error(state, "--aov: layers are of the size that is lit: leave --output-size out");
    for (int i = 0; i < pictures->count; i++)
        if (pictures->kinds[i] == OUTPUT_EXR)
            return;
    argp_error(state,
               "--aov: layers go into an EXR, of which no output is one; add -o FILE.exr");
}
