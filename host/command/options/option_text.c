#define _GNU_SOURCE /* asprintf, open_memstream */
#include "option_text.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct line {
    char *text; /* owned */
    size_t place;
} line;

typedef struct recorder {
    const struct argp *of;
    const char *const *without;
    line *lines; /* [count], owned */
    size_t count;
    bool ran_out;
} recorder;

enum { MOST_GROUPS = 16 };

/* Stands in for an argp: the same options, whose parser writes them down. */
typedef struct stand_in {
    struct argp argp;
    const struct argp_option *options;
    struct argp_child children[MOST_GROUPS + 1];
    struct stand_in *below[MOST_GROUPS]; /* owned */
    size_t count;
    bool counts; /* whether its options are written down */
    recorder *to;
} stand_in;

static bool is_left_out(const recorder *to, const char *name)
{
    for (const char *const *left = to->without; *left; left++)
        if (strcmp(*left, name) == 0)
            return true;
    return false;
}

static void write_down(recorder *to, const char *name, const char *value)
{
    char *text = NULL;
    line *more = realloc(to->lines, (to->count + 1) * sizeof *more);
    if (more)
        to->lines = more;
    if (!more || asprintf(&text, "%s=%s\n", name, value ? value : "") < 0) {
        to->ran_out = true;
        return;
    }
    to->lines[to->count] = (line){text, to->count};
    to->count++;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    const stand_in *of = state->input;
    if (key == ARGP_KEY_INIT) {
        for (size_t i = 0; i < of->count; i++)
            state->child_inputs[i] = of->below[i];
        return 0;
    }
    for (const struct argp_option *o = of->options; of->counts && o && (o->name || o->doc); o++)
        if (o->name && o->key == key && !is_left_out(of->to, o->name))
            write_down(of->to, o->name, text);
    return 0;
}

static void release(stand_in *of)
{
    for (size_t i = 0; of && i < of->count; i++)
        release(of->below[i]);
    free(of);
}

/* NULL: out of memory. */
static stand_in *make(const struct argp *of, bool counts, recorder *to)
{
    stand_in *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    made->options = of->options;
    made->counts = counts || of == to->of;
    made->to = to;
    for (const struct argp_child *child = of->children; child && child->argp; child++) {
        stand_in *below =
            made->count < MOST_GROUPS ? make(child->argp, made->counts, to) : NULL;
        if (!below) {
            release(made);
            return NULL;
        }
        made->below[made->count] = below;
        made->children[made->count++] = (struct argp_child){&below->argp, 0, NULL, 0};
    }
    made->argp =
        (struct argp){.options = of->options, .parser = parse, .children = made->children};
    return made;
}

static int by_name(const void *a, const void *b)
{
    const line *first = a, *second = b;
    const size_t length = strcspn(first->text, "=");
    const int order = length == strcspn(second->text, "=")
                          ? strncmp(first->text, second->text, length)
                          : strcmp(first->text, second->text);
    if (order != 0)
        return order;
    return first->place < second->place ? -1 : 1;
}

/* NULL: out of memory. */
static char *join(recorder *to)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = to->ran_out ? NULL : open_memstream(&text, &size);
    if (!out)
        return NULL;
    if (to->count > 0)
        qsort(to->lines, to->count, sizeof *to->lines, by_name);
    for (size_t i = 0; i < to->count; i++)
        fputs(to->lines[i].text, out);
    const bool failed = ferror(out) != 0;
    if (fclose(out) == 0 && !failed)
        return text;
    free(text);
    return NULL;
}

tl_status option_text(const struct argp *root,
                      const struct argp *of,
                      int argc,
                      char **argv,
                      const char *const *without,
                      char **out,
                      tl_error *err)
{
    recorder to = {.of = of, .without = without};
    stand_in *all = make(root, false, &to);
    char *text = NULL;
    if (all && argp_parse(&all->argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_EXIT | ARGP_NO_HELP,
                          NULL, all) == 0)
        text = join(&to);
    release(all);
    for (size_t i = 0; i < to.count; i++)
        free(to.lines[i].text);
    free(to.lines);
    if (!text)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for options");
    *out = text;
    return TL_OK;
}
