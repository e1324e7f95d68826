/* Does every shading model reflect what its equations say, to within what is derived for float and for
 * double?
 *
 * Expected is tests/oracle/models.h; the bounds are those of kernels/halfway.h, specular.h and lobe_*.h
 * (model_bounds.c). Surface and light are floats, so both arithmetics and the oracle begin with the same. */
#include "formula_cases.h"
#include "model_bounds.h"

#include "models.h"

enum { SAMPLES = 1200 }; /* of a model */

#define COSINE "n.l: directions and lengths of n and l, sum"
#define POWER "turn of h; power"
#define FACETS "turn and length of h; sine, cosine; exponential"
static const struct {
    const char *word, *file, *diffuse, *specular;
} models[TL_MODEL_COUNT] = {
    [TL_MODEL_PHONG] = {"phong", "kernels/lobe_plain.h", COSINE, POWER},
    [TL_MODEL_BLINN_PHONG_NORMALIZED] = {"blinn-phong-normalized", "kernels/lobe_plain.h",
                                         COSINE, POWER ", n.l"},
    [TL_MODEL_LAMBERT] = {"lambert", "kernels/lobe_plain.h", COSINE, ""},
    [TL_MODEL_PHONG_REFLECTION] = {"phong-reflection", "kernels/lobe_phong_reflection.h",
                                   COSINE, "turn of the mirrored light; power"},
    [TL_MODEL_OREN_NAYAR] = {"oren-nayar", "kernels/lobe_oren_nayar.h",
                             "n.l, n.v, l.v; their quotient; A and B", ""},
    [TL_MODEL_WARD] = {"ward", "kernels/lobe_ward.h", COSINE, FACETS "; v.h"},
    [TL_MODEL_WARD_ANISOTROPIC] = {"ward-anisotropic", "kernels/lobe_ward.h", COSINE,
                                   FACETS "; v.h; sharp axis"},
    [TL_MODEL_COOK_TORRANCE] = {"cook-torrance", "kernels/lobe_cook_torrance.h", COSINE,
                                FACETS "; n.v, n.l, v.h"},
    [TL_MODEL_MINNAERT] = {"minnaert", "kernels/lobe_minnaert.h",
                           "n.l, n.v; two logarithms; power of two", ""},
    [TL_MODEL_METAL_ROUGH] = {"metal-rough", "kernels/lobe_metal_rough.h",
                              "n.l; v.h to the fifth",
                              "turn of h; alpha^2 cos^2 + sin^2; n.v, n.l, two roots"},
};

/* --- surfaces and lights ------------------------------------------------------------------------------ */

static double between(uint64_t *seed, double low, double high)
{
    return low + (high - low) * uniform_of(seed);
}

/* Across n, of length 1. */
static wide3 aside(uint64_t *seed, wide3 n)
{
    const wide3 a = direction_of(seed);
    return wide3_unit(wide3_sum(a, -wide3_dot(a, n), n));
}

/* n turned by an angle, towards anywhere. */
static wide3 tilted(uint64_t *seed, wide3 n, double angle)
{
    const wide3 none = {0, 0, 0};
    return wide3_sum(wide3_sum(none, cosq(angle), n), sinq(angle), aside(seed, n));
}

static wide3 mirrored(wide3 a, wide3 at)
{
    const wide3 none = {0, 0, 0};
    return wide3_sum(wide3_sum(none, 2 * wide3_dot(a, at), at), -1, a);
}

/* What is asked of how light, eye and normal stand. */
typedef enum stance {
    ANYWHERE,
    IN_THE_LOBE,   /* h within a few widths of n */
    ON_THE_PEAK,   /* h hardly off n */
    GRAZING_LIGHT, /* n.l nearly 0, or 0 */
    GRAZING_EYE,   /* n.v nearly 0 */
    BOTH_GRAZING,  /* in the lobe */
    OPPOSITE,      /* l and v nearly so: h is short */
    BEHIND,        /* the normal is turned from the eye */
    ONE_DIRECTION, /* l is v */
    STANCE_COUNT
} stance;

static const double tiny[] = {0.0, 1e-12, 1e-8, 1e-7, 1e-6, 1e-4, 1e-2};

static const char *const stances[STANCE_COUNT] = {
    "anywhere",        "in the lobe",
    "on the peak",     "grazing light",
    "grazing eye",     "both grazing, in the lobe",
    "l opposite to v", "normal turned from eye",
    "l is v"};

static double tiny_of(uint64_t *seed)
{
    return tiny[(size_t)(uniform_of(seed) * COUNT_OF(tiny))];
}

/* Unit vectors to the light and to the eye, before they are rounded. */
static void stand(uint64_t *seed, stance as, wide3 n, double width, wide3 *l, wide3 *v)
{
    static const double right = 1.5707963267948966;
    const wide3 none = {0, 0, 0};
    *l = tilted(seed, n, acos(uniform_of(seed)));
    *v = tilted(seed, n, acos(uniform_of(seed)));
    switch (as) {
    case IN_THE_LOBE: *v = mirrored(*l, tilted(seed, n, between(seed, 0, 4 * width))); break;
    case ON_THE_PEAK: *v = mirrored(*l, tilted(seed, n, tiny_of(seed))); break;
    case GRAZING_LIGHT: *l = tilted(seed, n, right - tiny_of(seed)); break;
    case GRAZING_EYE: *v = tilted(seed, n, right - tiny_of(seed)); break;
    case BOTH_GRAZING:
        *l = tilted(seed, n, right - tiny_of(seed));
        *v = mirrored(*l, tilted(seed, n, between(seed, 0, 2 * width)));
        break;
    case OPPOSITE: *v = tilted(seed, wide3_sum(none, -1, *l), 10 * tiny_of(seed)); break;
    case BEHIND: *v = tilted(seed, n, between(seed, right, 2 * right)); break;
    case ONE_DIRECTION: *v = *l; break;
    default: break;
    }
}

static const float exponents[] = {0.0f, 1.0f, 1.5f, 7.0f, 80.0f, 1000.0f, 10000.0f};
static const float alphas2[] = {0x1.a35b04p-13f, 1e-3f, 0.04f, 0.3f,
                                1.0f}; /* roughness 0 to 1 */
static const float reflectances[] = {0.0f, 0.004f, 0.04f, 1.0f};
static const float ks[] = {0.0f, 0.5f, 0.75f, 1.0f, 1.7f, 10.0f};

typedef struct sample {
    stance as;
    formula_surface surface;
    float light[3];
} sample;

/* Distances of the eye from 1e-8 to 1e15 m, of the light a thousandth to a thousand times that. */
static sample random_sample(uint64_t *seed, unsigned long i)
{
    sample s = {.as = (stance)(i % STANCE_COUNT)};
    formula_surface *of = &s.surface;
    const wide3 n = direction_of(seed);
    wide3 l, v;
    of->exponent = exponents[i / 3 % COUNT_OF(exponents)];
    of->alpha2 = alphas2[i / 5 % COUNT_OF(alphas2)];
    of->across2 = alphas2[i / 25 % COUNT_OF(alphas2)];
    of->k = ks[i / 7 % COUNT_OF(ks)];
    of->f0 = reflectances[i / 11 % COUNT_OF(reflectances)];
    const double width = sqrt(i % 2 ? (double)of->alpha2 : 2.0 / ((double)of->exponent + 2.0));
    const double away = pow(10, between(seed, -8, 15)), by = pow(10, between(seed, -3, 3));
    stand(seed, s.as, n, width, &l, &v);
    round_to(of->normal, n, i % 4 == 3 ? pow(10, between(seed, -14, 17)) : 1);
    round_to(of->along, i % 6 == 5 ? tilted(seed, n, 0.01) : direction_of(seed), 1);
    round_to(of->position, v, -away);
    const wide3 from = wide3_of(of->position);
    round_to(s.light, wide3_sum(from, by * away, l), 1);
    return s;
}

static tl_oracle_surface exact_surface(const sample *s, int is_round)
{
    const formula_surface *of = &s->surface;
    const wide3 at = wide3_of(of->position), none = {0, 0, 0};
    const wide f0[3] = {of->f0, of->f0, of->f0};
    return (tl_oracle_surface){.normal = wide3_of(of->normal),
                               .to_light = wide3_sum(wide3_of(s->light), -1, at),
                               .to_eye = wide3_sum(none, -1, at),
                               .exponent = of->exponent,
                               .alpha = sqrtq(of->alpha2),
                               .across = sqrtq(is_round ? of->alpha2 : of->across2),
                               .k = of->k,
                               .f90 = tl_oracle_f90(f0),
                               .along = wide3_of(of->along)};
}

/* --- what comes of them ------------------------------------------------------------------------------- */

static double largest_off(span allowed, wide want)
{
    const wide above = allowed.high - want, below = want - allowed.low;
    return (double)(above > below ? above : below);
}

static void fail_at(const sample *s, const char *what, span allowed, wide want, double got)
{
    const formula_surface *of = &s->surface;
    fail_msg(
        "%s is %.9g, want %.9g, within %.9g to %.9g: %s, exponent %g, alpha^2 %g and %g, k "
        "%g, F0 %g, n (%a, %a, %a), at (%a, %a, %a), light (%a, %a, %a)",
        what, got, (double)want, (double)allowed.low, (double)allowed.high, stances[s->as],
        (double)of->exponent, (double)of->alpha2, (double)of->across2, (double)of->k,
        (double)of->f0, (double)of->normal[0], (double)of->normal[1], (double)of->normal[2],
        (double)of->position[0], (double)of->position[1], (double)of->position[2],
        (double)s->light[0], (double)s->light[1], (double)s->light[2]);
}

/* A lobe of facets may be any height: where it is above 1, errors are of itself. What is decided by rounding,
 * what is cut to 0 and what may be off by less than u, for it is next to nothing, is held to its bound but no
 * figure. */
static void check(
    figure *f, double u, const sample *s, int is_decided, span allowed, wide want, double got)
{
    const double scale = want > 1 ? (double)want : 1.0;
    const double bound = largest_off(allowed, want) / scale;
    if (!(got >= 0.0 && got >= (double)allowed.low && got <= (double)allowed.high))
        fail_at(s, f->formula, allowed, want, got);
    const int is_cut = got == 0.0 && !(allowed.low > 0);
    if (is_decided && bound >= u && !is_cut)
        figure_sees(f, (double)fabsq(got - want) / scale, bound, "%s", stances[s->as]);
}

static figure figure_of_model(uint32_t model, const char *lobe, const formulas *by)
{
    return figure_of("models", models[model].word, models[model].file, lobe, by,
                     lobe[0] == 'd' ? models[model].diffuse : models[model].specular);
}

static void model_is_within(uint32_t model, const formulas *by)
{
    figure diffuse = figure_of_model(model, "diffuse", by),
           specular = figure_of_model(model, "specular", by),
           grazing = figure_of_model(model, "specular times Fresnel's weight", by);
    uint64_t seed = 1977 + model;
    for (unsigned long i = 0; i < (unsigned long)scaled_count(SAMPLES); i++) {
        const sample s = random_sample(&seed, i);
        const tl_oracle_surface exact = exact_surface(&s, model != TL_MODEL_WARD_ANISOTROPIC);
        const tl_oracle_reflected want = tl_oracle_reflection(models[model].word, &exact);
        const bounds_of_reflection b =
            tl_bounds_of_reflection(model, &exact, s.surface.f0, by->u);
        const formula_reflection got = by->reflection(model, &s.surface, s.light);
        assert_true(isfinite(got.diffuse) && isfinite(got.specular) && isfinite(got.grazing));
        if (!b.is_known)
            continue;
        check(&diffuse, by->u, &s, b.is_decided, b.diffuse, want.diffuse, got.diffuse);
        check(&specular, by->u, &s, b.is_decided, b.specular, want.specular, got.specular);
        check(&grazing, by->u, &s, b.is_decided, b.grazing, want.grazing, got.grazing);
    }
    figure_report(&diffuse);
    if (specular.cases > 0)
        figure_report(&specular);
    if (grazing.cases > 0)
        figure_report(&grazing);
}

static void floats_are_within(void **state)
{
    (void)state;
    for (uint32_t model = 0; model < TL_MODEL_COUNT; model++)
        model_is_within(model, &tl_formulas_float);
}

static void doubles_are_within(void **state)
{
    (void)state;
    for (uint32_t model = 0; model < TL_MODEL_COUNT; model++)
        model_is_within(model, &tl_formulas_double);
}

/* Where squares of distances leave the range of an arithmetic, or no direction is left of them, nothing is
 * lit. */
static void lights_out_of_range_add_nothing(void **state)
{
    static const double distances[] = {0.0, 1e-30, 1e-20, 1e-13, 1e20, 1e30, 3e38};
    uint64_t seed = 30;
    (void)state;
    for (unsigned long i = 0; i < 4000; i++) {
        const double to_eye = distances[i % COUNT_OF(distances)],
                     to_light = distances[i / 7 % COUNT_OF(distances)];
        sample s = random_sample(&seed, i);
        round_to(s.surface.position, direction_of(&seed), to_eye);
        round_to(s.light,
                 wide3_sum(wide3_of(s.surface.position), to_light, direction_of(&seed)), 1);
        for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
            const formula_reflection r =
                arithmetics[k]->reflection((uint32_t)(i % TL_MODEL_COUNT), &s.surface, s.light);
            const int is_out = to_light <= 1e-13 && to_eye <= 1e-13;
            const int is_beyond = k == 0 && to_light > to_eye && to_light >= 1e20;
            const int is_fine = r.diffuse >= 0.0 && r.specular >= 0.0 && r.grazing >= 0.0 &&
                                isfinite(r.diffuse + r.specular + r.grazing);
            if (!is_fine)
                fail_msg("%s, %s: %g, %g, %g with the eye at %g m and the light at %g m, %s",
                         models[i % TL_MODEL_COUNT].word, arithmetics[k]->name, r.diffuse,
                         r.specular, r.grazing, to_eye, to_light, stances[s.as]);
            if (is_out || is_beyond)
                assert_true(r.diffuse == 0.0 && r.specular == 0.0 && r.grazing == 0.0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_within),
        cmocka_unit_test(doubles_are_within),
        cmocka_unit_test(lights_out_of_range_add_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
