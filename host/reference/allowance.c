/* The value of a pixel in double, and how far a kernel in float may be from it.
 *
 * The manner is that of conformance tests (acceptance intervals, Higham, "Accuracy and Stability of
 * Numerical Algorithms", 2002, chapter 3): every quantity has an interval that any evaluation of its
 * formula in float falls into, and formulas that are monotone carry the ends of one interval to the
 * ends of the next. Nothing here is measured.
 *
 * u = 2^-24. A step of a kernel may be off, relative to itself, by
 *     + - * fma          1u     IEEE 754
 *     division           5u     2.5 ulp, OpenCL 1.2, section 7.4, full profile; an ulp is at most 2u
 *     sqrt               6u     3 ulp; rsqrt, 2 ulp, is less than sqrt and division
 *     exp, exp2, log1p   6u     3 ulp
 *     pow               32u     16 ulp
 * and sums and products may be grouped as they like, with fma or without: a dot product is off by at
 * most 3u sum |a_i b_i|. Products of errors are left out; U is larger than u by more than they are.
 * Squares that leave the range of float (flushed to zero, or infinite) make what depends on them
 * unknown.
 *
 * Where a comparison decides on a light (d2 < range2, n.l > 0, in its cone) and the two sides are closer
 * than they may be off, either decision is allowed: the light's interval then begins at 0.
 *
 * tests/test_check_bounds.c shows that the kernels are within, tests/test_check_sensitivity.c that small
 * faults are not. */
#include "allowance.h"

#include "allowance_map.h"
#include "allowance_shadow.h"
#include "allowance_sky.h"
#include "occlusion.h"
#include "ranges.h"
#include "rough_lobes.h"
#include "sections.h"

static const double least_square = 1e-30,
                    most_square = 1e37; /* squares float keeps, with room */

/* 1 / sqrt(a.a): dot product, half of 3u; root; division; and the product with it. */
static const double unit_length = 1.5 + 6.0 + 5.0 + 1.0; /* u */

static double length_of(vec3 v)
{
    return sqrt(dot3(v, v));
}

static int keeps_square(double square)
{
    return square > least_square && square < most_square;
}

/* How far a unit vector moves when the vector it is made of, `length` long, moves by `by`: the
 * chord of the widest angle, asin(by / length). */
static double chord(double by, double length)
{
    return by < length ? 2.0 * sin(0.5 * asin(by / length)) : 2.0;
}

/* x0 + column dx is the sum of two roundings, and the product with depth of one more. */
static double moved_along(double ray, double step, double depth, int orthographic)
{
    const double ray_moved = U * (fabs(step) + fabs(ray));
    return orthographic ? ray_moved : depth * (ray_moved + U * fabs(ray));
}

/* Rotation: 3u sum |r_i w_i| in each component; rounding of its parts when it is made unit, 2u. What
 * that does to its length is in unit_length. */
static double normal_error(const tl_frame *frame, vec3 world, double length)
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        const float *r = frame->view_from_world[i];
        const double sum = fabs((double)r[0] * world.x) + fabs((double)r[1] * world.y) +
                           fabs((double)r[2] * world.z);
        square += sum * sum;
    }
    return U * (3.0 * sqrt(square) / length + 2.0);
}

/* Whether a parameter of the pixel comes from metal-rough planes: what its row gives is exact. */
static int is_mapped(const tl_prepared *prepared, pixel in, enum tl_brdf_parameter parameter)
{
    if (!(prepared->needs.present & TL_GROUP_METAL_ROUGH))
        return 0;
    return !reads_planes(prepared->needs, TL_GROUP_BRDF) ||
           !(prepared->rows[(tl_u32)in.brdf].given & (tl_u32)parameter);
}

/* alpha^2 = roughness^4: 3u; the quotient 2/alpha^2: 8u and the constant's rounding; minus 2: u. */
static interval exponent_of(const tl_prepared *prepared, pixel in, double exponent)
{
    const int is_computed =
        !prepared->needs.fixed_exponent && is_mapped(prepared, in, TL_TAKES_EXPONENT);
    const double error = is_computed ? U * 10.0 * (exponent + 2.0) : 0.0;
    return (interval){clamp_low(exponent - error), exponent + error};
}

/* Its row of models.h. */
static tl_u32 model_of(tl_needs needs, const substance *made)
{
    return has_one_model(needs) ? needs.model : (tl_u32)made->model;
}

static rough_surface rough_surface_of(
    const tl_prepared *prepared, pixel in, double exponent, uint32_t column, uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    const substance made = substance_at(frame, prepared->needs, in, prepared->rows);
    const tl_u32 model = model_of(prepared->needs, &made);
    const tl_rays rays = frame->rays;
    const int parallel = (int)prepared->needs.orthographic;
    const double step_x = (column + (double)rays.column0) * (double)rays.dx,
                 step_y = (row + (double)rays.row0) * (double)rays.dy;
    const double ray_x = step_x + (double)rays.x0, ray_y = step_y + (double)rays.y0;
    const surface s =
        surface_of(frame, prepared->needs, in, exponent, (real)column, (scalar)row);
    const double world2 = dot3(in.normal, in.normal), eye2 = dot3(s.position, s.position);
    rough_surface r = {.exact = s,
                       .at = (size_t)row * frame->pitch + column,
                       .off = tl_approximations_off(&prepared->approximations),
                       .moved_x = moved_along(ray_x, step_x, in.depth, parallel),
                       .moved_y = moved_along(ray_y, step_y, in.depth, parallel),
                       .made = made,
                       .model = model,
                       .traits = traits_of(model),
                       .alpha2 = around(made.alpha2, 10.0 * U * made.alpha2),
                       .is_lit = world2 > 0.0,
                       .has_normal = keeps_square(world2),
                       .has_eye = parallel || keeps_square(eye2),
                       .exponent = exponent_of(prepared, in, exponent)};
    if (r.has_normal)
        r.normal_moved = normal_error(frame, in.normal, sqrt(world2));
    if (!parallel && r.has_eye)
        r.eye_moved = chord(hypot(r.moved_x, r.moved_y), sqrt(eye2)) + U * unit_length;
    return r;
}

static interval distance2_of(double exact, double moved)
{
    const double near = clamp_low(exact - moved), far = exact + moved;
    return (interval){clamp_low(near * near * (1.0 - 3.0 * U) - flushed),
                      far * far * (1.0 + 3.0 * U) + flushed};
}

/* Positions move by moved_x, moved_y, the differences round once each. In range: d2 < range2. Nearer
 * than kernels/light.h takes lights for real, none may add anything; without a range they do
 * wherever d2 is not 0. */
static way way_to(const rough_surface *s, tl_view_light light, int global)
{
    const vec3 l = vector_to_light(s->exact.position, light);
    const vec3 moves = {s->moved_x + U * fabs(l.x), s->moved_y + U * fabs(l.y), U * fabs(l.z)};
    way w = {.l = l,
             .l_moved = length_of(moves),
             .exact = length_of(l),
             .root_off = global ? 0.0 : s->off.root};
    w.distance2 = distance2_of(w.exact, w.l_moved);
    w.distance = (interval){sqrt(w.distance2.low) * (1.0 - root * U - w.root_off),
                            sqrt(w.distance2.high) * (1.0 + root * U + w.root_off)};
    w.may_reach = global || (w.distance2.low < (double)light.range2 &&
                             w.distance2.high > TL_LEAST_DISTANCE2);
    w.does_reach = w.distance2.high < most_square && w.distance2.low > TL_LEAST_DISTANCE2 &&
                   (global || w.distance2.high < (double)light.range2);
    return w;
}

static way way_to_sun(tl_view_light light)
{
    const way w = {
        .l = {(real)light.position[0], (real)light.position[1], (real)light.position[2]},
        .exact = 1.0,
        .distance = {1.0, 1.0},
        .distance2 = {1.0, 1.0},
        .may_reach = 1,
        .does_reach = 1};
    return w;
}

/* 1 - d fade falls with d; the product rounds, and the sum. */
static interval linear_weight(interval distance, double fade)
{
    const interval share = {distance.low * fade, distance.high * fade};
    return (interval){clamp_low(1.0 - share.high * (1.0 + U) - U),
                      clamp_low(1.0 - share.low * (1.0 - U) + U)};
}

/* offset - d fade falls with d, cut at 0 and 1: the product rounds, and the sum, which is of no matter
 * above 1. */
static interval linear_from_weight(interval distance, double fade, tl_u32 offset_bits)
{
    const double offset = WORD_AS_REAL(offset_bits);
    const double low = offset - distance.high * fade * (1.0 + U) - U;
    const double high = offset - distance.low * fade * (1.0 - U) + U;
    return (interval){clamp_low(low < 1.0 ? low : 1.0), clamp_low(high < 1.0 ? high : 1.0)};
}

/* max(0, 1 - (d2 fade)^2) falls with d2: 3u in the square, u in the difference. 1/d^2, from 1/d:
 * root, division and square beyond what d2 is off, 23u; cut where the light is near. */
static interval inverse_square_weight(interval distance2, double fade, double root_off)
{
    const double near = distance2.low * fade, far = distance2.high * fade;
    const double quotient = (2.0 * (root + division) + 1.0) * U + root_off * (2.0 + root_off);
    const double most = TL_MOST_PER_DISTANCE2;
    const double dim = 1.0 / distance2.high * (1.0 - quotient);
    const double bright =
        distance2.low > 0.0 ? 1.0 / distance2.low * (1.0 + quotient) : 2.0 * most;
    const interval window = {clamp_low(1.0 - far * far * (1.0 + 3.0 * U) - U),
                             clamp_low(1.0 - near * near * (1.0 - 3.0 * U) + U)};
    return (interval){window.low * (dim < most ? dim : most) * (1.0 - 6.0 * U),
                      window.high * (bright < most ? bright : most) * (1.0 + 6.0 * U)};
}

static interval weight_of(tl_view_light light, const way *w)
{
    static const interval one = {1.0, 1.0};
    if (light.falloff == TL_FADE_NONE)
        return one;
    if (light.falloff == TL_FADE_LINEAR)
        return linear_weight(w->distance, (double)light.fade);
    if (falloff_row(light.falloff) == TL_FADE_LINEAR_FROM)
        return linear_from_weight(w->distance, (double)light.fade, light.falloff);
    return inverse_square_weight(w->distance2, (double)light.fade, w->root_off);
}

/* What the cone of a spot lets through. */
typedef struct aperture {
    interval share;
    int may_pass, does_pass; /* whether the way is in it: perhaps, whatever rounding does */
} aperture;

static interval clamped_square(interval of)
{
    const double low = clamp_low(of.low < 1.0 ? of.low : 1.0),
                 high = clamp_low(of.high < 1.0 ? of.high : 1.0);
    return (interval){low * low * (1.0 - U), high * high * (1.0 + U) + flushed};
}

/* The cosine between axis and l: l turns as it moves; the sum of products is off by 3u of their
 * magnitudes, which add up to 1 at most; a unit vector by unit_length. Where scale and offset are
 * multiplied in, KHR_lights_punctual's way, scale, offset and sum are rounded once each, and none is more
 * than scale. */
static aperture aperture_of(tl_view_spot spot, const way *w)
{
    const vec3 axis = {spot.axis[0], spot.axis[1], spot.axis[2]};
    if (!(dot3(axis, axis) > 0.0)) /* no spot */
        return (aperture){{1.0, 1.0}, 1, 1};
    if (!(w->exact > 0.0))
        return (aperture){{0.0, 1.0}, 1, 0};
    const double above = dot3(axis, w->l) / w->exact - (double)spot.least_cos;
    const double off = chord(w->l_moved, w->exact) + (3.0 + unit_length + 3.0) * U;
    const interval share = {(above - off - w->root_off) * (double)spot.scale,
                            (above + off + w->root_off) * (double)spot.scale};
    return (aperture){clamped_square(share), above > -off, above > off};
}

/* The directions of both move; the dot product rounds, 3u, and the parts of l where they are divided
 * first, u. Lengths scale it and cannot change its sign. */
static incidence incidence_of(const rough_surface *s, const way *w)
{
    const vec3 n = s->exact.normal;
    const double terms = fabs(n.x * w->l.x) + fabs(n.y * w->l.y) + fabs(n.z * w->l.z);
    const double scaled = (unit_length + unit_length) * U + w->root_off;
    incidence out = {.may_be_above = 1, .cosine = {0.0, 1.0 + scaled}};
    if (!s->has_normal || !(w->exact > 0.0))
        return out;
    out.exact = dot3(n, w->l) / w->exact;
    const double off =
        s->normal_moved + chord(w->l_moved, w->exact) + 4.0 * U * terms / w->exact;
    out.may_be_above = out.exact > -off;
    out.is_above = out.exact > off;
    out.cosine = (interval){clamp_low(out.exact - off) * (1.0 - scaled),
                            clamp_low(out.exact + off) * (1.0 + scaled)};
    return out;
}

/* Light received by each lobe, per channel, not yet multiplied with what the surface reflects. */
typedef struct rough_light {
    interval diffuse[3], specular[3], grazing[3], ambient[3];
    int may_add, is_certain;
    double n_dot_l, distance;
} rough_light;

/* Weight, what is reflected of it, colour: two products, and one more where a kernel multiplies the material
 * in at once. Where one colour multiplies both lobes, a kernel may add them before: a sum, and a product. */
static interval product(tl_u32 traits, interval a, interval b, double colour)
{
    const double roundings = traits & TL_LOBE_PLAIN && !(traits & TL_LOBE_DIFFUSE) ? 3.0 : 5.0;
    return (interval){
        clamp_low(a.low * b.low * colour * (1.0 - roundings * U) - flushed * colour),
        a.high * b.high * colour * (1.0 + roundings * U) + flushed * colour};
}

/* What a light has beside the rest, whose falloff becomes *light's; NULL where it has nothing. */
static const tl_view_shape *shape_at(const tl_prepared *prepared, tl_view_light *light)
{
    if (!has_shape(light->falloff))
        return NULL;
    const tl_view_shape *shapes = tl_section_at(prepared, prepared->frame.shapes_at);
    const tl_view_shape *shape = &shapes[light->falloff - TL_FADE_COUNT];
    light->falloff = shape->falloff;
    return shape;
}

/* What it shines through in the direction from the light, 1 without a picture. */
static void tint_on(const tl_prepared *prepared,
                    const tl_view_shape *shape,
                    const way *w,
                    interval tint[3])
{
    const vec3 from = {-w->l.x, -w->l.y, -w->l.z};
    for (int i = 0; i < 3; i++)
        tint[i] = (interval){1.0, 1.0};
    if (shape && shape->map.pixels_at != 0)
        tl_map_allowance(prepared, &shape->map, (int)(shape->spot_and_link & 1u), from,
                         w->l_moved, tint);
}

/* One more product, whose colour is cut. */
static interval tinted(interval light, double colour, interval whole_tint)
{
    const interval tint = at_most(whole_tint, (double)TL_BRIGHTEST / colour);
    return (interval){light.low * tint.low * (1.0 - U),
                      light.high * tint.high * (1.0 + U) + flushed};
}

static interval weight_on(const tl_prepared *prepared,
                          const rough_surface *s,
                          const tl_view_shape *shape,
                          tl_view_light light,
                          const way *w,
                          const incidence *n_dot_l,
                          const aperture *cone)
{
    const interval falloff =
        light.falloff == TL_FADE_TABLE
            ? tl_table_allowance(prepared, shape, (double)light.fade, w->distance)
            : weight_of(light, w);
    const interval seen = tl_shadow_allowance(prepared, shape, s, w, n_dot_l);
    const vec3 from = {-w->l.x, -w->l.y, -w->l.z};
    const interval given = tl_profile_allowance(prepared, shape, from, w->l_moved);
    return (interval){falloff.low * cone->share.low * given.low * seen.low * (1.0 - 3.0 * U),
                      falloff.high * cone->share.high * given.high * seen.high *
                          (1.0 + 3.0 * U)};
}

/* The lobe that asks for no normal: weight, colour and tint. */
static void add_ambient(const tl_view_shape *shape,
                        interval weight,
                        const interval tint[3],
                        int is_certain,
                        rough_light *out)
{
    for (int i = 0; i < 3; i++) {
        const double colour = (double)shape->ambient[i];
        const interval light = {weight.low * colour * (1.0 - 2.0 * U),
                                weight.high * colour * (1.0 + 2.0 * U)};
        out->ambient[i] = tinted(light, colour, tint[i]);
        if (!(colour > 0.0))
            out->ambient[i] = (interval){0.0, 0.0};
        out->may_add |= out->ambient[i].high > 0.0;
        if (!is_certain)
            out->ambient[i].low = 0.0;
    }
}

/* All lobes of a light that may be above the surface. */
static void add_lobes(const tl_prepared *prepared,
                      const rough_surface *s,
                      tl_view_light light,
                      const way *w,
                      interval weight,
                      const interval tint[3],
                      tl_cosine form,
                      const incidence *n_dot_l,
                      rough_light *out)
{
    const rough_reflection r =
        tl_rough_reflection(s, w, n_dot_l->cosine, (int)prepared->needs.specular, form);
    out->may_add = 1;
    out->is_certain &= n_dot_l->is_above;
    for (int i = 0; i < 3; i++) {
        const double diffuse = (double)light.diffuse[i], specular = (double)light.specular[i];
        out->diffuse[i] =
            tinted(product(s->traits, weight, r.diffuse, diffuse), diffuse, tint[i]);
        out->specular[i] =
            tinted(product(s->traits, weight, r.specular, specular), specular, tint[i]);
        out->grazing[i] =
            tinted(product(s->traits, weight, r.grazing, specular), specular, tint[i]);
        if (!out->is_certain)
            out->diffuse[i].low = out->specular[i].low = out->grazing[i].low = 0.0;
    }
}

static rough_light light_on(const tl_prepared *prepared,
                            const rough_surface *s,
                            uint32_t index,
                            tl_cosine form)
{
    tl_view_light light = prepared->lights[index];
    const tl_view_shape *shape = shape_at(prepared, &light);
    const way w = light.falloff == TL_FADE_NONE
                      ? way_to_sun(light)
                      : way_to(s, light, index < prepared->frame.global_count);
    rough_light out = {.distance = w.exact};
    if (!w.may_reach || (shape && !lanes_of_link(&prepared->frame, prepared->needs,
                                                 (tl_numbers)prepared->lights, *shape, s->at)))
        return out;
    const incidence n_dot_l = incidence_of(s, &w);
    const aperture cone = aperture_of(prepared->spots[index], &w);
    const int may_be_above = s->is_lit && n_dot_l.may_be_above;
    if (!cone.may_pass || (!may_be_above && !shape))
        return out;
    interval tint[3];
    const interval weight = weight_on(prepared, s, shape, light, &w, &n_dot_l, &cone);
    tint_on(prepared, shape, &w, tint);
    out.n_dot_l = n_dot_l.exact;
    out.is_certain = w.does_reach && cone.does_pass;
    if (shape)
        add_ambient(shape, weight, tint, out.is_certain, &out);
    if (may_be_above)
        add_lobes(prepared, s, light, &w, weight, tint, form, &n_dot_l, &out);
    return out;
}

/* What a surface reflects. Metal-rough: base (1 - metallic), two roundings; mix(0.04, base,
 * metallic), three of its parts and that of the constant. */
typedef struct rough_material {
    interval diffuse[3], specular[3];
    interval grazing[3]; /* F90 - F0 */
    interval mirror[3];  /* F0, as the model tints it */
    interval f90;
    double exponent;
} rough_material;

/* (e + 2)/8, two roundings, and its product; the product with the diffuse colour. */
static interval lobe_factors(tl_u32 traits, interval e, interval specular, interval diffuse)
{
    interval out = specular;
    if (traits & TL_LOBE_ENERGY) {
        out.low *= (e.low + 2.0) / 8.0 * (1.0 - 3.0 * U);
        out.high *= (e.high + 2.0) / 8.0 * (1.0 + 3.0 * U);
    }
    if (traits & TL_LOBE_DIFFUSE)
        out = times(out, diffuse);
    return out;
}

static rough_material rough_material_of(const tl_prepared *prepared, pixel in)
{
    const tl_needs needs = prepared->needs;
    const substance m = substance_at(&prepared->frame, needs, in, prepared->rows);
    const double diffuse[3] = {m.diffuse.x, m.diffuse.y, m.diffuse.z};
    const double specular[3] = {m.specular.x, m.specular.y, m.specular.z};
    const double base[3] = {in.albedo.x, in.albedo.y, in.albedo.z};
    const int diffuse_is_mixed = is_mapped(prepared, in, TL_TAKES_DIFFUSE);
    const int specular_is_mixed = is_mapped(prepared, in, TL_TAKES_SPECULAR);
    const tl_u32 traits = traits_of(model_of(needs, &m));
    const interval f90 = tl_rough_f90(&m);
    rough_material out = {.exponent = m.shininess, .f90 = f90};
    for (int i = 0; i < 3; i++) {
        out.diffuse[i] =
            around(diffuse[i], diffuse_is_mixed ? 2.0 * U * diffuse[i] + flushed : 0.0);
        /* 1 - F0, which is off as F0 is, and by u. */
        if (traits & TL_LOBE_BELOW)
            out.diffuse[i] = times(out.diffuse[i], around(m.below, 6.0 * U));
        const double f0_off = specular_is_mixed
                                  ? 4.0 * U * (TL_DIELECTRIC + base[i] * in.metallic) + flushed
                                  : 0.0;
        if (traits & TL_LOBE_GRAZING)
            out.grazing[i] = (interval){clamp_low(f90.low - specular[i] - f0_off - U),
                                        clamp_low(f90.high - specular[i] + f0_off + U)};
        out.specular[i] = lobe_factors(traits, exponent_of(prepared, in, m.shininess),
                                       around(specular[i], f0_off), out.diffuse[i]);
        out.mirror[i] = lobe_factors(traits & ~(tl_u32)TL_LOBE_ENERGY, (interval){0.0, 0.0},
                                     around(specular[i], f0_off), out.diffuse[i]);
    }
    return out;
}

/* The sum of `terms` numbers, none negative, in any order: each addition rounds what it gives, which
 * is never more than the whole. Ambient light and emission are two more, materials one product
 * each. */
static interval summed(interval sum, uint32_t terms)
{
    const double error = (double)(terms + 6) * U * sum.high + flushed;
    return (interval){clamp_low(sum.low - error), sum.high + error};
}

/* Beyond the largest float a value is that, and where the light that is received may be beyond it, what is
 * reflected of it may. */
static interval cut(interval value, double most_received)
{
    const double most = (double)TL_MOST_FLOAT;
    if (most_received > most && value.high > 0.0)
        value.high = most;
    return at_most(value, most);
}

/* One colour, or by the ray, which moves as the pixel's position in it does. */
static tl_allowance sky_of(const tl_prepared *prepared, uint32_t column, uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    const tl_rays rays = frame->rays;
    tl_allowance out = {.certain = 1};
    interval of[3];
    for (int i = 0; i < 3; i++)
        out.expected[i] = out.low[i] = out.high[i] = (double)frame->sky[i];
    if (prepared->needs.sky == 0)
        return out;
    const vec3 expected =
        sky_radiance(frame, prepared->needs, prepared->lights, (real)column, (real)row);
    const vec3 ray = ray_direction(rays, prepared->needs, (real)column, (real)row);
    const double across = column + (double)rays.column0, down = row + (double)rays.row0;
    const int parallel = (int)prepared->needs.orthographic;
    const double moved = parallel ? 0.0
                                  : hypot(moved_along(ray.x, across * (double)rays.dx, 1.0, 1),
                                          moved_along(ray.y, down * (double)rays.dy, 1.0, 1));
    tl_sky_allowance(prepared, ray, moved, of);
    const double exact[3] = {expected.x, expected.y, expected.z};
    for (int i = 0; i < 3; i++) {
        out.expected[i] = exact[i];
        out.low[i] = of[i].low;
        out.high[i] = of[i].high;
    }
    return out;
}

/* Of ambient light: products with albedo and occlusion, and of the capture's occlusion with what surroundings
 * let through. That share is what kernels are given, so it is exact here. */
static double ambient_roundings(const tl_prepared *prepared)
{
    return prepared->needs.surroundings ? 3.0 : 2.0;
}

/* A light's ambient lobe multiplies albedo and occlusion; what it is added to before that rounds once. */
static interval reflected(const tl_prepared *prepared,
                          pixel in,
                          const rough_material *m,
                          const rough_light *light,
                          int i)
{
    const double albedo[3] = {in.albedo.x, in.albedo.y, in.albedo.z};
    const double share = albedo[i] * in.occlusion;
    const double off = (ambient_roundings(prepared) + 1.0) * U;
    return (interval){m->diffuse[i].low * light->diffuse[i].low +
                          m->specular[i].low * light->specular[i].low +
                          m->grazing[i].low * light->grazing[i].low +
                          share * light->ambient[i].low * (1.0 - off),
                      m->diffuse[i].high * light->diffuse[i].high +
                          m->specular[i].high * light->specular[i].high +
                          m->grazing[i].high * light->grazing[i].high +
                          share * light->ambient[i].high * (1.0 + off)};
}

/* Light that needs no light: albedo ambient occlusion, and emission. */
static void add_unlit(const tl_prepared *prepared, pixel in, interval sum[3])
{
    const double off = ambient_roundings(prepared) * U;
    const double albedo[3] = {in.albedo.x, in.albedo.y, in.albedo.z};
    const double emissive[3] = {in.emissive.x, in.emissive.y, in.emissive.z};
    for (int i = 0; i < 3; i++) {
        const double ambient = albedo[i] * (double)prepared->frame.ambient[i] * in.occlusion;
        sum[i].low += ambient * (1.0 - off) + emissive[i];
        sum[i].high += ambient * (1.0 + off) + emissive[i];
    }
}

/* Diffuse light of the sky, and what is mirrored of it: radiance_of's terms. */
static void add_sky_light(const tl_prepared *prepared,
                          pixel in,
                          const rough_material *m,
                          const rough_surface *s,
                          interval sum[3])
{
    if (!lit_by_sky(prepared->needs))
        return;
    const rough_sky sky = tl_rough_sky(prepared, s, in.occlusion, m->f90);
    for (int i = 0; i < 3; i++) {
        interval share = times(m->mirror[i], sky.base);
        if (s->traits & TL_LOBE_GRAZING) {
            const interval rest = times(m->grazing[i], sky.grazing);
            share = rounded((interval){share.low + rest.low, share.high + rest.high}, 2.0);
        }
        if (!(s->traits & TL_LOBE_SPECULAR))
            share = (interval){0.0, 0.0};
        const interval diffuse = times(m->diffuse[i], sky.diffuse[i]),
                       mirrored = times(share, sky.mirrored[i]);
        const interval both =
            rounded((interval){diffuse.low + mirrored.low, diffuse.high + mirrored.high}, 4.0);
        sum[i].low += both.low;
        sum[i].high += both.high;
    }
}

/* The frame as this pixel has it: of the one model that its row names. */
static tl_prepared prepared_at(const tl_prepared *prepared, pixel in)
{
    tl_prepared own = *prepared;
    if (reads_planes(own.needs, TL_GROUP_BRDF)) {
        own.needs.model = own.rows[(tl_u32)in.brdf].model;
        own.needs.models = 1u << own.needs.model;
    }
    return own;
}

/* at: counted in the planes. */
static pixel surrounded_pixel(const tl_prepared *prepared,
                              float *const planes[TL_PLANE_COUNT],
                              size_t at)
{
    pixel in = pixel_at(planes, at);
    in.occlusion = ambient_share(&prepared->frame, prepared->needs,
                                 (tl_numbers)prepared->lights, in.occlusion, at);
    return in;
}

tl_allowance tl_allowance_of(const tl_prepared *prepared,
                             float *const planes[TL_PLANE_COUNT],
                             uint32_t column,
                             uint32_t row,
                             tl_cosine form)
{
    const tl_frame *frame = &prepared->frame;
    const pixel in = surrounded_pixel(prepared, planes, (size_t)row * frame->pitch + column);
    if (!(in.depth < INFINITY))
        return sky_of(prepared, column, row);
    const vec3 expected = light_pixel(prepared, in, column, row);
    const tl_prepared own = prepared_at(prepared, in);
    const rough_material material = rough_material_of(&own, in);
    const rough_surface s = rough_surface_of(&own, in, material.exponent, column, row);
    interval sum[3] = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    double arriving[3] = {0.0, 0.0, 0.0};
    uint32_t terms = 0;
    int certain = 1;
    for (uint32_t index = 0; index < frame->light_count; index++) {
        const rough_light light = light_on(&own, &s, index, form);
        if (!light.may_add)
            continue;
        terms++;
        certain &= light.is_certain;
        for (int i = 0; i < 3; i++) {
            const interval added = reflected(prepared, in, &material, &light, i);
            sum[i].low += added.low;
            sum[i].high += added.high;
            arriving[i] += light.diffuse[i].high + light.specular[i].high +
                           light.grazing[i].high + light.ambient[i].high;
        }
    }
    add_unlit(prepared, in, sum);
    add_sky_light(&own, in, &material, &s, sum);
    tl_allowance out = {.expected = {expected.x, expected.y, expected.z}, .certain = certain};
    for (int i = 0; i < 3; i++) {
        const interval light = summed((interval){0.0, arriving[i]}, terms);
        const interval whole = cut(summed(sum[i], terms), light.high);
        out.low[i] = whole.low;
        out.high[i] = whole.high;
    }
    return out;
}

int tl_allowance_share(const tl_prepared *prepared,
                       float *const planes[TL_PLANE_COUNT],
                       uint32_t column,
                       uint32_t row,
                       uint32_t index,
                       tl_cosine form,
                       tl_light_share *out)
{
    const pixel in =
        surrounded_pixel(prepared, planes, (size_t)row * prepared->frame.pitch + column);
    if (!(in.depth < INFINITY))
        return 0;
    const tl_prepared own = prepared_at(prepared, in);
    const rough_material material = rough_material_of(&own, in);
    const rough_surface s = rough_surface_of(&own, in, material.exponent, column, row);
    const rough_light light = light_on(&own, &s, index, form);
    if (!light.may_add)
        return 0;
    *out = (tl_light_share){
        .distance = light.distance, .n_dot_l = light.n_dot_l, .certain = light.is_certain};
    for (int i = 0; i < 3; i++) {
        const interval added = reflected(prepared, in, &material, &light, i);
        out->low[i] = added.low;
        out->high[i] = added.high;
    }
    return 1;
}
