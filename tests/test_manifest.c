/* Are manifests read as they are written, in lines or as an array, and is what is wrong in one named with its
 * line? */
#define _DEFAULT_SOURCE
#include "item_list.h"

#include "file_cases.h"

#include <unistd.h>

static char path[512];

static tl_status list_of(const char *text,
                         size_t size,
                         const char *output,
                         const char *lights,
                         tl_item_list *list,
                         tl_error *err)
{
    save_bytes(path, text, size);
    const tl_batch_request request = {
        .manifest = path, .outputs = &output, .output_count = output ? 1 : 0, .lights = lights};
    return tl_items_list(&request, list, err);
}

/* The path of a manifest's own folder, made anew in each call. */
static const char *beside(const char *name)
{
    static char text[1024];
    snprintf(text, sizeof text, "%.*s%s", (int)(strrchr(path, '/') + 1 - path), path, name);
    return text;
}

static void both_forms_are_read(void **state)
{
    static const char *const texts[] = {
        "{\"input\": \"a.exr\", \"output\": \"a.png\"}\n"
        "{\"input\": \"/b/b.1.exr\", \"outputs\": [\"b.png\", \"/o/b.exr\"], \"lights\": "
        "\"b.json\","
        " \"frame\": -7, \"name\": \"second\"}\n",
        "\n [ {\"output\": \"a.png\", \"input\": \"a.exr\"} , \n"
        "{\"name\": \"second\", \"input\": \"/b/b.1.exr\", \"outputs\": [\"b.png\", "
        "\"/o/b.exr\"],\n"
        "\"frame\": -7, \"lights\": \"b.json\"} ] \n\n",
        "{\"input\": \"a.exr\",\n\"output\": \"a.png\"}"
        "{\"input\": \"/b/b.1.exr\", \"outputs\": [\"b.png\", \"/o/b.exr\"], \"lights\": "
        "\"b.json\","
        " \"frame\": -7, \"name\": \"second\"}",
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        ASSERT_OK(list_of(texts[i], strlen(texts[i]), NULL, "all.json", &list, &err), err);
        assert_int_equal(list.count, 2);
        const tl_item *first = &list.of[0], *second = &list.of[1];
        assert_string_equal(first->input, beside("a.exr"));
        assert_string_equal(first->outputs[0], beside("a.png"));
        assert_string_equal(first->name, "a");
        assert_string_equal(first->lights, "all.json");
        assert_int_equal(first->output_count, 1);
        assert_false(first->has_frame);
        assert_string_equal(second->input, "/b/b.1.exr");
        assert_int_equal(second->output_count, 2);
        assert_string_equal(second->outputs[0], beside("b.png"));
        assert_string_equal(second->outputs[1], "/o/b.exr");
        assert_string_equal(second->lights, beside("b.json"));
        assert_string_equal(second->name, "second");
        assert_true(second->has_frame);
        assert_int_equal(second->frame, -7);
        tl_items_clear(&list);
    }
}

/* Of the command's options, not of the manifest: paths start where the program does. */
static void outputs_of_the_request(void **state)
{
    static const char text[] =
        "{\"input\": \"a.exr\", \"frame\": 3}\n\n{\"input\": \"b.exr\", \"frame\": 4}";
    (void)state;
    tl_error err;
    tl_item_list list = {.of = NULL};
    ASSERT_OK(list_of(text, strlen(text), "o/{name}.##.png", "l.#.json", &list, &err), err);
    assert_string_equal(list.of[0].outputs[0], "o/a.03.png");
    assert_string_equal(list.of[1].outputs[0], "o/b.04.png");
    assert_string_equal(list.of[1].lights, "l.4.json");
    tl_items_clear(&list);
}

typedef struct damage {
    const char *text, *output;
    tl_status status;
    const char *words[4];
} damage;

#define GOOD "{\"input\": \"a.exr\", \"output\": \"a.png\"}\n"
static const damage damages[] = {
    {"", NULL, TL_ERR_ARGUMENT, {"no frames"}},
    {" \n ", NULL, TL_ERR_ARGUMENT, {"no frames"}},
    {"[]", NULL, TL_ERR_ARGUMENT, {"no frames"}},
    {GOOD "{\"input\": \"b.exr\"}", NULL, TL_ERR_FORMAT, {"line 2", "\"output\""}},
    {GOOD "\n{\"output\": \"b.png\"}", NULL, TL_ERR_FORMAT, {"line 3", "\"input\""}},
    {GOOD "{\"imput\": \"b.exr\"}",
     NULL,
     TL_ERR_FORMAT,
     {"line 2", "\"imput\"", "was \"input\""}},
    {GOOD "{\"input\": 3}", NULL, TL_ERR_FORMAT, {"line 2", "\"input\"", "a path"}},
    {GOOD "{\"input\": \"\"}", NULL, TL_ERR_FORMAT, {"line 2", "a path"}},
    {GOOD "{\"input\": \"a\", \"output\": [\"b\"]}",
     NULL,
     TL_ERR_FORMAT,
     {"line 2", "\"output\""}},
    {GOOD "{\"input\": \"a\", \"outputs\": \"b\"}",
     NULL,
     TL_ERR_FORMAT,
     {"line 2", "an array"}},
    {GOOD "{\"input\": \"a\", \"outputs\": []}", NULL, TL_ERR_FORMAT, {"line 2", "an array"}},
    {GOOD "{\"input\": \"a\", \"outputs\": [\"b\", 2]}",
     NULL,
     TL_ERR_FORMAT,
     {"line 2", "a path"}},
    {GOOD "{\"input\": \"a\", \"output\": \"b\", \"outputs\": [\"c\"]}",
     NULL,
     TL_ERR_FORMAT,
     {"line 2", "not both"}},
    {GOOD "{\"input\": \"a\", \"frame\": 1.5}", NULL, TL_ERR_FORMAT, {"line 2", "\"frame\""}},
    {GOOD "{\"input\": \"a\", \"frame\": 1000000000}",
     NULL,
     TL_ERR_FORMAT,
     {"line 2", "9 digits"}},
    {GOOD "{\"input\": \"a\", \"name\": \"a/b\"}", NULL, TL_ERR_FORMAT, {"line 2", "\"name\""}},
    {GOOD "{\"input\": \"a\", \"input\": \"b\"}", NULL, TL_ERR_FORMAT, {"line 2", "duplicate"}},
    {GOOD "[]", NULL, TL_ERR_FORMAT, {"line 2", "an object"}},
    {GOOD "\n\n{\"input\": \"b.exr\",\n \"output\" \"b\"}", NULL, TL_ERR_FORMAT, {"line 5"}},
    {GOOD "nonsense", NULL, TL_ERR_FORMAT, {"line 2"}},
    {"[" GOOD "," GOOD, NULL, TL_ERR_FORMAT, {"line 3", "not closed"}},
    {"[" GOOD "]" GOOD, NULL, TL_ERR_FORMAT, {"line 2", "behind the array"}},
    {"[" GOOD ",]", NULL, TL_ERR_FORMAT, {"line 2"}},
    {"[" GOOD ", 7]", NULL, TL_ERR_FORMAT, {"line 2", "expected"}},
    {GOOD GOOD, NULL, TL_ERR_ARGUMENT, {"a.png", "twice"}},
    {GOOD, "o.png", TL_ERR_FORMAT, {"line 1", "leave one out"}},
    {"{\"input\": \"a.exr\"}\n{\"input\": \"b.exr\"}",
     "o.png",
     TL_ERR_ARGUMENT,
     {"o.png", "all of 2"}},
    {"{\"input\": \"a.exr\"}\n", "o.#.png", TL_ERR_ARGUMENT, {"a.exr", "o.#.png"}},
};

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(damages); i++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        const damage *d = &damages[i];
        assert_refused(d->text, list_of(d->text, strlen(d->text), d->output, NULL, &list, &err),
                       d->status, &err, d->words);
        assert_null(list.of);
    }
}

/* A path with a NUL in it would be another. */
static void no_nul_in_paths(void **state)
{
    static const char text[] = "{\"input\": \"a\\u0000b\", \"output\": \"a.png\"}";
    static const char *const words[] = {"line 1", NULL};
    (void)state;
    tl_error err;
    tl_item_list list = {.of = NULL};
    assert_refused("NUL", list_of(text, strlen(text), NULL, NULL, &list, &err), TL_ERR_FORMAT,
                   &err, words);
}

/* Every beginning of a good file is whole lines, or told from them. */
static void cut_short(void **state)
{
    static const char text[] =
        "[{\"input\": \"a.exr\", \"outputs\": [\"a.png\"], \"frame\": 12}]";
    (void)state;
    for (size_t size = 0; size < strlen(text); size++) {
        tl_error err;
        tl_item_list list = {.of = NULL};
        assert_int_not_equal(list_of(text, size, NULL, NULL, &list, &err), TL_OK);
    }
}

static void not_there(void **state)
{
    static const char *const words[] = {"not-there.json", "No such file", NULL};
    (void)state;
    tl_error err;
    tl_item_list list = {.of = NULL};
    const tl_batch_request request = {.manifest = beside("not-there.json")};
    assert_refused("absent", tl_items_list(&request, &list, &err), TL_ERR_READ, &err, words);
}

static void with_inputs_or_frames(void **state)
{
    static const char *const words[] = {"manifest", "leave", NULL};
    const char *const input = "a.exr";
    (void)state;
    tl_error err;
    tl_item_list list = {.of = NULL};
    tl_batch_request request = {.manifest = path, .inputs = &input, .input_count = 1};
    assert_refused("inputs", tl_items_list(&request, &list, &err), TL_ERR_ARGUMENT, &err,
                   words);
    request = (tl_batch_request){.manifest = path, .frames = "1-3"};
    assert_refused("frames", tl_items_list(&request, &list, &err), TL_ERR_ARGUMENT, &err,
                   words);
}

static int make_path(void **state)
{
    (void)state;
    scratch_path(path, sizeof path, "manifest-XXXXXX");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    return close(file);
}

static int remove_path(void **state)
{
    (void)state;
    return remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_forms_are_read),
        cmocka_unit_test(outputs_of_the_request),
        cmocka_unit_test(what_is_wrong_is_named),
        cmocka_unit_test(no_nul_in_paths),
        cmocka_unit_test(cut_short),
        cmocka_unit_test(not_there),
        cmocka_unit_test(with_inputs_or_frames),
    };
    return cmocka_run_group_tests(tests, make_path, remove_path);
}
