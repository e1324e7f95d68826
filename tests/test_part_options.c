/* Do frames have one culling program exactly where culling reads the same of them, and one program of
 * surroundings where those do?
 *
 * The oracle knows no table: frames of every layout and of several sets of planes, of the same size, have the
 * same random bytes, and are read alike where every pixel has the same bits. */
#include "packed_frames.h"

#include "part_options.h"

enum { WIDTH = 30, HEIGHT = 20, NUMBERS = 6 };

/* A frame of random bytes as it is read. */
typedef struct reading {
    tl_kernel_options options;
    float numbers[WIDTH * HEIGHT][NUMBERS]; /* of each pixel: its position, its normal */
} reading;

static const uint32_t wanted[] = {
    TL_GROUP_BASE, TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_TANGENT};

enum { FRAME_COUNT = TL_LAYOUT_COUNT * COUNT_OF(wanted) };

static void read_random(enum tl_layout_name layout, uint32_t present, reading *out)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = NULL;
    uint32_t seed = 2009;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create_packed(&camera, layout, present, &g, &err), err);
    for (size_t i = 0; i < gbuffer_bytes(g) / 4; i++) {
        uniform(&seed, 0.0f, 1.0f);
        memcpy(g->planes + 4 * i, &seed, 4);
    }
    const tl_unpacking from = tl_unpacking_of(g);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint32_t x = i % WIDTH, y = i / WIDTH;
        const tl_words words = tl_words_at(&from.words, (size_t)y * g->pitch + x);
        const vec3 read[] = {
            position_of(&from.frame, from.needs, from.words.layout, &words, (real)x, (real)y),
            normal_of(&from.frame, from.words.layout, &words)};
        memcpy(out->numbers[i], read, sizeof read);
    }
    out->options = (tl_kernel_options){.width = 1, .layout = layout, .present = present};
    tl_gbuffer_destroy(g);
}

static reading *read_all(void)
{
    reading *all = calloc(FRAME_COUNT, sizeof *all);
    assert_non_null(all);
    for (size_t i = 0; i < FRAME_COUNT; i++) {
        const enum tl_layout_name layout = (enum tl_layout_name)(i / COUNT_OF(wanted));
        read_random(layout, tl_layout_planes_of(layout, wanted[i % COUNT_OF(wanted)]), &all[i]);
    }
    return all;
}

/* By their first `count` numbers a pixel. */
static int same_numbers(const reading *a, const reading *b, size_t count)
{
    for (size_t i = 0; i < COUNT_OF(a->numbers); i++)
        if (memcmp(a->numbers[i], b->numbers[i], count * sizeof(float)) != 0)
            return 0;
    return 1;
}

static int same_options(tl_program_part part,
                        const tl_kernel_options *a,
                        const tl_kernel_options *b)
{
    const tl_kernel_options of_a = tl_part_options(part, a), of_b = tl_part_options(part, b);
    return memcmp(&of_a, &of_b, sizeof of_a) == 0;
}

static void frames_share_where_they_are_read_alike(void **state)
{
    static const struct {
        const char *name;
        tl_program_part part;
        size_t numbers;
    } parts[] = {{"culling", TL_PART_CULL, 3}, {"surroundings", TL_PART_OCCLUDE, 6}};
    reading *all = read_all();
    (void)state;
    for (size_t p = 0; p < COUNT_OF(parts); p++)
        for (size_t i = 0; i < FRAME_COUNT; i++)
            for (size_t j = 0; j <= i; j++) {
                const tl_kernel_options *a = &all[i].options, *b = &all[j].options;
                const int same = same_options(parts[p].part, a, b);
                if (same != same_numbers(&all[i], &all[j], parts[p].numbers))
                    fail_msg("%s of %s, planes %x, and of %s, planes %x, %s", parts[p].name,
                             tl_layout_word(a->layout), a->present, tl_layout_word(b->layout),
                             b->present,
                             same ? "are shared, though they differ" : "are not shared");
            }
    free(all);
}

/* Whether another value of a field is another program, of each part. */
static void parts_differ_by_what_they_read(void **state)
{
    static const struct {
        const char *name;
        size_t field;
    } fields[] = {
#define FIELD(macro, field) {#field, offsetof(tl_kernel_options, field)},
        TL_KERNEL_OPTIONS(FIELD)
#undef FIELD
#define KNOB(name, flag, word, usual, rows, kind, kinds, meaning) \
    {word, offsetof(tl_kernel_options, approximations.of[name])},
            TL_KNOBS(KNOB)
#undef KNOB
    };
    static const char *const cull = " width by_pixel real_double orthographic spots ";
    static const char *const occlude = " width by_pixel real_double orthographic surroundings ";
    static const char *const blend = " width by_pixel real_double ";
    const tl_kernel_options plain = {.width = 1, .present = TL_GROUP_BASE};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        tl_kernel_options other = plain;
        char word[64];
        if (fields[i].field == offsetof(tl_kernel_options, layout) ||
            fields[i].field == offsetof(tl_kernel_options, present))
            continue; /* these depend on each other: above */
        snprintf(word, sizeof word, " %s ", fields[i].name);
        *(uint32_t *)(void *)((char *)&other + fields[i].field) += 1;
        if (same_options(TL_PART_CULL, &plain, &other) != !strstr(cull, word) ||
            same_options(TL_PART_OCCLUDE, &plain, &other) != !strstr(occlude, word) ||
            same_options(TL_PART_BLEND, &plain, &other) != !strstr(blend, word) ||
            same_options(TL_PART_SHADE, &plain, &other))
            fail_msg("%s", fields[i].name);
    }
}

static const tl_program *culling_of(tl_device *device, enum tl_layout_name layout)
{
    const tl_kernel_options options = {
        .width = 1, .by_pixel = 1, .layout = layout, .present = TL_GROUP_BASE};
    const tl_program *found = NULL;
    tl_error err;
    ASSERT_OK(tl_program_find(device, TL_PART_CULL, &options, NULL, &found, &err), err);
    return found;
}

static void a_device_builds_what_is_shared_once(void **state)
{
    const tl_program *metres = culling_of(*state, TL_LAYOUT_FLOAT);
    const tl_program *forward = culling_of(*state, TL_LAYOUT_ISPC);
    assert_ptr_equal(culling_of(*state, TL_LAYOUT_COMPACT_16), metres);
    assert_ptr_equal(culling_of(*state, TL_LAYOUT_FLOAT_FORWARD), forward);
    assert_ptr_not_equal(metres, forward);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_share_where_they_are_read_alike),
        cmocka_unit_test(parts_differ_by_what_they_read),
        cmocka_unit_test_setup_teardown(a_device_builds_what_is_shared_once, open_device,
                                        close_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
