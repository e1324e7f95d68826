/* Do materials go from a scene to its picture by their names: captured, listed, lit, and refused where a
 * name or an index leads nowhere? */
#define _GNU_SOURCE
#include "program.h"

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-materials");
    return 0;
}

#define CAPTURE "$T capture $D/nine-lights.gltf --size 64x40 "
#define MODELS "--lights $D/nine-models.lights.json --precision twin "

static void captured_and_lit_by_name(void **state)
{
    (void)state;
    expect_run(CAPTURE "--materials -o g.exr", 0, "", "");
    expect_run("$T info g.exr", 0, "materials   1   floor\n            2   middle sphere\n",
               "");
    expect_run("$T info g.exr --json", 0, "\"materials\": [", "");
    expect_run(
        "$T info $D/nine-models.lights.json", 0,
        "ring: cook-torrance, diffuse 0.05 0.03 0.01, specular 1 0.71 0.29, roughness 0.45\n",
        "");
    const program_run *run = expect_run("$T light g.exr " MODELS "--explain -o a.exr", 0, "",
                                        "material \"ring\" by cook-torrance");
    assert_non_null(strstr(run->err, "oren-nayar, ward, ward-anisotropic"));
    assert_non_null(strstr(run->err, "material \"box\" by lambert"));
}

/* The lights file asks for the capture. */
static void rendered_at_once(void **state)
{
    (void)state;
    expect_run("$T render $D/nine-lights.gltf --size 64x40 " MODELS "-o b.exr; cmp a.exr b.exr",
               0, "", "");
}

static void by_the_bits_of_a_layout(void **state)
{
    (void)state;
    expect_run(CAPTURE "--materials --layout merlin -o m.exr", 0, "",
               "for want of a place in layout merlin: specular");
    expect_run("$T light m.exr " MODELS "-o m.png", 0, "", "");
    expect_run("$T convert g.exr --layout ispc -o i.exr", 0, "", "layout ispc: brdf");
}

static void write_lights(const char *rows)
{
    FILE *file = fopen("rows.json", "w");
    assert_non_null(file);
    fprintf(file,
            "{ \"tilelight\": 1, \"materials\": [ %s ], \"lights\": [ { \"type\": "
            "\"point\", \"position\": [0, 3, 2] } ] }",
            rows);
    assert_int_equal(fclose(file), 0);
}

static void what_leads_nowhere(void **state)
{
    static const struct {
        const char *rows, *capture;
        int status;
        const char *says;
    } cases[] = {
        {"{ \"material\": \"Gold\" }", "g.exr", 3,
         "materials[0] \"Gold\" of the lights: the capture has no material of this name; it "
         "has \"floor\", \"middle sphere\""},
        {"{ \"material\": \"ring\" }, { \"index\": 3 }", "g.exr", 3,
         "materials[0] \"ring\" of the lights: index 3 has a row already, materials[1]"},
        {"{ \"material\": \"ring\" }", "plain.exr", 3,
         "the capture names no materials; capture it with --materials"},
        {"{ \"index\": 3 }", "plain.exr", 0, "the lights' materials are for nothing"},
        {"{ \"index\": 200 }", "g.exr", 0,
         "no surface has an index that the lights' materials are for"},
    };
    (void)state;
    expect_run(CAPTURE "-o plain.exr", 0, "", "");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char command[256];
        write_lights(cases[i].rows);
        snprintf(command, sizeof command,
                 "$T light %s --lights rows.json --precision twin -o c.png", cases[i].capture);
        expect_run(command, cases[i].status, "", cases[i].says);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(captured_and_lit_by_name),
        cmocka_unit_test(rendered_at_once),
        cmocka_unit_test(by_the_bits_of_a_layout),
        cmocka_unit_test(what_leads_nowhere),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
