/* Is a lights file that says something wrong, unknown or not yet supported refused, with a sentence
 * that names the light and the field? */
#define _GNU_SOURCE /* mknod */
#include "file_cases.h"

#include "full_device.h"
#include "tilelight/lights.h"

#define FILE_WITH(members) "{ \"tilelight\": 1, " members " }"
#define LIGHT(fields) FILE_WITH("\"lights\": [ { " fields " } ]")
#define POINT(fields) LIGHT("\"type\": \"point\", \"position\": [0, 0, 0], " fields)
#define SPOT(fields) \
    LIGHT("\"type\": \"spot\", \"position\": [0, 0, 0], \"direction\": [1, 0, 0], " fields)
#define SECOND(fields)                                                                    \
    FILE_WITH("\"lights\": [ { \"type\": \"point\", \"position\": [0, 0, 0] }, { " fields \
              " } ]")

#define ROWS(rows) FILE_WITH("\"materials\": [ " rows " ]")
#define ROW(fields) ROWS("{ \"model\": \"phong\", " fields " }")
#define LONG_NAME                                                                 \
    "a name of more than a hundred and twenty-seven bytes, which is longer than " \
    "any that a row can hold, and so cannot be compared with a capture's own"

static const struct {
    const char *text;
    tl_status status;
    const char *words[6]; /* ends with NULL */
} cases[] = {
    /* Not JSON, or not ours. */
    {"", TL_ERR_FORMAT, {"line 1", "JSON"}},
    {"{ \"tilelight\": 1,\n  oops }", TL_ERR_FORMAT, {"line 2", "column", "oops"}},
    {"{ \"tilelight\": 1 } trailing", TL_ERR_FORMAT, {"trailing"}},
    {"{ \"tilelight\": 1, \"lights\": [], \"lights\": [] }",
     TL_ERR_FORMAT,
     {"duplicate", "lights"}},
    {"[]", TL_ERR_FORMAT, {"\"tilelight\": 1"}},
    {"3", TL_ERR_FORMAT, {"lights.json"}},
    {"{}", TL_ERR_FORMAT, {"\"tilelight\": 1"}},
    {"{ \"tilelight\": \"1\" }", TL_ERR_FORMAT, {"\"tilelight\""}},
    {"{ \"lights\": [], \"tilelight\": 2 }", TL_ERR_UNSUPPORTED, {"version 2", "version 1"}},
    {"\xff\xfe", TL_ERR_FORMAT, {"lights.json"}},

    /* Unknown fields and words. */
    {FILE_WITH("\"light\": []"), TL_ERR_FORMAT, {"\"light\"", "did you mean \"lights\""}},
    {FILE_WITH("\"zebra\": []"), TL_ERR_FORMAT, {"unknown field \"zebra\""}},
    {SECOND("\"type\": \"point\", \"position\": [0, 0, 0], \"name\": \"key\", \"intensty\": 1"),
     TL_ERR_FORMAT,
     {"lights[1] \"key\"", "unknown field \"intensty\"", "did you mean \"intensity\""}},
    {POINT("\"Color\": [1, 1, 1]"), TL_ERR_FORMAT, {"\"Color\"", "did you mean \"color\""}},
    {POINT("\"innerCone\": 1"), TL_ERR_FORMAT, {"lights[0]", "\"innerCone\""}},
    {LIGHT("\"type\": \"area\""), TL_ERR_FORMAT, {"\"area\"", "point", "directional", "spot"}},
    {POINT("\"falloff\": \"cubic\""), TL_ERR_FORMAT, {"\"cubic\"", "linear", "inverse-square"}},
    {FILE_WITH("\"materials\": { \"model\": \"gouraud\" }"),
     TL_ERR_FORMAT,
     {"materials", "\"gouraud\"", "\"phong\"", "\"blinn-phong-normalized\""}},
    {FILE_WITH("\"materials\": { \"modell\": \"phong\" }"),
     TL_ERR_FORMAT,
     {"materials", "\"modell\"", "did you mean \"model\""}},
    {FILE_WITH("\"sky\": { \"type\": \"blue\" }"), TL_ERR_FORMAT, {"\"blue\"", "constant"}},
    {FILE_WITH("\"sky\": { \"type\": \"constant\", \"color\": [1, 1, 1], \"colour\": 1 }"),
     TL_ERR_FORMAT,
     {"sky", "\"colour\"", "did you mean \"color\""}},

    /* Ambient occlusion. */
    {FILE_WITH("\"ambientOcclusion\": 0.5"), TL_ERR_FORMAT, {"ambientOcclusion", "\"radius\""}},
    {FILE_WITH("\"ambientOcclusion\": {}"), TL_ERR_FORMAT, {"ambientOcclusion", "\"radius\""}},
    {FILE_WITH("\"ambientOcclusion\": { \"radius\": -1 }"),
     TL_ERR_FORMAT,
     {"ambientOcclusion: radius", "-1", "from 0"}},
    {FILE_WITH("\"ambientOcclusion\": { \"radius\": 1e30 }"),
     TL_ERR_FORMAT,
     {"ambientOcclusion: radius", "1e+30"}},
    {FILE_WITH("\"ambientOcclusion\": { \"radius\": \"wide\" }"),
     TL_ERR_FORMAT,
     {"ambientOcclusion", "\"radius\""}},
    {FILE_WITH("\"ambientOcclusion\": { \"radius\": 1, \"radios\": 1 }"),
     TL_ERR_FORMAT,
     {"ambientOcclusion", "\"radios\"", "did you mean \"radius\""}},

    /* Of a later version. */
    {POINT("\"group\": 3"), TL_ERR_FORMAT, {"lights[0]", "group", "string"}},

    {POINT("\"castsShadow\": 1"), TL_ERR_FORMAT, {"lights[0]", "castsShadow", "true or false"}},

    /* Falloff tables. */
    {POINT("\"lut\": [1, 0]"), TL_ERR_FORMAT, {"lights[0]", "\"lut\"", "falloff"}},
    {POINT("\"falloff\": \"lut\", \"range\": 1"),
     TL_ERR_FORMAT,
     {"lights[0]", "needs its table"}},
    {POINT("\"falloff\": \"lut\", \"lut\": [1, 0]"), TL_ERR_FORMAT, {"table needs a range"}},
    {POINT("\"falloff\": \"lut\", \"range\": 1, \"lut\": [1]"),
     TL_ERR_FORMAT,
     {"\"lut\"", "2 to 4096"}},
    {POINT("\"falloff\": \"lut\", \"range\": 1, \"lut\": 3"), TL_ERR_FORMAT, {"array"}},
    {POINT("\"falloff\": \"lut\", \"range\": 1, \"lut\": [1, \"x\"]"),
     TL_ERR_FORMAT,
     {"\"lut\"", "number"}},
    {POINT("\"falloff\": \"lut\", \"range\": 1, \"lut\": [1, -1]"),
     TL_ERR_FORMAT,
     {"lut[1]", "-1", "0 to 10000"}},
    {POINT("\"falloff\": \"lut\", \"range\": 1, \"lut\": [1, 2e4, 0]"),
     TL_ERR_FORMAT,
     {"lut[1]", "20000"}},
    {LIGHT("\"type\": \"directional\", \"direction\": [0, 0, 1], \"lut\": [1, 0]"),
     TL_ERR_FORMAT,
     {"directional light has no \"lut\""}},

    /* Textures of lights. */
    {POINT("\"name\": \"window\", \"texture\": \"no/such.png\""),
     TL_ERR_READ,
     {"lights[0] \"window\"", "\"texture\"", "no/such.png", "cannot be opened"}},
    {POINT("\"texture\": 3"), TL_ERR_FORMAT, {"\"texture\"", "OpenEXR or PNG"}},
    {POINT("\"texture\": \"\""), TL_ERR_FORMAT, {"\"texture\"", "OpenEXR or PNG"}},
    {LIGHT("\"type\": \"directional\", \"direction\": [0, 0, 1], \"texture\": \"a.png\""),
     TL_ERR_FORMAT,
     {"directional light has no \"texture\""}},
    {POINT("\"up\": [0, 1, 0]"), TL_ERR_FORMAT, {"up", "texture", "remove it"}},
    {POINT("\"ambient\": -1"), TL_ERR_FORMAT, {"lights[0]", "ambient", "-1"}},

    /* Skies. */
    {FILE_WITH(
         "\"sky\": { \"type\": \"gradient\", \"zenith\": [1, 1, 1], \"ground\": [0, 0, 0] }"),
     TL_ERR_FORMAT,
     {"gradient", "needs \"horizon\""}},
    {FILE_WITH("\"sky\": { \"type\": \"gradient\", \"color\": [1, 1, 1] }"),
     TL_ERR_FORMAT,
     {"gradient", "no \"color\""}},
    {FILE_WITH("\"sky\": { \"type\": \"image\" }"), TL_ERR_FORMAT, {"needs \"image\""}},
    {FILE_WITH("\"sky\": { \"type\": \"image\", \"image\": \"no/such.exr\" }"),
     TL_ERR_READ,
     {"sky", "\"image\"", "no/such.exr", "cannot be opened"}},
    {FILE_WITH(
         "\"sky\": { \"type\": \"gradient\", \"zenith\": [1, -1, 1], \"horizon\": [1, 1, 1], "
         "\"ground\": [0, 0, 0] }"),
     TL_ERR_FORMAT,
     {"sky: zenith[1] is -1, it must be from 0 to 1e+30"}},
    {FILE_WITH("\"sky\": { \"type\": \"constant\", \"color\": [1, 1, 1], \"light\": -1 }"),
     TL_ERR_FORMAT,
     {"sky: light is -1, it must be from 0 to 1e+30"}},
    {FILE_WITH("\"sky\": { \"type\": \"constant\", \"color\": [1, 1, 1], \"light\": true }"),
     TL_ERR_FORMAT,
     {"\"light\""}},
    {FILE_WITH("\"sky\": { \"type\": \"latlong\" }"), TL_ERR_FORMAT, {"latlong", "\"image\""}},

    /* Missing, or where it does not belong. */
    {LIGHT("\"position\": [0, 0, 0]"), TL_ERR_FORMAT, {"lights[0]", "\"type\""}},
    {LIGHT("\"type\": \"point\""), TL_ERR_FORMAT, {"point", "needs \"position\""}},
    {LIGHT("\"type\": \"directional\""), TL_ERR_FORMAT, {"needs \"direction\""}},
    {LIGHT("\"type\": \"spot\", \"position\": [0, 0, 0]"),
     TL_ERR_FORMAT,
     {"needs \"direction\""}},
    {POINT("\"direction\": [0, 0, 1]"), TL_ERR_FORMAT, {"point light has no \"direction\""}},
    {POINT("\"outerConeAngle\": 1"), TL_ERR_FORMAT, {"point light has no \"outerConeAngle\""}},
    {LIGHT("\"type\": \"directional\", \"direction\": [0, 0, 1], \"range\": 4"),
     TL_ERR_FORMAT,
     {"directional light has no \"range\""}},
    {FILE_WITH("\"sky\": { \"type\": \"constant\" }"), TL_ERR_FORMAT, {"sky", "\"color\""}},

    /* Of the wrong type. */
    {FILE_WITH("\"lights\": {}"), TL_ERR_FORMAT, {"\"lights\"", "array"}},
    {FILE_WITH("\"lights\": [ 3 ]"), TL_ERR_FORMAT, {"lights[0]", "object"}},
    {FILE_WITH("\"ambient\": 0.1"), TL_ERR_FORMAT, {"\"ambient\"", "three numbers"}},
    {FILE_WITH("\"ambient\": [1, 2]"), TL_ERR_FORMAT, {"\"ambient\"", "three numbers"}},
    {FILE_WITH("\"sky\": [1, 2, 3]"), TL_ERR_FORMAT, {"\"sky\"", "object"}},
    {FILE_WITH("\"materials\": \"phong\""), TL_ERR_FORMAT, {"\"materials\"", "array"}},
    {FILE_WITH("\"shininess\": \"sharp\""), TL_ERR_FORMAT, {"\"shininess\"", "number"}},
    {FILE_WITH("\"shininess\": 10001"), TL_ERR_FORMAT, {"shininess", "10001", "10000"}},
    {FILE_WITH("\"shininess\": -1"), TL_ERR_FORMAT, {"shininess", "-1"}},
    {FILE_WITH("\"model\": 1"), TL_ERR_FORMAT, {"\"model\"", "\"phong\""}},
    {FILE_WITH("\"model\": \"gouraud\""),
     TL_ERR_FORMAT,
     {"\"gouraud\"", "\"lambert\"", "\"metal-rough\""}},
    {FILE_WITH("\"materials\": { \"model\": 1 }"), TL_ERR_FORMAT, {"\"model\"", "phong"}},
    {LIGHT("\"type\": 1"), TL_ERR_FORMAT, {"\"type\"", "point"}},
    {LIGHT("\"type\": null"), TL_ERR_FORMAT, {"\"type\""}},
    {POINT("\"name\": 7"), TL_ERR_FORMAT, {"\"name\"", "string"}},
    {POINT("\"intensity\": \"bright\""), TL_ERR_FORMAT, {"\"intensity\"", "number"}},
    {POINT("\"intensity\": null"), TL_ERR_FORMAT, {"\"intensity\"", "number"}},
    {POINT("\"color\": [1, 1, 1, 1]"), TL_ERR_FORMAT, {"\"color\"", "three"}},
    {POINT("\"color\": [1, true, 1]"), TL_ERR_FORMAT, {"\"color\"", "number"}},
    {POINT("\"falloff\": 2"), TL_ERR_FORMAT, {"\"falloff\""}},

    /* No finite number, or out of range. */
    {POINT("\"intensity\": NaN"), TL_ERR_FORMAT, {"line 1", "NaN"}},
    {POINT("\"intensity\": Infinity"), TL_ERR_FORMAT, {"line 1", "Infinity"}},
    {POINT("\"intensity\": -Infinity"), TL_ERR_FORMAT, {"line 1", "-"}},
    {POINT("\"intensity\": 1e999"), TL_ERR_FORMAT, {"line 1", "overflow"}},
    {POINT("\"intensity\": 1e39"), TL_ERR_FORMAT, {"lights[0]", "\"intensity\"", "1e+39"}},
    {POINT("\"intensity\": 99999999999999999999"), TL_ERR_FORMAT, {"line 1", "integer"}},
    {POINT("\"intensity\": -1"), TL_ERR_FORMAT, {"lights[0]", "intensity"}},
    {POINT("\"color\": [0, -0.5, 0]"), TL_ERR_FORMAT, {"color"}},
    {POINT("\"range\": 0"), TL_ERR_FORMAT, {"range"}},
    {POINT("\"falloff\": \"linear\""), TL_ERR_FORMAT, {"linear", "range"}},
    {POINT("\"falloff\": \"linear\", \"range\": 2, \"begin\": 2.5"),
     TL_ERR_FORMAT,
     {"lights[0]", "begin", "2.5", "2"}},
    {POINT("\"falloff\": \"linear\", \"range\": 2, \"begin\": -1"),
     TL_ERR_FORMAT,
     {"begin", "-1"}},
    {POINT("\"range\": 2, \"begin\": 1"), TL_ERR_FORMAT, {"begin", "linear"}},
    {LIGHT("\"type\": \"directional\", \"direction\": [0, 0, 1], \"begin\": 1"),
     TL_ERR_FORMAT,
     {"directional light has no \"begin\""}},
    {SPOT("\"innerConeAngle\": 1.0, \"outerConeAngle\": 0.5"),
     TL_ERR_FORMAT,
     {"innerConeAngle"}},
    {SPOT("\"outerConeAngle\": 3.2"), TL_ERR_FORMAT, {"outerConeAngle"}},
    {LIGHT("\"type\": \"directional\", \"direction\": [0, 0, 0]"),
     TL_ERR_FORMAT,
     {"\"direction\"", "length"}},
    /* Rows of materials. */
    {ROWS("3"), TL_ERR_FORMAT, {"materials[0]:", "object"}},
    {ROWS("{ \"model\": \"gouraud\" }"), TL_ERR_FORMAT, {"materials[0]:", "\"gouraud\""}},
    {ROW("\"shinines\": 3"),
     TL_ERR_FORMAT,
     {"materials[0]:", "\"shinines\"", "did you mean \"shininess\""}},
    {ROWS("{}, { \"index\": 0 }"), TL_ERR_FORMAT, {"materials[1]:", "\"index\"", "1 to 255"}},
    {ROW("\"index\": 256"), TL_ERR_FORMAT, {"materials[0]:", "\"index\"", "1 to 255"}},
    {ROW("\"index\": 1.0"), TL_ERR_FORMAT, {"\"index\"", "whole number"}},
    {ROW("\"index\": \"Gold\""), TL_ERR_FORMAT, {"\"index\"", "whole number"}},
    {ROWS("{ \"index\": 2 }, {}"), TL_ERR_FORMAT, {"materials[1]:", "index 2", "materials[0]"}},
    {ROWS("{ \"index\": 7 }, { \"index\": 9 }, { \"index\": 7 }"),
     TL_ERR_FORMAT,
     {"materials[2]:", "index 7", "materials[0]"}},
    {ROWS("{ \"material\": \"Gold\" }, { \"material\": \"Gold\" }"),
     TL_ERR_FORMAT,
     {"materials[1] \"Gold\":", "materials[0]"}},
    {ROW("\"index\": 1, \"material\": \"Gold\""),
     TL_ERR_FORMAT,
     {"materials[0] \"Gold\":", "exclude"}},
    {ROW("\"material\": 1"), TL_ERR_FORMAT, {"\"material\"", "name"}},
    {ROW("\"material\": \"\""), TL_ERR_FORMAT, {"\"material\"", "name"}},
    {ROW("\"material\": \"" LONG_NAME "\""), TL_ERR_FORMAT, {"127 bytes", "\"index\""}},
    {ROW("\"shininess\": 10001"), TL_ERR_FORMAT, {"materials[0]:", "shininess", "0 to 10000"}},
    {ROW("\"specular\": [0, 1.5, 0]"), TL_ERR_FORMAT, {"\"specular\"", "1.5", "0 to 1"}},
    {ROW("\"diffuse\": 0.5"), TL_ERR_FORMAT, {"\"diffuse\"", "three numbers"}},
    {ROW("\"diffuse\": [0, -1, 0]"), TL_ERR_FORMAT, {"\"diffuse\"", "-1"}},
    {ROWS("{ \"model\": \"lambert\", \"specular\": [1, 1, 1] }"),
     TL_ERR_FORMAT,
     {"materials[0]:", "lambert takes no \"specular\""}},
    {FILE_WITH("\"materials\": [ { \"shininess\": 5 } ], \"model\": \"lambert\""),
     TL_ERR_FORMAT,
     {"materials[0]:", "lambert takes no \"shininess\""}},

    {FILE_WITH("\"ambient\": [-1, 0, 0]"), TL_ERR_FORMAT, {"ambient[0] is -1"}},
    {FILE_WITH("\"sky\": { \"type\": \"constant\", \"color\": [0, 0, 1e38] }"),
     TL_ERR_FORMAT,
     {"sky: color[2] is 1e+38, it must be from 0 to 1e+30"}},
};

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err = {.status = TL_OK};
        tl_light_set set = {.ambient = {7.0f}};
        const tl_status status = tl_lights_parse(cases[i].text, strlen(cases[i].text),
                                                 "lights.json", NULL, &set, &err);
        assert_refused(cases[i].text, status, cases[i].status, &err, cases[i].words);
        assert_int_equal(strncmp(err.message, "lights.json:", 12), 0);
        assert_true(same_bits(set.ambient[0], 7.0f));
        assert_null(set.lights);
    }
}

static void truncations_are_refused(void **state)
{
    static const char text[] =
        SPOT("\"name\": \"a\\u00e4\\\"b\", \"range\": 2.5e0, \"color\": [1, 0.5, 2]");
    (void)state;
    tl_error err;
    tl_light_set set = {0};
    ASSERT_OK(tl_lights_parse(text, sizeof text - 1, "cut.json", NULL, &set, &err), err);
    tl_light_set_clear(&set);
    for (size_t length = 0; length < sizeof text - 1; length++) {
        /* A copy of the exact size, so that a sanitizer sees reading beyond it. */
        char *cut = malloc(length ? length : 1);
        assert_non_null(cut);
        memcpy(cut, text, length);
        if (tl_lights_parse(cut, length, "cut.json", NULL, &set, &err) != TL_ERR_FORMAT ||
            !strstr(err.message, "cut.json"))
            fail_msg("cut to %zu bytes: %s", length, err.message);
        assert_null(set.lights);
        free(cut);
    }
}

/* A million opening brackets must not take the stack. */
static void deep_nesting(void **state)
{
    static const char *const words[] = {"deep.json", NULL};
    const size_t depth = 1000000;
    (void)state;
    tl_error err;
    tl_light_set set = {0};
    char *text = malloc(depth);
    assert_non_null(text);
    memset(text, '[', depth);
    assert_refused("deep", tl_lights_parse(text, depth, "deep.json", NULL, &set, &err),
                   TL_ERR_FORMAT, &err, words);
    free(text);
}

/* Of 256 rows, whatever is in them. */
static void more_rows_than_indices(void **state)
{
    static const char *const words[] = {"256 materials", "255 at most", NULL};
    (void)state;
    tl_error err;
    for (int count = 255; count <= 256; count++) {
        tl_light_set set = {0};
        char *text = malloc(4096), *end = text;
        assert_non_null(text);
        end += sprintf(end, "{ \"tilelight\": 1, \"materials\": [ {}");
        for (int i = 1; i < count; i++)
            end += sprintf(end, ", {}");
        end += sprintf(end, " ] }");
        const tl_status status =
            tl_lights_parse(text, (size_t)(end - text), "rows.json", NULL, &set, &err);
        if (count == 255)
            ASSERT_OK(status, err);
        else
            assert_refused("rows", status, TL_ERR_FORMAT, &err, words);
        tl_light_set_clear(&set);
        free(text);
    }
}

static void too_large(void **state)
{
    static const char *const words[] = {"64 MiB", NULL};
    const size_t size = ((size_t)64 << 20) + 1;
    (void)state;
    char path[512];
    tl_error err;
    tl_light_set set = {0};
    char *text = malloc(size);
    assert_non_null(text);
    memset(text, ' ', size);
    scratch_path(path, sizeof path, "large.json");
    assert_refused("text", tl_lights_parse(text, size, "large.json", NULL, &set, &err),
                   TL_ERR_FORMAT, &err, words);
    save_bytes(path, text, size);
    assert_refused("file", tl_lights_read(path, &set, &err), TL_ERR_FORMAT, &err, words);
    remove(path);
    free(text);
}

/* What could not be read back is not written: a position of 9 digits and a name, 140 bytes each. */
static void too_many_to_write(void **state)
{
    static const char *const words[] = {"500000 lights", "64 at most", NULL};
    (void)state;
    tl_error err;
    tl_light_set set = {0};
    tl_light light = tl_light_default();
    char *text = NULL;
    for (int i = 0; i < 3; i++)
        light.position[i] = 1.0f / 3.0f;
    memset(light.name, 'n', sizeof light.name - 1);
    for (int i = 0; i < 500000; i++)
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    assert_refused("many", tl_lights_format(&set, NULL, &text, &err), TL_ERR_WRITE, &err,
                   words);
    assert_null(text);
    tl_light_set_clear(&set);
}

static void files_that_are_none(void **state)
{
    static const char *const absent[] = {"absent.json", "cannot be opened", NULL};
    static const char *const folder[] = {"cannot be read", NULL};
    static const char *const full_words[] = {"No space", NULL};
    (void)state;
    char path[512], full[512];
    tl_error err;
    tl_light_set set = {0};
    scratch_path(path, sizeof path, "absent.json");
    remove(path); /* of a run that failed */
    assert_refused("absent", tl_lights_read(path, &set, &err), TL_ERR_READ, &err, absent);
    assert_refused("folder", tl_lights_read("/", &set, &err), TL_ERR_READ, &err, folder);
    own_device(full, sizeof full, "lights_full", 7);
    assert_refused("full", tl_lights_write(full, &set, &err), TL_ERR_WRITE, &err, full_words);
    remove_device(full);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_wrong_is_named),
        cmocka_unit_test(truncations_are_refused),
        cmocka_unit_test(deep_nesting),
        cmocka_unit_test(more_rows_than_indices),
        cmocka_unit_test(too_large),
        cmocka_unit_test(too_many_to_write),
        cmocka_unit_test(files_that_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
