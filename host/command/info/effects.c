/* tilelight effects: what lighting computes, and what calls for it. */
#include "tilelight/effects.h"
#include "commands.h"
#include "console.h"
#include "explain_text.h"
#include "json_values.h"
#include "report_options.h"
#include "tilelight/post.h"
#include "values.h"

#include <stdio.h>

typedef struct effects_command {
    report_options report;
} effects_command;

static error_t parse(int key, char *text, struct argp_state *state)
{
    effects_command *options = state->input;
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = &options->report;
        return 0;
    }
    return value_argument(key, text, state, &(value_arguments){NULL, NULL, 0});
}

static const struct argp_child children[] = {{&json_argp, 0, NULL, 0}, {0}};

static const struct argp argp = {
    .parser = parse,
    .doc =
        "Lists the effects that lighting computes: what each is, what a frame must have for "
        "it, the planes it reads, and what switches it. `tilelight light --explain' says which "
        "a frame called for, and why.",
    .children = children,
};

static void print_row(const tl_effect_row *row)
{
    enum { INDENT = 16 };
    const char *before = "for: ";
    char planes[128];
    explain_planes(row->planes, planes, sizeof planes);
    printf("%-*s%s; %s%s\n%*s", INDENT, row->word, row->computes, row->option,
           tl_effect_is_by_tile((tl_effect)(row - tl_effect_rows)) ? ", tile by tile" : "",
           INDENT, "");
    for (int c = 0; c < TL_CAUSE_COUNT; c++)
        if (row->causes >> c & 1u) {
            printf("%s%s", before, tl_cause_rows[c].what);
            before = "; ";
        }
    if (planes[0])
        printf("\n%*sreads: %s", INDENT, "", planes);
    printf("\n");
}

static void print_stages(void)
{
    printf("after lighting, in this order:\n");
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        printf("%-16s%s; reads %s\n", tl_post_stage_rows[i].word, tl_post_stage_rows[i].meaning,
               tl_post_stage_rows[i].reads);
}

static json_t *stages_json(void)
{
    json_t *list = json_array();
    for (int i = 0; i < TL_POST_STAGE_COUNT; i++)
        json_array_append_new(list, json_pack("{ss ss ss}", "name", tl_post_stage_rows[i].word,
                                              "does", tl_post_stage_rows[i].meaning, "reads",
                                              tl_post_stage_rows[i].reads));
    return list;
}

static json_t *row_json(const tl_effect_row *row)
{
    json_t *causes = json_array(), *planes = json_array();
    for (int c = 0; c < TL_CAUSE_COUNT; c++)
        if (row->causes >> c & 1u)
            json_array_append_new(causes, json_string(tl_cause_rows[c].what));
    for (int p = 0; p < EXPLAIN_PLANE_WORDS; p++)
        if (explain_plane_word(p, row->planes))
            json_array_append_new(planes, json_string(explain_plane_word(p, row->planes)));
    return json_pack("{ss ss so so ss sb}", "name", row->word, "computes", row->computes, "for",
                     causes, "planes", planes, "switch", row->option, "by_tile",
                     (int)tl_effect_is_by_tile((tl_effect)(row - tl_effect_rows)));
}

static tl_status print_json(tl_error *err)
{
    json_t *list = json_array();
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        json_array_append_new(list, row_json(&tl_effect_rows[i]));
    return tl_json_write(
        "-", json_pack("{so so}", "effects", list, "after_lighting", stages_json()), err);
}

int command_effects(int argc, char **argv)
{
    effects_command options = {0};
    tl_error err;
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    if (options.report.json)
        return console_finish(print_json(&err), &err);
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        print_row(&tl_effect_rows[i]);
    print_stages();
    return console_finish(TL_OK, &err);
}
