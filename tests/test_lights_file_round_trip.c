/* Do lights come back bit for bit from the text they are written as, and does a file mean what it
 * says? */
#include "file_cases.h"

#include "material_rows.h"
#include "tilelight/lights.h"

#include <float.h>
#include <unistd.h>

static const float awkward[] = {
    0.1f,          1.0f / 3.0f, FLT_MIN,     FLT_TRUE_MIN, 0x1.fffffep-1f, 16777217.0f,
    123456789.0f,  1e17f,       0x1.8p-140f, 3e17f,        0.0f,           0x1.000002p0f,
    0x1.99999ap3f, 3e-45f,      8.5e9f,      2.0f,
};

static float next_awkward(uint32_t *random)
{
    uint32_t bits = next_random(random) >> 1;
    float value;
    if ((bits >> 20 & 3) == 0)
        return awkward[bits % COUNT_OF(awkward)];
    bits = (bits & 0x007fffff) | (60u + (bits >> 23) % 120u) << 23;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* A unit vector as a program makes one: normalised in double, rounded to float. */
static void next_direction(uint32_t *random, float out[3])
{
    double v[3], length2 = 0.0;
    for (int i = 0; i < 3; i++) {
        v[i] = (double)(next_random(random) >> 8) * 0x1p-23 - 1.0;
        length2 += v[i] * v[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] / sqrt(length2));
}

/* A falloff table of the set's, of a size and numbers of its own. */
static uint32_t next_table(uint32_t *random, tl_light_set *set)
{
    float values[40];
    uint32_t table = 0;
    tl_error err;
    const uint32_t count = 2 + (next_random(random) >> 16) % 39;
    for (uint32_t i = 0; i < count; i++)
        values[i] = fminf(next_awkward(random), TL_MOST_WEIGHT);
    ASSERT_OK(tl_light_set_add_table(set, values, count, &table, &err), err);
    return table;
}

/* tables: of the set that it becomes part of; NULL: it has none. */
static tl_light next_light(uint32_t *random, tl_light_set *tables)
{
    static const char *const groups[] = {"", "\"", "k\xc3\xa9", "key"};
    tl_light light = tl_light_default();
    light.type = (tl_light_type)((next_random(random) >> 16) % TL_LIGHT_TYPE_COUNT);
    for (int i = 0; i < 3; i++) {
        light.color[i] = next_awkward(random);
        if (light.type != TL_LIGHT_DIRECTIONAL)
            light.position[i] = next_awkward(random) * (i == 1 ? -1.0f : 1.0f);
    }
    if (light.type != TL_LIGHT_POINT)
        next_direction(random, light.direction);
    light.intensity = next_awkward(random);
    light.diffuse = next_awkward(random);
    light.specular = next_awkward(random);
    if (next_random(random) >> 31)
        light.ambient = next_awkward(random);
    light.casts_shadow = next_random(random) >> 31;
    if (light.type != TL_LIGHT_DIRECTIONAL && next_random(random) >> 31) {
        light.range = next_awkward(random) + FLT_MIN;
        light.falloff = (tl_falloff)((next_random(random) >> 16) %
                                     (tables ? TL_FALLOFF_COUNT : TL_FALLOFF_TABLE));
        if (light.falloff == TL_FALLOFF_TABLE)
            light.table = next_table(random, tables);
        if (light.falloff == TL_FALLOFF_LINEAR && next_random(random) >> 31)
            light.begin = fminf(next_awkward(random), light.range);
    }
    if (light.type == TL_LIGHT_SPOT) {
        light.outer_cone = (float)(next_random(random) >> 8) * 0x1p-23f;
        light.inner_cone = light.outer_cone * 0.7f;
    }
    snprintf(light.name, sizeof light.name, "light \"%u\" \\ \t\xc3\xa4\xe2\x82\xac",
             next_random(random));
    strcpy(light.group, groups[next_random(random) >> 30]);
    return light;
}

static void assert_same_lights(const tl_light_set *a, const tl_light_set *b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->ambient, b->ambient, sizeof a->ambient);
    assert_true(same_bits(a->occlusion_radius, b->occlusion_radius));
    assert_int_equal(a->sky_type, b->sky_type);
    assert_memory_equal(a->sky, b->sky, sizeof a->sky);
    assert_true(same_bits(a->sky_light, b->sky_light));
    assert_memory_equal(a->zenith, b->zenith, sizeof a->zenith);
    assert_memory_equal(a->ground, b->ground, sizeof a->ground);
    assert_int_equal(a->table_count, b->table_count);
    for (size_t i = 0; i < a->table_count; i++) {
        assert_int_equal(a->tables[i].count, b->tables[i].count);
        assert_memory_equal(a->tables[i].values, b->tables[i].values,
                            a->tables[i].count * sizeof(float));
    }
    assert_int_equal(a->model, b->model);
    assert_int_equal(a->has_shininess, b->has_shininess);
    assert_true(same_bits(a->shininess, b->shininess));
    assert_int_equal(a->material_count, b->material_count);
    for (size_t i = 0; i < a->material_count; i++) {
        const tl_material_row *x = &a->materials[i], *y = &b->materials[i];
        assert_string_equal(x->material, y->material);
        assert_int_equal(x->material[0] ? 0 : x->index, y->material[0] ? 0 : y->index);
        assert_memory_equal(&x->model, &y->model, sizeof *x - offsetof(tl_material_row, model));
    }
    for (size_t i = 0; i < a->count; i++) {
        assert_string_equal(a->lights[i].name, b->lights[i].name);
        assert_string_equal(a->lights[i].group, b->lights[i].group);
        if (memcmp(&a->lights[i], &b->lights[i], offsetof(tl_light, name)) != 0)
            fail_msg("light %zu (%s) differs", i, a->lights[i].name);
    }
}

static void bit_for_bit(void **state)
{
    (void)state;
    tl_error err;
    tl_light_set set = {.ambient = {0.1f, 1e-40f, 3.0f},
                        .occlusion_radius = 0.3f,
                        .sky = {0.7f, 0.0f, 1e29f},
                        .sky_light = 0.35f},
                 back = {0};
    set.model = TL_MODEL_BLINN_PHONG_NORMALIZED;
    set.has_shininess = 1;
    set.shininess = 12.3f;
    uint32_t random = 1;
    char *text = NULL;
    for (int i = 0; i < 3000; i++) {
        const tl_light light = next_light(&random, &set);
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    }
    set.sky_type = TL_SKY_GRADIENT;
    memcpy(set.zenith, (float[]){0.1f, 0x1.fffffep-1f, 3e-45f}, sizeof set.zenith);
    memcpy(set.ground, (float[]){1e30f, 0.0f, 0.3f}, sizeof set.ground);
    ASSERT_OK(tl_lights_format(&set, NULL, &text, &err), err);
    ASSERT_OK(tl_lights_parse(text, strlen(text), "text", NULL, &back, &err), err);
    assert_same_lights(&back, &set);
    free(text);
    tl_light_set_clear(&back);
    tl_light_set_clear(&set);
}

static float next_share(uint32_t *random)
{
    return (float)(next_random(random) >> 8) * 0x1p-24f;
}

/* What the model takes, each with a chance of one half; 255 rows. */
static void every_row_of_materials(void **state)
{
    (void)state;
    tl_error err;
    tl_light_set set = {0}, back = {0};
    uint32_t random = 3;
    char *text = NULL;
    for (uint32_t i = 0; i < 255; i++) {
        tl_material_row row = tl_material_row_default();
        float *const floats[] = {row.diffuse, row.specular, row.direction};
        row.model = (enum tl_shading_model)(i % TL_MODEL_COUNT);
        row.given = tl_model_takes(row.model) & next_random(&random) >> 8;
        row.index = 255 - i;
        if (i % 3 == 0)
            snprintf(row.material, sizeof row.material, "%u \"\xc3\xa4\"%.*s", i,
                     i == 0 ? 110 : 0,
                     "0123456789012345678901234567890123456789012345678901234567890123456789"
                     "0123456789012345678901234567890123456789");
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                if (row.given & (uint32_t)(k == 0   ? TL_TAKES_DIFFUSE
                                           : k == 1 ? TL_TAKES_SPECULAR
                                                    : TL_TAKES_DIRECTION))
                    floats[k][axis] = next_share(&random);
        if (row.given & TL_TAKES_EXPONENT)
            row.exponent = 1e4f * next_share(&random);
        if (row.given & TL_TAKES_ROUGHNESS)
            row.roughness = next_share(&random);
        if (row.given & TL_TAKES_ACROSS)
            row.across = next_share(&random);
        if (row.given & TL_TAKES_K)
            row.k = 3.0f * next_share(&random);
        ASSERT_OK(tl_light_set_add_material(&set, &row, &err), err);
    }
    ASSERT_OK(tl_lights_format(&set, NULL, &text, &err), err);
    ASSERT_OK(tl_lights_parse(text, strlen(text), "text", NULL, &back, &err), err);
    assert_same_lights(&back, &set);
    free(text);
    tl_light_set_clear(&back);
    tl_light_set_clear(&set);
}

/* Rows by hand: indices by position and given, the set's model where none is named, whichever comes first. */
static void rows_mean_what_they_say(void **state)
{
    static const char text[] =
        "{ \"tilelight\": 1, \"materials\": [\n"
        "    { \"shininess\": 30, \"specular\": [0.25, 0.5, 1] },\n"
        "    { \"index\": 9, \"model\": \"lambert\", \"diffuse\": [0, 0.5, 0] },\n"
        "    { \"material\": \"Gold\" } ],\n"
        "  \"model\": \"blinn-phong-normalized\" }";
    (void)state;
    tl_error err;
    tl_light_set set = {0};
    ASSERT_OK(tl_lights_parse(text, sizeof text - 1, "text", NULL, &set, &err), err);
    assert_int_equal(set.model, TL_MODEL_BLINN_PHONG_NORMALIZED);
    assert_int_equal(set.material_count, 3);
    const tl_material_row *row = set.materials;
    assert_int_equal(row[0].index, 1);
    assert_int_equal(row[0].model, TL_MODEL_BLINN_PHONG_NORMALIZED);
    assert_int_equal(row[0].given, TL_TAKES_EXPONENT | TL_TAKES_SPECULAR);
    assert_true(same_bits(row[0].exponent, 30.0f));
    assert_true(same_bits(row[0].specular[0], 0.25f) && same_bits(row[0].specular[2], 1.0f));
    assert_int_equal(row[1].index, 9);
    assert_int_equal(row[1].model, TL_MODEL_LAMBERT);
    assert_int_equal(row[1].given, TL_TAKES_DIFFUSE);
    assert_string_equal(row[2].material, "Gold");
    assert_int_equal(row[2].given, 0);
    tl_light_set_clear(&set);
}

static void negative_zero(void **state)
{
    (void)state;
    tl_error err;
    tl_light_set set = {0}, back = {0};
    tl_light light = tl_light_default();
    char *text = NULL;
    light.position[1] = -0.0f;
    ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    ASSERT_OK(tl_lights_format(&set, NULL, &text, &err), err);
    ASSERT_OK(tl_lights_parse(text, strlen(text), "text", NULL, &back, &err), err);
    assert_same_lights(&back, &set);
    free(text);
    tl_light_set_clear(&back);
    tl_light_set_clear(&set);
}

/* A name that was cut within a character is written up to it. */
static void cut_names(void **state)
{
    (void)state;
    tl_error err;
    tl_light_set set = {0}, back = {0};
    tl_light light = tl_light_default();
    char *text = NULL;
    strcpy(light.name, "caf\xc3");
    ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    ASSERT_OK(tl_lights_format(&set, NULL, &text, &err), err);
    ASSERT_OK(tl_lights_parse(text, strlen(text), "text", NULL, &back, &err), err);
    assert_string_equal(back.lights[0].name, "caf");
    free(text);
    tl_light_set_clear(&back);
    tl_light_set_clear(&set);
}

/* Everything a file can say, read by hand. */
static void meaning(void **state)
{
    static const char text[] =
        "{ \"tilelight\": 1, \"ambient\": [0.02, 0.5, 1], \"ambientOcclusion\": { \"radius\": "
        "0.75 },\n"
        "  \"sky\": { \"type\": \"constant\", \"color\": [0.1, 0.2, 4] },\n"
        "  \"materials\": { \"model\": \"blinn-phong-normalized\" },\n"
        "  \"lights\": [\n"
        "    { \"type\": \"directional\", \"direction\": [0, -3, 4], \"castsShadow\": false, "
        "\"group\": \"key\" },\n"
        "    { \"type\": \"point\", \"position\": [1, 2, 3], \"range\": 5, \"begin\": 1.5, "
        "\"ambient\": 0.25,\n"
        "      \"falloff\": \"linear\", \"diffuse\": 0.5, \"specular\": 0, \"name\": \"lamp\" "
        "},\n"
        "    { \"type\": \"spot\", \"position\": [0, 4, 0], \"direction\": [0, -1, 0],\n"
        "      \"color\": [1, 0.5, 0.25], \"intensity\": 50, \"range\": 12,\n"
        "      \"innerConeAngle\": 0.25, \"outerConeAngle\": 0.5, \"castsShadow\": true,\n"
        "      \"falloff\": \"inverse-square\" } ] }";
    (void)state;
    tl_error err;
    tl_light_set set = {0}, wanted = {.ambient = {0.02f, 0.5f, 1.0f},
                                      .occlusion_radius = 0.75f,
                                      .sky = {0.1f, 0.2f, 4.0f}};
    wanted.model = TL_MODEL_BLINN_PHONG_NORMALIZED;
    tl_light sun = tl_light_default(), lamp = tl_light_default(), spot = tl_light_default();
    sun.type = TL_LIGHT_DIRECTIONAL;
    strcpy(sun.group, "key");
    memcpy(sun.direction, (float[]){0.0f, -0.6f, 0.8f}, sizeof sun.direction);
    memcpy(lamp.position, (float[]){1.0f, 2.0f, 3.0f}, sizeof lamp.position);
    lamp.range = 5.0f;
    lamp.begin = 1.5f;
    lamp.ambient = 0.25f;
    lamp.falloff = TL_FALLOFF_LINEAR;
    lamp.diffuse = 0.5f;
    lamp.specular = 0.0f;
    strcpy(lamp.name, "lamp");
    spot.type = TL_LIGHT_SPOT;
    memcpy(spot.position, (float[]){0.0f, 4.0f, 0.0f}, sizeof spot.position);
    memcpy(spot.direction, (float[]){0.0f, -1.0f, 0.0f}, sizeof spot.direction);
    memcpy(spot.color, (float[]){1.0f, 0.5f, 0.25f}, sizeof spot.color);
    spot.intensity = 50.0f;
    spot.range = 12.0f;
    spot.inner_cone = 0.25f;
    spot.outer_cone = 0.5f;
    spot.casts_shadow = 1;
    ASSERT_OK(tl_light_set_add(&wanted, &sun, &err), err);
    ASSERT_OK(tl_light_set_add(&wanted, &lamp, &err), err);
    ASSERT_OK(tl_light_set_add(&wanted, &spot, &err), err);
    ASSERT_OK(tl_lights_parse(text, sizeof text - 1, "text", NULL, &set, &err), err);
    assert_same_lights(&set, &wanted);
    tl_light_set_clear(&set);
    tl_light_set_clear(&wanted);
}

static void through_a_file(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_light_set set = {0}, back = {0};
    uint32_t random = 9;
    scratch_path(path, sizeof path, "lights.json");
    ASSERT_OK(tl_lights_write(path, &set, &err), err);
    ASSERT_OK(tl_lights_read(path, &back, &err), err);
    assert_same_lights(&back, &set);
    /* More than the buffer that reading starts with; what `back` held is released. */
    for (int i = 0; i < 1000; i++) {
        const tl_light light = next_light(&random, NULL);
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
        ASSERT_OK(tl_light_set_add(&back, &light, &err), err);
    }
    ASSERT_OK(tl_lights_write(path, &set, &err), err);
    ASSERT_OK(tl_lights_read(path, &back, &err), err);
    assert_same_lights(&back, &set);
    tl_light_set_clear(&back);
    tl_light_set_clear(&set);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bit_for_bit),
        cmocka_unit_test(negative_zero),
        cmocka_unit_test(cut_names),
        cmocka_unit_test(meaning),
        cmocka_unit_test(through_a_file),
        cmocka_unit_test(every_row_of_materials),
        cmocka_unit_test(rows_mean_what_they_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
