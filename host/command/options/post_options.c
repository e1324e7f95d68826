#include "post_options.h"

#include "values.h"

enum {
    OPTION_EDGES = 1024,
    OPTION_ANGLE,
    OPTION_STEP,
    OPTION_BLOOM,
    OPTION_THRESHOLD,
    OPTION_KNEE,
    OPTION_WIDTH,
    OPTION_SIZE
};

static const double radians_of_degree = 0.017453292519943295;

static const char *const edge_words[] = {"normals", "depth", "both"};
static const value_words edges = {"attribute", "attributes", edge_words, 3};

static const char *const size_words[] = {"half", "quarter"};
static const value_words sizes = {"size", "sizes", size_words, 2};

post_choice post_choice_default(void)
{
    return (post_choice){.options.bloom = {.threshold = 1.0f,
                                           .knee = TL_DEFAULT_BLOOM_KNEE,
                                           .width = TL_DEFAULT_BLOOM_WIDTH,
                                           .side = TL_DEFAULT_BLOOM_SIDE}};
}

static void choose_edges(tl_edge_options *to, const char *text, struct argp_state *state)
{
    const unsigned word = text ? value_word(state, "--antialias", text, &edges) : 2;
    to->normals = word != 1;
    to->depth = word != 0;
}

static void check_bloom(const post_choice *choice, struct argp_state *state)
{
    const tl_bloom_options *b = &choice->options.bloom;
    const double least = tl_least_bloom_width(b->side), most = tl_most_bloom_width(b->side);
    if (choice->bloom_detail && !(b->strength > 0.0f))
        argp_error(state, "%s goes with --bloom", choice->bloom_detail);
    if ((double)b->width < least || (double)b->width > most)
        argp_error(state,
                   "--bloom-width: a picture of %s size is blurred by %g to %g px, not by %g",
                   b->side == 2 ? "half" : "a quarter of the", least, most, (double)b->width);
}

static void check_together(const post_choice *choice, struct argp_state *state)
{
    const tl_edge_options *e = &choice->options.edges;
    if (choice->edge_detail && !e->normals && !e->depth)
        argp_error(state, "%s goes with --antialias", choice->edge_detail);
    if (e->angle > 0.0f && !e->normals && e->depth)
        argp_error(state, "--antialias-angle is of normals, and --antialias=depth has none");
    if (e->step > 0.0f && e->normals && !e->depth)
        argp_error(state, "--antialias-step is of depth, and --antialias=normals has none");
}

static error_t parse_bloom(int key,
                           const char *text,
                           post_choice *choice,
                           struct argp_state *state)
{
    tl_bloom_options *b = &choice->options.bloom;
    switch (key) {
    case OPTION_BLOOM:
        b->strength =
            (float)value_number(state, "--bloom", text, 0.0, (double)TL_MOST_BLOOM_STRENGTH);
        return 0;
    case OPTION_THRESHOLD:
        choice->bloom_detail = "--bloom-threshold";
        b->threshold = (float)value_number(state, "--bloom-threshold", text, 0.0, 1e6);
        return 0;
    case OPTION_KNEE:
        choice->bloom_detail = "--bloom-knee";
        b->knee = (float)value_number(state, "--bloom-knee", text, 0.0, 1.0);
        return 0;
    case OPTION_WIDTH:
        choice->bloom_detail = "--bloom-width";
        b->width = (float)value_number(state, "--bloom-width", text, 1.0, 100.0);
        return 0;
    case OPTION_SIZE:
        choice->bloom_detail = "--bloom-size";
        b->side = value_word(state, "--bloom-size", text, &sizes) == 0 ? 2 : 4;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    post_choice *choice = state->input;
    switch (key) {
    case OPTION_EDGES: choose_edges(&choice->options.edges, text, state); return 0;
    case OPTION_ANGLE:
        choice->edge_detail = "--antialias-angle";
        choice->options.edges.angle =
            (float)(value_number(state, "--antialias-angle (degrees)", text, 0.1, 180.0) *
                    radians_of_degree);
        return 0;
    case OPTION_STEP:
        choice->edge_detail = "--antialias-step";
        choice->options.edges.step =
            (float)value_number(state, "--antialias-step", text, 1e-6, 1.0);
        return 0;
    case ARGP_KEY_SUCCESS:
        check_together(choice, state);
        check_bloom(choice, state);
        return 0;
    default: return parse_bloom(key, text, choice, state);
    }
}

static const struct argp_option options_table[] = {
    {"antialias", OPTION_EDGES, "normals|depth|both", OPTION_ARG_OPTIONAL,
     "Smooth edges of surfaces, found in their normals, in depth, or in both (both unless "
     "told); layers that blend have none",
     0},
    {"antialias-angle", OPTION_ANGLE, "DEGREES", 0,
     "What normals turn by where an edge begins, 0.1 to 180 (default 30)", 0},
    {"antialias-step", OPTION_STEP, "SHARE", 0,
     "The step in depth where an edge begins, as a share of the depth, 1e-6 to 1 (default "
     "0.02)",
     0},
    {"bloom", OPTION_BLOOM, "STRENGTH", 0,
     "Scatter what is bright over what is around: so much of what is over the threshold is "
     "added there, 0 to 1000; 0.1 to 0.5 is a glow",
     0},
    {"bloom-threshold", OPTION_THRESHOLD, "X", 0,
     "What is bright, once exposed: 1, the default, is what --tone none shows as white", 0},
    {"bloom-knee", OPTION_KNEE, "SHARE", 0,
     "How softly that begins: from so much of the threshold below it on, 0 to 1 (default 0.5)",
     0},
    {"bloom-width", OPTION_WIDTH, "PIXELS", 0,
     "How far it scatters, a standard deviation (default 6): 3 to 39, at half size 1.5 to 19",
     0},
    {"bloom-size", OPTION_SIZE, "half|quarter", 0,
     "The size of the picture that is blurred (default quarter); half is finer, and slower", 0},
    {0},
};

const struct argp post_argp = {.options = options_table, .parser = parse};
