/* Does the program run pictures through what is asked for after lighting, say what it came to, and refuse
 * what cannot be? Is a capture that is lit in bands or by the twin the same then, and does a user's kernel
 * that gives no numbers spoil nothing? */
#define _GNU_SOURCE
#include "program.h"

#define STAGES " --antialias --bloom 0.3 --bloom-threshold 0.5 "

static const char no_numbers[] =
    "__kernel void broken(const tl_frame frame, __global const float *planes,\n"
    "                     __global const tl_view_light *lights, __global const uint *starts,\n"
    "                     __global const uint *ends, __global const uint *list,\n"
    "                     __global float *radiance)\n"
    "{\n"
    "    const uint tile = get_group_id(0), item = get_local_id(0), size = frame.tile_size;\n"
    "    const uint column = tile % frame.tiles_x * size + item % size;\n"
    "    const uint row = tile / frame.tiles_x * size + item / size;\n"
    "    const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;\n"
    "    for (int c = 0; c < 3; c++)\n"
    "        radiance[(size_t)c * frame.rows * frame.pitch + at] =\n"
    "            column == 20 && row % 9 == 4 ? NAN : 1.0f;\n"
    "}\n";

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-post");
    FILE *file = fopen("broken.cl", "w");
    assert_non_null(file);
    fputs(no_numbers, file);
    fclose(file);
    expect_run("$T capture $D/nine-lights.gltf --size 96x54 -o g.exr", 0, "", "");
    return 0;
}

static void every_way_is_the_same_file(void **state)
{
    (void)state;
    expect_run("$T light g.exr" STAGES "-o a.exr --json", 0, "\"bloomed\": true", "");
    expect_run("$T light g.exr" STAGES "--precision twin -o b.exr && cmp a.exr b.exr", 0, "",
               "");
    expect_run("$T render $D/nine-lights.gltf --size 96x54" STAGES
               "-o c.exr && cmp a.exr c.exr",
               0, "", "");
    expect_run(
        "$T light g.exr --precision twin -o plain.exr --json && ! cmp -s a.exr plain.exr", 0,
        "\"stages\": []", "");
    expect_run("$T light g.exr --antialias=depth --precision twin -o d.exr --json", 0,
               "\"edges\"", "");
}

/* A picture that is exposed eight times as much has a threshold of an eighth. */
static void thresholds_are_exposed(void **state)
{
    (void)state;
    expect_run("$T light g.exr --precision twin --bloom 0.3 --bloom-threshold 0.5 -o e.exr", 0,
               "", "");
    expect_run("$T light g.exr --precision twin --bloom 0.3 --bloom-threshold 4 --exposure 3 "
               "-o f.exr && cmp e.exr f.exr",
               0, "", "");
    expect_run("$T light g.exr --precision twin --bloom 0.3 --bloom-threshold 4 -o h.exr && "
               "! cmp -s e.exr h.exr",
               0, "", "");
}

static void nothing_bright_is_told(void **state)
{
    (void)state;
    expect_run(
        "$T light g.exr --precision twin --bloom 0.3 --bloom-threshold 1e5 -o i.exr --json "
        "&& $T light g.exr --precision twin -o j.exr && cmp i.exr j.exr",
        0, "\"bloomed\": false", "--bloom is for nothing: no pixel has a radiance above 50000");
}

static void what_is_no_number_is_mended(void **state)
{
    (void)state;
    expect_run("$T light g.exr --kernel broken.cl --entry broken --items pixel -o k.exr --json",
               0, "\"mended_pixels\": 6", "6 pixels were no colour, NaN or infinite");
    expect_run(
        "$T light g.exr --kernel broken.cl --entry broken --items pixel --bloom 1 -o l.exr "
        "&& $T compare l.exr l.exr --tolerance 0",
        0, "not finite                0 values", "");
}

static void what_cannot_be_is_refused(void **state)
{
    static const struct {
        const char *options, *says;
    } wrong[] = {
        {"--antialias=edges", "--antialias: no such attribute \"edges\""},
        {"--antialias-step 0.1", "--antialias-step goes with --antialias"},
        {"--antialias=depth --antialias-angle 3", "--antialias-angle is of normals"},
        {"--antialias=normals --antialias-step 0.1", "--antialias-step is of depth"},
        {"--bloom-knee 0.1", "--bloom-knee goes with --bloom"},
        {"--bloom -1", "--bloom"},
        {"--bloom 1 --bloom-width 2", "is blurred by 3 to 39 px, not by 2"},
        {"--bloom 1 --bloom-size half --bloom-width 25",
         "half size is blurred by 1.5 to 19 px"},
        {"--bloom 1 --bloom-size third", "--bloom-size: no such size \"third\""},
        {"--kernel broken.cl --entry broken --precision twin", "--kernel runs on a device"},
        {"--kernel broken.cl", "--entry is missing"},
        {"--kernel broken.cl --entry broken --max-error 0.1", "leave --kernel out"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        char command[256];
        snprintf(command, sizeof command, "$T light g.exr -o x.exr %s", wrong[i].options);
        expect_run(command, 2, "", wrong[i].says);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_is_the_same_file),
        cmocka_unit_test(thresholds_are_exposed),
        cmocka_unit_test(nothing_bright_is_told),
        cmocka_unit_test(what_is_no_number_is_mended),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
