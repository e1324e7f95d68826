/* Does a batch's list have the frames that were asked for, each with what it is read from, lit by and written
 * to, and is refused what could not be kept apart? */
#define _DEFAULT_SOURCE
#include "item_list.h"

#include "file_cases.h"

#include <dirent.h>
#include <unistd.h>

static char folder[512];

/* Files of sequences, among others that only look like them. */
static const char *const files[] = {
    "f.0001.exr",  "f.0002.exr",  "f.0010.exr",  "f.-003.exr", "f.12345.exr", "f.002.exr",
    "f.00004.exr", "f.0005.exrx", "xf.0006.exr", "f.exr",      "f.00a1.exr",  "f..exr",
    "g[1].exr",    "h.0001.exr",  "v1/a.exr",    "v2/a.exr",   "v3/b.exr",    "f.-1.exr",
};

static int make_files(void **state)
{
    char name[64];
    (void)state;
    scratch_path(folder, sizeof folder, "items-XXXXXX");
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    for (int i = 1; i <= 3; i++) {
        snprintf(name, sizeof name, "v%d", i);
        assert_int_equal(mkdir(name, 0777), 0);
    }
    for (size_t i = 0; i < COUNT_OF(files); i++)
        save_bytes(files[i], "", 0);
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(files); i++)
        remove(files[i]);
    remove("v1");
    remove("v2");
    remove("v3");
    return chdir("/") | rmdir(folder);
}

/* The items as one text: "input>lights>output output" each, "-" for no lights; "name:frame" before, where
 * `names` says so. */
static char *text_of(const tl_item_list *list, bool names)
{
    char *text = calloc(1, 4096);
    size_t used = 0;
    assert_non_null(text);
    for (size_t i = 0; i < list->count; i++) {
        const tl_item *item = &list->of[i];
        used += (size_t)snprintf(text + used, 4096 - used, "%s", i ? "\n" : "");
        if (names)
            used += (size_t)snprintf(text + used, 4096 - used,
                                     item->has_frame ? "%s:%d " : "%s: ", item->name,
                                     (int)item->frame);
        used += (size_t)snprintf(text + used, 4096 - used, "%s>%s>", item->input,
                                 item->lights ? item->lights : "-");
        for (size_t k = 0; k < item->output_count; k++)
            used += (size_t)snprintf(text + used, 4096 - used, "%s%s", k ? " " : "",
                                     item->outputs[k]);
    }
    return text;
}

/* Strings in a NULL-terminated list. */
static size_t count_of(const char *const *list)
{
    size_t count = 0;
    while (list[count])
        count++;
    return count;
}

typedef struct list_case {
    const char *inputs[4], *outputs[3], *frames, *lights, *want;
} list_case;

static tl_batch_request request_of(const list_case *c)
{
    return (tl_batch_request){.inputs = c->inputs,
                              .input_count = count_of(c->inputs),
                              .outputs = c->outputs,
                              .output_count = count_of(c->outputs),
                              .frames = c->frames,
                              .lights = c->lights};
}

static void inputs_become_items(void **state)
{
    static const list_case cases[] = {
        {{"f.####.exr"},
         {"o.##.png"},
         "1-2,9",
         NULL,
         "f.0001:1 f.0001.exr>->o.01.png\nf.0002:2 f.0002.exr>->o.02.png\nf.0009:9 "
         "f.0009.exr>->o.09.png"},
        {{"f.####.exr"},
         {"o.%d.png"},
         NULL,
         "l.json",
         "f.-003:-3 f.-003.exr>l.json>o.-3.png\nf.0001:1 f.0001.exr>l.json>o.1.png\nf.0002:2 "
         "f.0002.exr>l.json>o.2.png\nf.0010:10 f.0010.exr>l.json>o.10.png\nf.12345:12345 "
         "f.12345.exr>l.json>o.12345.png"},
        {{"f.%d.exr"},
         {"o.#.png"},
         NULL,
         NULL,
         "f.-1:-1 f.-1.exr>->o.-1.png\nf.12345:12345 f.12345.exr>->o.12345.png"},
        {{"v#/a.exr"},
         {"o.#.png"},
         NULL,
         "l.@@.json",
         "a:1 v1/a.exr>l.01.json>o.1.png\na:2 v2/a.exr>l.02.json>o.2.png"},
        {{"v[12]/?.exr"}, {"{name}"}, "1", NULL, NULL},
        {{"f.000*.exr"},
         {"{name}.##.png"},
         NULL,
         NULL,
         "f.00004:4 f.00004.exr>->f.00004.04.png\nf.0001:1 "
         "f.0001.exr>->f.0001.01.png\nf.0002:2 "
         "f.0002.exr>->f.0002.02.png"},
        {{"g[1].exr"}, {"o.png"}, NULL, NULL, "g[1]:1 g[1].exr>->o.png"},
        {{"f.exr", "not/there.7x.exr", "h.0001.exr"},
         {"{name}.png", "{name}.exr"},
         NULL,
         NULL,
         NULL},
        {{"f.exr", "not/there.7x.exr"},
         {"o/{name}.png", "o/{name}.exr"},
         NULL,
         NULL,
         "f: f.exr>->o/f.png o/f.exr\nthere.7x:7 not/there.7x.exr>->o/there.7x.png "
         "o/there.7x.exr"},
        {{"./.hidden"}, {"o.png"}, NULL, NULL, ".hidden: ./.hidden>->o.png"},
        {{"f.####.exr", "h.####.exr"},
         {"{name}.png"},
         "1",
         NULL,
         "f.0001:1 f.0001.exr>->f.0001.png\nh.0001:1 h.0001.exr>->h.0001.png"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        const tl_batch_request request = request_of(&cases[i]);
        const tl_status status = tl_items_list(&request, &list, &err);
        if (!cases[i].want) {
            assert_int_equal(status, TL_ERR_ARGUMENT);
            continue;
        }
        ASSERT_OK(status, err);
        char *text = text_of(&list, true);
        assert_string_equal(text, cases[i].want);
        assert_int_equal(list.all_count, list.count);
        free(text);
        tl_items_clear(&list);
    }
}

static void what_is_refused(void **state)
{
    static const struct {
        list_case asked;
        tl_status status;
        const char *words[5];
    } cases[] = {
        {{{"x.####.exr"}, {"o.#.png"}, NULL, NULL, NULL},
         TL_ERR_ARGUMENT,
         {"x.####.exr", "no file"}},
        {{{"no/f.#.exr"}, {"o.#.png"}, NULL, NULL, NULL}, TL_ERR_READ, {"no/", "No such file"}},
        {{{"x*.exr.?"}, {"o.#.png"}, NULL, NULL, NULL},
         TL_ERR_ARGUMENT,
         {"x*.exr.?", "no file"}},
        {{{"f.exr"}, {"o.#.png"}, "1-3", NULL, NULL}, TL_ERR_ARGUMENT, {"f.exr", "####"}},
        {{{"f.#.exr"}, {"o.#.png"}, "1-x", NULL, NULL}, TL_ERR_ARGUMENT, {"\"1-x\""}},
        {{{NULL}, {"o.#.png"}, "1", NULL, NULL}, TL_ERR_ARGUMENT, {"no inputs"}},
        {{{"f.#.exr"}, {NULL}, "1", NULL, NULL}, TL_ERR_ARGUMENT, {"no output"}},
        {{{"f.#.exr"}, {"o.png"}, "1-3", NULL, NULL},
         TL_ERR_ARGUMENT,
         {"o.png", "all of 3", "{name}"}},
        {{{"f.exr"}, {"o.#.png"}, NULL, NULL, NULL},
         TL_ERR_ARGUMENT,
         {"f.exr", "o.#.png", "no number"}},
        {{{"f.exr"}, {"o.png"}, NULL, "l.#.json", NULL},
         TL_ERR_ARGUMENT,
         {"f.exr", "l.#.json"}},
        {{{"f.0001.exr", "h.0001.exr"}, {"o.#.png"}, NULL, NULL, NULL},
         TL_ERR_ARGUMENT,
         {"o.1.png", "f.0001.exr", "h.0001.exr", "both"}},
        {{{"v1/a.exr", "v2/a.exr"}, {"{name}.png"}, NULL, NULL, NULL},
         TL_ERR_ARGUMENT,
         {"a.png", "v1/a.exr", "v2/a.exr"}},
        {{{"f.exr", "f.exr"}, {"{name}.png"}, NULL, NULL, NULL},
         TL_ERR_ARGUMENT,
         {"f.png", "twice"}},
        {{{"f.#.exr"}, {"o.#.png", "./o.#.png"}, "1", NULL, NULL},
         TL_ERR_ARGUMENT,
         {"o.1.png", "twice"}},
        {{{"f.#.exr"}, {"o//p/o.#.png", "o/./p/.//o.#.png"}, "1", NULL, NULL},
         TL_ERR_ARGUMENT,
         {"o.1.png", "twice"}},
        {{{"f.#.exr"}, {"f.#.exr"}, "1", NULL, NULL}, TL_ERR_ARGUMENT, {"f.1.exr", "an input"}},
        {{{"f.#.exr", "g.#.exr"}, {"x.{name}.exr", "g.1.exr"}, "1", NULL, NULL},
         TL_ERR_ARGUMENT,
         {"g.1.exr"}},
        {{{"f.#.exr"}, {"./l.exr"}, "1", "l.exr", NULL},
         TL_ERR_ARGUMENT,
         {"l.exr", "a lights file"}},
        {{{"f.#.exr"}, {"#####################"}, "1", NULL, NULL},
         TL_ERR_ARGUMENT,
         {"21 digits"}},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        const tl_batch_request request = request_of(&cases[i].asked);
        assert_refused(cases[i].words[0], tl_items_list(&request, &list, &err), cases[i].status,
                       &err, cases[i].words);
        assert_null(list.of);
    }
}

/* Names that differ by more than what is skipped. */
static void alike_is_not_the_same(void **state)
{
    static const char *const inputs[] = {"a", "b", "c", "d", "e", "f", "g", "h"};
    static const char *const outputs[] = {"o/p.png",    "op.png",   "o/.p.png", "/o/p.png",
                                          "../o/p.png", "o./p.png", "o/p.png.", ".o/p.png"};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(outputs); i++)
        for (size_t k = i + 1; k < COUNT_OF(outputs); k++) {
            tl_error err;
            tl_item_list list = {.of = NULL};
            const char *const two[] = {outputs[i], outputs[k]};
            const tl_batch_request request = {
                .inputs = &inputs[i], .input_count = 1, .outputs = two, .output_count = 2};
            ASSERT_OK(tl_items_list(&request, &list, &err), err);
            tl_items_clear(&list);
        }
}

/* Shards have everything once, and no more. */
static void shards_make_the_whole(void **state)
{
    const char *const input = "f.####.exr", *const output = "o.####.png";
    unsigned char seen[101] = {0};
    (void)state;
    for (unsigned shard = 1; shard <= 7; shard++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        const tl_batch_request request = {.inputs = &input,
                                          .input_count = 1,
                                          .frames = "1-100",
                                          .outputs = &output,
                                          .output_count = 1,
                                          .shard = shard,
                                          .shard_count = 7};
        ASSERT_OK(tl_items_list(&request, &list, &err), err);
        assert_int_equal(list.all_count, 100);
        assert_in_range(list.count, 14, 15);
        for (size_t i = 0; i < list.count; i++)
            assert_int_equal(list.of[i].frame, shard + 7 * i);
        for (size_t i = 0; i < list.count; i++)
            seen[list.of[i].frame]++;
        tl_items_clear(&list);
    }
    for (size_t i = 1; i <= 100; i++)
        assert_int_equal(seen[i], 1);
}

static void shards_that_are_none(void **state)
{
    static const unsigned shards[][2] = {{0, 3}, {4, 3}, {1, 0}};
    static const char *const words[] = {"no shard", NULL};
    const char *const input = "f.####.exr", *const output = "o.####.png";
    (void)state;
    for (size_t i = 0; i < COUNT_OF(shards); i++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        const tl_batch_request request = {.inputs = &input,
                                          .input_count = 1,
                                          .frames = "1-9",
                                          .outputs = &output,
                                          .output_count = 1,
                                          .shard = shards[i][0],
                                          .shard_count = shards[i][1]};
        assert_refused("shard", tl_items_list(&request, &list, &err), TL_ERR_ARGUMENT, &err,
                       words);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inputs_become_items),   cmocka_unit_test(what_is_refused),
        cmocka_unit_test(alike_is_not_the_same), cmocka_unit_test(shards_make_the_whole),
        cmocka_unit_test(shards_that_are_none),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
