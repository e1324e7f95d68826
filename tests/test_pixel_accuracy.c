/* Is the radiance of whole pixels what the equations come to, by every model, for the reference and for
 * floats?
 *
 * The oracle lights a pixel from its planes and from the frame's numbers as kernels get them (tl_prepared),
 * in 128-bit floats: it shares no formula with kernels/. It is held against the interval that `check` derives
 * for kernels (host/reference/allowance.c), whose middle is the reference in double: that shows reference and
 * oracle to be of one mind to within what float rounds, and the intervals to be where the truth is. In double
 * all roundings are 2^-29 of those in float, and so is what the reference may be off. */
#include "figures.h"
#include "hard_pixels.h"
#include "oracle/models.h"

#include "allowance.h"
#include "falloff.h"
#include "reference.h"

static const uint32_t kinds[] = {TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_EMISSIVE,
                                 TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION};

static const char *const words[TL_MODEL_COUNT] = {
#define WORD(name, word, traits, parameters, source) [name] = word,
    TL_MODELS(WORD)
#undef WORD
};

/* --- the oracle --------------------------------------------------------------------------------------- */

typedef struct seen {
    tl_oracle_surface surface; /* all but the light */
    wide3 position;
    wide diffuse[3], f0[3], below, albedo[3], emissive[3], occlusion;
    uint32_t model;
} seen;

static wide value(const tl_gbuffer *g, int plane, size_t at)
{
    const float *values = tl_gbuffer_plane(g, (enum tl_plane)plane);
    return values ? values[at] : plane == TL_OCCLUSION ? 1 : 0;
}

static wide3 turned(const tl_frame *frame, wide3 world)
{
    return (wide3){wide3_dot(wide3_of(frame->view_from_world[0]), world),
                   wide3_dot(wide3_of(frame->view_from_world[1]), world),
                   wide3_dot(wide3_of(frame->view_from_world[2]), world)};
}

static void place(
    const tl_frame *frame, int parallel, wide depth, uint32_t x, uint32_t y, seen *s)
{
    const tl_rays r = frame->rays;
    const wide ray_x = r.x0 + (wide)x * r.dx, ray_y = r.y0 + (wide)y * r.dy;
    const wide scale = parallel ? 1 : depth;
    const wide3 none = {0, 0, 0}, back = {0, 0, 1};
    s->position = (wide3){ray_x * scale, ray_y * scale, -depth};
    s->surface.to_eye = parallel ? back : wide3_sum(none, -1, s->position);
}

/* docs/conventions.md, "Materials". */
static void make(const tl_gbuffer *g, size_t at, seen *s)
{
    const wide metal = value(g, TL_METALLIC, at), rough = value(g, TL_ROUGHNESS, at);
    const int is_metal_rough = (g->present & TL_GROUP_METAL_ROUGH) != 0;
    wide alpha2 = fmaxq(powq(rough, 4), 2 / 10002.0Q), largest = 0;
    s->surface.exponent = 2 / alpha2 - 2;
    if (!is_metal_rough) {
        s->surface.exponent = value(g, TL_SHININESS, at);
        alpha2 = 2 / (s->surface.exponent + 2);
    }
    for (int i = 0; i < 3; i++) {
        const wide base = value(g, TL_ALBEDO_R + i, at);
        s->albedo[i] = base;
        s->diffuse[i] = is_metal_rough ? base * (1 - metal) : base;
        s->f0[i] =
            is_metal_rough ? 0.04Q + metal * (base - 0.04Q) : value(g, TL_SPECULAR_R + i, at);
        s->emissive[i] = value(g, TL_EMISSIVE_R + i, at);
        largest = fmaxq(largest, s->f0[i]);
    }
    s->below = is_metal_rough ? 0.96Q : 1 - largest;
    s->occlusion = value(g, TL_OCCLUSION, at);
    s->surface.alpha = s->surface.across = sqrtq(alpha2);
    s->surface.k = 1 - sqrtq(s->surface.alpha) / 2;
    s->surface.f90 = tl_oracle_f90(s->f0);
}

/* Of a light's numbers. d2: m^2. */
static wide weight_of(const tl_view_light *light, wide d2)
{
    const wide d = sqrtq(d2), fade = light->fade;
    float offset;
    memcpy(&offset, &light->falloff, sizeof offset);
    if (light->falloff == TL_FADE_NONE)
        return 1;
    if (light->falloff == TL_FADE_LINEAR)
        return fmaxq(0, 1 - d * fade);
    if (light->falloff >= TL_FADE_COUNT)
        return fminq(1, fmaxq(0, offset - d * fade));
    return fmaxq(0, 1 - d2 * fade * d2 * fade) * fminq(1 / d2, 1e4Q);
}

/* What multiplies its specular lobe: docs/conventions.md, "Shading models". */
static wide specular_part(const seen *s, const tl_oracle_reflected *r, int channel)
{
    const wide f0 = s->f0[channel];
    if (s->model == TL_MODEL_BLINN_PHONG_NORMALIZED)
        return f0 * s->diffuse[channel] * (s->surface.exponent + 2) / 8 * r->specular;
    return f0 * r->specular + (s->surface.f90 - f0) * r->grazing;
}

/* Returns whether it reaches the surface, from above. */
static int add_light_to(const seen *s, const tl_view_light *light, int is_global, wide sum[3])
{
    const wide3 at = wide3_of(light->position);
    const int is_sun = light->falloff == TL_FADE_NONE;
    seen lit = *s;
    lit.surface.to_light = is_sun ? at : wide3_sum(at, -1, s->position);
    const wide d2 = wide3_dot(lit.surface.to_light, lit.surface.to_light);
    if (!(d2 > (is_global ? 0 : 1e-24Q)) || !(is_global || d2 < light->range2))
        return 0;
    const tl_oracle_reflected r = tl_oracle_reflection(words[s->model], &lit.surface);
    const wide weight = weight_of(light, d2);
    for (int i = 0; i < 3; i++) {
        const wide below = s->model == TL_MODEL_METAL_ROUGH ? s->below : 1;
        sum[i] += weight * (light->diffuse[i] * s->diffuse[i] * below * r.diffuse +
                            light->specular[i] * specular_part(s, &r, i));
    }
    return r.diffuse > 0;
}

/* Returns how many lights reach the surface. */
static int radiance(
    const tl_prepared *p, const tl_gbuffer *g, uint32_t x, uint32_t y, wide sum[3])
{
    const size_t at = (size_t)y * g->pitch + x;
    const wide depth = value(g, TL_DEPTH, at);
    const wide3 normal = {value(g, TL_NORMAL_X, at), value(g, TL_NORMAL_Y, at),
                          value(g, TL_NORMAL_Z, at)};
    seen s = {.model = p->needs.model};
    make(g, at, &s);
    place(&p->frame, (int)p->needs.orthographic, depth, x, y, &s);
    s.surface.normal = turned(&p->frame, normal);
    s.surface.along = turned(&p->frame, (wide3){0, 1, 0});
    for (int i = 0; i < 3; i++)
        sum[i] = isinfq(depth)
                     ? p->frame.sky[i]
                     : s.albedo[i] * p->frame.ambient[i] * s.occlusion + s.emissive[i];
    if (isinfq(depth) || !(wide3_length(s.surface.normal) > 0))
        return 0;
    int reached = 0;
    for (uint32_t i = 0; i < p->frame.light_count; i++)
        reached += add_light_to(&s, &p->lights[i], i < p->frame.global_count, sum);
    return reached;
}

/* --- frames ------------------------------------------------------------------------------------------- */

/* Every `stride`th of the many random lights is enough. */
static void thin(tl_light_set *lights, size_t stride)
{
    size_t kept = 0;
    for (size_t i = 0; i < lights->count; i++)
        if (i % stride == 0 || i + 3 >= lights->count)
            lights->lights[kept++] = lights->lights[i];
    lights->count = kept;
}

typedef struct lit_frame {
    tl_gbuffer *g;
    tl_light_set lights;
    tl_prepared prepared;
    tl_image *image; /* by the float twin */
    float *planes[TL_PLANE_COUNT];
} lit_frame;

static lit_frame lit_frame_of(int model, uint32_t present, tl_projection projection)
{
    lit_frame f = {.g = NULL};
    tl_error err;
    f.g = hard_frame(projection, present, &f.lights);
    ASSERT_OK(tl_gbuffer_repair(f.g, "hard", false, NULL, &err), err);
    thin(&f.lights, 16);
    f.lights.model = (enum tl_shading_model)model;
    ASSERT_OK(tl_prepare(f.g, &f.lights,
                         &(tl_prepare_options){.tile_size = 16, .effects = TL_EFFECTS_ALL},
                         NULL, &f.prepared, &err),
              err);
    f.image = image_like(f.g);
    tl_reference_light(&f.prepared, f.g, TL_TWIN_FLOAT, f.image);
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        f.planes[p] = tl_gbuffer_plane(f.g, (enum tl_plane)p);
    return f;
}

static void lit_frame_clear(lit_frame *f)
{
    tl_image_destroy(f->image);
    tl_prepared_clear(&f->prepared);
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->g);
}

/* Numbers end at 2^-64 of a power, 2^-126 and the like in every precision. */
static const double ends = 0x1p-46;

static void check_pixel(
    const lit_frame *f, uint32_t x, uint32_t y, figure *single, figure *reference)
{
    const tl_allowance a = tl_allowance_of(&f->prepared, f->planes, x, y, TL_COSINE_STABLE);
    wide want[3];
    const int reached = radiance(&f->prepared, f->g, x, y, want);
    for (unsigned c = 0; c < 3; c++) {
        const double got = (double)tl_image_plane(f->image, c)[(size_t)y * f->image->pitch + x];
        const double slack = fmax(a.high[c] - (double)want[c], (double)want[c] - a.low[c]);
        const double scale = fmax(1.0, a.expected[c]), width = a.high[c] - a.low[c];
        if (!(want[c] >= a.low[c] - ends * scale && want[c] <= a.high[c] + ends * scale))
            fail_msg("%s, pixel (%u, %u), channel %u: the equations give %.12g, the reference "
                     "%.12g, kernels may %.12g to %.12g",
                     single->formula, x, y, c, (double)want[c], a.expected[c], a.low[c],
                     a.high[c]);
        if (!a.certain || !reached) /* a figure of what is lit */
            continue;
        figure_sees(single, (double)fabsq(got - want[c]) / scale, slack / scale,
                    "pixel (%u, %u), channel %u: %.12g for %.12g", x, y, c, got,
                    (double)want[c]);
        figure_sees(reference, (double)fabsq(a.expected[c] - want[c]) / scale,
                    width / scale * 0x1p-29 + ends,
                    "pixel (%u, %u), channel %u: %.12g for %.12g", x, y, c, a.expected[c],
                    (double)want[c]);
    }
}

static figure figure_of(int model, const char *arithmetic, const char *unit, const char *parts)
{
    return (figure){.section = "pixels",
                    .formula = words[model],
                    .file = "host/reference/allowance.c",
                    .quantity = "radiance, of itself above 1",
                    .arithmetic = arithmetic,
                    .unit = unit,
                    .parts = parts};
}

static void pixels_are_within(void **state)
{
    (void)state;
    for (int model = 0; model < TL_MODEL_COUNT; model++) {
        figure single = figure_of(model, "float", "u",
                                  "intervals of position, normal, eye, "
                                  "way, weight, lobes, materials, sums; OpenCL's full profile");
        figure reference = figure_of(model, "double", "u", "the same times 2^-29, and 2^-46");
        for (size_t k = 0; k < COUNT_OF(kinds); k++) {
            lit_frame f = lit_frame_of(model, kinds[k],
                                       (model + (int)k) % 2 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE);
            const uint32_t hard = (uint32_t)COUNT_OF(hard_pixels);
            for (uint32_t x = 0; x < hard; x++)
                check_pixel(&f, x, 0, &single, &reference);
            for (uint32_t i = 0; i < 60; i++)
                check_pixel(&f, i * 7 % HARD_WIDTH, 1 + i * 11 % (HARD_HEIGHT - 1), &single,
                            &reference);
            lit_frame_clear(&f);
        }
        figure_report(&single);
        figure_report(&reference);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pixels_are_within)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
