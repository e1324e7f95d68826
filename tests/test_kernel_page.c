/* Does docs/your-kernel.md show what is: code as it stands in the files, what the command says, every
 * constant of a build? */
#define _GNU_SOURCE
#include "golden_scenes.h"
#include "program.h"

#include "options.h"

#include <ctype.h>
#include <unistd.h>

static char page[65536];

static int read_page(void **state)
{
    char path[4096];
    (void)state;
    read_text(source_path(path, sizeof path, "docs", "your-kernel", ".md"), page, sizeof page);
    return 0;
}

/* The text after the next fence of this kind at or behind *at, NUL-terminated, in a buffer of the
 * caller's; NULL where there is none. Moves *at behind it. */
static const char *next_block(const char **at, const char *fence, char *block, size_t size)
{
    const char *begin = strstr(*at, fence);
    if (!begin)
        return NULL;
    begin += strlen(fence);
    const char *end = strstr(begin, "```\n");
    assert_non_null(end);
    assert_true((size_t)(end - begin) < size);
    memcpy(block, begin, (size_t)(end - begin));
    block[end - begin] = '\0';
    *at = end + 4;
    return block;
}

static void code_is_that_of_the_files(void **state)
{
    static const struct {
        const char *folder, *name, *ending, *fence;
    } files[] = {
        {"docs/kernels", "plain", ".cl", "```c\n"},
        {"docs/kernels", "with_headers", ".cl", "```c\n"},
        {"docs/kernels", "faulty", ".cl", "```c\n"},
        {"kernels", "frame", ".h", "```c\n"},
        {"tests/outside", "CMakeLists", ".txt", "```cmake\n"},
    };
    static char block[32768], text[32768];
    int shown[COUNT_OF(files)] = {0};
    const char *fences[] = {"```c\n", "```cmake\n"};
    (void)state;
    for (size_t k = 0; k < COUNT_OF(fences); k++)
        for (const char *at = page; next_block(&at, fences[k], block, sizeof block);) {
            int found = 0;
            for (size_t f = 0; f < COUNT_OF(files); f++) {
                char path[4096];
                read_text(source_path(path, sizeof path, files[f].folder, files[f].name,
                                      files[f].ending),
                          text, sizeof text);
                if (strcmp(files[f].fence, fences[k]) == 0 && strstr(text, block))
                    found = ++shown[f];
            }
            if (!found)
                fail_msg("in no file:\n%s", block);
        }
    for (size_t f = 0; f < COUNT_OF(files); f++)
        assert_true(shown[f] > 0);
}

/* Numbers as #, however long, and blanks between as one: devices differ in them. */
static void mask_numbers(char *text)
{
    char *to = text;
    for (const char *from = text; *from;) {
        if (isdigit((unsigned char)*from)) {
            from += strspn(from, "0123456789.e+-");
            *to++ = '#';
        } else if (*from == ' ') {
            from += strspn(from, " ");
            *to++ = ' ';
        } else {
            *to++ = *from++;
        }
    }
    *to = '\0';
}

static void output_is_what_the_command_says(void **state)
{
    static char block[8192], said[sizeof((program_run *)NULL)->out];
    const char *at = page;
    (void)state;
    enter_empty_folder("kernel-page");
    assert_non_null(next_block(&at, "```text\n", block, sizeof block));
    const program_run *run =
        run_shell("cp \"$TILELIGHT_SOURCE/docs/kernels/faulty.cl\" . && $T "
                  "check --kernel faulty.cl --entry faulty --items pixel "
                  "--frame spheres");
    if (strstr(run->err, "no OpenCL device found"))
        exit(TL_SKIPPED);
    assert_int_equal(run->exit_status, 1);
    memcpy(said, run->out, sizeof said);
    mask_numbers(said);
    mask_numbers(block);
    assert_string_equal(block, said);
}

static void every_constant_is_described(void **state)
{
    static const char *const names[] = {
#define NAME(macro, field) "| `" #macro "` |",
        TL_KERNEL_OPTIONS(NAME)
#undef NAME
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(names); i++)
        if (!strstr(page, names[i]))
            fail_msg("no row %s", names[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(code_is_that_of_the_files),
        cmocka_unit_test(every_constant_is_described),
        cmocka_unit_test(output_is_what_the_command_says),
    };
    return cmocka_run_group_tests(tests, read_page, NULL);
}
