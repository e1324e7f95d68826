#include "explain_text.h"

#include "brdf_table.h"
#include "explain_costs.h"
#include "light_words.h"
#include "printable.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TEXT = 512 };

static const struct {
    const char *word, *why;
} idle_lights[TL_IDLE_LIGHT_COUNT] = {
#define ROW(name, word, why) [name] = {word, why},
    TL_IDLE_LIGHTS(ROW)
#undef ROW
};

/* Words of planes as one says them; a material is one whole. */
static const struct {
    const char *name;
    uint32_t planes;
    const char *neutral; /* what each pixel has where it says nothing */
} plane_words[EXPLAIN_PLANE_WORDS] = {
    {"specular", TL_THREE(TL_SPECULAR_R), "black"},
    {"shininess", TL_HAS(TL_SHININESS), "0"},
    {"metallic", TL_HAS(TL_METALLIC), "0"},
    {"roughness", TL_HAS(TL_ROUGHNESS), "0"},
    {"ao", TL_GROUP_OCCLUSION, "1"},
    {"emissive", TL_GROUP_EMISSIVE, "black"},
    {"brdf", TL_GROUP_BRDF, "0"},
    {"tangent", TL_GROUP_TANGENT, "0"},
};

/* Appends to text, [MOST_TEXT], and cuts what does not fit. */
static __attribute__((format(printf, 2, 3))) void add(char *text, const char *format, ...)
{
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, MOST_TEXT - length, format, arguments);
    va_end(arguments);
}

const char *explain_plane_word(int index, uint32_t planes)
{
    return planes & plane_words[index].planes ? plane_words[index].name : NULL;
}

void explain_planes(uint32_t planes, char *text, size_t size)
{
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < EXPLAIN_PLANE_WORDS && length < size; i++)
        if (planes & plane_words[i].planes)
            length += (size_t)snprintf(text + length, size - length, "%s%s", length ? ", " : "",
                                       plane_words[i].name);
}

/* A name of the file, without what steers a terminal. */
static void add_name(char *text, const char *name)
{
    char *at = text + strlen(text);
    add(text, " \"%s\"", name);
    for (; *at; at++)
        *at = tl_printable(*at);
}

/* Of a light: its number, and its name where it has one. */
static void add_light(char *text, const job *j, uint32_t index)
{
    const char *name = j->lights.lights[index].name;
    add(text, "light %" PRIu32, index);
    if (name[0])
        add_name(text, name);
}

static void add_lights(char *text, const job *j, tl_some_lights some)
{
    if (some.count > 1)
        add(text, "%" PRIu32 " lights, the first is ", some.count);
    add_light(text, j, some.first);
}

/* Planes that may be a cause. */
static uint32_t planes_of(tl_cause cause)
{
    switch (cause) {
    case TL_CAUSE_GLOSS: return TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH;
    case TL_CAUSE_METAL_ROUGH: return TL_GROUP_METAL_ROUGH;
    case TL_CAUSE_OCCLUSION: return TL_GROUP_OCCLUSION;
    case TL_CAUSE_EMISSION: return TL_GROUP_EMISSIVE;
    case TL_CAUSE_TANGENT: return TL_GROUP_TANGENT;
    default: return 0;
    }
}

static void add_color(char *text, const char *what, const float color[3])
{
    add(text, "%s %.3g %.3g %.3g", what, (double)color[0], (double)color[1], (double)color[2]);
}

/* A row of materials, by what it is for. */
static void add_row(char *text, const tl_material_row *row)
{
    if (row->material[0])
        add_name(text, row->material);
    else
        add(text, " index %" PRIu32, row->index);
}

/* What surfaces reflect by; false where it cannot be told, which no frame that was lit has. */
static bool find_table(const job *j, tl_brdf_table *out)
{
    tl_error ignored;
    return tl_brdf_table_make(j->gbuffer, &j->lights, out, &ignored) == TL_OK;
}

/* Rows that surfaces have, each once, and what they reflect by. */
static void add_rows(char *text, const job *j)
{
    tl_brdf_table table;
    const char *before = "";
    if (!find_table(j, &table))
        return;
    for (size_t row = 0; row < j->lights.material_count; row++)
        for (int i = 0; i < TL_BRDF_COUNT; i++)
            if (table.occurs[i] && table.sources[i] == (int)row) {
                add(text, "%smaterial", before);
                add_row(text, &j->lights.materials[row]);
                add(text, " by %s", tl_model_words[j->lights.materials[row].model]);
                before = ", ";
                break;
            }
}

/* Models that surfaces have, beside phong; the frame's own where some have no row. */
static void add_models(char *text, const job *j)
{
    tl_brdf_table table;
    const char *before = "";
    if (!find_table(j, &table))
        return;
    for (int model = 0; model < TL_MODEL_COUNT; model++)
        if (model != TL_MODEL_PHONG && (table.models >> model & 1u)) {
            add(text, "%s%s", before[0] ? before : "shading model ", tl_model_words[model]);
            before = ", ";
        }
}

/* Lights with ambient lobes call for it, too. */
static void add_ambient(char *text, const job *j, const explained *e)
{
    const float *color = j->lights.ambient;
    if (color[0] > 0.0f || color[1] > 0.0f || color[2] > 0.0f) {
        add_color(text, "ambient light", color);
        return;
    }
    add(text, "ambient lobe of ");
    add_lights(text, j, e->of.lights[TL_CAUSE_AMBIENT_LOBE]);
}

static void add_gradient(char *text, const tl_light_set *lights)
{
    add_color(text, "sky", lights->zenith);
    add_color(text, " to", lights->sky);
    add_color(text, " to", lights->ground);
}

static void add_setting(char *text, const job *j, const explained *e, tl_cause cause)
{
    switch (cause) {
    case TL_CAUSE_AMBIENT: add_ambient(text, j, e); return;
    case TL_CAUSE_RADIUS:
        add(text, "ambient occlusion within %g m", (double)j->lights.occlusion_radius);
        return;
    case TL_CAUSE_SKY: add_color(text, "sky", j->lights.sky); return;
    case TL_CAUSE_MODEL: add_models(text, j); return;
    case TL_CAUSE_ROWS: add_rows(text, j); return;
    case TL_CAUSE_SKY_GRADIENT: add_gradient(text, &j->lights); return;
    case TL_CAUSE_SKY_IMAGE:
        add(text, "sky");
        add_name(text, j->lights.images[j->lights.sky_image - 1].path);
        return;
    default: add(text, "%s", tl_cause_rows[cause].what); return;
    }
}

static void add_cause(char *text, const job *j, const explained *e, tl_cause cause)
{
    char planes[128];
    if (!(e->of.causes >> cause & 1u)) {
        add(text, "--effects all");
        return;
    }
    switch (tl_cause_rows[cause].kind) {
    case TL_CAUSE_OF_LIGHTS: add_lights(text, j, e->of.lights[cause]); return;
    case TL_CAUSE_OF_PLANES:
        explain_planes(e->of.present & planes_of(cause), planes, sizeof planes);
        if (!planes[0])
            add(text, "rows of materials");
        else
            add(text, "plane%s %s", strchr(planes, ',') ? "s" : "", planes);
        return;
    case TL_CAUSE_OF_FRAME: add_setting(text, j, e, cause); return;
    }
}

static const char *neutral_word(uint32_t planes)
{
    for (int i = 0; i < EXPLAIN_PLANE_WORDS; i++)
        if (planes & plane_words[i].planes)
            return plane_words[i].neutral;
    return "";
}

static void add_lack(char *text, const explained *e, tl_cause cause)
{
    const uint32_t neutral = planes_of(cause) & e->of.neutral;
    char planes[128];
    if (cause == TL_CAUSE_AMBIENT && e->of.is_dark) {
        add(text, "nothing reflects light");
        return;
    }
    if (!neutral) {
        add(text, "no %s", tl_cause_rows[cause].what);
        return;
    }
    explain_planes(neutral, planes, sizeof planes);
    add(text, "%s is %s in every pixel", planes, neutral_word(neutral));
}

static bool is_on(const explained *e, int effect)
{
    return (e->of.effects >> effect & 1u) != 0;
}

/* What the effect is there for, or what it lacks. text: [MOST_TEXT]. */
static void because(const job *j, const explained *e, int effect, char *text)
{
    const uint64_t causes = tl_effect_rows[effect].causes;
    const uint64_t told = is_on(e, effect) ? causes : causes & ~(e->of.causes | e->of.assumed);
    const char *before = "";
    text[0] = '\0';
    for (int c = 0; c < TL_CAUSE_COUNT; c++) {
        if (!(told >> c & 1u))
            continue;
        add(text, "%s", before);
        if (is_on(e, effect))
            add_cause(text, j, e, (tl_cause)c);
        else
            add_lack(text, e, (tl_cause)c);
        before = "; ";
    }
}

/* Whether planes that are not read say nothing, or nothing asks for what they say. */
static void add_idle_planes(char *text, const explained *e, uint32_t planes, const char *name)
{
    const bool is_neutral = (planes & e->of.neutral) != 0;
    if (is_neutral)
        add(text, "plane %s: not read, %s in every pixel", name, neutral_word(planes));
    else
        add(text, "plane %s: not read by any effect that is on", name);
}

/* Lines of what was left out, one at a time: calls say(context, line). */
static void each_left_out(const job *j,
                          const explained *e,
                          void (*say)(void *context, const char *line),
                          void *context)
{
    for (int i = 0; i < TL_IDLE_LIGHT_COUNT; i++) {
        char text[MOST_TEXT] = "";
        if (e->of.idle_lights[i].count == 0)
            continue;
        add_lights(text, j, e->of.idle_lights[i]);
        add(text, ": %s%s%s", e->of.idle_lights[i].count > 1 ? "each " : "", idle_lights[i].why,
            e->of.assumed ? "; lit all the same, by --effects all" : "");
        say(context, text);
    }
    for (int i = 0; i < EXPLAIN_PLANE_WORDS; i++) {
        char text[MOST_TEXT] = "";
        if (!(e->of.idle & plane_words[i].planes))
            continue;
        add_idle_planes(text, e, plane_words[i].planes, plane_words[i].name);
        say(context, text);
    }
}

typedef struct tile_sums {
    uint32_t tiles, sky, unlit; /* unlit: they show surfaces, and list no light */
    double pairs;               /* of tiles and lights */
    double pixels, pixel_pairs; /* that show a surface; with the lights that their tiles list */
} tile_sums;

static tile_sums sums_of(const explained *e)
{
    tile_sums s = {.tiles = e->tiles_x * e->tiles_y};
    for (uint32_t t = 0; t < s.tiles; t++) {
        s.sky += e->surfaces[t] == 0;
        s.unlit += e->surfaces[t] > 0 && e->lights[t] == 0;
        s.pairs += e->lights[t];
        s.pixels += e->surfaces[t];
        s.pixel_pairs += (double)e->surfaces[t] * e->lights[t];
    }
    return s;
}

/* Of the effects that are on: where they are used, and what they cost where that was measured. */
static void print_use(const explained *e)
{
    fprintf(stderr, "use\n");
    for (int i = 0; i < TL_EFFECT_COUNT; i++) {
        const effect_use *use = &e->use[i];
        const effect_cost *cost = &e->costs[i];
        if (!is_on(e, i))
            continue;
        fprintf(stderr, "  %-17s  %7" PRIu32 " tiles", tl_effect_rows[i].word, use->tiles);
        if (tl_effects_of_light(~0u, ~0u) >> i & 1u)
            fprintf(stderr, " %10.0f pairs", use->pairs);
        else if (e->has_costs)
            fprintf(stderr, "%17s", "");
        if (e->has_costs && cost->is_known)
            fprintf(stderr, " %8.2f ms (%.2f to %.2f) %6.1f %%", cost->ms, cost->low,
                    cost->high, 100.0 * cost->share);
        else if (e->has_costs)
            fprintf(stderr, "  %s", cost->why);
        fprintf(stderr, "\n");
    }
    if (e->has_costs)
        fprintf(
            stderr,
            "  A cost is how much longer the shading kernel takes than one built without the "
            "effect, on the\n  same lists: the median of %d pairs, by turns, with its 95 %% "
            "interval, and its share of the\n  kernel's %.2f ms. Effects overlap, so costs do "
            "not add up; culling is not in them.\n",
            (int)COST_RUNS, e->shade_ms);
}

static double ratio(double of, double by)
{
    return by > 0.0 ? of / by : 0.0;
}

static void print_work(const explained *e)
{
    const tile_sums s = sums_of(e);
    fprintf(stderr, "work\n");
    fprintf(stderr,
            "  tiles           %" PRIu32 " of %u x %u pixels: %" PRIu32 " sky alone, %" PRIu32
            " more without a listed light\n",
            s.tiles, e->tile_size, e->tile_size, s.sky, s.unlit);
    fprintf(stderr, "  pairs           %.0f of a tile and a light, %.1f a tile\n", s.pairs,
            ratio(s.pairs, s.tiles));
    fprintf(stderr,
            "  pixels          %.0f of surfaces: %.1f listed lights each in the mean, %" PRIu32
            " for all\n",
            s.pixels, ratio(s.pixel_pairs, s.pixels), e->counts.global_light_count);
}

/* The word behind the next -D, [64], of what kernels were built with; returns what follows it, or NULL. */
static const char *next_macro(const char *at, char word[64])
{
    const char *found = strstr(at, "-D ");
    if (!found)
        return NULL;
    const size_t length = strcspn(found + 3, " ");
    snprintf(word, 64, "%.*s", (int)length, found + 3);
    return found + 3 + length;
}

static void print_macros(const explained *e)
{
    enum { COLUMNS = 80, INDENT = 18 };
    char word[64];
    size_t column = INDENT;
    fprintf(stderr, "kernels           ");
    if (!e->build[0])
        fprintf(stderr, "none: computed without OpenCL");
    for (const char *at = e->build; (at = next_macro(at, word));) {
        if (column + strlen(word) > COLUMNS) {
            fprintf(stderr, "\n%*s", INDENT, "");
            column = INDENT;
        }
        column += strlen(word) + 1;
        fprintf(stderr, "%s ", word);
    }
    fprintf(stderr, "\n");
}

static void print_stages(const tl_timings *timings)
{
    enum { ON_A_LINE = 4 };
    fprintf(stderr, "stages, ms");
    for (int i = 0; i < timings->count; i++)
        fprintf(stderr, "%s%s %.2f",
                i % ON_A_LINE ? ", "
                : i           ? ",\n                  "
                              : "        ",
                timings->stages[i].name, timings->stages[i].ms);
    fprintf(stderr, "\n");
}

static void print_left_out(void *context, const char *line)
{
    int *lines = context;
    fprintf(stderr, "%s  %s\n", (*lines)++ ? "" : "left out\n", line);
}

void explain_print(const job *j, const explained *e)
{
    char text[MOST_TEXT];
    int lines = 0;
    fprintf(stderr, "effects\n");
    for (int i = 0; i < TL_EFFECT_COUNT; i++) {
        because(j, e, i, text);
        fprintf(stderr, "  %-17s  %-3s  %s\n", tl_effect_rows[i].word,
                is_on(e, i) ? "on" : "off", text);
    }
    each_left_out(j, e, print_left_out, &lines);
    print_use(e);
    print_work(e);
    print_macros(e);
    print_stages(&j->timings);
}

static void append_left_out(void *context, const char *line)
{
    json_array_append_new(context, json_string(line));
}

static json_t *macros_as_json(const explained *e)
{
    json_t *object = json_object();
    char word[64];
    for (const char *at = e->build; (at = next_macro(at, word));) {
        char *value = strchr(word, '=');
        if (!value)
            continue;
        *value++ = '\0';
        json_object_set_new(object, word, json_string(value));
    }
    return object;
}

/* NULL where costs were not asked for, or the effect is off. */
static json_t *cost_as_json(const explained *e, int effect)
{
    const effect_cost *cost = &e->costs[effect];
    if (!e->has_costs || !is_on(e, effect))
        return NULL;
    if (!cost->is_known)
        return json_pack("{ss}", "unknown_because", cost->why);
    return json_pack("{sf s[ff] sf sf si}", "ms", cost->ms, "interval", cost->low, cost->high,
                     "share", cost->share, "of_shading_ms", e->shade_ms, "frames",
                     (int)COST_RUNS);
}

json_t *explain_as_json(const job *j, const explained *e)
{
    const tile_sums s = sums_of(e);
    json_t *effects = json_object(), *left_out = json_array();
    char text[MOST_TEXT];
    for (int i = 0; i < TL_EFFECT_COUNT; i++) {
        because(j, e, i, text);
        json_object_set_new(effects, tl_effect_rows[i].word,
                            json_pack("{sb ss sI sf so*}", "on", (int)is_on(e, i), "because",
                                      text, "tiles", (json_int_t)e->use[i].tiles, "pairs",
                                      e->use[i].pairs, "cost", cost_as_json(e, i)));
    }
    each_left_out(j, e, append_left_out, left_out);
    return json_pack(
        "{so so so s{sI sI sI sI} s{sf sf sf sf}}", "effects", effects, "left_out", left_out,
        "kernels", macros_as_json(e), "tiles", "size", (json_int_t)e->tile_size, "all",
        (json_int_t)s.tiles, "sky", (json_int_t)s.sky, "without_lights", (json_int_t)s.unlit,
        "pairs", "tile_light", s.pairs, "per_tile", ratio(s.pairs, s.tiles), "surface_pixels",
        s.pixels, "per_surface_pixel", ratio(s.pixel_pairs, s.pixels));
}
