/* tilelight layouts: how a pixel may be packed, what that keeps, and what its bytes buy. */
#include "layouts.h"

#include "commands.h"
#include "console.h"
#include "json_values.h"
#include "layouts_bandwidth.h"
#include "report_options.h"
#include "try.h"
#include "values.h"
#ifdef TILELIGHT_LIGHTING
#    include "layouts_measured.h"
#endif

#include <argp.h>
#include <stdbool.h>
#include <stdio.h>

enum { OPTION_BANDWIDTH = 256, OPTION_DEPTH, OPTION_SIZE, OPTION_DEVICE };

typedef struct layouts_command {
    const char *name; /* NULL: all */
    bool bandwidth, depth, size_given;
    uint32_t width, height; /* px */
    const char *device;
    report_options report;
} layouts_command;

static void check_together(const layouts_command *options, struct argp_state *state)
{
    if (!options->bandwidth && (options->size_given || options->device))
        argp_error(state, "--size and --device are for --bandwidth");
    if (options->depth && (options->bandwidth || options->name))
        argp_error(state, "--depth compares ways to store depth: neither NAME nor --bandwidth "
                          "goes with it");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    layouts_command *options = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &options->report; return 0;
    case OPTION_BANDWIDTH: options->bandwidth = true; return 0;
    case OPTION_DEPTH: options->depth = true; return 0;
    case OPTION_SIZE:
        value_size(state, "--size", text, &options->width, &options->height);
        options->size_given = true;
        return 0;
    case OPTION_DEVICE: options->device = text; return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num > 0)
            argp_error(state, "\"%s\" is an argument too many", text);
        options->name = text;
        return 0;
    case ARGP_KEY_SUCCESS: check_together(options, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"bandwidth", OPTION_BANDWIDTH, NULL, 0,
     "The bytes that layouts move: by the model of ShaderX2 (Thibieroz, 2003), as counted of our "
     "passes, and what they cost as measured, in about a minute for all",
     0},
    {"depth", OPTION_DEPTH, NULL, 0,
     "What each way to store depth loses, from near to far: stored, read as kernels do, and read "
     "by the textbook's form",
     0},
    {"size", OPTION_SIZE, "WIDTHxHEIGHT", 0,
     "With --bandwidth: the picture that is measured (default 1920x1080)", 0},
    {"device", OPTION_DEVICE, "INDEX|NAME|cpu|gpu", 0,
     "With --bandwidth: the OpenCL device; `tilelight devices' lists them (default: PoCL, else "
     "any CPU, else any)",
     0},
    {0},
};

static const struct argp_child children[] = {{&json_argp, 0, NULL, 0}, {0}};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "[NAME]",
    .doc = "Lists the layouts of a pixel: source, bytes, what each keeps and how closely. With "
           "NAME, one of them word by word.",
    .children = children,
};

/* Layouts [first, end) are told of. */
typedef struct selection {
    enum tl_layout_name first, end;
} selection;

static tl_status select_layouts(const layouts_command *options, selection *out, tl_error *err)
{
    enum tl_layout_name found = TL_LAYOUT_FLOAT;
    *out = (selection){TL_LAYOUT_FLOAT, TL_LAYOUT_COUNT};
    if (!options->name)
        return TL_OK;
    const tl_status status = tl_layout_find(options->name, &found, err);
    if (status == TL_OK)
        *out = (selection){found, (enum tl_layout_name)(found + 1)};
    return status;
}

static json_t *list_json(const layouts_command *options, selection of)
{
    json_t *list = json_array();
    for (int i = (int)of.first; i < (int)of.end; i++) {
        json_t *object = layout_json((enum tl_layout_name)i);
        if (options->bandwidth)
            json_object_set_new(object, "bandwidth",
                                bandwidth_layout_json((enum tl_layout_name)i));
        json_array_append_new(list, object);
    }
    return list;
}

#ifdef TILELIGHT_LIGHTING
static tl_status measure(
    const layouts_command *options, selection of, json_t *report, json_t *list, tl_error *err)
{
    const measured_options measured = {.device = options->device,
                                       .width = options->width,
                                       .height = options->height,
                                       .first = of.first,
                                       .end = of.end};
    return measured_layouts(&measured, report, list, err);
}
#else
static tl_status measure(
    const layouts_command *options, selection of, json_t *report, json_t *list, tl_error *err)
{
    (void)options, (void)of, (void)report, (void)list, (void)err;
    tl_notice(&console_notices, "nothing is measured: lighting is not in this build; configure "
                                "it with -DTILELIGHT_LIGHTING=ON");
    return TL_OK;
}
#endif

static tl_status report_depths(const layouts_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    json_t *report = NULL;
    if (!options->report.json)
        return depths_print(err);
    TRY(depths_json(&report, err));
    TRY(tl_json_write("-", report, err));
done:
    return status;
}

static tl_status report_json(const layouts_command *options, selection of, tl_error *err)
{
    tl_status status = TL_OK;
    json_t *report = json_object(), *list = list_json(options, of);
    if (!report || !list)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the report"));
    if (options->bandwidth) {
        json_object_set_new(report, "article", bandwidth_article_json());
        TRY(measure(options, of, report, list, err));
    }
    json_object_set(report, "layouts", list);
    TRY(tl_json_write("-", json_incref(report), err));
done:
    json_decref(list);
    json_decref(report);
    return status;
}

static tl_status run(const layouts_command *options, tl_error *err)
{
    selection of = {TL_LAYOUT_FLOAT, TL_LAYOUT_COUNT};
    tl_status status = TL_OK;
    TRY(select_layouts(options, &of, err));
    if (options->depth) {
        TRY(report_depths(options, err));
    } else if (options->report.json) {
        TRY(report_json(options, of, err));
    } else if (options->bandwidth) {
        bandwidth_print(of.first, of.end);
        TRY(console_flush(err));
        TRY(measure(options, of, NULL, NULL, err));
    } else if (options->name) {
        layout_print_details(of.first);
    } else {
        layouts_print();
    }
    TRY(console_flush(err));
done:
    return status;
}

int command_layouts(int argc, char **argv)
{
    layouts_command options = {.width = 1920, .height = 1080};
    tl_error err;
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    return console_finish(run(&options, &err), &err);
}
