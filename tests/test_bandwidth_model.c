/* Does the model of bandwidth give the article's own figures, to the digit they are printed with? */
#include "testing.h"

#include "bandwidth_model.h"

/* By hand from the text's equations: a row for 2, 3, 4 targets, columns 32, 64, 128 bits each; in
 * units of 10^9 bytes a second. */
enum { ROWS = 3, COLUMNS = 3 };
static const double bits[COLUMNS] = {32.0, 64.0, 128.0};

static const struct {
    const char *name;
    double depth_bytes; /* 0: equation 7 */
    int digits;         /* behind the point */
    const char *printed[ROWS][COLUMNS];
} tables[] = {
    {"equation 7, which table 2 prints",
     0.0,
     0,
     {{"14", "18", "26"}, {"16", "22", "34"}, {"18", "26", "42"}}},
    {"equation 6 with 8 bytes of depth, as the example has it",
     8.0,
     1,
     {{"14.2", "17.8", "25.0"}, {"16.0", "21.4", "32.1"}, {"17.8", "25.0", "39.3"}}},
    {"equation 6 with 4 bytes of depth, as table 1 has it",
     4.0,
     1,
     {{"13.4", "17.0", "24.1"}, {"15.2", "20.5", "31.3"}, {"17.0", "24.1", "38.5"}}},
};

static double of_table(size_t table, tl_target_bytes targets)
{
    tl_bandwidth_variables variables = tl_bandwidth_variables_default();
    if (tables[table].depth_bytes <= 0.0)
        return tl_bandwidth_rounded(targets.written);
    variables.depth_bytes = tables[table].depth_bytes;
    return tl_bandwidth(&variables, targets);
}

static void tables_are_those_of_the_article(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT_OF(tables); t++)
        for (int row = 0; row < ROWS; row++)
            for (int column = 0; column < COLUMNS; column++) {
                char text[32];
                snprintf(text, sizeof text, "%.*f", tables[t].digits,
                         1e-9 * of_table(t, tl_targets_alike(row + 2, bits[column])));
                if (strcmp(text, tables[t].printed[row][column]) != 0)
                    fail_msg("%s: %d targets of %g bits give %s, not %s", tables[t].name,
                             row + 2, bits[column], text, tables[t].printed[row][column]);
            }
}

/* Each term alone: all else is 0 or 1, so that what is left is the term. */
static const struct {
    const char *term;
    tl_bandwidth_variables of;
    tl_target_bytes targets;
    double building, shading;
} terms[] = {
    {"depth is tested for every fragment and written where it passes",
     {.depth_bytes = 4, .overdraw = 3, .sorting = 2},
     {0, 0},
     20,
     0},
    {"textures of the building pass are read where the fragment passes",
     {.texture_bytes = 3, .building_lookups = 5, .sorting = 2},
     {0, 0},
     30,
     0},
    {"targets are written where the fragment passes", {.sorting = 2}, {7, 0}, 14, 0},
    {"targets are read once a pass", {.shading_passes = 8}, {0, 7}, 0, 56},
    {"the back buffer is read and written once a pass",
     {.back_buffer_bytes = 4, .shading_passes = 8},
     {0, 0},
     0,
     64},
    {"textures of a shading pass are read once a pass",
     {.texture_bytes = 3, .shading_lookups = 4, .shading_passes = 8},
     {0, 0},
     0,
     96},
    {"geometry is read once a frame", {.geometry_bytes = 11}, {0, 0}, 11, 0},
};

static void every_term_stands_in_its_pass(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(terms); i++) {
        tl_bandwidth_variables of = terms[i].of;
        of.width = of.height = 1.0;
        of.frames_per_second = 60.0;
        const double building = tl_bandwidth_building(&of, terms[i].targets);
        const double shading = tl_bandwidth_shading(&of, terms[i].targets);
        const double both = tl_bandwidth(&of, terms[i].targets);
        if (building != terms[i].building || shading != terms[i].shading ||
            both != 60.0 * (building + shading))
            fail_msg("%s: %g and %g bytes, %g a second", terms[i].term, building, shading,
                     both);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_those_of_the_article),
        cmocka_unit_test(every_term_stands_in_its_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
