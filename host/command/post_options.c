#include "post_options.h"

#include "values.h"

enum { OPTION_EDGES = 1024, OPTION_ANGLE, OPTION_STEP };

static const double radians_of_degree = 0.017453292519943295;

static const char *const edge_words[] = {"normals", "depth", "both"};
static const value_words edges = {"attribute", "attributes", edge_words, 3};

static void choose_edges(tl_edge_options *to, const char *text, struct argp_state *state)
{
    const unsigned word = text ? value_word(state, "--antialias", text, &edges) : 2;
    to->normals = word != 1;
    to->depth = word != 0;
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
    case ARGP_KEY_SUCCESS: check_together(choice, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
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
    {0},
};

const struct argp post_argp = {.options = options_table, .parser = parse};
