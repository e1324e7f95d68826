/* Has a region the bits of the same pixels of the whole picture, with all that pixels look around for, and do
 * files say where it lies? */
#define _GNU_SOURCE
#include "program.h"

#include "exr_reader.h"
#include "tilelight/image.h"

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-region");
    expect_run("$T capture $D/nine-lights.gltf --size 210x130 -o g.exr", 0, "", "");
    expect_run("$T capture $D/nine-lights.gltf --size 70x50 --samples 9 -o samples.exr", 0, "",
               "");
    expect_run("$T capture $D/panes.gltf --size 200x110 -o panes.exr", 0, "", "");
    expect_run("$T capture $D/hard-cases.glb --camera above --size 150x90 -o parallel.exr "
               "--layout compact-16",
               0, "", "");
    expect_run("$T capture $D/nine-lights.gltf --size 90x50 --ids -o ids.exr", 0, "", "");
    return 0;
}

static tl_image *picture_in(const char *path)
{
    tl_image *image = NULL;
    tl_error err;
    int is_png;
    ASSERT_OK(tl_image_read(path, &image, &is_png, &err), err);
    return image;
}

static void expect_pixels_of(
    const char *what, const tl_image *all, const tl_image *some, uint32_t x, uint32_t y)
{
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t row = 0; row < some->height; row++)
            if (memcmp(tl_image_plane(all, c) + (size_t)(y + row) * all->pitch + x,
                       tl_image_plane(some, c) + (size_t)row * some->pitch,
                       some->width * sizeof(float)) != 0)
                fail_msg("%s: the part has other bits in row %u of channel %u", what, row, c);
}

static void expect_part_of(
    const char *what, const char *whole, const char *part, uint32_t x, uint32_t y)
{
    tl_image *const all = picture_in(whole), *const some = picture_in(part);
    expect_pixels_of(what, all, some, x, y);
    tl_image_destroy(all);
    tl_image_destroy(some);
}

static tl_image *layer_in(const char *path, const char *layer)
{
    tl_exr_reader reader = {.is_open = false};
    tl_exr_target targets[3];
    char names[3][64];
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_exr_reader_open_part(&reader, path, &err), err);
    ASSERT_OK(tl_image_create(reader.width, reader.height, &image, &err), err);
    for (unsigned c = 0; c < 3; c++) {
        snprintf(names[c], sizeof names[c], "%s.%c", layer, "RGB"[c]);
        ASSERT_OK(tl_exr_reader_require(&reader, names[c], &err), err);
        targets[c] = (tl_exr_target){names[c], EXR_PIXEL_FLOAT, tl_image_plane(image, c)};
    }
    ASSERT_OK(tl_exr_reader_pixels(&reader, targets, 3, image->pitch, &err), err);
    tl_exr_reader_close(&reader);
    return image;
}

static void bits_are_those_of_the_whole(void **state)
{
    static const struct {
        const char *options;
        uint32_t x, y, width, height;
    } cases[] = {
        {"g.exr --precision twin", 67, 33, 90, 50},
        {"g.exr --precision twin", 209, 129, 1, 1},
        {"g.exr --precision twin", 0, 0, 210, 130},
        {"g.exr --precision reference", 3, 100, 200, 7},
        {"g.exr", 67, 33, 90, 50},
        {"g.exr --path gpu --tile 8", 130, 70, 31, 60},
        {"g.exr --memory 1 --tile 8", 130, 70, 31, 60},
        {"g.exr --precision twin --lights $D/nine-lights.lights.json --ambient-occlusion 0.4",
         70, 66, 33, 20},
        {"g.exr --precision twin --antialias --dither blue-noise", 67, 65, 90, 50},
        {"samples.exr --precision twin --antialias=depth", 23, 11, 31, 22},
        {"g.exr --precision twin --bloom 0.4 --bloom-threshold 0.2", 101, 75, 40, 30},
        {"panes.exr --precision twin", 40, 31, 80, 40},
        {"parallel.exr --precision twin --lights $D/nine-lights.lights.json "
         "--ambient-occlusion 0.5",
         66, 9, 20, 70},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char command[512];
        snprintf(command, sizeof command, "$T light %s -o whole.exr -o whole.png",
                 cases[i].options);
        expect_run(command, 0, "", "");
        snprintf(command, sizeof command,
                 "$T light %s -o part.exr -o part.png --region %u,%u,%u,%u", cases[i].options,
                 cases[i].x, cases[i].y, cases[i].width, cases[i].height);
        expect_run(command, 0, "", "");
        expect_part_of(cases[i].options, "whole.exr", "part.exr", cases[i].x, cases[i].y);
        expect_part_of(cases[i].options, "whole.png", "part.png", cases[i].x, cases[i].y);
    }
}

#define LINKED \
    "$T light ids.exr --lights l.json --precision twin --aov diffuse,specular,groups "

/* With lights that are linked to objects, by the ids of the part's own pixels. */
static void layers_are_parts_of_theirs(void **state)
{
    static const char *const layers[] = {"diffuse", "specular", "light_key", "rest"};
    (void)state;
    FILE *const file = fopen("l.json", "w");
    assert_non_null(file);
    fputs("{\"tilelight\": 1, \"lights\": ["
          "{\"type\": \"point\", \"position\": [0, 4, 4], \"intensity\": 40, "
          "\"group\": \"key\", \"link\": {\"only\": [\"floor\", \"middle sphere\"]}}, "
          "{\"type\": \"point\", \"position\": [3, 3, 2], \"intensity\": 30, "
          "\"link\": {\"except\": [\"cone\"]}}]}",
          file);
    assert_int_equal(fclose(file), 0);
    expect_run(LINKED "-o whole.exr && " LINKED "-o part.exr --region 67,9,20,31", 0, "", "");
    expect_part_of("linked", "whole.exr", "part.exr", 67, 9);
    for (size_t i = 0; i < COUNT_OF(layers); i++) {
        tl_image *const all = layer_in("whole.exr", layers[i]), *const some = layer_in(
                                                                    "part.exr", layers[i]);
        expect_pixels_of(layers[i], all, some, 67, 9);
        tl_image_destroy(all);
        tl_image_destroy(some);
    }
}

/* Data window inside display window: read back, told, and no G-buffer. */
static void files_say_where_it_lies(void **state)
{
    (void)state;
    expect_run("$T light g.exr --precision twin -o part.exr --region 20,30,40,50", 0, "", "");
    tl_image *const part = picture_in("part.exr");
    assert_int_equal(part->width, 40);
    assert_int_equal(part->height, 50);
    assert_true(part->x == 20 && part->y == 30);
    assert_true(part->whole_width == 210 && part->whole_height == 130);
    tl_image_destroy(part);
    expect_run("$T info part.exr", 0, "part        from (20, 30) on, of 210 x 130 pixels", "");
    expect_run("$T info part.exr --json", 0, "\"part\"", "");
    expect_run("$T compare part.exr part.exr", 0, "max", "");
    expect_run("$T render $D/nine-lights.gltf --size 210x130 --precision twin -o r.exr "
               "--region 20,30,40,50 --aov diffuse && $T info r.exr",
               0, "40 x 50 pixels", "");
    expect_part_of("rendered", "r.exr", "part.exr", 0, 0);
}

static void mistakes_are_named(void **state)
{
    static const char *const cases[][2] = {
        {"1,2,3", "\"1,2,3\" is no region"},
        {"1,2,3,4,5", "is no region"},
        {"1,2,0,4", "is no region"},
        {"-1,2,3,4", "is no region"},
        {"1, 2,3,4", "is no region"},
        {"99999,2,3,4", "is no region"},
        {"200,2,11,4", "--region 200,2,11,4 leaves the picture, which has 210 x 130 pixels"},
        {"0,127,5,4", "leaves the picture"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char command[256];
        snprintf(command, sizeof command,
                 "$T light g.exr --precision twin -o x.png --region '%s'", cases[i][0]);
        expect_run(command, 2, "", cases[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_are_those_of_the_whole),
        cmocka_unit_test(layers_are_parts_of_theirs),
        cmocka_unit_test(files_say_where_it_lies),
        cmocka_unit_test(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
