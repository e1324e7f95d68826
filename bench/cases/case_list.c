#include "bench_case.h"
#include "word_list.h"

#include "tilelight/layouts.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CASES = 10000 };

/* Layouts under the usual lights, under some that reach every pixel, and under one that reaches none:
 * there pixels are read and written, and nothing else is done. */
#define UNDER(set, described, made_of, other, packed, count, metres) \
    {                                                                \
        set, described, 1,                                           \
        {                                                            \
            .of = {                                                  \
                [TL_AXIS_MATERIAL] = made_of,                        \
                [TL_AXIS_AGAINST] = other,                           \
                [TL_AXIS_LAYOUT] = packed,                           \
                [TL_AXIS_LIGHTS] = count,                            \
                [TL_AXIS_RANGE] = metres                             \
            }                                                        \
        }                                                            \
    }
#define LAYOUTS(made_of, packed)                                                             \
    UNDER("layouts", "every layout, many lights", made_of, "float", packed, "1024", "auto"), \
        UNDER("layouts", "few, which reach all", made_of, "float", packed, "8", "100"),      \
        UNDER("layouts", "none to speak of", made_of, "float", packed, "1", "0.001")
#define POSITIONS(packed, other)                                                             \
    UNDER("positions", "depth in place of positions, many lights", "phong", other, packed,   \
          "1024", "auto"),                                                                   \
        UNDER("positions", "few, which reach all", "phong", other, packed, "1,8,32", "100"), \
        UNDER("positions", "none to speak of", "phong", other, packed, "1", "0.001")

const tl_bench_set tl_bench_sets[] = {
    {"scenes",
     "every scene, 1080p, 1024 lights, 27 per tile",
     0,
     {.of[TL_AXIS_SCENE] = "spheres,wall,foliage,grazing"}},
    {"sizes", "more pixels", 0, {.of[TL_AXIS_SIZE] = "640x360,1920x1080,3840x2160"}},
    {"lights", "more lights, as many per tile", 0, {.of[TL_AXIS_LIGHTS] = "64,1024,16384"}},
    {"density", "more lights per tile", 0, {.of[TL_AXIS_PER_TILE] = "3,27,100"}},
    {"tiles", "other tiles", 0, {.of[TL_AXIS_TILE] = "8,16,32,64"}},
    {"culling", "what culling saves", 0, {.of[TL_AXIS_CULL] = "split,depth,rect"}},
    {"widths", "one source, narrower vectors", 0, {.of[TL_AXIS_WIDTH] = "1,4,8,auto"}},
    {"precisions", "what double costs", 0, {.of[TL_AXIS_PRECISION] = "float,double"}},
    {"packing",
     "fewer bytes per pixel",
     0,
     {.of[TL_AXIS_LAYOUT] = "float,compact-16,compact-12"}},
    {"translucency",
     "layers that blend, of all of the picture and of a tenth, by turns with none",
     1,
     {.of[TL_AXIS_LAYERS] = "1,2,4,8,1/10,8/10,8/1000"}},
    LAYOUTS("phong", "all"),
    LAYOUTS("diffuse",
            "shaderx2-128,shaderx2-128-s10,shaderx2-128-u8,shaderx2-128-s8,"
            "shaderx2-160,shaderx2-96,compact-16,compact-12"),
    LAYOUTS("full", "dxr,compact-16,compact-12"),
    POSITIONS("float,float-forward", "float-position"),
    POSITIONS("merlin", "merlin-position"),
};
const int tl_bench_set_count = sizeof tl_bench_sets / sizeof tl_bench_sets[0];

static tl_status split(const char *list,
                       const tl_bench_axis *of,
                       tl_word_list *out,
                       tl_error *err)
{
    char option[2 + TL_BENCH_WORD_SIZE];
    snprintf(option, sizeof option, "--%s", of->name);
    return tl_word_list_split(option, list, of->all, out, err);
}

static tl_bench_case starting_case(void)
{
    return (tl_bench_case){.scene = &tl_bench_scenes[0],
                           .scene_options = tl_bench_scene_options_default(),
                           .lighting = tl_lighting_options_default()};
}

static int is_there(const tl_bench_cases *cases, const tl_bench_case *one)
{
    for (size_t i = 0; i < cases->count; i++)
        if (memcmp(cases->cases[i].words, one->words, sizeof one->words) == 0)
            return 1;
    return 0;
}

static tl_status append(tl_bench_cases *cases, const tl_bench_case *one, tl_error *err)
{
    if (is_there(cases, one))
        return TL_OK;
    if (cases->count == MOST_CASES)
        return tl_fail(err, TL_ERR_ARGUMENT, "the lists make more than %d cases", MOST_CASES);
    tl_bench_case *grown = realloc(cases->cases, (cases->count + 1) * sizeof *grown);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for cases");
    grown[cases->count++] = *one;
    cases->cases = grown;
    return TL_OK;
}

/* The case whose words are the `number`th combination, the last axis changing fastest. */
static tl_status make_case(const tl_word_list *lists,
                           size_t number,
                           tl_bench_case *out,
                           tl_error *err)
{
    tl_status status = TL_OK;
    *out = starting_case();
    for (int axis = TL_AXIS_COUNT; axis-- > 0;) {
        const char *word = lists[axis].of[number % lists[axis].count];
        number /= lists[axis].count;
        memcpy(out->words[axis], word, strlen(word) + 1);
        TRY(tl_bench_axes[axis].set(out, word, err));
    }
done:
    return status;
}

/* Whether the case's layout keeps all that its scene has. */
static int has_place(const tl_bench_case *of)
{
    return (of->scene_options.material->present & ~tl_layout_planes(of->layout)) == 0;
}

/* Refuses here what tl_gbuffer_pack would refuse after minutes. */
static tl_status check_layout(const tl_bench_case *of,
                              enum tl_layout_name layout,
                              tl_error *err)
{
    const tl_bench_material *material = of->scene_options.material;
    const uint32_t can_hold = tl_layout_planes(layout);
    if ((material->present & TL_GROUP_PHONG) && !(can_hold & TL_GROUP_PHONG) &&
        (can_hold & TL_GROUP_METAL_ROUGH))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "layout %s cannot say what --material %s has: it holds metallic and "
                       "roughness, as --material metal-rough and full do",
                       tl_layout_word(layout), material->name);
    return TL_OK;
}

tl_status tl_bench_cases_add(tl_bench_cases *cases, const tl_bench_lists *lists, tl_error *err)
{
    const size_t count_before = cases->count;
    tl_status status = TL_OK;
    size_t product = 1;
    tl_word_list *split_lists = calloc(TL_AXIS_COUNT, sizeof *split_lists);
    if (!split_lists)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for cases"));
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++) {
        const char *list = lists->of[axis] ? lists->of[axis] : tl_bench_axes[axis].usual;
        TRY(split(list, &tl_bench_axes[axis], &split_lists[axis], err));
        product *= split_lists[axis].count;
        if (product > MOST_CASES)
            TRY(tl_fail(err, TL_ERR_ARGUMENT, "the lists make more than %d cases", MOST_CASES));
    }
    for (size_t number = 0; number < product; number++) {
        tl_bench_case one;
        TRY(make_case(split_lists, number, &one, err));
        if (split_lists[TL_AXIS_LAYOUT].is_all && !has_place(&one))
            continue;
        TRY(check_layout(&one, one.layout, err));
        TRY(check_layout(&one, one.against, err));
        TRY(append(cases, &one, err));
    }
done:
    if (status != TL_OK)
        cases->count = count_before;
    free(split_lists);
    return status;
}

void tl_bench_cases_clear(tl_bench_cases *cases)
{
    free(cases->cases);
    *cases = (tl_bench_cases){0};
}

int tl_bench_case_same_gbuffer(const tl_bench_case *a, const tl_bench_case *b)
{
    return a->scene == b->scene && a->scene_options.width == b->scene_options.width &&
           a->scene_options.height == b->scene_options.height &&
           a->scene_options.material == b->scene_options.material &&
           a->scene_options.layer_count == b->scene_options.layer_count &&
           a->scene_options.layer_part == b->scene_options.layer_part;
}

int tl_bench_case_same_frame(const tl_bench_case *a, const tl_bench_case *b)
{
    const tl_bench_scene_options *x = &a->scene_options, *y = &b->scene_options;
    return tl_bench_case_same_gbuffer(a, b) && x->light_count == y->light_count &&
           x->seed == y->seed && x->lights_per_tile == y->lights_per_tile &&
           x->range == y->range;
}
