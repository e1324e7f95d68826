#include "import_options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    OPTION_MAP = 256,
    OPTION_DEPTH_KIND,
    OPTION_UNIT,
    OPTION_SKY,
    OPTION_NORMAL_SPACE,
    OPTION_NORMAL_RANGE,
    OPTION_POSITION_SPACE,
    OPTION_EDGES,
    OPTION_CAMERA_FILE,
    OPTION_FOV,
    OPTION_HFOV,
    OPTION_EYE,
    OPTION_TARGET,
    OPTION_UP,
    OPTION_NEAR,
    OPTION_FAR
};

#define WORD(name, word, meaning) [name] = word,
#define WORD_AND_MEANING(name, word, meaning) " " word ": " meaning "."
#define MAP_WORD(name, word, numbers, plane, meaning) " " word
static const char *const edge_words[] = {TL_EDGE_RULES(WORD)};
static const char *const range_words[] = {"signed", "unit"};
static const value_words kinds = {"kind", "kinds", tl_depth_kind_words, TL_DEPTH_KIND_COUNT};
static const value_words spaces = {"space", "spaces", tl_import_space_words, TL_SPACE_COUNT};
static const value_words edges = {"rule", "rules", edge_words, TL_EDGE_RULE_COUNT};
static const value_words ranges = {"range", "ranges", range_words, 2};

/* Which of the camera's points were given. */
typedef struct camera_points {
    bool eye, target, up;
} camera_points;

static void parse_point(struct argp_state *state,
                        const char *option,
                        const char *text,
                        double out[3])
{
    const char *rest = text;
    for (int i = 0; i < 3; i++) {
        char *end = NULL;
        out[i] = strtod(rest, &end);
        if (end == rest || *end != (i < 2 ? ',' : '\0') || !(fabs(out[i]) <= 1e18))
            argp_error(state, "%s: \"%s\" is no point; write X,Y,Z in metres", option, text);
        rest = end + 1;
    }
}

static void add_map(tl_import_options *options, const char *text, struct argp_state *state)
{
    tl_error err;
    if (options->map_count == TL_MAX_MAPS)
        argp_error(state, "--map: at most %d at a time", TL_MAX_MAPS);
    else if (tl_import_map_parse(text, &options->maps[options->map_count], &err) != TL_OK)
        argp_error(state, "--map: %s", err.message);
    else
        options->map_count++;
}

static void check_together(const tl_import_options *options,
                           const camera_points *points,
                           struct argp_state *state)
{
    const tl_import_camera *c = &options->camera;
    const bool has_lens = c->vertical_fov > 0.0 || c->horizontal_fov > 0.0;
    if (c->vertical_fov > 0.0 && c->horizontal_fov > 0.0)
        argp_error(state, "--fov and --hfov exclude each other");
    if (points->eye != points->target)
        argp_error(state, "--eye and --target go together");
    if (points->up && !points->eye)
        argp_error(state, "--up goes with --eye and --target");
    if (c->file && (has_lens || points->eye))
        argp_error(state, "--camera-file says it all: without --fov, --hfov, --eye, --target");
    if (c->near > 0.0 && c->far > 0.0 && c->near >= c->far)
        argp_error(state, "--near must be less than --far");
}

static error_t parse_camera(int key, char *text, struct argp_state *state)
{
    tl_import_options *options = state->input;
    tl_import_camera *camera = &options->camera;
    camera_points *points = state->hook;
    switch (key) {
    case OPTION_CAMERA_FILE: camera->file = text; break;
    case OPTION_FOV:
        camera->vertical_fov = value_number(state, "--fov", text, 1e-3, 179.9);
        break;
    case OPTION_HFOV:
        camera->horizontal_fov = value_number(state, "--hfov", text, 1e-3, 179.9);
        break;
    case OPTION_EYE:
        parse_point(state, "--eye", text, camera->eye);
        points->eye = true;
        break;
    case OPTION_TARGET:
        parse_point(state, "--target", text, camera->target);
        points->target = true;
        break;
    case OPTION_UP:
        parse_point(state, "--up", text, camera->up);
        points->up = true;
        break;
    case OPTION_NEAR: camera->near = value_number(state, "--near", text, 1e-12, 1e12); break;
    case OPTION_FAR:
        camera->far = strcmp(text, "inf") == 0
                          ? HUGE_VAL
                          : value_number(state, "--far (metres, or inf)", text, 1e-12, 1e12);
        break;
    default: return ARGP_ERR_UNKNOWN;
    }
    camera->is_placed = points->eye && points->target;
    options->is_given = true;
    return 0;
}

static error_t parse_meaning(int key, char *text, struct argp_state *state)
{
    tl_import_options *options = state->input;
    switch (key) {
    case OPTION_MAP: add_map(options, text, state); break;
    case OPTION_DEPTH_KIND:
        options->depth_kind = (tl_depth_kind)value_word(state, "--depth-kind", text, &kinds);
        break;
    case OPTION_UNIT: options->unit = value_number(state, "--unit", text, 1e-12, 1e12); break;
    case OPTION_SKY:
        options->sky_from = value_number(state, "--sky-from", text, 1e-12, 1e38);
        break;
    case OPTION_NORMAL_SPACE:
        options->normal_space =
            (tl_import_space)value_word(state, "--normal-space", text, &spaces);
        break;
    case OPTION_POSITION_SPACE:
        options->position_space =
            (tl_import_space)value_word(state, "--position-space", text, &spaces);
        break;
    case OPTION_NORMAL_RANGE:
        options->normals_are_encoded = value_word(state, "--normal-range", text, &ranges) == 1;
        break;
    case OPTION_EDGES:
        options->edges = (tl_edge_rule)value_word(state, "--edges", text, &edges);
        break;
    default: return parse_camera(key, text, state);
    }
    options->is_given = true;
    return 0;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    switch (key) {
    case ARGP_KEY_INIT:
        *(tl_import_options *)state->input = tl_import_options_default();
        state->hook = calloc(1, sizeof(camera_points));
        return state->hook ? 0 : ENOMEM;
    case ARGP_KEY_SUCCESS: check_together(state->input, state->hook, state); return 0;
    case ARGP_KEY_FINI: free(state->hook); return 0;
    default: return parse_meaning(key, text, state);
    }
}

static const struct argp_option options_table[] = {
    {"map", OPTION_MAP, "PLANE=[FILE:][PART/]CHANNELS", 0,
     "Where a plane comes from, where its channels have no known name; may be given for each "
     "of" TL_IMPORTS(MAP_WORD) ". depth=d.pfm, normal=n.exr:RGB, albedo=beauty/DiffCol.RGB",
     0},
    {"depth-kind", OPTION_DEPTH_KIND, "KIND", 0,
     "What the numbers of depth are (default planar)." TL_DEPTH_KINDS(WORD_AND_MEANING), 0},
    {"unit", OPTION_UNIT, "METRES", 0,
     "Of one unit of depth, of positions, and of a camera in the file (default 1)", 0},
    {"sky-from", OPTION_SKY, "UNITS", 0,
     "Depths from here on are sky, as are those of 0 or below (default 1e9)", 0},
    {"normal-space", OPTION_NORMAL_SPACE, "SPACE", 0,
     "What normals are relative to (default auto)." TL_IMPORT_SPACES(WORD_AND_MEANING), 0},
    {"normal-range", OPTION_NORMAL_RANGE, "signed|unit", 0,
     "Normals from -1 to 1, or encoded from 0 to 1 (default signed)", 0},
    {"position-space", OPTION_POSITION_SPACE, "SPACE", 0,
     "What positions are relative to (default auto: where they lie on their pixels)", 0},
    {"edges", OPTION_EDGES, "RULE", 0,
     "Pixels that alpha says are covered in part (default keep)." TL_EDGE_RULES(
         WORD_AND_MEANING),
     0},
    {"camera-file", OPTION_CAMERA_FILE, "FILE.json", 0,
     "The camera, as docs/file-formats.md says", 0},
    {"fov", OPTION_FOV, "DEGREES", 0, "The camera's vertical field of view, edge to edge", 0},
    {"hfov", OPTION_HFOV, "DEGREES", 0, "The horizontal one in its place", 0},
    {"eye", OPTION_EYE, "X,Y,Z", 0,
     "Where the camera stands, in metres (default: the origin, looking along -z)", 0},
    {"target", OPTION_TARGET, "X,Y,Z", 0, "What it looks at", 0},
    {"up", OPTION_UP, "X,Y,Z", 0, "What is above it (default 0,1,0)", 0},
    {"near", OPTION_NEAR, "METRES", 0, "Near plane of the depth buffer, for --depth-kind ndc",
     0},
    {"far", OPTION_FAR, "METRES|inf", 0, "Its far plane", 0},
    {0},
};

const struct argp import_argp = {.options = options_table, .parser = parse};

error_t import_argument(int key,
                        char *text,
                        struct argp_state *state,
                        const value_arguments *arguments,
                        const tl_import_options *options)
{
    if (key == ARGP_KEY_END && state->arg_num == 0 && options->map_count > 0)
        return 0;
    return value_argument(key, text, state, arguments);
}
