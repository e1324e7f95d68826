/* How much of the light does each row of models.h reflect, and does it both ways alike?
 *
 * The lobes are compiled in double here, with the library's powers; energies are held against what integrals
 * come to in closed form, or against 1. Values are tests/test_model_accuracy.c's. */
#include "testing.h"

#include "finish.h"
#include "lobes.h"

#include <math.h>

typedef long double wide;
static const wide pi = 3.14159265358979323846264338328L;

/* A direction, and light and eye as angles to the normal (0, 0, 1) and around it. */
typedef struct direction {
    wide theta, phi;
} direction;

static vec3 vector_of(direction d)
{
    const vec3 v = {(real)(sinl(d.theta) * cosl(d.phi)), (real)(sinl(d.theta) * sinl(d.phi)),
                    (real)cosl(d.theta)};
    return v;
}

typedef struct sample {
    enum tl_shading_model model;
    double exponent, alpha, across, k, specular;
    direction light, eye;
} sample;

static tl_needs needs_of(enum tl_shading_model model)
{
    return (tl_needs){.model = model, .models = 1u << model, .specular = 1};
}

/* By kernels/: what is received of a light of weight 1. */
static reflection lit(const sample *of)
{
    const tl_needs needs = needs_of(of->model);
    const vec3 n = {0.0, 0.0, 1.0}, x = {1.0, 0.0, 0.0};
    const vec3 colour = {of->specular, of->specular, of->specular};
    const surface s = {.normal = n, .to_eye = vector_of(of->eye), .shininess = of->exponent};
    const substance m = {.model = of->model,
                         .diffuse = colour,
                         .specular = colour,
                         .shininess = of->exponent,
                         .alpha2 = of->alpha * of->alpha,
                         .across2 = of->across * of->across,
                         .k = of->k,
                         .along = x};
    const vec3 l = vector_of(of->light);
    const double cosine = l.z > 0.0 ? l.z : 0.0;
    const meeting met = {l, 1.0, 1.0, cosine, cosine > 0.0 ? 1.0 : 0.0, cosine};
    return reflection_of(needs, s, finish_of(needs, s, m), met);
}

static wide uniform_of(uint32_t *seed) /* xorshift32 */
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return (wide)*seed * 0x1p-32L;
}

static const double exponents[] = {0, 1, 3.7, 80, 1000, 10000};
static const double alphas[] = {0.01414213, 0.03, 0.2, 1.0};
static const double reflectances[] = {0.0, 0.01, 0.04, 1.0};

/* Anywhere above the surface, one in three near the horizon, one in three near the mirror of `other`. */
static direction direction_near(uint32_t *seed, direction other, double width)
{
    const wide kind = uniform_of(seed), r = uniform_of(seed);
    direction d = {acosl(r), 2 * pi * uniform_of(seed)};
    if (kind < 0.33L)
        d.theta = pi / 2 - 0.001L * r;
    else if (kind < 0.66L)
        d = (direction){fminl(fabsl(other.theta + (r - 0.5L) * (wide)width), 1.57L),
                        other.phi + pi + (uniform_of(seed) - 0.5L) * (wide)width};
    return d;
}

static sample random_sample(uint32_t *seed, int model, size_t i)
{
    sample of = {.model = (enum tl_shading_model)model,
                 .exponent = exponents[i % COUNT_OF(exponents)],
                 .alpha = alphas[i % COUNT_OF(alphas)],
                 .across = alphas[(i / 4) % COUNT_OF(alphas)],
                 .k = (double)(2 * uniform_of(seed)),
                 .specular = reflectances[i % COUNT_OF(reflectances)],
                 .eye = {acosl(uniform_of(seed)), 2 * pi * uniform_of(seed)}};
    of.light = direction_near(seed, of.eye, 4 * of.alpha);
    return of;
}

/* What has no light, or has it behind, reflects nothing; nothing is ever below 0 or no number. */
static void nothing_comes_from_below(void **state)
{
    uint32_t seed = 4;
    (void)state;
    for (int model = 0; model < TL_MODEL_COUNT; model++)
        for (size_t i = 0; i < 2000; i++) {
            sample of = random_sample(&seed, model, i);
            of.eye.theta = pi * uniform_of(&seed);
            const reflection any = lit(&of);
            if (!(any.diffuse >= 0.0 && any.specular >= 0.0 && any.grazing >= 0.0 &&
                  isfinite(any.diffuse) && isfinite(any.specular)))
                fail_msg("model %d, sample %zu: %g, %g, %g", model, i, any.diffuse,
                         any.specular, any.grazing);
            of.light.theta = pi - of.light.theta;
            const reflection none = lit(&of);
            assert_true(none.diffuse == 0.0 && none.specular == 0.0 && none.grazing == 0.0);
        }
}

/* The unnormalised lobes are received under no cosine: as reflectance they are over n.l, one way only. */
static const int is_reciprocal[TL_MODEL_COUNT] = {
    [TL_MODEL_BLINN_PHONG_NORMALIZED] = 1,
    [TL_MODEL_LAMBERT] = 1,
    [TL_MODEL_OREN_NAYAR] = 1,
    [TL_MODEL_WARD] = 1,
    [TL_MODEL_WARD_ANISOTROPIC] = 1,
    [TL_MODEL_COOK_TORRANCE] = 1,
    [TL_MODEL_MINNAERT] = 1,
    [TL_MODEL_METAL_ROUGH] = 1,
};

static void light_and_eye_may_change_places(void **state)
{
    uint32_t seed = 11;
    (void)state;
    for (int model = 0; model < TL_MODEL_COUNT; model++) {
        int differ = 0;
        for (size_t i = 0; i < 2000; i++) {
            const sample of = random_sample(&seed, model, i);
            sample back = of;
            back.light = of.eye;
            back.eye = of.light;
            const reflection a = lit(&of), b = lit(&back);
            const double to = (double)cosl(of.light.theta), from = (double)cosl(of.eye.theta);
            if (to < 0.002 || from < 0.002)
                continue;
            differ |= fabs(a.diffuse / to - b.diffuse / from) > 1e-9 * a.diffuse / to;
            differ |=
                fabs(a.specular / to - b.specular / from) > 1e-7 * a.specular / to + 1e-30;
        }
        if (differ == is_reciprocal[model])
            fail_msg("model %d is %sreciprocal", model, differ ? "not " : "");
    }
}

/* Of light that comes back to an eye at theta from everywhere: the integral over h, whose slopes are spread
 * as a lobe of this width has them; l is v mirrored at h, and turns four times v.h as far. */
static reflection from_everywhere(sample of, wide width)
{
    enum { SLOPES = 256, TURNS = 48 };
    reflection sum = {0, 0, 0};
    const vec3 v = vector_of(of.eye);
    for (int i = 0; i < SLOPES; i++)
        for (int j = 0; j < TURNS; j++) {
            const wide u = ((wide)i + 0.5L) / SLOPES, phi = 2 * pi * ((wide)j + 0.5L) / TURNS;
            const wide slope = width * u / (1 - u), theta = atanl(slope);
            /* d theta / d u */
            const wide step = powl(cosl(theta), 2) * width / powl(1 - u, 2) / SLOPES;
            const vec3 h = vector_of((direction){theta, phi});
            const wide vh = dot3(v, h);
            const wide l[3] = {2 * vh * h.x - v.x, 2 * vh * h.y - v.y, 2 * vh * h.z - v.z};
            if (!(vh > 0 && l[2] > 0))
                continue;
            of.light = (direction){acosl(fminl(1, l[2])), atan2l(l[1], l[0])};
            const reflection r = lit(&of);
            const wide weight = 4 * vh * sinl(theta) * step * (2 / (wide)TURNS);
            sum.diffuse += (double)weight * r.diffuse;
            sum.specular += (double)weight * r.specular;
            sum.grazing += (double)weight * r.grazing;
        }
    return sum;
}

static const double eyes[] = {0.0, 0.5, 1.2, 1.5};

static sample seen_from(int model, double eye)
{
    return (sample){.model = (enum tl_shading_model)model, .eye = {eye, 0.3L}, .specular = 1.0};
}

/* Seen from above, angles of h are half those of l: each is an integral that can be done. */
static wide power_from_above(int model, wide e)
{
    const wide a = (1 - powl(2, -(e + 2) / 2)) / (e + 2),
               b = (1 - powl(2, -(e + 4) / 2)) / (e + 4);
    if (model == TL_MODEL_PHONG)
        return 8 * a;
    if (model == TL_MODEL_BLINN_PHONG_NORMALIZED)
        return 8 * (2 * b - a);
    return 2 / (e + 1); /* about the mirrored eye, which is the normal */
}

static void lobes_of_powers_reflect_what_their_integrals_say(void **state)
{
    static const int models[] = {TL_MODEL_PHONG, TL_MODEL_BLINN_PHONG_NORMALIZED,
                                 TL_MODEL_PHONG_REFLECTION};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(models); i++)
        for (size_t e = 0; e < COUNT_OF(exponents); e++) {
            sample of = seen_from(models[i], 0.0);
            of.exponent = exponents[e];
            const wide want = power_from_above(models[i], exponents[e]);
            const double got = from_everywhere(of, sqrtl(2 / ((wide)of.exponent + 2))).specular;
            if (!(fabsl(got - want) <= 0.002L * want))
                fail_msg("model %d, exponent %g: %g of the light, want %Lg", models[i],
                         exponents[e], got, want);
            if (models[i] == TL_MODEL_BLINN_PHONG_NORMALIZED)
                assert_true(got * (of.exponent + 2.0) / 8.0 <= 1.001);
        }
}

/* With reflectance 1 facets reflect all, and what is lost is what they hide from each other: nearly nothing
 * of smooth surfaces. */
static void facets_never_reflect_more_than_arrives(void **state)
{
    static const int models[] = {TL_MODEL_WARD, TL_MODEL_WARD_ANISOTROPIC,
                                 TL_MODEL_COOK_TORRANCE, TL_MODEL_METAL_ROUGH};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(models); i++)
        for (size_t a = 0; a < COUNT_OF(alphas); a++)
            for (size_t e = 0; e < COUNT_OF(eyes); e++) {
                sample of = seen_from(models[i], eyes[e]);
                of.alpha = alphas[a];
                of.across = models[i] == TL_MODEL_WARD_ANISOTROPIC ? 0.5 * of.alpha : of.alpha;
                const double got = from_everywhere(of, of.alpha).specular;
                if (!(got <= 1.003))
                    fail_msg("model %d, alpha %g, eye at %g: %g of the light", models[i],
                             of.alpha, eyes[e], got);
                if (of.alpha < 0.04 && eyes[e] < 1.4 && !(got >= 0.98))
                    fail_msg("model %d, alpha %g, eye at %g: only %g of the light", models[i],
                             of.alpha, eyes[e], got);
            }
}

/* White, of glTF's dielectric: diffuse and specular together. Seen from above they share the light; towards
 * grazing angles they do not, for the appendix takes from diffuse light what facets reflect under v.h, which
 * is less than what the surface does under n.v. */
static void a_dielectric_keeps_its_energy_seen_from_above(void **state)
{
    (void)state;
    for (size_t a = 0; a < COUNT_OF(alphas); a++)
        for (size_t e = 0; e < COUNT_OF(eyes); e++) {
            sample of = seen_from(TL_MODEL_METAL_ROUGH, eyes[e]);
            of.alpha = alphas[a];
            of.specular = 0.04;
            const reflection lobe = from_everywhere(of, of.alpha),
                             below = from_everywhere(of, 1.0L);
            const double shown = 0.04 * lobe.specular + 0.96 * lobe.grazing,
                         all = 0.96 * below.diffuse + shown;
            if (!(shown <= 1.0 && 0.96 * below.diffuse <= 0.96))
                fail_msg("alpha %g, eye at %g: %g and %g", of.alpha, eyes[e], shown,
                         below.diffuse);
            if (eyes[e] < 0.6 && !(all <= 1.003 && all >= 0.8))
                fail_msg("alpha %g, eye at %g: %g of the light", of.alpha, eyes[e], all);
            if (eyes[e] > 1.4 && of.alpha < 0.1)
                assert_true(all > 1.4 && all < 1.7); /* as docs/conventions.md says */
        }
}

static void diffuse_models_reflect_what_their_integrals_say(void **state)
{
    (void)state;
    for (size_t a = 0; a < COUNT_OF(alphas); a++)
        for (size_t e = 0; e < COUNT_OF(eyes); e++) {
            sample lambert = seen_from(TL_MODEL_LAMBERT, eyes[e]);
            sample rough = seen_from(TL_MODEL_OREN_NAYAR, eyes[e]);
            sample moon = seen_from(TL_MODEL_MINNAERT, eyes[e]);
            const double nv = cos(eyes[e]), sigma2 = rough.alpha = alphas[a];
            moon.k = 0.5 + sigma2;
            assert_true(fabs(from_everywhere(lambert, 1.0L).diffuse - 1.0) < 0.002);
            /* From above the smaller angle is 0, and A is left; elsewhere B adds, and A and B are fits: up
             * to 1.012 comes back. */
            const double got = from_everywhere(rough, 1.0L).diffuse;
            if (e == 0)
                assert_true(fabs(got - (1.0 - 0.5 * sigma2 / (sigma2 + 0.33))) < 0.002);
            if (!(got <= 1.015))
                fail_msg("Oren-Nayar, sigma^2 %g, eye at %g: %g", sigma2, eyes[e], got);
            const double share = from_everywhere(moon, 1.0L).diffuse,
                         want = pow(nv, moon.k - 1.0);
            if (!(fabs(share - want) <= 0.004 * want))
                fail_msg("Minnaert, k %g, eye at %g: %g, want %g", moon.k, eyes[e], share,
                         want);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_comes_from_below),
        cmocka_unit_test(light_and_eye_may_change_places),
        cmocka_unit_test(lobes_of_powers_reflect_what_their_integrals_say),
        cmocka_unit_test(facets_never_reflect_more_than_arrives),
        cmocka_unit_test(a_dielectric_keeps_its_energy_seen_from_above),
        cmocka_unit_test(diffuse_models_reflect_what_their_integrals_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
