/* Sizes of images and tiles, and what is in a tile: cases 4, 16, 17, 18 and 19. */
#include "hard_case.h"
#include "hard_frames.h"

#include "tile_rect.h"

/* At the last column of a tile, and that of the image, with lights to the right of it. */
static tl_light_set lights_right_of_tiles(const tl_gbuffer *g)
{
    tl_light_set lights = {0};
    uint32_t seed = 4;
    tl_error err;
    for (uint32_t i = 0; i < 60; i++) {
        static const uint32_t columns[] = {0, 7, 15, 31, 39};
        rim at = random_rim(g, &seed, i);
        const float offset[3] = {uniform(&seed, 0.05f, 3.0f), 0.0f, 0.0f};
        at.x = columns[i % COUNT_OF(columns)];
        if (isinf(depth_at(g, at.x, at.y)))
            continue;
        const tl_light light = rim_light(g, at, offset);
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    }
    return lights;
}

/* Tiles of 8 px that hold a pixel in reach against the rectangle; and against one whose first column is that
 * of the sphere's left end, rounded. */
static void count_tiles(hard_bench *bench, const tl_gbuffer *g, const tl_light_set *lights)
{
    const int orthographic = g->camera.projection == TL_ORTHOGRAPHIC;
    tl_prepared prepared = prepared_of(g, lights);
    const tl_view_window window = view_window(&prepared.frame, TL_LEAST_DEPTH(orthographic),
                                              TL_GREATEST_DEPTH, orthographic);
    for (uint32_t i = 0; i < prepared.frame.light_count; i++) {
        const tl_view_light *light = &prepared.lights[i];
        const tl_tile_rect rect = tile_rect_of(window, &prepared.frame, *light);
        const tl_interval seen =
            sphere_interval((double)light->position[0], -(double)light->position[2],
                            sqrt((double)light->range2), window.near, window.far, orthographic);
        const int rounded = (int)round((seen.low - window.left) / window.width / 8.0);
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++) {
                const vec3 l = vector_to_light(seen_position(&prepared, g, x, y), *light);
                const int tile_x = (int)x / 8, tile_y = (int)y / 8;
                if (reaches(*light, dot3(l, l)))
                    hard_count(bench,
                               tile_x >= rect.x0 && tile_x < rect.x1 && tile_y >= rect.y0 &&
                                   tile_y < rect.y1,
                               tile_x >= rounded);
            }
    }
    tl_prepared_clear(&prepared);
}

void hard_left_tile(hard_bench *bench)
{
    for (int projection = 0; projection < 2; projection++) {
        const tl_camera camera =
            camera_of(FRAME_WIDTH, FRAME_HEIGHT, (tl_projection)projection);
        tl_gbuffer *g = surfaces_between(&camera, 4.0f, 4.5f);
        tl_light_set lights = lights_right_of_tiles(g);
        count_tiles(bench, g, &lights);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

static tl_light_set some_lights(const tl_gbuffer *g, uint32_t count, float farthest)
{
    tl_light_set lights = {0};
    uint32_t seed = 17;
    for (uint32_t i = 0; i < count; i++)
        add_light_around(&lights, g, random_rim(g, &seed, i), &seed,
                         uniform(&seed, 0.05f, farthest));
    return lights;
}

/* Large after small and small after large, many lights after none and none after many. */
void hard_resize(hard_bench *bench)
{
    static const struct {
        uint32_t width, height, light_count;
    } frames[] = {{64, 64, 200}, {17, 9, 3}, {130, 1, 90}, {1, 67, 0},
                  {1, 1, 40},    {9, 9, 0},  {64, 64, 5},  {33, 20, 300}};
    tl_gbuffer *g[COUNT_OF(frames)];
    tl_light_set lights[COUNT_OF(frames)];
    tl_image *want[COUNT_OF(frames)];
    hard_scene scenes[COUNT_OF(frames)];
    for (size_t i = 0; i < COUNT_OF(frames); i++) {
        const tl_camera camera = camera_of(frames[i].width, frames[i].height, TL_PERSPECTIVE);
        g[i] = surfaces_between(&camera, 3.0f, 6.0f);
        lights[i] = some_lights(g[i], frames[i].light_count, 2.0f);
        want[i] = hard_picture(g[i], &lights[i]);
        scenes[i] = (hard_scene){g[i], &lights[i], want[i]};
    }
    hard_light_in_turn(bench, scenes, COUNT_OF(frames));
    for (size_t i = 0; i < COUNT_OF(frames); i++) {
        tl_light_set_clear(&lights[i]);
        tl_image_destroy(want[i]);
        tl_gbuffer_destroy(g[i]);
    }
}

/* Every size up to a tile and one more, both ways; one pixel wide, one pixel tall. */
void hard_odd_sizes(hard_bench *bench)
{
    for (uint32_t i = 0; i < 17 + 17 + 4; i++) {
        static const uint32_t sizes[][2] = {{1, 300}, {300, 1}, {63, 65}, {129, 3}};
        const uint32_t width = i < 17 ? i + 1 : i < 34 ? 34 - i : sizes[i - 34][0];
        const uint32_t height = i < 17 ? 1 + i / 4 : i < 34 ? i - 16 : sizes[i - 34][1];
        const tl_camera camera = camera_of(width, height, TL_PERSPECTIVE);
        tl_gbuffer *g = surfaces_between(&camera, 3.0f, 6.0f);
        tl_light_set lights = some_lights(g, 12, 2.0f);
        const uint32_t whole_x = width / 8 * 8, whole_y = height / 8 * 8;
        tl_image *image = hard_picture(g, &lights);
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++)
                hard_count(bench,
                           isfinite(tl_image_plane(image, 0)[(size_t)y * image->pitch + x]),
                           x < whole_x && y < whole_y);
        tl_image_destroy(image);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* A surface in place of sky. */
static void fill(tl_gbuffer *g, uint32_t x, uint32_t y)
{
    const size_t at = pixel_at(g, x, y);
    set_pixel(g, TL_DEPTH, at, 5.0f);
    set_pixel(g, TL_NORMAL_Z, at, 1.0f);
    for (int p = TL_ALBEDO_R; p <= TL_SPECULAR_B; p++)
        set_pixel(g, (enum tl_plane)p, at, 0.5f);
}

/* Tiles of nothing but sky, of sky but for one pixel, of surfaces but for one pixel, and all else. */
static void cut_holes(tl_gbuffer *g)
{
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const uint32_t kind = (x / 8 + y / 8) % 4, corner = x % 8 == 7 && y % 8 == 7;
            if (kind == 0 || (kind == 1 && !corner) || (kind == 2 && corner))
                set_pixel(g, TL_DEPTH, pixel_at(g, x, y), INFINITY);
            else if (kind != 3 && isinf(depth_at(g, x, y)))
                fill(g, x, y);
        }
}

/* The nearest and the farthest depth of the pixel's tile of 8 px. */
static void depths_of_tile(
    const tl_gbuffer *g, uint32_t x, uint32_t y, int with_sky, float *nearest, float *farthest)
{
    *nearest = INFINITY;
    *farthest = 0.0f;
    for (uint32_t row = y / 8 * 8; row < y / 8 * 8 + 8 && row < g->camera.height; row++)
        for (uint32_t column = x / 8 * 8; column < x / 8 * 8 + 8 && column < g->camera.width;
             column++) {
            const float depth = depth_at(g, column, row);
            if (isinf(depth) && !with_sky)
                continue;
            *nearest = fminf(*nearest, depth);
            *farthest = fmaxf(*farthest, depth);
        }
}

/* Which of 32 cells between the depths of its tile a surface is in, by a factor that is computed once. */
static float cell_of(const tl_gbuffer *g, uint32_t x, uint32_t y, int with_sky)
{
    float nearest, farthest;
    depths_of_tile(g, x, y, with_sky, &nearest, &farthest);
    return floorf((depth_at(g, x, y) - nearest) * (31.0f / (farthest - nearest)));
}

/* Sky has the sky's bits, surfaces are finite and lit. */
static int is_as_hit(const tl_gbuffer *g,
                     const tl_light_set *lights,
                     const tl_image *image,
                     uint32_t x,
                     uint32_t y)
{
    int right = 1;
    for (unsigned c = 0; c < 3; c++) {
        const float value = tl_image_plane(image, c)[(size_t)y * image->pitch + x];
        right &= isinf(depth_at(g, x, y)) ? same_bits(value, lights->sky[c])
                                          : isfinite(value) && value > 0.0f;
    }
    return right;
}

void hard_sky(hard_bench *bench)
{
    for (int projection = 0; projection < 2; projection++) {
        const tl_camera camera =
            camera_of(FRAME_WIDTH, FRAME_HEIGHT, (tl_projection)projection);
        tl_gbuffer *g = surfaces_between(&camera, 3.0f, 6.0f);
        cut_holes(g);
        tl_light_set lights = some_lights(g, 48, 2.0f);
        for (int c = 0; c < 3; c++) {
            lights.sky[c] = 0.25f + 0.1f * (float)c;
            lights.ambient[c] = 0.125f;
        }
        tl_image *image = hard_picture(g, &lights);
        for (uint32_t y = 0; y < camera.height; y++)
            for (uint32_t x = 0; x < camera.width; x++)
                hard_count(bench, is_as_hit(g, &lights, image, x, y),
                           isinf(depth_at(g, x, y)) ||
                               cell_of(g, x, y, 1) == cell_of(g, x, y, 0));
        tl_image_destroy(image);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

void hard_one_depth(hard_bench *bench)
{
    static const float depths[] = {4.0f, 0x1.fffffep1f, 0.1f};
    for (size_t i = 0; i < COUNT_OF(depths); i++) {
        const tl_projection projection = i % 2 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
        const tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, projection);
        tl_gbuffer *g = surfaces_between(&camera, depths[i], depths[i]);
        tl_light_set lights = some_lights(g, 48, 2.0f);
        for (int c = 0; c < 3; c++)
            lights.ambient[c] = 0.125f;
        tl_image *image = hard_picture(g, &lights);
        for (uint32_t y = 0; y < camera.height; y++)
            for (uint32_t x = 0; x < camera.width; x++)
                if (isfinite(depth_at(g, x, y)))
                    hard_count(bench, is_as_hit(g, &lights, image, x, y),
                               isfinite(cell_of(g, x, y, 0)));
        tl_image_destroy(image);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}
