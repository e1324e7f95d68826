/* Does the rectangle of a light hold the tile of every pixel whose position may be within its range,
 * however far positions may lie off their rays?
 *
 * Backwards: a pixel, a position as far off its ray as the slack allows, a light that reaches it. */
#include "frames.h"

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
            if (tile_x < rect.x0 || tile_x >= rect.x1 || tile_y < rect.y0 || tile_y >= rect.y1)
                fail_msg("%s: tile (%d, %d) is not in [%d, %d) x [%d, %d)", cases[i].name,
                         tile_x, tile_y, rect.x0, rect.x1, rect.y0, rect.y1);
            assert_true(rect.x0 >= 0 && rect.y0 >= 0 && rect.x1 <= TILES_X &&
                        rect.y1 <= TILES_Y);
        }
        assert_in_range(reached, POINT_COUNT / 4, POINT_COUNT);
    }
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rectangles_hold_every_pixel),
        cmocka_unit_test(rectangles_without_slack_are_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
