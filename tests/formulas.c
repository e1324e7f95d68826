/* Compiled once in float and once in double: TL_FORMULAS is the name of what comes of it. */
#include "formulas.h"

#include "light.h"
#include "sky.h"
#include "texture.h"
#include "unpack.h"

static vec3 in(const double v[3])
{
    return (vec3){(real)v[0], (real)v[1], (real)v[2]};
}

static vec3 in_floats(const float v[3])
{
    return (vec3){(real)v[0], (real)v[1], (real)v[2]};
}

static void out3(vec3 v, double out[3])
{
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
}

static void unit(const float v[3], double out[3])
{
    out3(unit3(in_floats(v)), out);
}

static double specular_power(const double normal[3], const double half[3], double exponent)
{
    return (double)blinn_phong_specular(in(normal), in(half), (real)exponent);
}

static substance substance_like(uint32_t model, const formula_surface *s)
{
    const vec3 grey = {(real)s->f0, (real)s->f0, (real)s->f0};
    return (substance){.model = (integer)model,
                       .diffuse = grey,
                       .specular = grey,
                       .shininess = (real)s->exponent,
                       .alpha2 = (real)s->alpha2,
                       .across2 = (real)s->across2,
                       .k = (real)s->k,
                       .along = in_floats(s->along)};
}

/* As add_any_light has it, of a light whose falloff and colours are 1. */
static formula_reflection reflection_at(uint32_t model,
                                        const formula_surface *from,
                                        const float light[3])
{
    const tl_needs needs = {.present = TL_GROUP_BASE,
                            .model = model,
                            .models = 1u << model,
                            .specular = (traits_of(model) & TL_LOBE_SPECULAR) != 0};
    const tl_view_light lamp = {.position = {light[0], light[1], light[2]}};
    const light_colors white = {{R(1.0), R(1.0), R(1.0)}, {R(1.0), R(1.0), R(1.0)}};
    const surface s = surface_at(needs, in_floats(from->position),
                                 unit3(in_floats(from->normal)), (real)from->exponent, R(0.0));
    const vec3 l = vector_to_light(s.position, lamp);
    const approach a = approach_of(s, l);
    arrival to;
    to.lit = a.distance2 > TL_LEAST_DISTANCE2;
    to.distance = SQRT(a.distance2);
    to.per_distance = R(1.0) / to.distance;
    to.weight = R(1.0);
    const received sum =
        add_light(nothing_received(), needs, s,
                  finish_of(needs, s, substance_like(model, from)), white, l, a, to);
    return (formula_reflection){(double)sum.diffuse.x, (double)sum.specular.x,
                                (double)sum.grazing.x};
}

static double fade(const formula_falloff *f, double at)
{
    const real d = (real)at;
    if (f->row == TL_FADE_LINEAR)
        return (double)fade_linear(d, f->fade);
    if (f->row == TL_FADE_LINEAR_FROM) {
        tl_u32 bits;
        memcpy(&bits, &f->offset, sizeof bits);
        return (double)fade_linear_from(d, f->fade, bits);
    }
    if (f->row == TL_FADE_TABLE)
        return (double)fade_by_table(d, f->fade, f->table, f->last);
    return (double)fade_inverse_square(d, R(1.0) / SQRT(d), f->fade);
}

static double share_of_cone(const formula_cone *cone, const double l[3], int *is_in)
{
    const tl_view_spot spot = {.axis = {cone->axis[0], cone->axis[1], cone->axis[2]},
                               .least_cos = cone->least_cos,
                               .least_cos2 = cone->least_cos2,
                               .scale = cone->scale};
    const vec3 way = in(l);
    const real distance2 = dot3(way, way);
    *is_in = in_cone(spot, way, distance2);
    return (double)cone_share(spot, way, R(1.0) / SQRT(distance2));
}

static double depth(uint32_t code, int orthographic, float slope, float offset, double stored)
{
    const tl_frame frame = {.depth_slope = slope, .depth_offset = offset};
    const tl_needs needs = {.orthographic = (tl_u32)orthographic};
    const real number = TL_IS_NEARNESS(code) ? nearness_of(code, (real)stored) : (real)stored;
    return (double)depth_of(&frame, needs, code, number);
}

static void position(
    const float rays[4], int orthographic, double column, double row, double at, double out[3])
{
    const tl_needs needs = {.orthographic = (tl_u32)orthographic};
    const tl_rays of = {.x0 = rays[0], .dx = rays[1], .y0 = rays[2], .dy = rays[3]};
    out3(view_position(of, needs, (real)column, (real)row, (real)at), out);
}

static double number(uint32_t format, uint32_t word, uint32_t shift, uint32_t bits)
{
    return (double)number_value(format, word, shift, bits);
}

static void octahedron(const double e[2], double out[3])
{
    out3(direction_of_octahedron((vec2){(real)e[0], (real)e[1]}), out);
}

static void spheremap(const double e[2], double out[3])
{
    out3(direction_of_spheremap((vec2){(real)e[0], (real)e[1]}), out);
}

static double exponent(double stored)
{
    return (double)shininess_of_logarithm((real)stored);
}

static void shared(uint32_t word, double out[3])
{
    out3(color_of_shared(word), out);
}

static double longitude(double y, double x)
{
    return (double)longitude_of((real)y, (real)x);
}

static double shown(const formula_map *map, const float direction[3])
{
    tl_view_map of = {.pixels_at = 1, .width = map->width, .height = map->height};
    memcpy(of.right, map->right, sizeof of.right);
    memcpy(of.up, map->up, sizeof of.up);
    memcpy(of.ahead, map->ahead, sizeof of.ahead);
    const vec3 d = in_floats(direction);
    return (double)(map->is_projected ? map_projected(map->texels, of, d).x
                                      : map_around(map->texels, of, d).x);
}

static double gradient(const formula_sky *sky, const float ray[3])
{
    const float horizon[3] = {sky->horizon, sky->horizon, sky->horizon};
    const tl_view_sky of = {.map = {.up = {sky->up[0], sky->up[1], sky->up[2]}},
                            .zenith = {sky->zenith, sky->zenith, sky->zenith},
                            .ground = {sky->ground, sky->ground, sky->ground}};
    return (double)sky_gradient(horizon, of, in_floats(ray)).x;
}

const formulas TL_FORMULAS = {
    .name = TL_REAL_DOUBLE ? "double" : "float",
    .u = TL_REAL_DOUBLE ? 0x1p-53 : 0x1p-24,
    .unit = unit,
    .specular_power = specular_power,
    .reflection = reflection_at,
    .fade = fade,
    .cone_share = share_of_cone,
    .depth = depth,
    .position = position,
    .number = number,
    .octahedron = octahedron,
    .spheremap = spheremap,
    .exponent = exponent,
    .shared = shared,
    .longitude = longitude,
    .shown = shown,
    .gradient = gradient,
};
