/* Which row does each index of a capture lead to, and is what leads nowhere refused with a sentence? */
#include "frames.h"

#include "brdf_table.h"

enum { WIDTH = 6, HEIGHT = 2 };

/* Pixels have these indices, by turns; materials of these names, which end with NULL. Repaired. */
static tl_gbuffer *capture_of(uint32_t present, const float *indices, const char *const *names)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, present, 3);
    tl_error err;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const size_t at = (size_t)(i / WIDTH) * g->pitch + i % WIDTH;
        set_pixel(g, TL_DEPTH, at, 4.0f);
        set_pixel(g, TL_NORMAL_Z, at, 1.0f);
        set_pixel(g, TL_BRDF, at, indices[i % 4]);
    }
    for (; *names; names++)
        ASSERT_OK(tl_material_names_add(&g->materials, *names, &err), err);
    ASSERT_OK(tl_gbuffer_repair(g, "capture", true, NULL, &err), err);
    return g;
}

/* A row of a set: for an index, or for a material. */
typedef struct row {
    uint32_t index;
    const char *material;
    enum tl_shading_model model;
} row;

static tl_light_set set_of(const row *rows, size_t count)
{
    tl_light_set set = {.model = TL_MODEL_PHONG};
    tl_error err;
    for (size_t i = 0; i < count; i++) {
        tl_material_row made = tl_material_row_default();
        made.index = rows[i].index;
        made.model = rows[i].model;
        snprintf(made.material, sizeof made.material, "%s",
                 rows[i].material ? rows[i].material : "");
        ASSERT_OK(tl_light_set_add_material(&set, &made, &err), err);
    }
    return set;
}

#define PLANES (TL_GROUP_BASE | TL_GROUP_BRDF)
#define M(model) (1u << TL_MODEL_##model)

static const char *const no_names[] = {NULL};
static const char *const two_golds[] = {"Gold", "", "Gold", "Lead", NULL};

static const struct {
    const char *name;
    uint32_t present;
    float indices[4];
    const char *const *names;
    size_t row_count;
    row rows[3];
    uint32_t models; /* expected */
    int selects;
    int sources[4]; /* expected, of indices[] */
} good[] = {
    {"no rows", PLANES, {0, 1, 2, 3}, no_names, 0, {{0}}, M(PHONG), 0, {-1, -1, -1, -1}},
    {"by index",
     PLANES,
     {0, 1, 255, 1},
     no_names,
     2,
     {{1, NULL, TL_MODEL_LAMBERT}, {255, NULL, TL_MODEL_BLINN_PHONG_NORMALIZED}},
     M(PHONG) | M(LAMBERT) | M(BLINN_PHONG_NORMALIZED),
     1,
     {-1, 0, 1, 0}},
    {"one name of two materials",
     PLANES,
     {1, 3, 4, 4},
     two_golds,
     1,
     {{0, "Gold", TL_MODEL_LAMBERT}},
     M(PHONG) | M(LAMBERT),
     1,
     {0, 0, -1, -1}},
    {"an index and a name",
     PLANES,
     {2, 4, 2, 4},
     two_golds,
     2,
     {{0, "Lead", TL_MODEL_LAMBERT}, {2, NULL, TL_MODEL_LAMBERT}},
     M(LAMBERT),
     1,
     {1, 0, 1, 0}},
    {"rows for what does not occur",
     PLANES,
     {0, 0, 2, 2},
     two_golds,
     2,
     {{0, "Lead", TL_MODEL_LAMBERT}, {77, NULL, TL_MODEL_LAMBERT}},
     M(PHONG),
     0,
     {-1, -1, -1, -1}},
    {"a capture without indices",
     TL_GROUP_BASE,
     {0, 0, 0, 0},
     no_names,
     1,
     {{1, NULL, TL_MODEL_LAMBERT}},
     M(PHONG),
     0,
     {-1, -1, -1, -1}},
};

static void rows_are_found(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        tl_gbuffer *g = capture_of(good[i].present, good[i].indices, good[i].names);
        tl_light_set set = set_of(good[i].rows, good[i].row_count);
        tl_brdf_table table;
        tl_error err;
        ASSERT_OK(tl_brdf_table_make(g, &set, &table, &err), err);
        if (table.models != good[i].models || table.selects != good[i].selects)
            fail_msg("%s: models %x, selects %d", good[i].name, table.models, table.selects);
        for (int k = 0; k < 4; k++) {
            const uint32_t index = (uint32_t)good[i].indices[k];
            const int source = good[i].sources[k];
            if (table.sources[index] != source)
                fail_msg("%s: index %u has row %d, not %d", good[i].name, index,
                         table.sources[index], source);
            assert_int_equal(table.rows[index].model,
                             source < 0 ? TL_MODEL_PHONG : good[i].rows[source].model);
        }
        tl_light_set_clear(&set);
        tl_gbuffer_destroy(g);
    }
}

/* Indices that nobody has looked for may all occur, as far as they have rows. */
static void indices_may_be_unknown(void **state)
{
    static const float indices[4] = {0, 0, 0, 9};
    static const row rows[] = {{1, NULL, TL_MODEL_LAMBERT}};
    (void)state;
    tl_gbuffer *g = capture_of(PLANES, indices, no_names);
    tl_light_set set = set_of(rows, 1);
    tl_brdf_table table;
    tl_error err;
    g->knows_indices = false;
    ASSERT_OK(tl_brdf_table_make(g, &set, &table, &err), err);
    assert_int_equal(table.models, M(PHONG) | M(LAMBERT));
    assert_true(table.selects);
    tl_light_set_clear(&set);
    tl_gbuffer_destroy(g);
}

static const struct {
    const char *name;
    float indices[4];
    const char *const *names;
    size_t row_count;
    row rows[2];
    const char *words[4]; /* ends with NULL */
} bad[] = {
    {"an index without row or name",
     {0, 1, 2, 7},
     no_names,
     2,
     {{1, NULL, 0}, {2, NULL, 0}},
     {"index 7", "no row", "\"index\": 7"}},
    {"one above the names", {0, 4, 5, 1}, two_golds, 1, {{1, NULL, 0}}, {"index 5"}},
    {"a material that is not there",
     {0, 1, 1, 1},
     two_golds,
     1,
     {{0, "Golden", 0}},
     {"materials[0] \"Golden\"", "\"Gold\", \"Gold\", \"Lead\""}},
    {"names that nobody gave",
     {0, 1, 1, 1},
     no_names,
     2,
     {{1, NULL, 0}, {0, "Gold", 0}},
     {"materials[1] \"Gold\"", "names no materials", "--materials"}},
    {"an index and the name of it",
     {0, 1, 1, 1},
     two_golds,
     2,
     {{0, "Gold", 0}, {3, NULL, 0}},
     {"materials[0] \"Gold\"", "index 3", "materials[1]"}},
};

static void what_leads_nowhere_is_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        tl_gbuffer *g = capture_of(PLANES, bad[i].indices, bad[i].names);
        tl_light_set set = set_of(bad[i].rows, bad[i].row_count);
        tl_brdf_table table;
        tl_error err = {.message = ""};
        if (tl_brdf_table_make(g, &set, &table, &err) != TL_ERR_FORMAT)
            fail_msg("%s: is not refused", bad[i].name);
        for (int k = 0; bad[i].words[k]; k++)
            if (!strstr(err.message, bad[i].words[k]))
                fail_msg("%s: \"%s\" does not say %s", bad[i].name, err.message,
                         bad[i].words[k]);
        tl_light_set_clear(&set);
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_found),
        cmocka_unit_test(indices_may_be_unknown),
        cmocka_unit_test(what_leads_nowhere_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
