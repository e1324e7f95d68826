/* tilelight convert: a G-buffer file from one layout to another. */
#include "commands.h"
#include "console.h"
#include "import_options.h"
#include "job.h"
#include "output.h"
#include "plane_channels.h"
#include "strict_options.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"
#include "try.h"
#include "values.h"

#include <inttypes.h>
#include <stdio.h>

typedef struct convert_command {
    const char *gbuffer, *output;
    enum tl_layout_name layout;
    bool strict;
    tl_import_options import;
    report_options report;
} convert_command;

enum { OPTION_LAYOUT = 256 };

static void check_together(const convert_command *options, struct argp_state *state)
{
    if (!options->output)
        argp_error(state, "-o is missing: where the G-buffer goes");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"G.exr"};
    convert_command *options = state->input;
    const value_arguments arguments = {names, &options->gbuffer, 1};
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->strict;
        state->child_inputs[1] = &options->import;
        state->child_inputs[2] = &options->report;
        return 0;
    case 'o':
        output_kind(state, "-o", text, OUTPUT_EXR);
        options->output = text;
        return 0;
    case OPTION_LAYOUT: options->layout = value_layout(state, "--layout", text); return 0;
    case ARGP_KEY_SUCCESS: check_together(options, state); return 0;
    default: return import_argument(key, text, state, &arguments, &options->import);
    }
}

static const struct argp_option options_table[] = {
    {"output", 'o', "H.exr", 0, "The G-buffer; the lights inside go along", 1},
    {"layout", OPTION_LAYOUT, "NAME", 0,
     "How its pixels are packed: a name of `tilelight layouts' (default float: full float)", 1},
    {0},
};

static const struct argp_child children[] = {
    {&strict_argp, 0, NULL, 2},
    {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 3},
    {&report_argp, 0, "Reports:", 4},
    {0},
};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "[G.exr]",
    .doc =
        "Brings a G-buffer from its layout to another, by way of full float, or a capture of "
        "another program to a G-buffer, and says what the other cannot hold.",
    .children = children,
};

typedef struct losses {
    const char *path;
    enum tl_layout_name layout;
    tl_packing_report packing;
    bool became_phong;
} losses;

static void say_dropped(job *j, const losses *of)
{
    json_t *names = json_array();
    for (size_t i = 0; i < TL_PLANE_GROUP_COUNT; i++)
        if (of->packing.dropped & tl_plane_groups[i].planes)
            json_array_append_new(names, json_string(tl_dropped_name(i, of->packing.dropped)));
    tl_layout_tell_dropped(of->layout, of->path, of->packing.dropped, &console_notices);
    job_report(j, "dropped", names);
}

static void say_cut(job *j, const losses *of)
{
    json_t *counts = json_object();
    char list[512] = "";
    size_t length = 0;
    for (int p = 0; p < TL_PLANE_COUNT; p++) {
        const uint64_t cut = of->packing.cut[p];
        if (cut == 0)
            continue;
        length += (size_t)snprintf(list + length, sizeof list - length, "%s%s %" PRIu64,
                                   length ? ", " : "", tl_plane_channels[p], cut);
        json_object_set_new(counts, tl_plane_channels[p], json_integer((json_int_t)cut));
    }
    if (length > 0)
        tl_notice(&console_notices, "%s: pixels cut to what layout %s can say: %s", of->path,
                  tl_layout_word(of->layout), list);
    job_report(j, "cut", counts);
}

static void say_losses(job *j, const losses *of)
{
    if (of->became_phong)
        tl_notice(&console_notices,
                  "%s: metallic and roughness became a Phong material: layout %s has no place "
                  "for them",
                  of->path, tl_layout_word(of->layout));
    say_dropped(j, of);
    say_cut(j, of);
    if (of->packing.lost > 0)
        tl_notice(
            &console_notices,
            "%s: pixels that became sky, as layout %s cannot say where they are: %" PRIu64,
            of->path, tl_layout_word(of->layout), of->packing.lost);
    job_report(j, "lost", json_integer((json_int_t)of->packing.lost));
    job_report(j, "became_phong", json_boolean(of->became_phong));
}

/* From full float. */
static tl_status pack(job *j, const convert_command *options, losses *lost, tl_error *err)
{
    const double start = tl_seconds();
    tl_gbuffer *packed = NULL;
    tl_error reason = {.status = TL_OK};
    console_stage("packing");
    const tl_status status =
        tl_gbuffer_pack(j->gbuffer, options->layout, &packed, &lost->packing, &reason);
    if (status != TL_OK)
        return tl_fail(err, status, "%.900s: %.3000s",
                       options->gbuffer ? options->gbuffer : "the capture", reason.message);
    lost->became_phong = (j->gbuffer->present & TL_GROUP_METAL_ROUGH) &&
                         !(packed->present & TL_GROUP_METAL_ROUGH);
    tl_gbuffer_destroy(j->gbuffer);
    j->gbuffer = packed;
    tl_timings_end(&j->timings, "pack", start);
    return TL_OK;
}

/* Words that stay in their layout stay as they are. */
static tl_status convert(job *j, const convert_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    losses lost = {.path = options->output, .layout = options->layout};
    if (j->gbuffer->layout != options->layout)
        TRY(job_unpack(j, err));
    if (j->gbuffer->layout != options->layout)
        TRY(pack(j, options, &lost, err));
    job_report(j, "to",
               json_pack("{ss sI}", "layout", tl_layout_word(lost.layout), "bytes_per_pixel",
                         (json_int_t)tl_gbuffer_pixel_size(j->gbuffer)));
    say_losses(j, &lost);
done:
    return status;
}

static tl_status run(job *j, const convert_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(output_check(options->output, options->gbuffer, err));
    TRY(job_begin(j, &options->report, err));
    TRY(job_read(j, options->gbuffer, &options->import, options->strict, err));
    TRY(convert(j, options, err));

    const double start = tl_seconds();
    console_stage("writing");
    TRY(tl_gbuffer_write(options->output, j->gbuffer, j->lights_inside ? &j->lights : NULL,
                         err));
    tl_timings_end(&j->timings, "write", start);
    job_report(j, "output", json_string(options->output));
    job_report(j, "light_count", json_integer((json_int_t)j->lights.count));
    TRY(job_finish(j, &options->report, err));
done:
    return status;
}

int command_convert(int argc, char **argv)
{
    convert_command options = {.layout = TL_LAYOUT_FLOAT};
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&j, &options, &err);
    job_release(&j);
    return console_finish(status, &err);
}
