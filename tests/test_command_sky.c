/* Does a map of the sky from the command line light a scene as the same sky in a lights file does, and is
 * what cannot be told in a sentence? */
#define _GNU_SOURCE
#include "program.h"

static const char lights[] =
    "{ \"tilelight\": 1, \"sky\": { \"type\": \"image\", \"image\": \"sky.exr\", "
    "\"intensity\": 2, "
    "\"rotation\": 1.5707963267948966, \"light\": 0.5 }, \"lights\": [] }";

static const char gradient[] = "{ \"tilelight\": 1, \"sky\": { \"type\": \"constant\", "
                               "\"color\": [1, 1, 1] }, \"lights\": [] }";

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-sky");
    write_file("l.json", lights);
    write_file("plain.json", gradient);
    expect_run("cp $D/sky.exr .", 0, "", "");
    expect_run("$T capture $D/nine-lights.gltf --size 64x36 -o g.exr", 0, "", "");
    return 0;
}

#define LIGHT "$T light g.exr --precision twin "

static void options_say_what_files_say(void **state)
{
    (void)state;
    expect_run(LIGHT "--lights l.json -o file.exr", 0, "", "");
    expect_run(LIGHT "--lights plain.json --sky sky.exr --sky-intensity 2 --sky-rotation 90 "
                     "--sky-light 0.5 -o option.exr",
               0, "", "");
    expect_run("$T compare file.exr option.exr --tolerance 0", 0, "", "");
    expect_run(LIGHT "--lights l.json --sky none -o none.exr", 0, "", "");
    expect_run("$T compare file.exr none.exr --tolerance 0", 1, "", "");
}

static void what_is_for_nothing_is_refused(void **state)
{
    (void)state;
    expect_run(LIGHT "--lights plain.json --sky none --sky-light 1 -o x.exr", 2, "",
               "--sky-light is for nothing: the lights have no sky");
    expect_run(LIGHT "--lights plain.json --sky-rotation 10 -o x.exr", 2, "",
               "--sky-rotation is for nothing: a sky of colours alone is the same all around");
    expect_run(LIGHT "--sky no-such.exr -o x.exr", 3, "", "the sky: no-such.exr: No such file");
    expect_run(LIGHT "--sky l.json -o x.exr", 3, "", "neither an OpenEXR nor a PFM nor a PNG");
    expect_run(LIGHT "--sky-light -1 -o x.exr", 2, "", "--sky-light");
    expect_run(LIGHT "--sky sky.exr --sky-light bright -o x.exr", 2, "", "--sky-light");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_say_what_files_say),
        cmocka_unit_test(what_is_for_nothing_is_refused),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
