/* Are the pictures that lights and skies name found beside their file, read once, decoded, and refused with a
 * sentence that names light and file? */
#include "file_cases.h"

#include "tilelight/image.h"
#include "tilelight/lights.h"

#include <sys/stat.h>
#include <unistd.h>

static char folder[400]; /* with a slash */

static const char *path_of(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s%s", folder, name);
    return path;
}

static void write_text(const char *name, const char *text)
{
    save_bytes(path_of(name), text, strlen(text));
}

/* 2 x 1: codes 0, 128, 255 and 255, 0, 64. */
static void write_png(const char *name)
{
    static const uint8_t rgb[6] = {0, 128, 255, 255, 0, 64};
    tl_error err;
    ASSERT_OK(tl_png_write(path_of(name), rgb, 2, 1, TL_CURVE_SRGB, &err), err);
}

static void write_exr(const char *name, uint32_t width, uint32_t height, float value)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    for (unsigned c = 0; c < 3; c++)
        tl_image_plane(image, c)[width - 1] = c == 1 ? value : 0.25f;
    ASSERT_OK(tl_image_write_exr(path_of(name), image, (tl_exr_form){0}, &err), err);
    tl_image_destroy(image);
}

static int make_folder(void **state)
{
    (void)state;
    scratch_path(folder, sizeof folder - 8, "light-images/");
    mkdir(folder, 0777);
    mkdir(path_of("inner"), 0777);
    write_png("inner/gobo.png");
    write_exr("inner/sky.exr", 3, 1, 5.5f);
    return 0;
}

#define LAMP(fields)                                                                           \
    "{ \"type\": \"point\", \"position\": [0, 0, 0], \"name\": \"lamp\", \"texture\": " fields \
    " }"
#define SPOT(fields)                                                             \
    "{ \"type\": \"spot\", \"position\": [0, 0, 0], \"direction\": [0, 0, -1], " \
    "\"name\": \"window\", " fields " }"

static void pictures_are_read_once_and_decoded(void **state)
{
    /* IEC 61966-2-1 of 128/255 and 64/255, by hand: ((c + 0.055)/1.055)^2.4. */
    static const double want[6] = {0, 0.2158605001, 1, 1, 0, 0.05126945837};
    tl_light_set set = {0}, back = {0};
    char *text = NULL;
    tl_error err;
    (void)state;
    write_text(
        "l.json",
        "{ \"tilelight\": 1, \"sky\": { \"type\": \"image\", \"image\": \"inner/sky.exr\", "
        "\"intensity\": 0.5, \"rotation\": 1.25 }, \"lights\": [ " LAMP(
            "\"inner/gobo.png\"") ", " SPOT("\"texture\": \"inner/gobo.png\", \"up\": [0, 2, "
                                            "0]") " ] }");
    ASSERT_OK(tl_lights_read(path_of("l.json"), &set, &err), err);
    assert_int_equal(set.image_count, 2);
    assert_int_equal(set.lights[0].texture, set.lights[1].texture);
    assert_int_not_equal(set.lights[0].texture, set.sky_image);
    const tl_light_image *gobo = &set.images[set.lights[0].texture - 1];
    const tl_light_image *sky = &set.images[set.sky_image - 1];
    assert_int_equal(gobo->width * 100 + gobo->height, 201);
    for (int i = 0; i < 6; i++)
        assert_true(fabs((double)gobo->pixels[i] - want[i]) < 1e-7);
    assert_int_equal(sky->width * 100 + sky->height, 301);
    assert_float_equal(sky->pixels[7], 5.5f, 0);
    assert_float_equal(sky->pixels[8], 0.25f, 0);
    assert_float_equal(set.lights[1].up[1], 1.0f, 0);
    assert_float_equal(set.sky_rotation, 1.25f, 0);

    /* Text for the same folder keeps names; for another one it names them whole. */
    ASSERT_OK(tl_lights_format(&set, path_of("other.json"), &text, &err), err);
    assert_non_null(strstr(text, "\"inner/gobo.png\""));
    free(text);
    ASSERT_OK(tl_lights_format(&set, path_of("inner/other.json"), &text, &err), err);
    assert_null(strstr(text, "\"inner/gobo.png\""));
    write_text("inner/other.json", text);
    free(text);
    ASSERT_OK(tl_lights_read(path_of("inner/other.json"), &back, &err), err);
    assert_int_equal(back.image_count, 2);
    assert_memory_equal(back.images[back.lights[0].texture - 1].pixels, gobo->pixels,
                        6 * sizeof(float));
    assert_memory_equal(&back.lights[1].up, &set.lights[1].up, 3 * sizeof(float));
    tl_light_set_clear(&back);
    tl_light_set_clear(&set);
}

static void refusals(void **state)
{
    static const struct {
        const char *lights;
        tl_status status;
        const char *words[5]; /* ends with NULL */
    } cases[] = {
        {LAMP("\"absent.png\""), TL_ERR_READ, {"lights[0] \"lamp\"", "texture", "absent.png"}},
        {LAMP("\"text.png\""), TL_ERR_FORMAT, {"lamp", "text.png", "neither"}},
        {LAMP("\"cut.png\""), TL_ERR_FORMAT, {"lamp", "cut.png", "damaged"}},
        {LAMP("\"negative.exr\""),
         TL_ERR_FORMAT,
         {"lamp", "negative.exr", "pixel (1, 0)", "-2"}},
        {LAMP("\"nan.exr\""), TL_ERR_FORMAT, {"lamp", "nan.exr", "nan"}},
        {LAMP("\"wide.exr\""), TL_ERR_UNSUPPORTED, {"lamp", "wide.exr", "8193 x 1", "8192"}},
        {SPOT("\"outerConeAngle\": 1.5707964, \"texture\": \"inner/gobo.png\""),
         TL_ERR_FORMAT,
         {"lights[0] \"window\"", "outerConeAngle", "below pi/2", "point light"}},
        {SPOT("\"up\": [0, 0, 3], \"texture\": \"inner/gobo.png\""),
         TL_ERR_FORMAT,
         {"lights[0] \"window\"", "up is along the direction"}},
    };
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    write_text("text.png", "no picture at all");
    write_text("cut.png", "\x89PNG\r\n\x1a\n");
    write_exr("negative.exr", 2, 1, -2.0f);
    write_exr("nan.exr", 2, 1, NAN);
    write_exr("wide.exr", 8193, 1, 1.0f);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char text[1024];
        snprintf(text, sizeof text, "{ \"tilelight\": 1, \"lights\": [ %s ] }",
                 cases[i].lights);
        write_text("refused.json", text);
        const tl_status status = tl_lights_read(path_of("refused.json"), &set, &err);
        assert_refused(cases[i].lights, status, cases[i].status, &err, cases[i].words);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_read_once_and_decoded),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, make_folder, NULL);
}
