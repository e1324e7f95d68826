#define _POSIX_C_SOURCE 200809L
#include "output.h"

#include "atomic_file.h"
#include "try.h"
#include "values.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const struct {
    int kind;
    const char *suffix, *says;
} kinds[] = {
    {OUTPUT_PNG, ".png", ".png"},
    {OUTPUT_EXR, ".exr", ".exr"},
    {OUTPUT_JSON, ".json", ".json"},
    {OUTPUT_STANDARD, NULL, "- (standard output)"},
};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

static bool has_suffix(const char *path, const char *suffix)
{
    const size_t length = strlen(path), end = strlen(suffix);
    return length > end && strcasecmp(path + length - end, suffix) == 0 &&
           path[length - end - 1] != '/';
}

int output_kind(struct argp_state *state, const char *option, const char *path, int accepted)
{
    const bool standard = strcmp(path, "-") == 0;
    char list[128] = "";
    for (size_t i = 0, used = 0; i < KIND_COUNT; i++) {
        if (!(kinds[i].kind & accepted))
            continue;
        if (kinds[i].suffix ? !standard && has_suffix(path, kinds[i].suffix) : standard)
            return kinds[i].kind;
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "",
                                 kinds[i].says);
    }
    argp_error(state, "%s: cannot tell what to write from \"%s\"; end it in %s", option, path,
               list);
    return 0;
}

tl_status output_check(const char *path, const char *input, tl_error *err)
{
    tl_status status = TL_OK;
    struct stat in, out;
    tl_atomic_file trial = {0};

    if (strcmp(path, "-") == 0)
        goto done;
    if (input && stat(input, &in) == 0 && stat(path, &out) == 0 && in.st_dev == out.st_dev &&
        in.st_ino == out.st_ino)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%s: the output is the input; choose another name",
                    path));
    TRY(tl_atomic_file_begin(&trial, path, err));
done:
    tl_atomic_file_abandon(&trial);
    return status;
}

tl_status picture_check(const picture_options *options, const char *input, tl_error *err)
{
    tl_status status = TL_OK;
    for (int i = 0; i < options->count; i++)
        TRY(output_check(options->paths[i], input, err));
done:
    return status;
}

bool picture_on_standard_output(const picture_options *options)
{
    for (int i = 0; i < options->count; i++)
        if (options->kinds[i] == OUTPUT_STANDARD)
            return true;
    return false;
}

enum { OPTION_EXPOSURE = 256, OPTION_TONE, OPTION_CURVE, OPTION_EXR };

#define TONE_WORD(name, word, source) [name] = word,
#define TONE_HELP(name, word, source) " " word ": " source "."
static const char *const tone_words[] = {TL_TONE_CURVES(TONE_WORD)};
#define CURVE_WORD(name, word, rounding, source) [name] = word,
#define CURVE_HELP(name, word, rounding, source) " " word ": " source "."
static const char *const curve_words[] = {TL_CURVES(CURVE_WORD)};
static const char *const depth_words[] = {"float", "half"};
static const value_words tones = {"curve", "curves", tone_words, TL_TONE_COUNT};
static const value_words curves = {"curve", "curves", curve_words, TL_CURVE_COUNT};
static const value_words depths = {"precision", "precisions", depth_words, 2};

static void add_output(picture_options *options, const char *path, struct argp_state *state)
{
    if (options->count == MOST_OUTPUTS) {
        argp_error(state, "-o: at most %d outputs at a time", MOST_OUTPUTS);
        return;
    }
    options->kinds[options->count] =
        output_kind(state, "-o", path, OUTPUT_PNG | OUTPUT_EXR | OUTPUT_STANDARD);
    options->paths[options->count++] = path;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    picture_options *options = state->input;
    switch (key) {
    case 'o': add_output(options, text, state); return 0;
    case OPTION_EXPOSURE:
        options->automatic = strcmp(text, "auto") == 0;
        if (!options->automatic)
            options->exposure =
                (float)value_number(state, "--exposure (stops, or auto)", text, -64.0, 64.0);
        return 0;
    case OPTION_TONE:
        options->look.tone = (tl_tone)value_word(state, "--tone", text, &tones);
        options->tone_given = true;
        return 0;
    case OPTION_CURVE:
        options->look.curve = (tl_curve)value_word(state, "--curve", text, &curves);
        options->curve_given = true;
        return 0;
    case OPTION_EXR: options->half = value_word(state, "--exr", text, &depths) == 1; return 0;
    case ARGP_KEY_SUCCESS: /* after the arguments, which are asked for first */
        if (options->count == 0)
            argp_error(state, "-o is missing: where the picture goes");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"output", 'o', "FILE", 0,
     "The picture: .png, .exr (linear radiance), or - for a PNG on standard output; may be "
     "given several times",
     0},
    {"exposure", OPTION_EXPOSURE, "STOPS|auto", 0,
     "What PNGs are brightened by, -64 to 64, or auto: to a log-average of 0.18 (default 0)",
     0},
    {"tone", OPTION_TONE, "CURVE", 0,
     "From radiance to the range of a PNG (default aces, or what a capture of another program "
     "asks for)." TL_TONE_CURVES(TONE_HELP),
     0},
    {"curve", OPTION_CURVE, "CURVE", 0,
     "From that range to the codes of a PNG (default srgb, or what a capture of another "
     "program asks for)." TL_CURVES(CURVE_HELP),
     0},
    {"exr", OPTION_EXR, "float|half", 0, "Numbers in EXRs (default float)", 0},
    {0},
};

tl_look picture_look(const picture_options *options, const tl_look *asked)
{
    tl_look look = options->look;
    if (asked && !options->tone_given)
        look.tone = asked->tone;
    if (asked && !options->curve_given)
        look.curve = asked->curve;
    return look;
}

const char *picture_tone_word(tl_tone tone)
{
    return tone_words[tone];
}

const char *picture_curve_word(tl_curve curve)
{
    return curve_words[curve];
}

const struct argp picture_argp = {.options = options_table, .parser = parse};
