/* Does the program say of a frame which effects it called for and why, and show what its tiles list? */
#define _GNU_SOURCE
#include "program.h"

#include "tilelight/effects.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/image.h"

#include <jansson.h>

enum { WIDTH = 64, HEIGHT = 48, TILE = 16 };

/* A wall 5 m in front of the camera, but for the first column of tiles, which is sky. */
static tl_gbuffer *wall(uint32_t present)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, WIDTH, HEIGHT, 0.1, 100.0);
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, present, &g, &err), err);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = TILE; x < WIDTH; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            tl_gbuffer_plane(g, TL_DEPTH)[at] = 5.0f;
            tl_gbuffer_plane(g, TL_NORMAL_Z)[at] = 1.0f;
            for (int c = 0; c < 3; c++)
                tl_gbuffer_plane(g, (enum tl_plane)(TL_ALBEDO_R + c))[at] = 0.5f;
            if (present & TL_GROUP_OCCLUSION)
                tl_gbuffer_plane(g, TL_OCCLUSION)[at] = 0.5f;
        }
    return g;
}

/* Before the middle of a tile, and it reaches no other: the tile is 1.8 m wide there. */
static tl_light lamp_at(const tl_camera *camera, uint32_t tile_x, uint32_t tile_y)
{
    tl_light light = tl_light_default();
    const float x = (float)(TILE * tile_x + TILE / 2) / WIDTH,
                y = (float)(TILE * tile_y + TILE / 2) / HEIGHT;
    light.position[0] = 5.0f * (camera->left + x * (camera->right - camera->left));
    light.position[1] = 5.0f * (camera->top + y * (camera->bottom - camera->top));
    light.position[2] = -4.9f;
    light.range = 0.5f;
    return light;
}

static void write_frame(const char *path, uint32_t present, tl_light_set *lights)
{
    tl_gbuffer *g = wall(present);
    tl_error err;
    ASSERT_OK(tl_gbuffer_write(path, g, lights, &err), err);
    tl_gbuffer_destroy(g);
    tl_light_set_clear(lights);
}

static void add(tl_light_set *set, tl_light light, const char *name)
{
    tl_error err;
    snprintf(light.name, sizeof light.name, "%s", name);
    ASSERT_OK(tl_light_set_add(set, &light, &err), err);
}

static tl_camera camera_of_wall(void)
{
    tl_gbuffer *g = wall(TL_GROUP_BASE);
    const tl_camera camera = g->camera;
    tl_gbuffer_destroy(g);
    return camera;
}

/* Three lights on tile (2, 1), one on (3, 2), one that is out, one from afar. */
static void write_lamps(const char *path)
{
    const tl_camera camera = camera_of_wall();
    tl_light_set lights = {.sky = {0.25f, 0.5f, 1.0f}};
    tl_light out = lamp_at(&camera, 1, 0), sun = tl_light_default();
    out.intensity = 0.0f;
    sun.type = TL_LIGHT_DIRECTIONAL;
    sun.direction[2] = -1.0f;
    add(&lights, out, "burnt out");
    for (int i = 0; i < 3; i++)
        add(&lights, lamp_at(&camera, 2, 1), "lamp");
    add(&lights, lamp_at(&camera, 3, 2), "");
    add(&lights, sun, "sun");
    write_frame(path, TL_GROUP_BASE | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, &lights);
}

static void expect_lines(const char *command, const char *const *lines, size_t count)
{
    const program_run *run = expect_run(command, 0, "", "");
    for (size_t i = 0; i < count; i++)
        if (!strstr(run->err, lines[i]))
            fail_msg("%s\nshould say\n%s\nand said\n%s", command, lines[i], run->err);
}

static void each_effect_is_told_with_its_reason(void **state)
{
    static const char *const lamps[] = {
        "\n  global-lights      on   light 5 \"sun\"\n",
        "\n  ranged-lights      on   4 lights, the first is light 1 \"lamp\"\n",
        "\n  directional        on   light 5 \"sun\"\n",
        "\n  inverse-square     on   4 lights, the first is light 1 \"lamp\"\n",
        "\n  linear             off  no light with a linear falloff\n",
        "\n  specular           off  no specular or metal-rough material\n",
        "\n  occlusion          off  no ambient light\n",
        "\n  emission           off  emissive is black in every pixel\n",
        "\n  sky                on   sky 0.25 0.5 1\n",
        "\n  orthographic       off  no orthographic camera\n",
        "left out\n  light 0 \"burnt out\": has no colour or no intensity\n"
        "  plane ao: not read by any effect that is on\n"
        "  plane emissive: not read, black in every pixel\n",
        "\n  global-lights            9 tiles          9 pairs\n",
        "\n  ranged-lights            2 tiles          4 pairs\n",
        "\n  sky                      3 tiles\n",
        "\n  tiles           12 of 16 x 16 pixels: 3 sky alone, 7 more without a listed "
        "light\n",
        "\n  pairs           4 of a tile and a light, 0.3 a tile\n",
        "\n  pixels          2304 of surfaces: 0.4 listed lights each in the mean, 1 for all\n",
        "TL_FALLOFFS_USED=6 ",
        "TL_IDLE=122880 ", /* planes 13 to 16 */
        "\nstages, ms",
    };
    static const char *const all[] = {
        "\n  linear             on   --effects all\n",
        "\n  ambient            on   --effects all\n",
        "\n  occlusion          on   plane ao; --effects all\n",
        "\n  emission           on   --effects all\n",
        "left out\n  light 0 \"burnt out\": has no colour or no intensity; lit all the same, "
        "by "
        "--effects all\n",
        "\nkernels           none: computed without OpenCL\n",
    };
    (void)state;
    write_lamps("lamps.exr");
    expect_lines("$T light lamps.exr -o lit.exr --explain", lamps, COUNT_OF(lamps));
    expect_lines("$T light lamps.exr -o all.exr --explain --effects all --precision twin", all,
                 COUNT_OF(all));
    expect_run("$T compare lit.exr all.exr --tolerance 0", 0, "", "");
}

static void a_dark_frame_calls_for_nothing(void **state)
{
    tl_light_set lights = {0};
    const tl_camera camera = camera_of_wall();
    tl_light out = lamp_at(&camera, 1, 0);
    (void)state;
    out.color[0] = out.color[1] = out.color[2] = 0.0f;
    add(&lights, out, "a\033b");
    write_frame("dark.exr", TL_GROUP_BASE, &lights);
    const program_run *run =
        expect_run("$T light dark.exr -o dark.png --explain --precision twin", 0, "",
                   "left out\n  light 0 \"a?b\": has no colour or no intensity\n");
    assert_null(strstr(run->err, "  on "));
}

static json_t *json_of(const char *path)
{
    json_error_t error;
    json_t *report = json_load_file(path, 0, &error);
    if (!report)
        fail_msg("%s: %s", path, error.text);
    return report;
}

static void json_has_the_same(void **state)
{
    const char *because = NULL;
    int on = 0, sky = 0, unlit = 0;
    const char *file = NULL;
    double pairs = 0.0;
    (void)state;
    write_lamps("lamps.exr");
    expect_run("$T light lamps.exr -o lit.exr --explain --explain-map map.png --json "
               "--precision twin >report.json",
               0, "", "");
    json_t *report = json_of("report.json");
    assert_int_equal(json_unpack(report, "{s{s{s{sb ss}} s{si si} s{sF}} s{ss}}", "explain",
                                 "effects", "sky", "on", &on, "because", &because, "tiles",
                                 "sky", &sky, "without_lights", &unlit, "pairs", "tile_light",
                                 &pairs, "explain_map", "file", &file),
                     0);
    assert_true(on);
    assert_string_equal(because, "sky 0.25 0.5 1");
    assert_string_equal(file, "map.png");
    assert_int_equal(sky, 3);
    assert_int_equal(unlit, 0);
    assert_true(pairs == 48.0); /* the twin has no lists: every tile has all four */
    json_decref(report);
}

/* Of the ramp its ends: Oklab of lightness 0.38 and 0.90, chroma 0.15, hue 280 and 465 degrees, by
 * tests/tools/oracle_explain_ramp.py. */
static const uint8_t sky[3] = {128, 128, 128}, none[3] = {0, 0, 0}, one[3] = {56, 48, 143},
                     three[3] = {237, 227, 97};

static void expect_tile(const tl_image *map, uint32_t x, uint32_t y, const uint8_t want[3])
{
    for (uint32_t i = 0; i < TILE * TILE; i++)
        for (unsigned c = 0; c < 3; c++) {
            const size_t at = (size_t)(y * TILE + i / TILE) * map->pitch + x * TILE + i % TILE;
            const float got = 255.0f * tl_image_plane(map, c)[at];
            if (lrintf(got) != want[c])
                fail_msg("tile (%u, %u), channel %u: %g, not %u", x, y, c, (double)got,
                         want[c]);
        }
}

static void map_shows_what_tiles_list(void **state)
{
    static const char *const lines[] = {
        "map.png\n  #808080  sky alone                          3 tiles\n",
        "\n  #000000        0 to       0 lights          7 tiles\n",
        "        1 to       1 lights          1 tiles\n",
        "        2 to       2 lights          0 tiles\n",
        "        3 to       3 lights          1 tiles\n",
    };
    tl_image *map = NULL;
    tl_error err;
    (void)state;
    write_lamps("lamps.exr");
    expect_lines("$T light lamps.exr -o lit.exr --explain-map map.png", lines, COUNT_OF(lines));
    ASSERT_OK(tl_image_read("map.png", &map, NULL, &err), err);
    assert_int_equal(map->width, WIDTH);
    assert_int_equal(map->height, HEIGHT);
    for (uint32_t y = 0; y < HEIGHT / TILE; y++)
        for (uint32_t x = 0; x < WIDTH / TILE; x++)
            expect_tile(map, x, y,
                        x == 0             ? sky
                        : x == 2 && y == 1 ? three
                        : x == 3 && y == 2 ? one
                                           : none);
    tl_image_destroy(map);
}

/* In bands a tile keeps its place. */
static void bands_show_the_same_map(void **state)
{
    char before[65536];
    (void)state;
    write_lamps("lamps.exr");
    snprintf(before, sizeof before, "%s",
             expect_run("$T light lamps.exr -o lit.exr --explain-map map.png", 0, "", "")->err);
    const program_run *run = expect_run("$T light lamps.exr -o lit.exr --explain-map map.png "
                                        "--path gpu --cull rect --memory 0.005",
                                        0, "", "");
    assert_string_equal(run->err, before);
}

/* Of which tile (2, 1) has three lights, in the dark: it takes longer than the sky. */
static void costs_are_measured(void **state)
{
    const char *why = NULL;
    double ms = 0.0, low = 1.0, high = 0.0, share = 0.0, most = 0.0;
    int frames = 0, tiles = 0;
    size_t i;
    json_t *class;
    (void)state;
    write_lamps("lamps.exr");
    expect_run("$T light lamps.exr -o lit.exr --explain-costs --explain-map-costs cost.png "
               "--json >report.json",
               0, "", "");
    expect_run("$T light lamps.exr -o plain.exr", 0, "", "");
    expect_run("$T compare lit.exr plain.exr --tolerance 0", 0, "", "");
    json_t *report = json_of("report.json");
    assert_int_equal(json_unpack(report, "{s{s{s{s{sF s[FF] sF si}} s{s{ss}}}}}", "explain",
                                 "effects", "ranged-lights", "cost", "ms", &ms, "interval",
                                 &low, &high, "share", &share, "frames", &frames, "directional",
                                 "cost", "unknown_because", &why),
                     0);
    assert_true(low <= ms && ms <= high && share <= 1.0);
    assert_int_equal(frames, 7);
    assert_string_equal(why, "not to be taken out alone: its lights would have no falloff");
    json_array_foreach(json_object_get(json_object_get(report, "explain_map_costs"), "classes"),
                       i, class)
    {
        tiles += (int)json_integer_value(json_object_get(class, "tiles"));
        assert_true(json_number_value(json_object_get(class, "above_us")) >= most);
        most = json_number_value(json_object_get(class, "to_us"));
    }
    assert_int_equal(tiles, 12);
    assert_true(most > 0.0);
    json_decref(report);
    expect_run("$T light lamps.exr -o lit.exr --explain-costs --precision twin", 3, "",
               "what is lit without OpenCL is not shaded once more");
    expect_run("$T light lamps.exr -o lit.exr --explain-map-costs c.png --path gpu", 3, "",
               "times of tiles are not to be had here");
}

static void wrong_maps_are_refused(void **state)
{
    (void)state;
    expect_run("$T light a.exr -o b.exr --explain-map c.exr", 2, "",
               "--explain-map: cannot tell what to write from \"c.exr\"; end it in .png");
    expect_run("$T light a.exr -o b.exr --effects some", 2, "",
               "--effects: no such mode \"some\"; modes: auto, all");
    write_lamps("lamps.exr");
    expect_run("$T light lamps.exr -o b.exr --explain-map nowhere/c.png", 5, "", "nowhere");
}

static void the_table_is_listed(void **state)
{
    static const char *const words[] = {
#define WORD(name, word, computes, causes, planes, option) word,
        TL_EFFECTS(WORD)
#undef WORD
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(words); i++)
        expect_run("$T effects", 0, words[i], "");
    expect_run("$T effects", 0,
               "occlusion       the share of ambient light that arrives; TL_IDLE\n"
               "                for: occlusion; ambient light\n"
               "                reads: ao\n",
               "");
    expect_run("$T effects more", 2, "", "\"more\" is an argument too many");
}

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-explain");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_effect_is_told_with_its_reason, enter),
        cmocka_unit_test_setup(a_dark_frame_calls_for_nothing, enter),
        cmocka_unit_test_setup(json_has_the_same, enter),
        cmocka_unit_test_setup(map_shows_what_tiles_list, enter),
        cmocka_unit_test_setup(bands_show_the_same_map, enter),
        cmocka_unit_test_setup(costs_are_measured, enter),
        cmocka_unit_test_setup(wrong_maps_are_refused, enter),
        cmocka_unit_test_setup(the_table_is_listed, enter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
