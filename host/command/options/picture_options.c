#include "picture_options.h"

#include "output.h"
#include "try.h"
#include "values.h"

#include <string.h>

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
        if (strcmp(options->paths[i], "-") == 0)
            return true;
    return false;
}

enum {
    OPTION_EXPOSURE = 256,
    OPTION_TONE,
    OPTION_WHITE,
    OPTION_CURVE,
    OPTION_DITHER,
    OPTION_PNG,
    OPTION_EXR,
    OPTION_EXR_COMPRESSION,
    OPTION_SIZE,
    OPTION_FILTER
};

#define TONE_WORD(name, word, mixes, function, source) [name] = word,
#define TONE_HELP(name, word, mixes, function, source) " " word ": " source "."
static const char *const tone_words[] = {TL_TONE_CURVES(TONE_WORD)};
#define CURVE_WORD(name, word, rounding, source) [name] = word,
#define CURVE_HELP(name, word, rounding, source) " " word ": " source "."
static const char *const curve_words[] = {TL_CURVES(CURVE_WORD)};
#define DITHER_WORD(name, word, source) [name] = word,
#define DITHER_HELP(name, word, source) " " word ": " source "."
static const char *const dither_words[] = {TL_DITHERS(DITHER_WORD)};
#define EXR_WORD(name, word, is_written, what) [name] = word,
#define EXR_WRITTEN(name, word, is_written, what) [name] = is_written,
#define EXR_HELP(name, word, is_written, what) EXR_HELP_##is_written(word ": " what)
#define EXR_HELP_1(text) " " text "."
#define EXR_HELP_0(text)
static const char *const exr_words[] = {TL_EXR_COMPRESSIONS(EXR_WORD)};
static const bool exr_written[] = {TL_EXR_COMPRESSIONS(EXR_WRITTEN)};
static const char *const number_words[] = {"float", "half"};
#define FILTER_WORD(name, word, radius, rings, source) [name] = word,
#define FILTER_HELP(name, word, radius, rings, source) " " word ": " source "."
static const char *const filter_words[] = {TL_FILTERS(FILTER_WORD)};
static const value_words filters = {"filter", "filters", filter_words, TL_FILTER_COUNT};
static const uint32_t png_depths[] = {8, 16};
static const value_words tones = {"curve", "curves", tone_words, TL_TONE_COUNT};
static const value_words curves = {"curve", "curves", curve_words, TL_CURVE_COUNT};
static const value_words dithers = {"dither", "dithers", dither_words, TL_DITHER_COUNT};
static const value_words numbers = {"precision", "precisions", number_words, 2};
static const value_words compressions = {"compression", "compressions", exr_words,
                                         TL_EXR_COMPRESSION_COUNT};

static void add_output(picture_options *options, const char *path, struct argp_state *state)
{
    if (options->count == MOST_OUTPUTS) {
        argp_error(state, "-o: at most %d outputs at a time", MOST_OUTPUTS);
        return;
    }
    const int kind = output_kind(state, "-o", path,
                                 OUTPUT_PNG | OUTPUT_EXR | OUTPUT_PFM | OUTPUT_STANDARD |
                                     OUTPUT_STANDARD_PFM);
    options->kinds[options->count] = kind;
    options->paths[options->count++] = kind == OUTPUT_STANDARD_PFM ? "-" : path;
}

/* Those that can be read elsewhere and not written here are told apart from what is no word at all. */
static tl_exr_compression compression_of(struct argp_state *state, const char *text)
{
    const unsigned found = value_word(state, "--exr-compression", text, &compressions);
    if (!exr_written[found])
        argp_error(state,
                   "--exr-compression: OpenEXR's C library, version 3.1, writes no %s; zip and "
                   "piz lose nothing, pxr24 and b44 are what it writes that rounds",
                   text);
    return (tl_exr_compression)found;
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
    case OPTION_WHITE:
        options->look.white = (float)value_number(
            state, "--white", text, (double)TL_LEAST_WHITE, (double)TL_MOST_WHITE);
        return 0;
    case OPTION_DITHER:
        options->look.dither = (tl_dither)value_word(state, "--dither", text, &dithers);
        return 0;
    case OPTION_CURVE:
        options->look.curve = (tl_curve)value_word(state, "--curve", text, &curves);
        options->curve_given = true;
        return 0;
    case OPTION_PNG:
        options->depth = value_among(state, "--png", text, png_depths, 2);
        return 0;
    case OPTION_EXR:
        options->exr.half = value_word(state, "--exr", text, &numbers) == 1;
        return 0;
    case OPTION_EXR_COMPRESSION:
        options->exr.compression = compression_of(state, text);
        return 0;
    case OPTION_SIZE:
        value_size(state, "--output-size", text, &options->width, &options->height);
        return 0;
    case OPTION_FILTER:
        options->filter = (tl_filter)value_word(state, "--filter", text, &filters);
        options->filter_given = true;
        return 0;
    case ARGP_KEY_SUCCESS: /* after the arguments, which are asked for first */
        if (options->count == 0 && !options->named_elsewhere)
            argp_error(state, "-o is missing: where the picture goes");
        if (options->filter_given && options->width == 0)
            argp_error(state, "--filter is for --output-size, which it scales to");
        if (options->look.white > 0.0f && options->look.tone != TL_TONE_REINHARD_EXTENDED)
            argp_error(state,
                       "--white is for --tone reinhard-extended, the curve that has one");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"output", 'o', "FILE", 0,
     "The picture: .png; .exr or .pfm (linear radiance); - for a PNG on standard output, pfm:- "
     "for a PFM; may be given several times",
     0},
    {"exposure", OPTION_EXPOSURE, "STOPS|auto", 0,
     "What PNGs are brightened by, -64 to 64, or auto: to a log-average of 0.18 (default 0)",
     0},
    {"tone", OPTION_TONE, "CURVE", 0,
     "From radiance to the range of a PNG (default aces, or what a capture of another program "
     "asks for)." TL_TONE_CURVES(TONE_HELP),
     0},
    {"white", OPTION_WHITE, "RADIANCE", 0,
     "What reinhard-extended shows as white, once exposed: 0.01 to 1e6 (default 4)", 0},
    {"dither", OPTION_DITHER, "NAME", 0,
     "What hides the steps between codes of PNGs; the same for a pixel's place in every frame "
     "(default none)." TL_DITHERS(DITHER_HELP),
     0},
    {"curve", OPTION_CURVE, "CURVE", 0,
     "From that range to the codes of a PNG (default srgb, or what a capture of another "
     "program asks for)." TL_CURVES(CURVE_HELP),
     0},
    {"png", OPTION_PNG, "8|16", 0, "Bits of a channel in PNGs (default 8)", 0},
    {"exr", OPTION_EXR, "float|half", 0, "Numbers in EXRs (default float)", 0},
    {"exr-compression", OPTION_EXR_COMPRESSION, "NAME", 0,
     "How EXRs are compressed (default usual)." TL_EXR_COMPRESSIONS(EXR_HELP), 0},
    {"output-size", OPTION_SIZE, "WIDTHxHEIGHT", 0,
     "Scale the lit picture to this size, in linear radiance, for every output; what is not of "
     "its shape is stretched (default: as it is lit)",
     0},
    {"filter", OPTION_FILTER, "NAME", 0,
     "What it is scaled by (default mitchell)." TL_FILTERS(FILTER_HELP), 0},
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

const char *picture_filter_word(tl_filter filter)
{
    return filter_words[filter];
}

const char *picture_dither_word(tl_dither dither)
{
    return dither_words[dither];
}

const char *picture_curve_word(tl_curve curve)
{
    return curve_words[curve];
}

const char *picture_exr_word(tl_exr_form form)
{
    if (form.compression == TL_EXR_USUAL)
        return exr_words[form.half ? TL_EXR_ZIP : TL_EXR_NONE];
    return exr_words[form.compression];
}

const struct argp picture_argp = {.options = options_table, .parser = parse};
