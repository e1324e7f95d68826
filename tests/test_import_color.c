/* Are colours of other primaries, and of other whites, what published conversions make of them? */
#include "testing.h"

#include "foreign_exr.h"
#include "foreign_frame.h"
#include "meaning.h"

/* Rec. 2020: ITU-R BT.2407-0, section 2.2 (inverse of BT.2087-0, M2), four digits. AP1 and AP0 with the
 * white of ACES (0.32168, 0.33767), adapted by Bradford: Academy S-2014-004 and the matrices that ACES' own
 * CTL makes, as the OpenColorIO configuration for ACES 1.2 lists them, to five digits. */
static const struct {
    const char *name;
    double chromaticities[8];
    double matrix[9];
    double tolerance; /* half a step of the last digit published */
} spaces[] = {
    {"Rec. 709",
     {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290},
     {1, 0, 0, 0, 1, 0, 0, 0, 1},
     1e-12},
    {"Rec. 2020",
     {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290},
     {1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187},
     5e-5},
    {"ACEScg",
     {0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767},
     {1.70505, -0.62179, -0.08326, -0.13026, 1.14080, -0.01055, -0.02400, -0.12897, 1.15297},
     5e-6},
    {"ACES 2065-1",
     {0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.0770, 0.32168, 0.33767},
     {2.52169, -1.13413, -0.38756, -0.27648, 1.37272, -0.09624, -0.01538, -0.15298, 1.16835},
     5e-6},
};

static void matrices_are_those_published(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(spaces); i++) {
        double got[9];
        assert_true(tl_color_matrix(spaces[i].chromaticities, got));
        for (int k = 0; k < 9; k++)
            if (fabs(got[k] - spaces[i].matrix[k]) > spaces[i].tolerance)
                fail_msg("%s: entry %d is %.7f, not %.7f", spaces[i].name, k, got[k],
                         spaces[i].matrix[k]);
    }
}

/* Whatever the primaries and the white, 1 1 1 is white. */
static void white_stays_white(void **state)
{
    static const double odd[][8] = {
        {0.7, 0.3, 0.2, 0.7, 0.15, 0.05, 1.0 / 3.0, 1.0 / 3.0},
        {0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.314, 0.351},
        {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3457, 0.3585},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(odd); i++) {
        double m[9];
        assert_true(tl_color_matrix(odd[i], m));
        for (int r = 0; r < 3; r++)
            assert_true(fabs(m[3 * r] + m[3 * r + 1] + m[3 * r + 2] - 1.0) < 1e-12);
    }
}

static void no_colors_are_refused(void **state)
{
    static const double flat[][8] = {
        {0, 0, 0, 0, 0, 0, 0, 0},
        {0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3127, 0.3290},
        {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.0},
        {NAN, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(flat); i++) {
        double m[9];
        assert_false(tl_color_matrix(flat[i], m));
    }
}

static void set_chromaticities(exr_context_t file, void *context)
{
    const double *c = context;
    exr_attr_chromaticities_t a;
    a.red_x = (float)c[0];
    a.red_y = (float)c[1];
    a.green_x = (float)c[2];
    a.green_y = (float)c[3];
    a.blue_x = (float)c[4];
    a.blue_y = (float)c[5];
    a.white_x = (float)c[6];
    a.white_y = (float)c[7];
    foreign_must(exr_attr_set_chromaticities(file, 0, "chromaticities", &a), "chromaticities");
}

/* Of a file: colours are converted, and it is said; Rec. 709 is taken bit for bit, and nothing is said. */
static void files_are_converted(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "chromaticities.exr");
    foreign_fill(&frame);
    for (size_t i = 0; i < COUNT_OF(spaces); i++) {
        double in[8], m[9];
        tl_error err;
        tl_gbuffer *g = NULL;
        foreign_notices said = {""};
        const tl_notices notices = {foreign_say, &said};
        const tl_import_options options = foreign_options();
        memcpy(in, spaces[i].chromaticities, sizeof in);
        foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
        file.attributes = set_chromaticities;
        file.context = in;
        foreign_write(&file, path);
        ASSERT_OK(tl_import_read(path, &options, &notices, &g, NULL, &err), err);
        memcpy(m, spaces[i].matrix, sizeof m);
        for (int at = 0; at < FRAME_WIDTH; at++)
            for (unsigned c = 0; c < 3; c++) {
                double wanted = 0.0;
                for (int k = 0; k < 3; k++)
                    wanted += m[3 * c + (unsigned)k] * (double)frame.albedo[k][at];
                const double got =
                    (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_ALBEDO_R + c))[at];
                const double allowed = i == 0 ? 0.0 : 3.0 * spaces[i].tolerance + 1e-6;
                if (fabs(got - (i == 0 ? (double)frame.albedo[c][at] : wanted)) > allowed)
                    fail_msg("%s: pixel %d is %g, not %g", spaces[i].name, at, got, wanted);
            }
        assert_true((strstr(said.text, "converted to Rec. 709") != NULL) == (i > 0));
        /* Depth and normals are no colours. */
        assert_true(same_bits(tl_gbuffer_plane(g, TL_DEPTH)[3], frame.depth[3]));
        assert_true(same_bits(tl_gbuffer_plane(g, TL_NORMAL_Z)[3], 1.0f));
        tl_gbuffer_destroy(g);
    }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrices_are_those_published),
        cmocka_unit_test(white_stays_white),
        cmocka_unit_test(no_colors_are_refused),
        cmocka_unit_test(files_are_converted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
