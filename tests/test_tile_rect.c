/* Does the rectangle of a light hold the tile of every pixel whose position may be within its range,
 * however far positions may lie off their rays?
 *
 * Backwards: a pixel, a position as far off its ray as the slack allows, a light that reaches it. */
#include "frames.h"

#include "bounds/tile_families.h"

#include "spot_cone.h"
#include "tile_rect.h"

enum { TILE = 8, TILES_X = 13, TILES_Y = 7, POINT_COUNT = 20000 };

static const struct {
    const char *name;
    float slack;
    float step; /* from column to column, x/depth or m */
    tl_u32 first_row;
    int orthographic;
} cases[] = {
    {"positions on their rays", 0.0f, 0.01f, 0, 0},
    {"off by a pixel", 0.01f, 0.01f, 0, 0},
    {"off by a screen", 1.0f, 0.01f, 0, 0},
    {"off by a screen, in m", 1.0f, 0.01f, 0, 1},
    {"off by a pixel, in m", 0.01f, 0.01f, 0, 1},
    {"a band", 0.05f, 0.01f, 80, 0},
    {"a band, in m", 0.05f, 0.01f, 80, 1},
    {"more px than an int holds", 1e30f, 0.01f, 0, 0},
    {"the largest number", 0x1.fffffep127f, 0.01f, 80, 0},
    {"infinite", INFINITY, 0.01f, 80, 0},
    {"infinite, in m", INFINITY, 0.01f, 0, 1},
    {"a tiny field of view", 1e-3f, 1e-12f, 0, 0},
    {"steps that vanish", 1e-3f, 0x1p-149f, 0, 0},
    {"steps that have vanished", 1e-3f, 0.0f, 0, 0},
};

static tl_frame frame_of(size_t i)
{
    const float step = cases[i].step;
    return (tl_frame){
        .rays = {-0.5f * TILES_X * TILE * step, step, 0.5f * 200.0f * step, -step},
        .tile_size = TILE,
        .tiles_x = TILES_X,
        .tiles_y = TILES_Y,
        .first_row = cases[i].first_row,
        .slack_x = cases[i].slack,
        .slack_y = cases[i].slack};
}

/* A slack beyond it is as good as infinite, and leads to what floats cannot hold. */
static const float farthest = 1e6f;

/* The position of a pixel, in view space. Of positions of which nothing is known, some are behind the
 * eye. */
static void position_of(size_t i, uint32_t column, uint32_t row, uint32_t *seed, double out[3])
{
    const tl_frame frame = frame_of(i);
    const float slack = fminf(cases[i].slack, farthest);
    const double depth = (double)uniform(seed, isinf(cases[i].slack) ? -9.0f : 0.01f, 9.0f);
    const double unit = cases[i].orthographic ? 1.0 : depth;
    out[0] = unit * ((double)frame.rays.x0 + column * (double)frame.rays.dx +
                     (double)uniform(seed, -slack, slack));
    out[1] = unit * ((double)frame.rays.y0 + row * (double)frame.rays.dy +
                     (double)uniform(seed, -slack, slack));
    out[2] = -depth;
}

/* Around the position; whether it reaches it is left to chance. */
static int reaching_light(const double at[3], uint32_t *seed, tl_view_light *out)
{
    const float range = uniform(seed, 0.0f, 1.0f);
    double distance2 = 0.0;
    *out = (tl_view_light){.range2 = range * range};
    for (int axis = 0; axis < 3; axis++) {
        out->position[axis] = (float)(at[axis] + (double)uniform(seed, -range, range));
        const double away = (double)out->position[axis] - at[axis];
        distance2 += away * away;
    }
    return distance2 < (double)out->range2;
}

static void assert_in_rect(tl_tile_rect rect, size_t i, int tile_x, int tile_y)
{
    if (tile_x < rect.x0 || tile_x >= rect.x1 || tile_y < rect.y0 || tile_y >= rect.y1)
        fail_msg("%s: tile (%d, %d) is not in [%d, %d) x [%d, %d)", cases[i].name, tile_x,
                 tile_y, rect.x0, rect.x1, rect.y0, rect.y1);
    assert_true(rect.x0 >= 0 && rect.y0 >= 0 && rect.x1 <= TILES_X && rect.y1 <= TILES_Y);
}

/* A spot that lights the position, which is within its range and at the edge of its cone as a rule. */
static tl_view_spot lighting_spot(const double at[3],
                                  uint32_t *seed,
                                  float outer,
                                  tl_view_light *out)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 1, 1, 0.1, 10.0);
    const double angle = (double)outer * (uniform(seed, 0.0f, 1.0f) < 0.5f ? 0.999 : 0.5);
    const double range = (double)uniform(seed, 0.01f, 3.0f);
    const double away = range * (uniform(seed, 0.0f, 1.0f) < 0.5f ? 0.9999 : 0.7);
    tl_light light = tl_light_default();
    double way[3], other[3], along = 0.0, length2 = 0.0;
    random_direction(seed, way);
    random_direction(seed, other);
    for (int i = 0; i < 3; i++)
        along += other[i] * way[i];
    for (int i = 0; i < 3; i++) {
        other[i] -= along * way[i];
        length2 += other[i] * other[i];
    }
    light.type = TL_LIGHT_SPOT;
    light.outer_cone = outer;
    *out = (tl_view_light){.range2 = (float)(range * range)};
    for (int i = 0; i < 3; i++) {
        out->position[i] = (float)(at[i] - away * way[i]);
        light.direction[i] =
            (float)(cos(angle) * way[i] + sin(angle) * other[i] / sqrt(length2));
    }
    return tl_spot_cone(&camera, &light);
}

/* Every pixel that is lit, again backwards: at every half-angle. */
static void rectangles_of_cones_hold_every_pixel(void **state)
{
    static const float half_angles[] = {0.01f, 0.3f, 0.78f, 0.79f, 1.2f, 1.57f, 1.6f, 3.0f};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_frame frame = frame_of(i);
        const int parallel = cases[i].orthographic;
        const tl_view_window window =
            view_window(&frame, TL_LEAST_DEPTH(parallel), TL_GREATEST_DEPTH, parallel);
        uint32_t seed = 12;
        for (int k = 0; k < POINT_COUNT; k++) {
            const uint32_t x = (uint32_t)uniform(&seed, 0.0f, TILES_X * TILE);
            const uint32_t y = (uint32_t)uniform(&seed, 0.0f, TILES_Y * TILE);
            double at[3];
            tl_view_light light;
            position_of(i, x, frame.first_row + y, &seed, at);
            const tl_view_spot spot = lighting_spot(
                at, &seed, half_angles[(size_t)k % COUNT_OF(half_angles)], &light);
            assert_in_rect(tile_rect_of_spot(window, &frame, light, spot), i, (int)x / TILE,
                           (int)y / TILE);
        }
    }
}

/* A cone that looks away from the view, beside it, has none; its sphere has. */
static void rectangles_of_cones_are_smaller(void **state)
{
    static const double right[3] = {1.0, 0.0, 0.0};
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 1, 1, 0.1, 10.0);
    const tl_frame frame = frame_of(0);
    const tl_view_window window = view_window(&frame, TL_LEAST_DEPTH(0), TL_GREATEST_DEPTH, 0);
    const tl_view_light light = {.position = {2.8f, 2.8f, -4.0f}, .range2 = 4.0f};
    tl_light spot = tl_light_default();
    (void)state;
    spot.type = TL_LIGHT_SPOT;
    spot.outer_cone = 0.3f;
    for (int i = 0; i < 3; i++)
        spot.direction[i] = (float)right[i];
    const tl_tile_rect all = tile_rect_of(window, &frame, light);
    const tl_tile_rect cone =
        tile_rect_of_spot(window, &frame, light, tl_spot_cone(&camera, &spot));
    assert_true(all.x1 > all.x0 && all.y1 > all.y0);
    assert_true(cone.x0 == cone.x1 && cone.y0 == cone.y1);
}

static void rectangles_hold_every_pixel(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_frame frame = frame_of(i);
        const int parallel = cases[i].orthographic;
        const tl_view_window window =
            view_window(&frame, TL_LEAST_DEPTH(parallel), TL_GREATEST_DEPTH, parallel);
        uint32_t seed = 11, reached = 0;
        for (int k = 0; k < POINT_COUNT; k++) {
            const uint32_t x = (uint32_t)uniform(&seed, 0.0f, TILES_X * TILE);
            const uint32_t y = (uint32_t)uniform(&seed, 0.0f, TILES_Y * TILE);
            const int tile_x = (int)x / TILE, tile_y = (int)y / TILE;
            double at[3];
            tl_view_light light;
            position_of(i, x, frame.first_row + y, &seed, at);
            if (!reaching_light(at, &seed, &light))
                continue;
            const tl_tile_rect rect = tile_rect_of(window, &frame, light);
            reached++;
            assert_in_rect(rect, i, tile_x, tile_y);
        }
        assert_in_range(reached, POINT_COUNT / 4, POINT_COUNT);
    }
}

static float flushed(float value)
{
    return fabsf(value) < 0x1p-126f ? 0.0f : value;
}

/* d2 < range2 of a device that flushes denormals: squares of less than 1e-19 m are 0. */
static int reaches_by_flushing(const float l[3], float range2)
{
    float distance2 = 0.0f;
    for (int axis = 2; axis >= 0; axis--)
        distance2 = flushed(fmaf(l[axis], l[axis], distance2));
    return distance2 < flushed(range2);
}

/* Two axes meet in the disc that a perspective camera sees. */
static void rectangles_hold_where_squares_are_flushed(void **state)
{
    const tl_frame frame = frame_of(0);
    const tl_view_window window = view_window(&frame, TL_LEAST_DEPTH(0), TL_GREATEST_DEPTH, 0);
    uint32_t seed = 13, reached = 0;
    (void)state;
    for (int k = 0; k < POINT_COUNT; k++) {
        const uint32_t x = (uint32_t)uniform(&seed, 0.0f, TILES_X * TILE);
        const uint32_t y = (uint32_t)uniform(&seed, 0.0f, TILES_Y * TILE);
        const float range = uniform(&seed, 1.1e-19f, 1.2e-19f);
        const float depth = uniform(&seed, 5e-19f, 1e-18f);
        const float at[3] = {(frame.rays.x0 + (float)x * frame.rays.dx) * depth,
                             (frame.rays.y0 + (float)y * frame.rays.dy) * depth, -depth};
        tl_view_light light = {.range2 = range * range};
        float l[3];
        for (int axis = 0; axis < 3; axis++) {
            light.position[axis] = at[axis] + uniform(&seed, -1.2e-19f, 1.2e-19f);
            l[axis] = flushed(light.position[axis] - at[axis]);
        }
        if (!reaches_by_flushing(l, light.range2))
            continue;
        reached++;
        assert_in_rect(tile_rect_of(window, &frame, light), 0, (int)x / TILE, (int)y / TILE);
    }
    assert_in_range(reached, POINT_COUNT / 10, POINT_COUNT);
}

/* Margins are no excuse for rectangles of everything. */
static void rectangles_without_slack_are_small(void **state)
{
    const tl_frame frame = frame_of(0);
    const tl_view_window window = view_window(&frame, TL_LEAST_DEPTH(0), TL_GREATEST_DEPTH, 0);
    const tl_view_light light = {.position = {0.0f, 2.8f, -4.0f}, .range2 = 0.01f};
    const tl_tile_rect rect = tile_rect_of(window, &frame, light);
    (void)state;
    assert_in_range((rect.x1 - rect.x0) * (rect.y1 - rect.y0), 1, 4);
}

/* Lights that reach a pixel by one ulp, of every camera that is hard: scripts/prove-bounds tries more. */
static void rectangles_hold_what_is_reached_by_an_ulp(void **state)
{
    enum { CASES = 150000 };
    (void)state;
    for (int f = 0; f < TL_TILE_FAMILIES; f++) {
        tl_tally tally = {.cases = 0};
        for (uint64_t i = 0; i < CASES; i++) {
            tl_draws draws = draws_of(1995, (uint64_t)f, i);
            tl_tile_families[f].attempt(&draws, &tally);
        }
        if (tally.lost > 0)
            fail_msg("%s: %d of %d pixels lost", tl_tile_families[f].name, (int)tally.lost,
                     (int)tally.hits);
        assert_in_range(tally.hits, CASES / 4, CASES);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rectangles_hold_every_pixel),
        cmocka_unit_test(rectangles_hold_where_squares_are_flushed),
        cmocka_unit_test(rectangles_without_slack_are_small),
        cmocka_unit_test(rectangles_of_cones_hold_every_pixel),
        cmocka_unit_test(rectangles_of_cones_are_smaller),
        cmocka_unit_test(rectangles_hold_what_is_reached_by_an_ulp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
