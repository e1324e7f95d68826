/* Profiles of lights where their angles begin and end: cases 39 and 40.
 *
 * What a profile gives is worked out in double from the angles of the direction as it is. */
#include "hard_case.h"
#include "hard_frames.h"

#include "profile.h"

/* A profile of its own in a buffer of its own, its shares at row 1. */
typedef struct own_profile {
    tl_view_profile view;
    float numbers[4 + 16 * 1801];
} own_profile;

static void random_frame(uint32_t *seed, tl_view_profile *view)
{
    double nadir[3], c0[3], along = 0.0, length = 0.0;
    do {
        length = 0.0;
        for (int i = 0; i < 3; i++)
            nadir[i] = (double)uniform(seed, -1.0f, 1.0f);
        for (int i = 0; i < 3; i++)
            length += nadir[i] * nadir[i];
    } while (length < 0.01 || length > 1.0);
    for (int i = 0; i < 3; i++)
        nadir[i] /= sqrt(length);
    for (int i = 0; i < 3; i++)
        c0[i] = (double)uniform(seed, -1.0f, 1.0f);
    for (int i = 0; i < 3; i++)
        along += c0[i] * nadir[i];
    length = 0.0;
    for (int i = 0; i < 3; i++) {
        c0[i] -= along * nadir[i];
        length += c0[i] * c0[i];
    }
    for (int i = 0; i < 3; i++)
        c0[i] /= sqrt(length);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        view->nadir[i] = (float)nadir[i];
        view->c0[i] = (float)c0[i];
        view->c90[i] = (float)(c0[j] * nadir[k] - c0[k] * nadir[j]);
    }
}

static double along(vec3 d, const float v[3])
{
    return (double)d.x * (double)v[0] + (double)d.y * (double)v[1] + (double)d.z * (double)v[2];
}

/* Towards an angle around and one from the nadir, rad, of any length. */
static vec3 direction_at(const tl_view_profile *view, double around, double down, double length)
{
    double d[3];
    for (int i = 0; i < 3; i++)
        d[i] = length * (cos(down) * (double)view->nadir[i] +
                         sin(down) * (cos(around) * (double)view->c0[i] +
                                      sin(around) * (double)view->c90[i]));
    return (vec3){(float)d[0], (float)d[1], (float)d[2]};
}

static double share_of(const own_profile *of, long column, long row)
{
    return (double)
        of->numbers[4 + row * (long)of->view.columns + column % (long)of->view.columns];
}

/* The share in that direction, in double; 0 <= x <= columns. */
static double expected_share(const own_profile *of, double x, double y)
{
    const long i = (long)fmin(floor(x), of->view.columns - 1.0),
               j = (long)fmin(floor(y), of->view.rows - 2.0);
    const double fx = x - (double)i, fy = y - (double)j;
    return (1 - fy) * ((1 - fx) * share_of(of, i, j) + fx * share_of(of, i + 1, j)) +
           fy * ((1 - fx) * share_of(of, i, j + 1) + fx * share_of(of, i + 1, j + 1));
}

/* A texture that ends at its edges: the last column goes on up to the seam. */
static double clamped_share(const own_profile *of, double x, double y)
{
    return expected_share(of, fmin(x, of->view.columns - 1.0), y);
}

/* A picture of a luminaire whose seam and whose edge run over surfaces. */
static void light_surfaces(hard_bench *bench, const own_profile *of, const float direction[3])
{
    const tl_camera camera = camera_of(40, 24, TL_PERSPECTIVE);
    tl_gbuffer *g = surfaces_between(&camera, 4.0f, 4.5f);
    tl_light_set lights = {0};
    tl_light light = tl_light_default();
    tl_light_profile profile = {.columns = of->view.columns,
                                .rows = of->view.rows,
                                .first_row = of->view.first_row,
                                .rows_of_half_turn = of->view.rows_of_half_turn,
                                .peak = 10.0};
    const size_t size = (size_t)profile.columns * profile.rows * sizeof(float);
    uint32_t seed = 1;
    tl_error err;
    profile.shares = malloc(size);
    assert_non_null(profile.shares);
    memcpy(profile.shares, of->numbers + 4, size);
    ASSERT_OK(tl_light_set_add_profile(&lights, "own", &profile, &light.profile, &err), err);
    memcpy(light.direction, direction, sizeof light.direction);
    light.range = 8.0f;
    for (uint32_t i = 0; i < 9; i++) {
        add_light_around(&lights, g, random_rim(g, &seed, i), &seed, 0.8f);
        memcpy(light.position, lights.lights[i].position, sizeof light.position);
        lights.lights[i] = light;
    }
    hard_light(bench, g, &lights);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

/* Directions on C0, to both sides of it, and by a rounding to either. */
void hard_profile_seam(hard_bench *bench)
{
    static const double off[] = {0.0, 1e-7, -1e-7, -1e-9, 1e-3, -1e-3, 0.1, -0.1, -0.3};
    static own_profile of;
    const double pi = acos(-1.0);
    uint32_t seed = 39;
    for (uint32_t trial = 0; trial < 300; trial++) {
        of.view = (tl_view_profile){
            .shares_at = 1, .columns = 1 + trial % 16, .rows = 19, .rows_of_half_turn = 18};
        for (uint32_t i = 0; i < of.view.columns * of.view.rows; i++)
            of.numbers[4 + i] = uniform(&seed, 0.0f, 1.0f);
        random_frame(&seed, &of.view);
        for (size_t i = 0; i < COUNT_OF(off); i++) {
            const vec3 d = direction_at(&of.view, off[i], (double)uniform(&seed, 0.3f, 2.8f),
                                        (double)uniform(&seed, 0.1f, 50.0f));
            const double right = along(d, of.view.c90), ahead = along(d, of.view.c0);
            const double turn = atan2(right, ahead) / (2.0 * pi);
            const double x = (turn < 0.0 ? turn + 1.0 : turn) * of.view.columns;
            const double y = atan2(hypot(right, ahead), along(d, of.view.nadir)) / pi * 18.0;
            const double want = expected_share(&of, x, y);
            const double got = (double)profile_share(of.numbers, of.view, d);
            hard_count(bench, fabs(got - want) < 2e-5,
                       fabs(clamped_share(&of, x, y) - want) < 2e-5);
        }
    }
    light_surfaces(bench, &of, (const float[]){0.0f, -1.0f, 0.0f});
}

/* Narrow beams: shares that fall from 1 to 0 within a degree of the axis, in rows of a tenth. Directions
 * exactly along the axis, against it, and around both. */
void hard_profile_axis(hard_bench *bench)
{
    static const double off[] = {0.0, 1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 2e-3};
    static own_profile of;
    const double pi = acos(-1.0);
    uint32_t seed = 40;
    of.view = (tl_view_profile){
        .shares_at = 1, .columns = 1, .rows = 1801, .rows_of_half_turn = 1800};
    for (uint32_t row = 0; row < of.view.rows; row++) {
        const uint32_t from_axis = row < 900 ? row : 1800 - row;
        of.numbers[4 + row] = from_axis < 10 ? 1.0f - 0.1f * (float)from_axis : 0.0f;
    }
    for (uint32_t trial = 0; trial < 300; trial++) {
        random_frame(&seed, &of.view);
        for (size_t i = 0; i < COUNT_OF(off); i++)
            for (int side = 0; side < 2; side++) {
                const vec3 d = direction_at(&of.view, (double)uniform(&seed, 0.0f, 6.0f),
                                            side ? pi - off[i] : off[i],
                                            (double)uniform(&seed, 0.1f, 50.0f));
                const double down = along(d, of.view.nadir);
                const double level = hypot(along(d, of.view.c0), along(d, of.view.c90));
                const double want = expected_share(&of, 0.0, atan2(level, down) / pi * 1800.0);
                const double got = (double)profile_share(of.numbers, of.view, d);
                const vec3 nadir = lanes_of(of.view.nadir);
                const float angle = acosf(dot3(d, nadir) / sqrtf(dot3(d, d)));
                const double usual =
                    isnan(angle) ? -1.0 : expected_share(&of, 0.0, (double)angle / pi * 1800.0);
                hard_count(bench, fabs(got - want) < 2e-4, fabs(usual - want) < 2e-4);
            }
    }
    /* As steep everywhere, for a picture. */
    for (uint32_t row = 0; row < of.view.rows; row++)
        of.numbers[4 + row] = uniform(&seed, 0.0f, 1.0f);
    light_surfaces(bench, &of, (const float[]){0.0f, 0.0f, -1.0f});
}
