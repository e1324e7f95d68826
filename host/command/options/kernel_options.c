#include "kernel_options.h"

#include "try.h"
#include "values.h"
#include "whole_file.h"

#include <stdlib.h>
#include <string.h>

enum { OPTION_KERNEL = 256, OPTION_ENTRY, OPTION_ITEMS };

#define WORD(name, word, meaning) [name] = word,
#define WORD_AND_MEANING(name, word, meaning) " " word ": " meaning "."
static const char *const item_words[] = {TL_KERNEL_ITEMS(WORD)};
static const value_words items = {"kind of work-item", "kinds", item_words,
                                  TL_KERNEL_ITEMS_COUNT};

/* A compiler would take minutes for less. */
static const size_t largest_file = (size_t)4 << 20;

static error_t parse(int key, char *text, struct argp_state *state)
{
    kernel_choice *choice = state->input;
    switch (key) {
    case OPTION_KERNEL: choice->file = text; return 0;
    case OPTION_ENTRY: choice->entry = text; return 0;
    case OPTION_ITEMS:
        choice->items = (tl_kernel_items)value_word(state, "--items", text, &items);
        return 0;
    case ARGP_KEY_SUCCESS:
        if (choice->file && !(choice->entry && *choice->entry))
            argp_error(state, "--entry is missing: the name of the kernel in %s", choice->file);
        if (choice->entry && !choice->file)
            argp_error(state, "--entry goes with --kernel, the file that has it");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"kernel", OPTION_KERNEL, "FILE.cl", 0,
     "A shading kernel of your own in place of tilelight's; docs/your-kernel.md says what it "
     "is given (- is standard input)",
     0},
    {"entry", OPTION_ENTRY, "NAME", 0, "The kernel's name in that file", 0},
    {"items", OPTION_ITEMS, "tile|pixel", 0,
     "What one work-item of it stands for (default tile)." TL_KERNEL_ITEMS(WORD_AND_MEANING),
     0},
    {0},
};

const struct argp kernel_argp = {.options = options_table, .parser = parse};

tl_status kernel_choice_read(kernel_choice *choice, tl_user_kernel *out, tl_error *err)
{
    tl_status status = TL_OK;
    char *source = NULL;
    size_t size = 0;
    tl_user_kernel kernel = {0};
    if (choice->file) {
        const char *name = strcmp(choice->file, "-") == 0 ? "standard input" : choice->file;
        TRY(tl_whole_file_read(choice->file, largest_file, &source, &size, err));
        if (strlen(source) != size)
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: holds a NUL byte: it is no OpenCL C", name));
        TRY(tl_user_kernel_text(name, source, &choice->text, err));
        kernel = (tl_user_kernel){
            .text = choice->text, .entry = choice->entry, .items = choice->items, .file = name};
    }
    *out = kernel;
done:
    free(source);
    return status;
}

void kernel_choice_release(kernel_choice *choice)
{
    free(choice->text);
    choice->text = NULL;
}
