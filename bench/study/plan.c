#include "plan.h"

#include "try.h"
#include "word_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CONFIGS = 10000 };

#define POWER (TL_STUDY_KNOB_APPROXIMATIONS + TL_KNOB_POWER)
#define ROOT (TL_STUDY_KNOB_APPROXIMATIONS + TL_KNOB_ROOT)
#define MATH (TL_STUDY_KNOB_APPROXIMATIONS + TL_KNOB_ARITHMETIC)

/* Words together, each with what it is hoped to show. */
static const tl_study_lists products[] = {
    /* that double arithmetic on packed numbers buys nothing */
    {{[TL_STUDY_KNOB_LAYOUT] =
          "float-forward,float-position,compact-16,compact-12,merlin,dxr,shaderx2-160",
      [TL_STUDY_KNOB_PRECISION] = "double"}},
    /* few bytes that are compressed besides */
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-16,compact-12",
      [TL_STUDY_KNOB_COMPRESSION] = "zip,piz"}},
    /* halves that are a channel each, which b44 is for */
    {{[TL_STUDY_KNOB_LAYOUT] = "ispc", [TL_STUDY_KNOB_COMPRESSION] = "b44,b44a,pxr24"}},
    /* that fewer bits in than out, or the other way round, are lost */
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-16,compact-12,merlin",
      [TL_STUDY_KNOB_OUTPUT] = "half,png"}},
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-12",
      [TL_STUDY_KNOB_COMPRESSION] = "zip",
      [TL_STUDY_KNOB_OUTPUT] = "png"}},
    /* faint light that is left out where it is least seen */
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-16,compact-12",
      [TL_STUDY_KNOB_CUTOFF] = "1e-4,1e-3,1e-2"}},
    {{[TL_STUDY_KNOB_PRECISION] = "double", [TL_STUDY_KNOB_CUTOFF] = "1e-4,1e-2"}},
    /* loose arithmetic, and forms that are the farther off the fewer operations they take */
    {{[POWER] = "degree-6,degree-5", [MATH] = "relaxed"}},
    {{[POWER] = "degree-6", [ROOT] = "rsqrt", [MATH] = "relaxed"}},
    {{[POWER] = "degree-4", [ROOT] = "newton-2", [MATH] = "strict,relaxed"}},
    {{[POWER] = "degree-3", [ROOT] = "newton-1", [MATH] = "relaxed"}},
    {{[POWER] = "degree-2", [ROOT] = "newton-0", [MATH] = "relaxed"}},
    {{[POWER] = "native", [ROOT] = "native", [MATH] = "relaxed"}},
    {{[TL_STUDY_KNOB_CUTOFF] = "1e-4,1e-3,1e-2", [MATH] = "relaxed"}},
    /* the same on few bytes, where the layout is farther off than most of them */
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-16,compact-12",
      [POWER] = "degree-6,degree-4",
      [MATH] = "relaxed"}},
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-12",
      [POWER] = "degree-3",
      [ROOT] = "newton-1",
      [MATH] = "relaxed"}},
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-12",
      [TL_STUDY_KNOB_CUTOFF] = "1e-3,1e-2",
      [MATH] = "relaxed"}},
};

static const tl_study_lists quick_products[] = {
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-12", [TL_STUDY_KNOB_PRECISION] = "double"}},
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-12", [TL_STUDY_KNOB_OUTPUT] = "png"}},
    {{[MATH] = "relaxed"}},
    {{[POWER] = "degree-6", [MATH] = "relaxed"}},
    {{[POWER] = "degree-4", [ROOT] = "newton-2", [MATH] = "relaxed"}},
    {{[POWER] = "degree-3", [ROOT] = "newton-1", [MATH] = "relaxed"}},
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-16,compact-12", [MATH] = "relaxed"}},
    {{[TL_STUDY_KNOB_LAYOUT] = "compact-12", [POWER] = "degree-4", [MATH] = "relaxed"}},
};

static tl_status split(const char *list,
                       const tl_study_knob *knob,
                       tl_word_list *out,
                       tl_error *err)
{
    char option[sizeof "--knob " + TL_BENCH_WORD_SIZE];
    snprintf(option, sizeof option, "--knob %s", knob->name);
    return tl_word_list_split(option, list, knob->all, out, err);
}

static int is_there(const tl_study_plan *plan, const tl_study_config *one)
{
    for (size_t i = 0; i < plan->count; i++)
        if (tl_study_config_is_same(&plan->configs[i], one))
            return 1;
    return 0;
}

static tl_status append(tl_study_plan *plan, const tl_study_config *one, tl_error *err)
{
    if (is_there(plan, one))
        return TL_OK;
    if (plan->count == MOST_CONFIGS)
        return tl_fail(err, TL_ERR_ARGUMENT, "the lists make more than %d configurations",
                       MOST_CONFIGS);
    tl_study_config *grown = realloc(plan->configs, (plan->count + 1) * sizeof *grown);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for configurations");
    grown[plan->count++] = *one;
    plan->configs = grown;
    return TL_OK;
}

/* The configuration whose words are the `number`th combination, the last knob changing fastest. */
static tl_status combine(const tl_word_list *lists,
                         size_t number,
                         tl_study_config *out,
                         tl_error *err)
{
    tl_status status = TL_OK;
    *out = tl_study_config_default();
    for (int knob = TL_STUDY_KNOB_COUNT; knob-- > 0;) {
        const char *word = lists[knob].of[number % lists[knob].count];
        number /= lists[knob].count;
        TRY(tl_study_config_set(out, (tl_study_knob_name)knob, word, err));
    }
done:
    return status;
}

tl_status tl_study_plan_add(tl_study_plan *plan, const tl_study_lists *lists, tl_error *err)
{
    const size_t count_before = plan->count;
    tl_status status = TL_OK;
    size_t product = 1;
    tl_word_list *split_lists = calloc(TL_STUDY_KNOB_COUNT, sizeof *split_lists);
    if (!split_lists)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for configurations"));
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++) {
        const tl_study_knob *row = &tl_study_knobs[knob];
        TRY(split(lists->of[knob] ? lists->of[knob] : row->usual, row, &split_lists[knob],
                  err));
        product *= split_lists[knob].count;
        if (product > MOST_CONFIGS)
            TRY(tl_fail(err, TL_ERR_ARGUMENT, "the lists make more than %d configurations",
                        MOST_CONFIGS));
    }
    for (size_t number = 0; number < product; number++) {
        tl_study_config one;
        TRY(combine(split_lists, number, &one, err));
        TRY(append(plan, &one, err));
    }
done:
    if (status != TL_OK)
        plan->count = count_before;
    free(split_lists);
    return status;
}

static tl_status add_products(tl_study_plan *plan,
                              const tl_study_lists *lists,
                              size_t count,
                              tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < count; i++)
        TRY(tl_study_plan_add(plan, &lists[i], err));
done:
    return status;
}

tl_status tl_study_plan_usual(tl_study_plan *plan, int is_quick, tl_error *err)
{
    static const tl_study_lists usual = {{NULL}};
    const size_t count_before = plan->count;
    tl_status status = TL_OK;
    TRY(tl_study_plan_add(plan, &usual, err));
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++) {
        tl_study_lists alone = usual;
        const tl_study_knob *row = &tl_study_knobs[knob];
        alone.of[knob] = is_quick ? row->quick : row->alone;
        TRY(tl_study_plan_add(plan, &alone, err));
    }
    TRY(is_quick ? add_products(plan, quick_products,
                                sizeof quick_products / sizeof *quick_products, err)
                 : add_products(plan, products, sizeof products / sizeof *products, err));
done:
    if (status != TL_OK)
        plan->count = count_before;
    return status;
}

void tl_study_plan_clear(tl_study_plan *plan)
{
    free(plan->configs);
    *plan = (tl_study_plan){0};
}
