#include "bench_case.h"

#include "tilelight/layouts.h"
#include "tilelight/scatter.h"
#include "try.h"
#include "words.h"

#include <string.h>

#define WORD(name, word, meaning) word,
#define MEANING(name, word, meaning) " " word ": " meaning "."
#define COMMA_WORD(name, row, word) "," word
#define ALL_LAYOUTS (&(TL_LAYOUTS(COMMA_WORD))[1])

static tl_status set_scene(tl_bench_case *of, const char *word, tl_error *err)
{
    const char *names[64];
    size_t at = 0;
    for (int i = 0; i < tl_bench_scene_count; i++)
        names[i] = tl_bench_scenes[i].name;
    const tl_status status =
        tl_word_among("--scene", word, names, (size_t)tl_bench_scene_count, &at, err);
    if (status == TL_OK)
        of->scene = &tl_bench_scenes[at];
    return status;
}

static tl_status set_size(tl_bench_case *of, const char *word, tl_error *err)
{
    return tl_word_size("--size", word, &of->scene_options.width, &of->scene_options.height,
                        err);
}

static tl_status set_material(tl_bench_case *of, const char *word, tl_error *err)
{
    const char *names[16];
    size_t at = 0;
    for (int i = 0; i < tl_bench_material_count; i++)
        names[i] = tl_bench_materials[i].name;
    const tl_status status =
        tl_word_among("--material", word, names, (size_t)tl_bench_material_count, &at, err);
    of->scene_options.material = &tl_bench_materials[at];
    return status;
}

/* "4" or "4/10". */
static tl_status set_layers(tl_bench_case *of, const char *word, tl_error *err)
{
    static const char option[] = "--layers (N, or N/PART)";
    const char *slash = strchr(word, '/');
    char count[TL_BENCH_WORD_SIZE] = "";
    uint32_t part = 1;
    tl_status status = TL_OK;
    const size_t length = slash ? (size_t)(slash - word) : strlen(word);
    memcpy(count, word, length < sizeof count ? length : sizeof count - 1);
    if (slash)
        TRY(tl_word_integer(option, slash + 1, 1, 1000, &part, err));
    TRY(tl_word_integer(option, count, 0, TL_MOST_LAYERS, &of->scene_options.layer_count, err));
    of->scene_options.layer_part = part;
done:
    return status;
}

static tl_status set_layout(tl_bench_case *of, const char *word, tl_error *err)
{
    return tl_layout_find(word, &of->layout, err);
}

static tl_status set_against(tl_bench_case *of, const char *word, tl_error *err)
{
    return tl_layout_find(word, &of->against, err);
}

static tl_status set_lights(tl_bench_case *of, const char *word, tl_error *err)
{
    return tl_word_integer("--lights", word, 1, TL_MAX_SCATTERED,
                           &of->scene_options.light_count, err);
}

static tl_status set_per_tile(tl_bench_case *of, const char *word, tl_error *err)
{
    return tl_word_number("--per-tile", word, 0.1, 1e6, &of->scene_options.lights_per_tile,
                          err);
}

static tl_status set_range(tl_bench_case *of, const char *word, tl_error *err)
{
    of->scene_options.range = 0.0;
    if (strcmp(word, "auto") == 0)
        return TL_OK;
    return tl_word_number("--range (m, or auto)", word, 1e-6, 1e6, &of->scene_options.range,
                          err);
}

static tl_status set_tile(tl_bench_case *of, const char *word, tl_error *err)
{
    static const char *const words[] = {"8", "16", "32", "64"};
    size_t at = 0;
    const tl_status status = tl_word_among("--tile", word, words, 4, &at, err);
    of->lighting.tile_size = 8u << at;
    return status;
}

static tl_status set_cull(tl_bench_case *of, const char *word, tl_error *err)
{
    static const char *const words[] = {TL_CULLS(WORD)};
    size_t at = 0;
    const tl_status status = tl_word_among("--cull", word, words, TL_CULL_COUNT, &at, err);
    of->lighting.cull = (tl_cull)at;
    return status;
}

static tl_status set_precision(tl_bench_case *of, const char *word, tl_error *err)
{
    static const char *const words[] = {TL_PRECISIONS(WORD)};
    size_t at = 0;
    const tl_status status =
        tl_word_among("--precision", word, words, TL_PRECISION_COUNT, &at, err);
    of->lighting.precision = (tl_precision)at;
    return status;
}

static tl_status set_width(tl_bench_case *of, const char *word, tl_error *err)
{
    static const char *const words[] = {"auto", "1", "4", "8", "16"};
    static const uint32_t widths[] = {0, 1, 4, 8, 16};
    size_t at = 0;
    const tl_status status = tl_word_among("--width", word, words, 5, &at, err);
    of->lighting.vector_width = widths[at];
    return status;
}

static tl_status set_path(tl_bench_case *of, const char *word, tl_error *err)
{
    static const char *const words[] = {TL_PATHS(WORD)};
    size_t at = 0;
    const tl_status status = tl_word_among("--path", word, words, TL_PATH_COUNT, &at, err);
    of->lighting.path = (tl_path)at;
    return status;
}

/* Knobs of the kernels: a function each, for one is told the word alone. */
#define KNOB_WORD(name, word, traits, off, meaning, source) word,
#define KNOB_MEANING(name, word, traits, off, meaning, source) " " word ": " meaning "."
#define SET_KNOB(name, flag, option, usual, rows, kind, kinds, meaning)                        \
    static tl_status set_##name(tl_bench_case *of, const char *word, tl_error *err)            \
    {                                                                                          \
        static const char *const words[] = {rows(KNOB_WORD)};                                  \
        size_t at = 0;                                                                         \
        const tl_status status =                                                               \
            tl_word_among("--" option, word, words, sizeof words / sizeof words[0], &at, err); \
        of->lighting.approximations.of[name] = (uint32_t)at;                                   \
        return status;                                                                         \
    }
TL_KNOBS(SET_KNOB)

/* Any selector is a word; opening it says whether it names a device. */
static tl_status set_device(tl_bench_case *of, const char *word, tl_error *err)
{
    (void)of, (void)word, (void)err;
    return TL_OK;
}

const tl_bench_axis tl_bench_axes[TL_AXIS_COUNT] = {
    [TL_AXIS_DEVICE] = {"device", "NAME,...",
                        "OpenCL devices, by index, part of a name, cpu, gpu, or default",
                        "default", NULL, set_device},
    [TL_AXIS_SCENE] = {"scene", "NAME,...", "Scenes; `tilelight bench --list' describes them",
                       "spheres", NULL, set_scene},
    [TL_AXIS_SIZE] = {"size", "WxH,...", "Sizes of the picture, px", "1920x1080", NULL,
                      set_size},
    [TL_AXIS_MATERIAL] = {"material", "NAME,...",
                          "What surfaces are made of; `tilelight bench --list' describes them",
                          "phong", NULL, set_material},
    [TL_AXIS_LAYERS] =
        {"layers", "N,...",
         "Layers that blend, before the scene, lit by turns with the scene without: "
         "0 to 64 of them; N/10: N of a tenth of the picture",
         "0", NULL, set_layers},
    [TL_AXIS_LIGHTS] = {"lights", "N,...", "How many lights, 1 to 1000000", "1024", NULL,
                        set_lights},
    [TL_AXIS_PER_TILE] =
        {"per-tile", "N,...",
         "Lights that a tile of 16 px lists on average with --cull depth; sets their "
         "range",
         "27", NULL, set_per_tile},
    [TL_AXIS_RANGE] = {"range", "METRES,...",
                       "Range of every light, in place of --per-tile, or auto", "auto", NULL,
                       set_range},
    [TL_AXIS_AGAINST] = {"against", "NAME",
                         "The layout that each of --layout is lit by turns with", "float", NULL,
                         set_against},
    [TL_AXIS_LAYOUT] = {"layout", "NAME,...",
                        "How pixels are packed, by turns with --against's: `tilelight layouts' "
                        "describes them. all: those with a place for all of --material",
                        "float", ALL_LAYOUTS, set_layout},
    [TL_AXIS_TILE] = {"tile", "PX,...", "Sides of a tile: 8, 16, 32 or 64", "16", NULL,
                      set_tile},
    [TL_AXIS_CULL] = {"cull", "MODE,...", "Which lights a tile computes." TL_CULLS(MEANING),
                      "split", NULL, set_cull},
    [TL_AXIS_PRECISION] = {"precision", "NAME,...",
                           "How it is computed." TL_PRECISIONS(MEANING), "float", NULL,
                           set_precision},
    [TL_AXIS_WIDTH] = {"width", "LANES,...", "Vector lanes of the kernels: 1, 4, 8, 16 or auto",
                       "auto", NULL, set_width},
    [TL_AXIS_PATH] = {"path", "NAME,...", "How kernels share the work out." TL_PATHS(MEANING),
                      "auto", NULL, set_path},
#define KNOB_AXIS(name, flag, option, usual, rows, kind, kinds, meaning) \
    [TL_AXIS_KNOBS +                                                     \
        name] = {option, "NAME,...", meaning "." rows(KNOB_MEANING), usual, NULL, set_##name},
    TL_KNOBS(KNOB_AXIS)};
