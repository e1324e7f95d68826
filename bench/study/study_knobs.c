#include "study_knobs.h"

#include "tilelight/layouts.h"
#include "tilelight/occlusion.h"
#include "try.h"
#include "words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CAUSE_WORD(name, word, meaning) [name] = word,
#define CAUSE_MEANING(name, word, meaning) [name] = meaning,
const char *const tl_study_cause_words[] = {TL_STUDY_CAUSES(CAUSE_WORD)};
const char *const tl_study_cause_meanings[] = {TL_STUDY_CAUSES(CAUSE_MEANING)};

#define WORD(name, word, meaning) word,
#define COMMA_WORD(name, word, meaning) "," word
#define LAYOUT_WORD(name, row, word) "," word
#define COMPRESSION_WORD(name, word, exact, meaning) word,
#define COMMA_COMPRESSION(name, word, exact, meaning) "," word
#define ALL(list) (&(list)[1])
#define ROW_WORD(name, word, traits, off, meaning, source) "," word

/* A knob of the kernels; its first row is the exact one. */
#define APPROXIMATION(knob, flag, word, first, rows, kind, kinds, said)                \
    [TL_STUDY_KNOB_APPROXIMATIONS +                                                    \
        knob] = {.name = word,                                                         \
                 .meaning = said,                                                      \
                 .trades = "how near a form is to what it stands for, for operations", \
                 .cause = TL_STUDY_APPROXIMATION,                                      \
                 .usual = first,                                                       \
                 .exact = first,                                                       \
                 .alone = "all",                                                       \
                 .all = ALL(rows(ROW_WORD)),                                           \
                 .axis = TL_AXIS_KNOBS + knob,                                         \
                 .fits = fits_approximations},

#define TEXT_OF(number) #number
#define TEXT_OF_VALUE(number) TEXT_OF(number)
#define DEFAULT_FILTER TEXT_OF_VALUE(TL_DEFAULT_SHADOW_FILTER)
#define DEFAULT_SAMPLES TEXT_OF_VALUE(TL_DEFAULT_OCCLUSION_SAMPLES)
#define SAMPLES_WORD(samples, slices, steps, halvings) TEXT_OF(samples),
#define COMMA_SAMPLES(samples, slices, steps, halvings) "," TEXT_OF(samples)

static tl_status set_cutoff(tl_study_config *config, const char *word, tl_error *err)
{
    return tl_word_number("--knob cutoff", word, 0.0, 1e6, &config->cutoff, err);
}

static tl_status set_compression(tl_study_config *config, const char *word, tl_error *err)
{
    static const char *const words[] = {TL_COMPRESSIONS(COMPRESSION_WORD)};
    size_t at = 0;
    const tl_status status =
        tl_word_among("--knob compression", word, words, TL_COMPRESSION_COUNT, &at, err);
    config->compression = (tl_compression)at;
    return status;
}

static tl_status set_output(tl_study_config *config, const char *word, tl_error *err)
{
    static const char *const words[] = {TL_STUDY_OUTPUTS(WORD)};
    size_t at = 0;
    const tl_status status =
        tl_word_among("--knob output", word, words, TL_STUDY_OUTPUT_COUNT, &at, err);
    config->output = (tl_study_output)at;
    return status;
}

static int has_place(const tl_study_needs *needs, const tl_study_config *config)
{
    return (needs->present & ~tl_layout_planes(config->of.layout)) == 0;
}

static int can_double(const tl_study_needs *needs, const tl_study_config *config)
{
    return needs->has_double || config->of.lighting.precision != TL_PRECISION_DOUBLE;
}

static int has_endless(const tl_study_needs *needs, const tl_study_config *config)
{
    return needs->has_endless || config->cutoff == 0.0;
}

static tl_status set_filter(tl_study_config *config, const char *word, tl_error *err)
{
    return tl_word_integer("--knob shadow-filter", word, 1, TL_MOST_SHADOW_FILTER,
                           &config->of.lighting.shadow_filter, err);
}

static int has_shadows(const tl_study_needs *needs, const tl_study_config *config)
{
    return needs->has_shadows || config->of.lighting.shadow_filter == TL_DEFAULT_SHADOW_FILTER;
}

static tl_status set_samples(tl_study_config *config, const char *word, tl_error *err)
{
    static const char *const words[] = {TL_OCCLUSION_SAMPLES(SAMPLES_WORD)};
    size_t at = 0;
    const tl_status status = tl_word_among("--knob occlusion-samples", word, words,
                                           sizeof words / sizeof words[0], &at, err);
    if (status == TL_OK)
        config->of.lighting.occlusion_samples = (uint32_t)strtoul(words[at], NULL, 10);
    return status;
}

static int has_occlusion(const tl_study_needs *needs, const tl_study_config *config)
{
    return needs->has_occlusion ||
           config->of.lighting.occlusion_samples == TL_DEFAULT_OCCLUSION_SAMPLES;
}

static tl_status set_layers(tl_study_config *config, const char *word, tl_error *err)
{
    config->of.lighting.layers = TL_MOST_LAYERS;
    if (strcmp(word, "all") == 0)
        return TL_OK;
    return tl_word_integer("--knob layers (or all)", word, 0, TL_MOST_LAYERS,
                           &config->of.lighting.layers, err);
}

static int has_layers(const tl_study_needs *needs, const tl_study_config *config)
{
    return needs->has_layers || config->of.lighting.layers == TL_MOST_LAYERS;
}

/* Those of highlights are for frames that have some; and some are not there in double. */
static int fits_approximations(const tl_study_needs *needs, const tl_study_config *config)
{
    const tl_approximations *of = &config->of.lighting.approximations;
    return (needs->has_highlights ||
            (of->of[TL_KNOB_POWER] == 0 && of->of[TL_KNOB_FORM] == 0)) &&
           (config->of.lighting.precision != TL_PRECISION_DOUBLE ||
            tl_approximations_have(of, TL_KNOB_DOUBLE));
}

const tl_study_knob tl_study_knobs[TL_STUDY_KNOB_COUNT] = {
    [TL_STUDY_KNOB_LAYOUT] = {.name = "layout",
                              .meaning =
                                  "how pixels are packed; `tilelight layouts' describes them",
                              .trades =
                                  "bits of depth, normals and materials for bytes to move",
                              .cause = TL_STUDY_STORAGE,
                              .usual = "float",
                              .exact = "float",
                              .alone = "all",
                              .quick = "float-position,compact-16,compact-12,merlin",
                              .all = ALL(TL_LAYOUTS(LAYOUT_WORD)),
                              .axis = TL_AXIS_LAYOUT,
                              .fits = has_place},
    [TL_STUDY_KNOB_COMPRESSION] = {.name = "compression",
                                   .meaning = "of the G-buffer's file",
                                   .trades =
                                       "time to decode, and with pxr24, b44 and b44a bits, for "
                                       "bytes of the file",
                                   .cause = TL_STUDY_STORAGE,
                                   .is_of_files = 1,
                                   .usual = "none",
                                   .exact = "none",
                                   .alone = "rle,zips,zip,piz,pxr24",
                                   .quick = "zip,pxr24",
                                   .all = ALL(TL_COMPRESSIONS(COMMA_COMPRESSION)),
                                   .axis = -1,
                                   .set = set_compression},
    [TL_STUDY_KNOB_PRECISION] = {.name = "precision",
                                 .meaning = "of the kernels' numbers",
                                 .trades = "rounding for half the lanes",
                                 .cause = TL_STUDY_ARITHMETIC,
                                 .usual = "float",
                                 .exact = "reference",
                                 .alone = "double",
                                 .quick = "double",
                                 .all = "float,double",
                                 .axis = TL_AXIS_PRECISION,
                                 .fits = can_double},
    [TL_STUDY_KNOB_WIDTH] = {.name = "width",
                             .meaning = "vector lanes of the kernels",
                             .trades = "nothing: exact forms have the same bits in every width",
                             .cause = TL_STUDY_ARITHMETIC,
                             .usual = "auto",
                             .exact = "auto",
                             .alone = "1,4,8",
                             .all = "auto,1,4,8,16",
                             .axis = TL_AXIS_WIDTH},
    [TL_STUDY_KNOB_CUTOFF] = {.name = "cutoff",
                              .meaning =
                                  "a light without a range ends where it gives a white surface "
                                  "this share of the frame's mean radiance; 0: nowhere",
                              .trades = "faint light for pairs that need not be computed",
                              .cause = TL_STUDY_APPROXIMATION,
                              .usual = "0",
                              .exact = "0",
                              .alone = "1e-5,1e-4,1e-3,1e-2,1e-1",
                              .quick = "1e-3,1e-1",
                              .axis = -1,
                              .set = set_cutoff,
                              .fits = has_endless},
    [TL_STUDY_KNOB_FILTER] = {.name = "shadow-filter",
                              .meaning = "width of shadows' edges, texels of their maps",
                              .trades = "steps of a shadow's edge for texels to look up, the "
                                        "square of the width and one; errors are what edges "
                                        "of another width differ by",
                              .cause = TL_STUDY_APPROXIMATION,
                              .usual = DEFAULT_FILTER,
                              .exact = DEFAULT_FILTER,
                              .alone = "1,3,5,9",
                              .quick = "1,5",
                              .axis = -1,
                              .set = set_filter,
                              .fits = has_shadows},
    [TL_STUDY_KNOB_OCCLUSION] =
        {.name = "occlusion-samples",
         .meaning = "looks around a pixel for what keeps ambient light from it",
         .trades = "horizons that are missed for looks; errors are what the picture differs by "
                   "from that of 256 looks, not from what rays would find",
         .cause = TL_STUDY_APPROXIMATION,
         .usual = DEFAULT_SAMPLES,
         .exact = "256",
         .alone = "8,16,32,128,256",
         .quick = "16",
         .all = ALL(TL_OCCLUSION_SAMPLES(COMMA_SAMPLES)),
         .axis = -1,
         .set = set_samples,
         .fits = has_occlusion},
    [TL_STUDY_KNOB_LAYERS] = {.name = "layers",
                              .meaning = "of surfaces that blend, the nearest of each pixel",
                              .trades =
                                  "what is seen through more than so many of them for the "
                                  "time of lighting it",
                              .cause = TL_STUDY_APPROXIMATION,
                              .usual = "all",
                              .exact = "all",
                              .alone = "0,1,2,4",
                              .quick = "0,2",
                              .axis = -1,
                              .set = set_layers,
                              .fits = has_layers},
    TL_KNOBS(APPROXIMATION)[TL_STUDY_KNOB_CULL] =
        {.name = "cull",
         .meaning = "which lights a tile computes",
         .trades = "nothing: a light that is left out reaches no pixel of the tile",
         .cause = TL_STUDY_CULLING,
         .usual = "split",
         .exact = "none",
         .alone = "depth,rect,none",
         .quick = "rect",
         .all = ALL(TL_CULLS(COMMA_WORD)),
         .axis = TL_AXIS_CULL},
    [TL_STUDY_KNOB_TILE] = {.name = "tile",
                            .meaning = "side of a tile, px",
                            .trades = "nothing: it moves work between culling and shading",
                            .cause = TL_STUDY_CULLING,
                            .usual = "16",
                            .exact = "16",
                            .alone = "8,32,64",
                            .quick = "32",
                            .all = "8,16,32,64",
                            .axis = TL_AXIS_TILE},
    [TL_STUDY_KNOB_OUTPUT] = {.name = "output",
                              .meaning = "what the picture is written as",
                              .trades = "bits of the picture for bytes of its file",
                              .cause = TL_STUDY_OUTPUT,
                              .is_of_files = 1,
                              .usual = "float",
                              .exact = "float",
                              .alone = "half,png",
                              .quick = "half,png",
                              .all = ALL(TL_STUDY_OUTPUTS(COMMA_WORD)),
                              .axis = -1,
                              .set = set_output},
};

tl_status tl_study_config_set(tl_study_config *config,
                              tl_study_knob_name knob,
                              const char *word,
                              tl_error *err)
{
    const tl_study_knob *row = &tl_study_knobs[knob];
    tl_study_config changed = *config;
    tl_status status = TL_OK;
    tl_error said = {.status = TL_OK};
    if (strlen(word) >= TL_BENCH_WORD_SIZE)
        return tl_fail(err, TL_ERR_ARGUMENT, "--knob %s: \"%s\" is too long a word", row->name,
                       word);
    if (row->axis < 0) {
        TRY(row->set(&changed, word, err));
    } else if (tl_bench_axes[row->axis].set(&changed.of, word, &said) != TL_OK) {
        /* The bench calls its option by two dashes, which are skipped. */
        const char *sentence = said.message + strspn(said.message, "-");
        TRY(tl_fail(err, said.status, "--knob %s", sentence));
    }
    snprintf(changed.words[knob], TL_BENCH_WORD_SIZE, "%s", word);
    *config = changed;
done:
    return status;
}

tl_study_config tl_study_config_default(void)
{
    tl_study_config config = {.of.lighting = tl_lighting_options_default()};
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        tl_study_config_set(&config, (tl_study_knob_name)knob, tl_study_knobs[knob].usual,
                            NULL);
    return config;
}

int tl_study_config_is_same(const tl_study_config *a, const tl_study_config *b)
{
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        if (strcmp(a->words[knob], b->words[knob]) != 0)
            return 0;
    return 1;
}

int tl_study_config_fits(const tl_study_config *config, const tl_study_needs *needs)
{
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        if (tl_study_knobs[knob].fits && !tl_study_knobs[knob].fits(needs, config))
            return 0;
    return 1;
}

int tl_study_config_is_usual(const tl_study_config *config, int is_of_files)
{
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++)
        if (tl_study_knobs[knob].is_of_files == is_of_files &&
            strcmp(config->words[knob], tl_study_knobs[knob].usual) != 0)
            return 0;
    return 1;
}

void tl_study_config_title(const tl_study_config *config, char *text, size_t size)
{
    size_t used = 0;
    snprintf(text, size, "default");
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT && used < size; knob++)
        if (strcmp(config->words[knob], tl_study_knobs[knob].usual) != 0)
            used += (size_t)snprintf(text + used, size - used, "%s%s=%s", used ? " " : "",
                                     tl_study_knobs[knob].name, config->words[knob]);
}
