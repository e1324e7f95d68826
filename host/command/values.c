#include "values.h"

#include "tilelight/camera.h"
#include "tilelight/layouts.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The whole of `text` as digits; false for anything else, and beyond 32 bits. */
static bool parse_digits(const char *text, size_t length, uint32_t *out)
{
    uint64_t value = 0;
    for (size_t i = 0; i < length; i++) {
        if (!isdigit((unsigned char)text[i]))
            return false;
        value = 10 * value + (uint64_t)(text[i] - '0');
        if (value > UINT32_MAX)
            return false;
    }
    *out = (uint32_t)value;
    return length > 0;
}

double value_number(
    struct argp_state *state, const char *option, const char *text, double least, double most)
{
    char *end = NULL;
    const double value = strtod(text, &end);
    if (end == text || *end || isspace((unsigned char)*text) || !(value >= least) ||
        !(value <= most) || !isfinite(value))
        argp_error(state, "%s: \"%s\" is no number from %g to %g", option, text, least, most);
    return value;
}

uint32_t value_integer(struct argp_state *state,
                       const char *option,
                       const char *text,
                       uint32_t least,
                       uint32_t most)
{
    uint32_t value = 0;
    if (!parse_digits(text, strlen(text), &value) || value < least || value > most)
        argp_error(state, "%s: \"%s\" is no whole number from %u to %u", option, text, least,
                   most);
    return value;
}

uint32_t value_among(struct argp_state *state,
                     const char *option,
                     const char *text,
                     const uint32_t *choices,
                     size_t count)
{
    char list[128] = "";
    uint32_t value = 0;
    const bool is_number = parse_digits(text, strlen(text), &value);
    for (size_t i = 0, used = 0; i < count; i++) {
        if (is_number && choices[i] == value)
            return value;
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%u", i ? ", " : "",
                                 choices[i]);
    }
    argp_error(state, "%s: \"%s\" is none of %s", option, text, list);
    return value;
}

void value_size(struct argp_state *state,
                const char *option,
                const char *text,
                uint32_t *width,
                uint32_t *height)
{
    const char *cross = strchr(text, 'x');
    uint32_t w = 0, h = 0;
    const bool are_numbers = cross && parse_digits(text, (size_t)(cross - text), &w) &&
                             parse_digits(cross + 1, strlen(cross + 1), &h);
    if (!are_numbers || w < 1 || w > TL_MAX_EXTENT || h < 1 || h > TL_MAX_EXTENT)
        argp_error(state, "%s: \"%s\" is no size; write WIDTHxHEIGHT, each from 1 to %d pixels",
                   option, text, TL_MAX_EXTENT);
    *width = w;
    *height = h;
}

unsigned value_word(struct argp_state *state,
                    const char *option,
                    const char *text,
                    const value_words *words)
{
    char list[256] = "";
    for (size_t i = 0, used = 0; i < words->count; i++) {
        if (strcmp(text, words->words[i]) == 0)
            return (unsigned)i;
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "",
                                 words->words[i]);
    }
    argp_error(state, "%s: no such %s \"%s\"; %s: %s", option, words->kind, text, words->kinds,
               list);
    return 0;
}

enum tl_layout_name value_layout(struct argp_state *state, const char *option, const char *text)
{
    enum tl_layout_name layout = TL_LAYOUT_FLOAT;
    tl_error err;
    if (tl_layout_find(text, &layout, &err) != TL_OK)
        argp_error(state, "%s: %s", option, err.message);
    return layout;
}

error_t value_argument(int key,
                       char *text,
                       struct argp_state *state,
                       const value_arguments *arguments)
{
    if (key == ARGP_KEY_ARG && state->arg_num >= arguments->count)
        argp_error(state, "\"%s\" is an argument too many", text);
    else if (key == ARGP_KEY_ARG)
        arguments->values[state->arg_num] = text;
    else if (key == ARGP_KEY_END && state->arg_num < arguments->count)
        argp_error(state, "%s is missing", arguments->names[state->arg_num]);
    else if (key != ARGP_KEY_END)
        return ARGP_ERR_UNKNOWN;
    return 0;
}
