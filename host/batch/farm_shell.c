#include "farm_shell.h"

#include <string.h>

static const char plain[] =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";

/* One word of a shell, whatever is in it: in single quotes where anything is that a shell would read. POSIX.1-2017,
 * Shell Command Language, 2.2.2: there every character is itself, but they cannot hold a single quote. An
 * apostrophe is so many quotes: one ends, one is escaped, one begins. */
static void shell_word(FILE *out, const char *word)
{
    if (word[0] && word[strspn(word, plain)] == '\0') {
        fputs(word, out);
        return;
    }
    fputc('\'', out);
    for (; *word; word++) {
        if (*word == '\'')
            fputs("'\\''", out);
        else
            fputc(*word, out);
    }
    fputc('\'', out);
}

void tl_farm_print_worker(FILE *out, const tl_farm_plan *plan)
{
    fputs("light() {\n    cd -- ", out);
    shell_word(out, plan->folder);
    fputs(" &&\n        ", out);
    shell_word(out, plan->program);
    fputs(" batch", out);
    for (size_t i = 0; i <= plan->argument_count; i++) {
        if (i == plan->chunk_at)
            fputs(" \"$1\"", out);
        if (i < plan->argument_count) {
            fputc(' ', out);
            shell_word(out, plan->arguments[i]);
        }
    }
    fputs("\n}\n", out);
}

void tl_farm_size(const tl_farm_plan *plan, char text[48])
{
    snprintf(text, 48, "%zu frame%s in %zu chunk%s", plan->frame_count,
             plan->frame_count == 1 ? "" : "s", plan->chunk_count,
             plan->chunk_count == 1 ? "" : "s");
}

void tl_farm_print_advice(FILE *out, const char *mark)
{
    static const char *const lines[] = {
        "To take it up again after whatever happened, do the same once more: pictures that are "
        "there",
        "and up to date are passed over, and no frame is lit by two workers at once.",
        "Workers need the folder under this name, the program (its lighting half is enough: a "
        "build",
        "with -DTILELIGHT_RASTER=OFF) and an OpenCL device."};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        fprintf(out, "%s%s\n", mark, lines[i]);
}
