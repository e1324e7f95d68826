/* Do files of LM-63 say what photometry has of them, in every edition and symmetry, do our own luminaires
 * give the lumens that they claim, and is what is wrong with a file said by line and by what was expected? */
#include "file_cases.h"

#include "tilelight/photometry.h"

#include <math.h>

/* The numbers of a file behind TILT=: counts, type, units, three sizes, factors, watts. */
#define HEAD(counts, type) "1 1000 2 " counts " " type " 2 0 0 0\n1 1 30\n"
#define BEFORE "IESNA:LM-63-2002\n[TEST] 1\nTILT=NONE\n"

static tl_status parse(const char *text, size_t size, tl_photometry *out, tl_error *err)
{
    return tl_photometry_parse(text, size, "lamp.ies", out, err);
}

static void editions_differ_by_their_first_line(void **state)
{
    static const struct {
        const char *text;
        tl_ies_edition edition;
        double candela; /* at the nadir */
    } files[] = {
        {"any label\nTILT=NONE\n1 1000 2 2 1 1 2 0 0 0\n0.5 0.5 30\n0 90\n0\n8 4\n",
         TL_IES_1986, 4.0},
        {"TILT=NONE\n1 1000 2 2 1 1 1 0 0 0\n0.5 0.5 30\n0 90\n0\n8 4", TL_IES_1986, 4.0},
        {"IESNA91\r\nTILT=NONE\r\n1,1000,2,2,1,1,2,0,0,0\r\n0.5,0.5,30\r\n0,90\r\n0\r\n8,"
         "4\r\n\x1a",
         TL_IES_1991, 4.0},
        {"IESNA:LM-63-1995\r[TEST] x\rTILT=NONE\r1 -1 2 2 1 1 2 0 0 0\r0.5 0.5 30\r0 90\r0\r8 "
         "4\r",
         TL_IES_1995, 8.0},
        {BEFORE HEAD("2 1", "1") "0 90\n0\n8 4\n", TL_IES_2002, 16.0},
        {"IES:LM-63-2019\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 1000 1e0 2 1 1 2 0 0 0\n"
         "0.5 1.00001 30\n0\n90\n0\n8\n4\n",
         TL_IES_2019, 4.0},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        tl_photometry p = {0};
        tl_error err;
        ASSERT_OK(parse(files[i].text, strlen(files[i].text), &p, &err), err);
        assert_int_equal(p.edition, files[i].edition);
        if (fabs(tl_photometry_at(&p, 0.0, 0.0) - files[i].candela) > 1e-12 ||
            fabs(tl_photometry_at(&p, 123.0, 45.0) - 0.75 * files[i].candela) > 1e-12)
            fail_msg("file %zu has %g cd", i, tl_photometry_at(&p, 0.0, 0.0));
        assert_true(i == 3 ? p.lamp_lumens < 0.0 : fabs(p.lamp_lumens - 1000.0) < 1e-9);
        tl_photometry_clear(&p);
    }
}

/* Which plane of the file stands for each quarter turn and what is between; candela are the planes'
 * angles. */
static void planes_stand_for_the_whole_circle(void **state)
{
    static const struct {
        const char *counts, *planes;
        tl_photometry_symmetry symmetry;
        double at[8]; /* at 0, 45, 90 ... 315 degrees */
    } files[] = {
        {"2 1", "0\n7 7\n", TL_SYMMETRY_AXIAL, {7, 7, 7, 7, 7, 7, 7, 7}},
        {"2 2", "0 90\n0 0\n90 90\n", TL_SYMMETRY_QUADRANT, {0, 45, 90, 45, 0, 45, 90, 45}},
        {"2 3",
         "0 60 180\n0 0\n60 60\n180 180\n",
         TL_SYMMETRY_ALONG,
         {0, 45, 90, 135, 180, 135, 90, 45}},
        {"2 2",
         "90 270\n90 90\n270 270\n",
         TL_SYMMETRY_ACROSS,
         {180, 135, 90, 135, 180, 225, 270, 225}},
        {"2 4",
         "0 180 300 360\n0 0\n180 180\n300 300\n0 0\n",
         TL_SYMMETRY_NONE,
         {0, 45, 90, 135, 180, 225, 270, 225}},
        {"2 3",
         "0 180 300\n0 0\n180 180\n300 300\n",
         TL_SYMMETRY_NONE,
         {0, 45, 90, 135, 180, 225, 270, 225}},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        char text[512];
        tl_photometry p = {0};
        tl_light_profile grid;
        tl_error err;
        snprintf(text, sizeof text, BEFORE "1 -1 1 %s 1 2 0 0 0\n1 1 30\n0 180\n%s",
                 files[i].counts, files[i].planes);
        ASSERT_OK(parse(text, strlen(text), &p, &err), err);
        assert_int_equal(p.symmetry, files[i].symmetry);
        ASSERT_OK(tl_photometry_resample(&p, &grid, &err), err);
        for (int k = 0; k < 8; k++)
            if (fabs(tl_photometry_at(&p, 45.0 * k, 77.0) - files[i].at[k]) > 1e-9)
                fail_msg("file %zu has %g at %d degrees, not %g", i,
                         tl_photometry_at(&p, 45.0 * k, 77.0), 45 * k, files[i].at[k]);
        assert_true(fabs(tl_photometry_at(&p, 360.0, 77.0) - files[i].at[0]) < 1e-9);
        assert_true(grid.off <= 0.0);
        free(grid.shares);
        tl_photometry_clear(&p);
    }
}

static void it_is_dark_beyond_the_file(void **state)
{
    static const struct {
        const char *angles;
        double up, level, down;
    } files[] = {{"0 90", 0.0, 6.0, 4.0}, {"90 180", 6.0, 4.0, 0.0}, {"0 180", 6.0, 5.0, 4.0}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        char text[256];
        tl_photometry p = {0};
        tl_error err;
        snprintf(text, sizeof text, BEFORE "1 -1 1 2 1 1 2 0 0 0\n1 1 30\n%s\n0\n4 6\n",
                 files[i].angles);
        ASSERT_OK(parse(text, strlen(text), &p, &err), err);
        assert_true(fabs(tl_photometry_at(&p, 10.0, 180.0) - files[i].up) < 1e-12);
        assert_true(fabs(tl_photometry_at(&p, 10.0, 90.0) - files[i].level) < 1e-12);
        assert_true(fabs(tl_photometry_at(&p, 10.0, 0.0) - files[i].down) < 1e-12);
        tl_photometry_clear(&p);
    }
}

static const char *const ours[] = {"downlight.ies", "washer.ies",  "linear.ies",
                                   "street.ies",    "uplight.ies", "star.ies"};

static char *load_ours(const char *name, size_t *size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/data/%s", getenv("TILELIGHT_SOURCE"), name);
    return (char *)load_bytes(path, size);
}

/* What the grid gives by a plain sum over the sphere, in steps of a quarter of a degree: midpoints are off by
 * h^2/24 of the second derivative. What is linear by pieces has kinks of 1500 cd in 10 degrees at most, and
 * columns in between are linear, of which every one is summed: 1e-3 of the whole is ample. */
static double summed(const tl_light_profile *grid)
{
    const double pi = acos(-1.0), step = pi / 720.0;
    double sum = 0.0;
    for (uint32_t c = 0; c < grid->columns; c++)
        for (uint32_t k = 0; k < 720; k++) {
            const double angle = (k + 0.5) * step;
            const double row = angle / pi * grid->rows_of_half_turn - grid->first_row;
            const long below = (long)floor(row);
            if (row < 0.0 || row > grid->rows - 1.0)
                continue;
            const double a = (double)grid->shares[(size_t)below * grid->columns + c],
                         b = (double)grid->shares[(size_t)(below + 1) * grid->columns + c];
            sum += (a + (row - (double)below) * (b - a)) * sin(angle) * step;
        }
    return sum * grid->peak * 2.0 * pi / grid->columns;
}

static void our_luminaires_give_what_they_claim(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(ours); i++) {
        tl_photometry p = {0};
        tl_light_profile grid;
        tl_error err;
        size_t size;
        char *const text = load_ours(ours[i], &size);
        ASSERT_OK(parse(text, size, &p, &err), err);
        ASSERT_OK(tl_photometry_resample(&p, &grid, &err), err);
        if (p.lamp_lumens >= 0.0 && fabs(grid.flux - p.lamp_lumens) > 1e-3 * grid.flux)
            fail_msg("%s: %g lm, but its lamps have %g", ours[i], grid.flux, p.lamp_lumens);
        if (fabs(summed(&grid) - grid.flux) > 1e-3 * grid.flux)
            fail_msg("%s: %g lm, but a sum over the sphere is %g", ours[i], grid.flux,
                     summed(&grid));
        assert_true(grid.off <= 0.0);
        free(grid.shares);
        tl_photometry_clear(&p);
        free(text);
    }
}

/* A source that is alike everywhere, one that is so below, and a cosine in fine steps: 4 pi, 2 pi and pi. */
static void known_sources_have_their_lumens(void **state)
{
    static const double pi = 3.14159265358979323846;
    char text[8192] = BEFORE "1 -1 1 91 1 1 2 0 0 0\n1 1 30\n";
    tl_photometry p = {0};
    tl_error err;
    size_t used = strlen(text);
    (void)state;
    ASSERT_OK(parse(BEFORE HEAD("2 1", "1") "0 180\n0\n5 5\n",
                    strlen(BEFORE HEAD("2 1", "1") "0 180\n0\n5 5\n"), &p, &err),
              err);
    assert_true(fabs(tl_photometry_flux(&p) - 40.0 * pi) < 1e-10);
    for (int i = 0; i <= 90; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%d ", i);
    used += (size_t)snprintf(text + used, sizeof text - used, "\n0\n");
    for (int i = 0; i <= 90; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%.9f ",
                                 100.0 * fabs(cos(pi * i / 180.0)));
    ASSERT_OK(parse(text, used, &p, &err), err);
    /* Chords of a cosine lie within h^2/8 of it. */
    assert_true(fabs(tl_photometry_flux(&p) - 100.0 * pi) < 100.0 * 2.0 * pi * 4e-5);
    tl_photometry_clear(&p);
}

/* Angles that no step has in common: how far off the grid is, is found where it is farthest. */
static void what_a_grid_cannot_have_is_said(void **state)
{
    static const char text[] =
        BEFORE "1 -1 1 5 3 1 2 0 0 0\n1 1 30\n0 33.33337 33.3334 61.8034 90\n0 77.7777 180\n"
               "1 900 2 700 5\n3 100 900 30 4\n8 1000 9 3 70\n";
    tl_photometry p = {0};
    tl_light_profile grid;
    tl_error err;
    double most = 0.0;
    (void)state;
    ASSERT_OK(parse(text, sizeof text - 1, &p, &err), err);
    ASSERT_OK(tl_photometry_resample(&p, &grid, &err), err);
    assert_true((size_t)grid.columns * grid.rows <= TL_MOST_PROFILE_SAMPLES);
    for (int i = 0; i < 3000; i++)
        for (int k = 0; k < 8; k++) {
            const double v = 33.0 + 0.0003 * i, c = 22.2222 + 55.5555 * k / 7.0;
            const double x = c / 360.0 * grid.columns, y = v / 180.0 * grid.rows_of_half_turn;
            const size_t j = (size_t)y * grid.columns + (size_t)x;
            const double fx = x - floor(x), fy = y - floor(y);
            const float *const s = grid.shares + j;
            const double a = (double)s[0] * (1 - fx) + (double)s[1] * fx,
                         b = (double)s[grid.columns] * (1 - fx) +
                             (double)s[grid.columns + 1] * fx;
            const double off =
                fabs((a * (1 - fy) + b * fy) * grid.peak - tl_photometry_at(&p, c, v));
            most = fmax(most, off);
        }
    if (!(most <= grid.off + 1e-3) || !(most > 0.5 * grid.off))
        fail_msg("off by %g cd, said to be %g", most, grid.off);
    free(grid.shares);
    tl_photometry_clear(&p);
}

/* One that is a digit more than steps are looked for in. */
static void what_is_almost_a_step_is_none(void **state)
{
    static const char text[] = BEFORE HEAD("3 1", "1") "0 45.00004 90\n0\n1 900 2\n";
    tl_photometry p = {0};
    tl_light_profile grid;
    tl_error err;
    (void)state;
    ASSERT_OK(parse(text, sizeof text - 1, &p, &err), err);
    ASSERT_OK(tl_photometry_resample(&p, &grid, &err), err);
    assert_true(grid.off > 1e-4 && grid.off < 2.0);
    free(grid.shares);
    tl_photometry_clear(&p);
}

static void what_is_wrong_is_said_by_line(void **state)
{
    static const struct {
        const char *text;
        const char *words[3];
    } cases[] = {
        {"", {"lamp.ies: line 1: the file is empty"}},
        {"IESNA:LM-63-2031\nTILT=NONE\n",
         {"line 1", "edition \"IESNA:LM-63-2031\"", "IES:LM-63-2019"}},
        {"IESNA91\n[X]\n", {"line 3", "without a line TILT="}},
        {"a\nb\nTILT=HID.TLT\n", {"line 3", "TILT=HID.TLT is another file"}},
        {"TILT=INCLUDE\n4\n", {"line 2", "lamp-to-luminaire geometry is 4", "from 1 to 3"}},
        {"TILT=NONE\n", {"line 2", "ends where the number of lamps is expected"}},
        {"TILT=NONE\n1 1000 one",
         {"line 2", "the candela multiplier is expected, a number", "\"one\""}},
        {"TILT=NONE\n1 nan", {"the lumens of a lamp is expected", "\"nan\""}},
        {"TILT=NONE\n1 1000 0x1p3", {"multiplier", "\"0x1p3\""}},
        {"TILT=NONE\n1 1000 1e999", {"multiplier is 1e999"}},
        {BEFORE "1 1000 1 1 1 1 2 0 0 0",
         {"line 4", "number of vertical angles is 1", "from 2 to 2048"}},
        {BEFORE "1 1000 1 2.5 1 1 2 0 0 0", {"vertical angles is 2.5", "whole number"}},
        {BEFORE "1 1000 1 2 99999999999 1", {"number of horizontal angles is 99999999999"}},
        {BEFORE "1 1000 1 2 1 2 2 0 0 0", {"line 4", "type 2, type B", "type C (1) alone"}},
        {BEFORE "1 1000 1 2 1 3 2 0 0 0", {"type 3, type A"}},
        {BEFORE HEAD("2 1", "1") "0 45\n", {"line 6", "from 0 to 45", "from 0 to 90"}},
        {BEFORE HEAD("3 1", "1") "0 90 60\n",
         {"vertical angle is 60 behind 90", "must ascend"}},
        {BEFORE HEAD("2 1", "1") "0 90\n45\n1 1\n",
         {"line 7", "horizontal angles are from 45 to 45"}},
        {BEFORE HEAD("2 2", "1") "0 90\n0 120\n", {"from 0 to 120"}},
        {BEFORE HEAD("2 1", "1") "0 90\n0\n1\n",
         {"line 9", "ends where a candela value is expected"}},
        {BEFORE HEAD("2 3", "1") "0 90\n0 90 180\n1 1\n",
         {"line 7", "6 candela values are expected, of 2 x 3 angles"}},
        {BEFORE HEAD("2 1", "1") "0 90\n0\n1 -1\n",
         {"line 8", "candela value is -1", "from 0 to"}},
        {BEFORE HEAD("2 1", "1") "0 90\n0\n1 1\n 7",
         {"line 9", "goes on behind the last candela value"}},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_photometry p = {0};
        tl_error err = {.message = ""};
        const tl_status status = parse(cases[i].text, strlen(cases[i].text), &p, &err);
        if (status != TL_ERR_FORMAT && status != TL_ERR_UNSUPPORTED)
            fail_msg("case %zu has status %d", i, (int)status);
        for (size_t w = 0; w < COUNT_OF(cases[i].words) && cases[i].words[w]; w++)
            if (!strstr(err.message, cases[i].words[w]))
                fail_msg("case %zu: \"%s\" should say \"%s\"", i, err.message,
                         cases[i].words[w]);
        tl_photometry_clear(&p);
    }
}

/* Every start of a good file is refused, but for those that end within the last number or behind it. */
static void every_truncation_is_refused(void **state)
{
    (void)state;
    size_t size;
    char *const text = load_ours("linear.ies", &size);
    for (size_t length = 0; length + 4 < size; length++) {
        tl_photometry p = {0};
        tl_error err;
        char *const cut = malloc(length + 1);
        assert_non_null(cut);
        memcpy(cut, text, length);
        if (parse(cut, length, &p, &err) == TL_OK)
            fail_msg("taken when cut to %zu of %zu bytes", length, size);
        free(cut);
    }
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(editions_differ_by_their_first_line),
        cmocka_unit_test(planes_stand_for_the_whole_circle),
        cmocka_unit_test(it_is_dark_beyond_the_file),
        cmocka_unit_test(our_luminaires_give_what_they_claim),
        cmocka_unit_test(known_sources_have_their_lumens),
        cmocka_unit_test(what_a_grid_cannot_have_is_said),
        cmocka_unit_test(what_is_almost_a_step_is_none),
        cmocka_unit_test(what_is_wrong_is_said_by_line),
        cmocka_unit_test(every_truncation_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
