/* Does docs/approximations.md show the tables of kernels/knobs.h, and nothing else in their place? Prints
 * what it should have where it has not. */
#include "testing.h"

#include "tilelight/approximations.h"

#include <stdio.h>
#include <stdlib.h>

enum { PAGE_SIZE = 1 << 16 };

static void put(char *page, const char *text)
{
    const size_t length = strlen(page);
    assert_true(length + strlen(text) < PAGE_SIZE);
    memcpy(page + length, text, strlen(text) + 1);
}

static const char *yes_or_no(uint32_t traits, enum tl_knob_trait trait)
{
    return traits & (uint32_t)trait ? "yes" : "no";
}

static void put_knob(char *page, const tl_knob *knob)
{
    char line[1024];
    snprintf(line, sizeof line,
             "## `--%s`\n\n%s.\n\n| row | what it is | same bits | double | bounded | from |\n"
             "| --- | --- | --- | --- | --- | --- |\n",
             knob->word, knob->meaning);
    put(page, line);
    for (uint32_t i = 0; i < knob->count; i++) {
        const tl_knob_row *row = &knob->rows[i];
        snprintf(line, sizeof line, "| `%s`%s | %s | %s | %s | %s | %s |\n", row->word,
                 i == 0 ? ", the default" : "", row->meaning,
                 yes_or_no(row->traits, TL_KNOB_SAME_BITS),
                 yes_or_no(row->traits, TL_KNOB_DOUBLE),
                 yes_or_no(row->traits, TL_KNOB_BOUNDED), row->source);
        put(page, line);
    }
    put(page, "\n");
}

static void the_page_has_the_tables(void **state)
{
    static char page[PAGE_SIZE], wanted[PAGE_SIZE];
    (void)state;
    FILE *file = fopen(TL_PAGE, "rb");
    assert_non_null(file);
    const size_t length = fread(page, 1, sizeof page - 1, file);
    fclose(file);
    assert_true(length > 0 && length < sizeof page - 1);
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        put_knob(wanted, &tl_knobs[knob]);
    const char *tables = strstr(page, "## `--"), *after = strstr(page, "## What they");
    assert_non_null(tables);
    assert_non_null(after);
    if ((size_t)(after - tables) != strlen(wanted) ||
        memcmp(tables, wanted, strlen(wanted)) != 0) {
        fputs(wanted, stdout);
        fail_msg("docs/approximations.md has other tables; those above belong there");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_page_has_the_tables)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
