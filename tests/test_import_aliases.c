/* Is every name of the table found in a file, as what the table says; and does the page list the table? */
#include "file_cases.h"
#include "golden_scenes.h"

#include "aliases.h"
#include "foreign_exr.h"

enum { SIDE = 2 };

static const float zeros[SIDE * SIDE];
static const float *const three_zeros[3] = {zeros, zeros, zeros};

static void mark(exr_context_t file, void *context)
{
    char name[64];
    snprintf(name, sizeof name, "%smark", (const char *)context);
    foreign_must(exr_attr_set_int(file, 0, name, 1), name);
}

/* The alias under `name`, with its components, in a file of its own. */
static void write_named(const tl_alias *alias,
                        const char *name,
                        const char *letters,
                        const char *path)
{
    static foreign_file file;
    const unsigned numbers = tl_import_kinds[alias->plane].numbers;
    file = (foreign_file){.width = SIDE,
                          .height = SIDE,
                          .pitch = SIDE,
                          .part_count = 1,
                          .attributes = alias->attribute ? mark : NULL,
                          .context = (void *)(uintptr_t)alias->attribute};
    if (numbers == 3)
        foreign_add_three(&file.parts[0], name, letters, EXR_PIXEL_HALF, three_zeros);
    else
        foreign_add(&file.parts[0], name, EXR_PIXEL_HALF, zeros);
    foreign_write(&file, path);
}

static void assert_found(const tl_alias *alias, const char *name, const char *path, int wanted)
{
    tl_error err;
    tl_source source = {0};
    tl_binding binding = {.is_bound = false};
    ASSERT_OK(tl_source_open(&source, path, &err), err);
    const bool found = tl_alias_find(&source, alias->plane, &binding);
    if (found != (wanted != 0) || (found && binding.alias != alias))
        fail_msg("\"%s\": %s", name,
                 !found   ? "is not found"
                 : wanted ? "is found by another row"
                          : "is found where it must not be");
    for (unsigned i = 0; found && i < tl_import_kinds[alias->plane].numbers; i++) {
        const char *channel = source.channels[binding.channels[i]].name;
        const char last = channel[strlen(channel) - 1];
        if (tl_import_kinds[alias->plane].numbers == 3 && last != "XYZ"[i] && last != "RGB"[i])
            fail_msg("\"%s\": component %u is \"%s\"", name, i, channel);
    }
    tl_source_close(&source);
    remove(path);
}

static void names_are_found(void **state)
{
    (void)state;
    char path[512], name[128];
    scratch_path(path, sizeof path, "alias.exr");
    for (size_t i = 0; i < tl_alias_count; i++) {
        const tl_alias *alias = &tl_aliases[i];
        const int has_layers = alias->name[1] != '\0';
        for (int set = 0; set < 2; set++) {
            write_named(alias, alias->name, set ? "RGB" : "XYZ", path);
            assert_found(alias, alias->name, path, 1);
        }
        snprintf(name, sizeof name, "A.Layer.%s", alias->name);
        write_named(alias, name, "XYZ", path);
        assert_found(alias, name, path, has_layers);
        snprintf(name, sizeof name, "x%s", alias->name);
        write_named(alias, name, "XYZ", path);
        assert_found(alias, name, path, 0);
    }
}

/* What a row's attribute keeps apart. */
static void names_need_their_attribute(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "alias.exr");
    for (size_t i = 0; i < tl_alias_count; i++) {
        tl_alias bare = tl_aliases[i];
        if (!bare.attribute)
            continue;
        bare.attribute = NULL;
        write_named(&bare, bare.name, "RGB", path);
        assert_found(&bare, bare.name, path, 0);
    }
}

/* The Z of a vector is no depth, nor is a colour of Cryptomatte coverage. */
static void components_are_no_planes(void **state)
{
    static const struct {
        const char *names[4];
        const char *parts[2];
        const char *depth; /* its name; NULL: none */
    } cases[] = {
        {{"N.X", "N.Y", "N.Z", NULL}, {NULL, NULL}, NULL},
        {{"X", "Y", "Z", NULL}, {"N", "depth"}, NULL},
        {{"Depth.X", "Depth.Y", "Depth.Z", NULL}, {NULL, NULL}, "Depth.Y"},
        {{"Z", "N.X", "N.Z", NULL}, {NULL, NULL}, "Z"},
    };
    static foreign_file file;
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "alias.exr");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_source source = {0};
        tl_binding binding = {.is_bound = false};
        file = (foreign_file){.width = SIDE, .height = SIDE, .pitch = SIDE, .part_count = 1};
        file.parts[0].name = cases[i].parts[0];
        for (int n = 0; cases[i].names[n]; n++)
            foreign_add(&file.parts[0], cases[i].names[n], EXR_PIXEL_HALF, zeros);
        foreign_write(&file, path);
        ASSERT_OK(tl_source_open(&source, path, &err), err);
        const bool found = tl_alias_find(&source, TL_IMPORT_DEPTH, &binding);
        const char *name = found ? source.channels[binding.channels[0]].name : NULL;
        if (!name != !cases[i].depth || (name && strcmp(name, cases[i].depth) != 0))
            fail_msg("case %zu: depth is \"%s\", not \"%s\"", i, name ? name : "none",
                     cases[i].depth ? cases[i].depth : "none");
        tl_source_close(&source);
        remove(path);
    }
}

/* A row of the page for each row of the table, in its order, and no more. */
static void page_lists_the_table(void **state)
{
    static const char *const spaces[] = {"", "world", "view", "view-forward"};
    (void)state;
    char path[512], row[512];
    size_t size, rows = 0;
    source_path(path, sizeof path, "docs", "file-formats", ".md");
    unsigned char *page = load_bytes(path, &size);
    page[size] = '\0';
    char *at = strstr((char *)page, "| plane | name | written by |");
    assert_non_null(at);
    at = strstr(at, "| --- | --- | --- | --- | --- |\n");
    assert_non_null(at);
    at = strchr(at, '\n') + 1;
    for (size_t i = 0; i < tl_alias_count; i++) {
        const tl_alias *a = &tl_aliases[i];
        snprintf(row, sizeof row, "| %s | `%s` | %s | %s | %s%s%s |\n",
                 tl_import_kinds[a->plane].word, a->name, a->program, spaces[a->space],
                 a->attribute ? "`" : "", a->attribute ? a->attribute : "",
                 a->attribute ? "...`" : "");
        if (strncmp(at, row, strlen(row)) != 0)
            fail_msg("the page has %.*s in place of %s", (int)strcspn(at, "\n"), at, row);
        at += strlen(row);
        rows++;
    }
    assert_int_equal(rows, tl_alias_count);
    assert_int_equal(*at, '\n');
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_found),
        cmocka_unit_test(names_need_their_attribute),
        cmocka_unit_test(components_are_no_planes),
        cmocka_unit_test(page_lists_the_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
