/* Do passes need the words of a pixel that are counted for them: those, all of them, and no others? */
#include "testing.h"

#include "layout.h"
#include "pass_bytes.h"
#include "tilelight/layouts.h"
#include "unpack.h"

enum { ROUNDS = 500 };

/* What frames can have, of which each layout takes what it holds. */
static const uint32_t contents[] = {
    TL_GROUP_BASE,
    TL_GROUP_BASE | TL_GROUP_PHONG,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
    TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
};

static const tl_frame frame = {
    .rays = {-0.9f, 0.01f, 0.5f, -0.01f},
    .view_from_world = {{0.6f, 0, 0.8f, 1}, {0, 1, 0, -2}, {-0.8f, 0, 0.6f, 3}},
    .ambient = {0.1f, 0.2f, 0.3f},
    .sky = {0.5f, 0.6f, 0.7f},
    .depth_slope = 9.99f,
    .depth_offset = 0.01f,
};

static uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state ^ *state >> 15;
}

/* The results of the three steps, as numbers: what passes keep of a pixel. */
typedef struct results {
    float positions[3], surfaces[10], colors[3];
} results;

static results results_of(tl_needs needs, const tl_words *words)
{
    const tl_layout *layout = &tl_layouts[needs.layout];
    const received light = {
        .diffuse = {1, 2, 3}, .specular = {3, 2, 1}, .ambient = {2, 1, 3}};
    const vec3 p = position_of(&frame, needs, layout, words, 17, 4);
    const surface s = unpacked_surface(&frame, needs, layout, words, NULL, 17, 4);
    const pixel in = pixel_of(needs, layout, words, 5.0f);
    const vec3 out = radiance_of(&frame, needs, in, substance_of(&frame, needs, in), light);
    return (results){
        .positions = {p.x, p.y, p.z},
        .surfaces = {s.position.x, s.position.y, s.position.z, s.normal.x, s.normal.y,
                     s.normal.z, s.to_eye.x, s.to_eye.y, s.to_eye.z,
                     needs.specular ? s.shininess : 0.0f},
        .colors = {out.x, out.y, out.z},
    };
}

static const struct {
    const char *name;
    size_t offset, size;
    size_t words; /* in tl_pass_words */
} steps[] = {
    {"positions", offsetof(results, positions), sizeof((results *)0)->positions,
     offsetof(tl_pass_words, positions)},
    {"surfaces", offsetof(results, surfaces), sizeof((results *)0)->surfaces,
     offsetof(tl_pass_words, surfaces)},
    {"colours", offsetof(results, colors), sizeof((results *)0)->colors,
     offsetof(tl_pass_words, colors)},
};

/* Steps, as bits, whose results change in some of many pixels where word `word` becomes another. */
static unsigned steps_that_need(tl_needs needs, uint32_t word)
{
    unsigned changed = 0;
    uint32_t random = 12345 + word;
    for (int round = 0; round < ROUNDS; round++) {
        tl_words words;
        for (int i = 0; i < TL_MAX_WORDS; i++)
            words.of[i] = next_random(&random);
        const results before = results_of(needs, &words);
        words.of[word] = next_random(&random);
        const results after = results_of(needs, &words);
        for (size_t s = 0; s < COUNT_OF(steps); s++)
            if (memcmp((const char *)&before + steps[s].offset,
                       (const char *)&after + steps[s].offset, steps[s].size) != 0)
                changed |= 1u << s;
    }
    return changed;
}

static void check_words(tl_needs needs)
{
    const tl_pass_words counted =
        tl_pass_words_of((enum tl_layout_name)needs.layout, needs.present, needs.specular);
    for (uint32_t word = 0; word < TL_MAX_WORDS; word++) {
        const unsigned needed = steps_that_need(needs, word);
        for (size_t s = 0; s < COUNT_OF(steps); s++) {
            const uint32_t of =
                *(const uint32_t *)(const void *)((const char *)&counted + steps[s].words);
            if ((needed >> s & 1) != (of >> word & 1))
                fail_msg("%s, planes %x, specular %u: word %u is %scounted for %s, which %s it",
                         tl_layout_word((enum tl_layout_name)needs.layout), needs.present,
                         needs.specular, word, of >> word & 1 ? "" : "not ", steps[s].name,
                         needed >> s & 1 ? "need" : "do not need");
        }
    }
}

static void counted_words_are_those_that_matter(void **state)
{
    (void)state;
    for (uint32_t layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (size_t c = 0; c < COUNT_OF(contents); c++) {
            const uint32_t present =
                contents[c] & tl_layout_planes((enum tl_layout_name)layout);
            const bool has_lobe = present & (TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH);
            for (uint32_t specular = 0; specular <= has_lobe; specular++)
                check_words((tl_needs){
                    .present = present, .specular = specular, .layout = layout, .ambient = 1});
        }
}

/* By hand: a G-buffer of 10 x 10 tiles of 16 px, 100 lights, 500 entries. */
static void bytes_of_a_frame_are_those_counted_by_hand(void **state)
{
    const tl_frame_extent extent = {.layout = TL_LAYOUT_DXR,
                                    .present = TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
                                    .specular = true,
                                    .pixels = 25600,
                                    .tiles = 100,
                                    .lights = 100,
                                    .list_entries = 500};
    const tl_pass_bytes culling = tl_culling_bytes(&extent),
                        shading = tl_shading_bytes(&extent);
    (void)state;
    assert_true(culling.words == 25600 * 8);  /* two words have the position */
    assert_true(shading.words == 25600 * 24); /* all six */
    assert_true(shading.radiance == 25600 * 12);
    assert_true(culling.lights == 100 * 2 * (48 + 16));
    assert_true(shading.lights == 100 * 48);
    assert_true(culling.lists == 2000 && shading.lists == 2000);
    /* two boxes of six floats, a bit for each of 1024 lights, count, start and end; twice */
    assert_true(culling.tiles == 100 * 2 * (48 + 128 + 12));
    assert_true(shading.tiles == 100 * 8);
    assert_true(tl_pass_bytes_sum(&culling) == 25600 * 8 + 100 * 128 + 100 * 376 + 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counted_words_are_those_that_matter),
        cmocka_unit_test(bytes_of_a_frame_are_those_counted_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
