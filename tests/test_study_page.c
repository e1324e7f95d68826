/* Is a study's page whole: every part put in, its data as they are, nothing that markup could break out of? */
#define _GNU_SOURCE /* memmem */
#include "program.h"

#include "base64.h"
#include "study_page.h"

#include <jansson.h>

#define PNG "\x89PNG\r\n\x1a\n"

static char *page; /* of the last make_page */

static void write_file(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void make_page(const char *study)
{
    tl_error err;
    write_file("study.json", study, strlen(study));
    ASSERT_OK(tl_study_page_write(".", &err), err);
    free(page);
    page = calloc(1, 4 << 20);
    read_text("study.html", page, 4 << 20);
}

/* The text of a script element; the caller frees it. */
static char *script(const char *id)
{
    char opens[128];
    snprintf(opens, sizeof opens, "<script type=\"application/json\" id=\"%s\">", id);
    const char *at = strstr(page, opens);
    assert_non_null(at);
    at += strlen(opens);
    return strndup(at, (size_t)(strstr(at, "</script>") - at));
}

static json_t *script_json(const char *id)
{
    char *text = script(id);
    json_t *made = json_loads(text, 0, NULL);
    free(text);
    assert_non_null(made);
    return made;
}

static void bytes_are_text(void **state)
{
    /* RFC 4648, section 10. */
    static const char *const rows[][2] = {{"", ""},
                                          {"f", "Zg=="},
                                          {"fo", "Zm8="},
                                          {"foo", "Zm9v"},
                                          {"foob", "Zm9vYg=="},
                                          {"fooba", "Zm9vYmE="},
                                          {"foobar", "Zm9vYmFy"},
                                          {"\xff\xfe\xfb", "//77"}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char *text = tl_base64(rows[i][0], strlen(rows[i][0]));
        assert_string_equal(text, rows[i][1]);
        free(text);
    }
}

static void every_part_is_put_in(void **state)
{
    static const char *const parts[] = {"plot.css",        "page.css",         "study_data.js",
                                        "study_plots.js",  "page_elements.js", "page_tables.js",
                                        "page_details.js", "page_front.js",    "page_maps.js",
                                        "page.js"};
    static char text[65536];
    (void)state;
    make_page("{\"tilelight_study\": 1, \"frames\": []}");
    assert_null(strstr(page, "@@"));
    assert_non_null(strstr(page, "d3js.org"));
    for (size_t i = 0; i < COUNT_OF(parts); i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/bench/study/page/%s", getenv("TILELIGHT_SOURCE"),
                 parts[i]);
        read_text(path, text, sizeof text);
        if (!strstr(page, text))
            fail_msg("%s is not in the page as it is", parts[i]);
    }
    static const char *const scripts[] = {"study", "extras"};
    for (size_t i = 0; i < COUNT_OF(scripts); i++)
        json_decref(script_json(scripts[i]));
}

static void data_stay_as_they_are(void **state)
{
    static const char study[] =
        "{\"tilelight_study\": 1, \"unheard_of\": [1e-7, 0.123456789, null, \"\\u00e4\"], "
        "\"command\": "
        "\"</script><script>alert(1)</script><!--\", \"frames\": [{\"picture\": null, "
        "\"configurations\": [{\"map\": 3}, 4]}, 5]}";
    (void)state;
    make_page(study);
    json_t *have = script_json("study"), *want = json_loads(study, 0, NULL);
    assert_true(json_equal(have, want));
    char *text = script("study");
    assert_null(strchr(text, '<'));
    free(text);
    json_decref(want);
    json_decref(have);
}

static void pictures_go_along(void **state)
{
    static const char study[] =
        "{\"tilelight_study\": 1, \"frames\": [{\"picture\": \"a.png\", \"configurations\": "
        "[{\"map\": \"b.png\"}, {\"map\": \"gone.png\"}, {\"map\": \"\"}, {\"map\": "
        "\"no.png\"}]}]}";
    (void)state;
    write_file("a.png", PNG "one", 11);
    write_file("b.png", PNG "\0two\xff", 13);
    write_file("no.png", "password", 8);
    make_page(study);
    json_t *extras = script_json("extras"), *images = json_object_get(extras, "images");
    assert_int_equal(json_object_size(images), 2);
    char *want = tl_base64(PNG "\0two\xff", 13), *uri = NULL;
    assert_true(asprintf(&uri, "data:image/png;base64,%s", want) > 0);
    assert_string_equal(json_string_value(json_object_get(images, "b.png")), uri);
    assert_int_equal(json_array_size(json_object_get(extras, "ramp")), 17);
    assert_non_null(strstr(json_string_value(json_object_get(extras, "licence")),
                           "Redistribution and use"));
    assert_int_equal(strlen(json_string_value(json_object_get(extras, "written"))), 20);
    free(uri);
    free(want);
    json_decref(extras);
}

static void what_is_no_study_is_refused(void **state)
{
    static const struct {
        const char *text, *says;
        tl_status status;
    } rows[] = {{"{", "study.json", TL_ERR_FORMAT},
                {"[]", "study.json", TL_ERR_FORMAT},
                {"{\"frames\": 3}", "it is no study", TL_ERR_FORMAT}};
    tl_error err;
    (void)state;
    unlink("study.html");
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        write_file("study.json", rows[i].text, strlen(rows[i].text));
        assert_int_equal(tl_study_page_write(".", &err), rows[i].status);
        assert_non_null(strstr(err.message, rows[i].says));
    }
    assert_int_equal(tl_study_page_write("nowhere", &err), TL_ERR_READ);
    assert_non_null(strstr(err.message, "nowhere/study.json"));
    assert_int_not_equal(access("study.html", F_OK), 0);
}

static int enter_folder(void **state)
{
    (void)state;
    enter_empty_folder("study-page");
    return 0;
}

static int release_page(void **state)
{
    (void)state;
    free(page);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_are_text),
        cmocka_unit_test(every_part_is_put_in),
        cmocka_unit_test(data_stay_as_they_are),
        cmocka_unit_test(pictures_go_along),
        cmocka_unit_test(what_is_no_study_is_refused),
    };
    return cmocka_run_group_tests(tests, enter_folder, release_page);
}
