/* Are a mesh's tangents those that normal maps are baked for? Against Mikkelsen's own program
 * (tests/tools/make_tangent_cases.cjs). */
#include "tangent_cases.h"
#include "tangent_space.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

/* Sums of a few products and an arc cosine in float, at corners where nothing cancels. */
static const double tolerance = 2e-5;

static void tangents_are_mikkelsens(void **state)
{
    (void)state;
    for (size_t m = 0; m < sizeof tangent_cases / sizeof *tangent_cases; m++) {
        const size_t count = tangent_cases[m].count;
        float(*positions)[3] = malloc(count * sizeof *positions);
        float(*normals)[3] = malloc(count * sizeof *normals);
        float(*uvs)[2] = malloc(count * sizeof *uvs);
        float(*tangents)[4] = malloc(count * sizeof *tangents);
        double worst = 0.0;
        size_t wrong = 0;
        for (size_t i = 0; i < count; i++) {
            memcpy(positions[i], tangent_cases[m].corners[i].position, sizeof *positions);
            memcpy(normals[i], tangent_cases[m].corners[i].normal, sizeof *normals);
            memcpy(uvs[i], tangent_cases[m].corners[i].uv, sizeof *uvs);
        }
        const tl_corners corners = {count / 3, (const float(*)[3])positions,
                                    (const float(*)[3])normals, (const float(*)[2])uvs};
        tl_error err;
        assert_int_equal(tl_tangent_space(&corners, tangents, &err), TL_OK);
        for (size_t i = 0; i < count; i++) {
            double off = 0.0;
            for (int c = 0; c < 4; c++)
                off = fmax(off, fabs((double)tangents[i][c] -
                                     (double)tangent_cases[m].corners[i].tangent[c]));
            worst = fmax(worst, off);
            wrong += !(off <= tolerance);
        }
        if (wrong > 0)
            fail_msg("%s: %zu of %zu corners are off, the worst by %g", tangent_cases[m].name,
                     wrong, count, worst);
        free(positions);
        free(normals);
        free(uvs);
        free(tangents);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tangents_are_mikkelsens)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
