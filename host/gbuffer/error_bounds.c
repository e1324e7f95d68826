/* The bounds, from the numbers up: what writing rounds, what reading in float adds, and how a code
 * carries both to the value. u = 2^-24 is half an ulp of 1 in float, relative to what is rounded.
 *
 * Packing computes in double; what it rounds there is below 2^-50 of its operands and is within the
 * `margin` that every sum of float roundings is given, which also holds their products. */
#define TL_REAL_DOUBLE 1
#include "layout.h"

#include "tilelight/error_bounds.h"

#include <assert.h>

static const double u = 0x1p-24;
static const double margin = 1.0 + 0x1p-20;
static const double pi = 3.14159265358979323846;

/* --- numbers (kernels/number.h) ------------------------------------------------------------------ */

/* Half of the distance between numbers of `digits` binary digits around `value`, whose exponents end at
 * `least`: values in [2^(e-1), 2^e) are multiples of 2^(e-digits). What is hardly above a power of two
 * rounds to it, by less than what is below. */
static double half_ulp(double value, int digits, int least)
{
    int exponent = least;
    if (value != 0.0)
        frexp(value * (1.0 - 0x1p-30), &exponent);
    return ldexp(0.5, (exponent > least ? exponent : least) - digits);
}

static double half_float_ulp(double value)
{
    return half_ulp(value, 24, -125);
}

static double half_step(tl_channel c)
{
    return c.number == TL_NUMBER_SNORM ? 0.5 * snorm_step(c.bits) : 0.5 * unorm_step(c.bits);
}

static bool is_whole(tl_channel c)
{
    return c.number != TL_NUMBER_FLOAT && c.number != TL_NUMBER_HALF &&
           c.number != TL_NUMBER_FLOAT24;
}

/* Between `value` and what its channel reads as. Half and float24 are rounded twice, to float first,
 * and read exactly; of whole numbers the step is rounded, and the product with it: 2u of what is read.
 * A float holds every plane exactly: those who store what they computed add half_float_ulp. */
static double number_error(tl_channel c, double value)
{
    if (c.number == TL_NUMBER_FLOAT || c.number == TL_NUMBER_WHOLE)
        return 0.0;
    if (c.number == TL_NUMBER_HALF)
        return half_ulp(value, 11, -13) + half_float_ulp(value * 0x1p-112) * 0x1p112;
    if (c.number == TL_NUMBER_FLOAT24)
        return half_ulp(value, 17, -125) + half_float_ulp(value);
    return half_step(c) + 2.0 * u * (fabs(value) + half_step(c)) * margin;
}

static double number_limit(tl_channel c)
{
    if (c.number == TL_NUMBER_FLOAT || c.number == TL_NUMBER_FLOAT24)
        return INFINITY;
    if (c.number == TL_NUMBER_WHOLE)
        return (double)((1u << c.bits) - 1u);
    return c.number == TL_NUMBER_HALF ? TL_MOST_HALF : 1.0;
}

/* --- depth (kernels/depth_code.h) ---------------------------------------------------------------- */

/* What a stored nearness may be: the surface's is q. */
typedef struct nearness {
    double low, high; /* as stored */
    double read;      /* relative error of reading it in float */
} nearness;

/* Half a step of the number that is stored, as one of q, and the least q of a surface: the number next
 * to the sky's, which is a whole step from the far plane. In float, 1 - d and (1 - d)/2 are exact for
 * d >= 1/2 (Sterbenz) and off by u of q below. */
static nearness nearness_around(const tl_attribute *depth, double q, double computed)
{
    const tl_channel c = depth->channels[0];
    double step = 0.0, least = 0.0, read = u;
    if (is_whole(c)) {
        step = half_step(c);
        least = 2.0 * step;
        read = 2.0 * u;
    } else if (depth->code == TL_DEPTH_REVERSED) {
        step = half_float_ulp(q);
        least = 0x1p-126;
        read = 0.0;
    } else if (depth->code == TL_DEPTH_FORWARD) {
        step = half_float_ulp(1.0 - q);
        least = u;
    } else {
        step = 0.5 * half_float_ulp(1.0 - 2.0 * q);
        least = 0.5 * u;
    }
    step += computed;
    return (nearness){fmax(q - step, least), fmax(q + step, least), read};
}

/* Of 1/(q slope + offset): slope, offset, fma and division round once each, and no term is negative:
 * 3u of the depth beside what q is off. */
static double perspective_error(const tl_camera *camera, const tl_attribute *a, double depth)
{
    const double at_near = 1.0 / (double)camera->near, at_far = 1.0 / (double)camera->far;
    const double slope = at_near - at_far, at_depth = 1.0 / depth;
    const double computed = 0x1p-51 * (at_depth + at_far) / slope;
    const nearness q =
        nearness_around(a, fmin(fmax((at_depth - at_far) / slope, 0.0), 1.0), computed);
    const double rounding = (q.read + 3.0 * u) * margin;
    const double denormal = 0x1p-149; /* what rounding the smallest offsets leaves */
    const double deepest = q.low * slope + at_far - denormal;
    const double high = deepest > 0.0 ? (1.0 + rounding) / deepest : INFINITY;
    const double low = (1.0 - rounding) / (q.high * slope + at_far + denormal);
    return fmax(high - depth, depth - low);
}

/* Of q slope + offset, slope = near - far rounded, offset = far exact. */
static double orthographic_error(const tl_camera *camera, const tl_attribute *a, double depth)
{
    const double near = (double)camera->near, far = (double)camera->far, span = far - near;
    const double computed = 0x1p-51 * (fabs(depth) + fabs(far)) / span;
    const double exact = fmin(fmax((far - depth) / span, 0.0), 1.0);
    const nearness q = nearness_around(a, exact, computed);
    const double moved = fmax(q.high - exact, exact - q.low) * span;
    return (moved + (q.read + u) * q.high * span + u * (fabs(depth) + moved)) * margin;
}

/* Of s slope + near: s rounds when it is stored, the slope, and their sum. */
static double fraction_error(const tl_camera *camera, const tl_attribute *a, double depth)
{
    (void)a;
    return (2.0 * u * fabs(depth - (double)camera->near) + u * fabs(depth)) * margin;
}

static double metres_error(const tl_camera *camera, const tl_attribute *a, double depth)
{
    (void)camera;
    return number_error(a->channels[0], depth);
}

static double depth_buffer_error(const tl_camera *camera, const tl_attribute *a, double depth)
{
    return camera->projection == TL_ORTHOGRAPHIC ? orthographic_error(camera, a, depth)
                                                 : perspective_error(camera, a, depth);
}

static double (*const depth_errors[TL_DEPTH_CODE_COUNT])(const tl_camera *,
                                                         const tl_attribute *,
                                                         double depth) = {
    [TL_DEPTH_METRES] = metres_error,     [TL_DEPTH_FORWARD] = depth_buffer_error,
    [TL_DEPTH_NDC] = depth_buffer_error,  [TL_DEPTH_REVERSED] = depth_buffer_error,
    [TL_DEPTH_FRACTION] = fraction_error,
};

/* The product of the ray, 2u off (position.h), and depth. */
static void bound_on_ray(const tl_camera *camera, const double view[3], double bound[3])
{
    const bool parallel = camera->projection == TL_ORTHOGRAPHIC;
    for (int i = 0; i < 2; i++) {
        const double along = parallel ? 0.0 : fabs(view[i] / view[2]) * bound[2];
        bound[i] = (along + 2.0 * u * (fabs(view[i]) + along)) * margin;
    }
}

/* --- positions ------------------------------------------------------------------------------------ */

/* || M M^T - 1 ||, Frobenius: how far the camera's matrix, of rounded floats, is from a rotation. It
 * bounds what the transpose in place of the inverse moves a vector of length 1, from either side. */
static double rotation_defect(const tl_camera *camera)
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double product = i == j ? -1.0 : 0.0;
            for (int k = 0; k < 3; k++)
                product += (double)camera->view_from_world[i][k] *
                           (double)camera->view_from_world[j][k];
            sum += product * product;
        }
    return sqrt(sum);
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double coordinate_error(tl_channel c, double value)
{
    return number_error(c, value) + half_float_ulp(value);
}

/* Each world coordinate is off by its number, which the camera's rows turn; their products with it add
 * up in float, 3u (vec3.h), the translation u; and the way there and back is the defect. */
static void bound_in_world(const tl_camera *camera,
                           const tl_attribute *a,
                           const double view[3],
                           double bound[3])
{
    double world[3];
    tl_camera_world_point(camera, view, world);
    const double defect = rotation_defect(camera) * length_of(world);
    for (int i = 0; i < 3; i++) {
        double moved = defect;
        for (int j = 0; j < 3; j++) {
            const double row = fabs((double)camera->view_from_world[i][j]);
            const double error = coordinate_error(a->channels[j], world[j]);
            moved += row * (error + 3.0 * u * (fabs(world[j]) + error));
        }
        bound[i] = (moved + u * (fabs(view[i]) + moved)) * margin;
    }
}

void tl_position_bound(const tl_camera *camera,
                       enum tl_layout_name layout,
                       const double view[3],
                       double bound[3])
{
    const tl_attribute *a = &tl_layouts[layout].depth;
    if (a->code == TL_DEPTH_WORLD_POSITION) {
        bound_in_world(camera, a, view, bound);
    } else if (a->code == TL_DEPTH_VIEW_POSITION) {
        for (int i = 0; i < 3; i++)
            bound[i] = coordinate_error(a->channels[i], view[i]) * margin;
    } else {
        bound[2] = depth_errors[a->code](camera, a, -view[2]);
        bound_on_ray(camera, view, bound);
    }
}

/* --- normals (kernels/normal_code.h) -------------------------------------------------------------- */

/* The angle by which a vector of length 1 turns when its end moves by `by`. */
static double turned(double by)
{
    return by < 1.0 ? asin(by) : pi;
}

/* unorm stores (v + 1)/2: twice its error, and reading it rounds once more, where |v| <= 1. */
static double xyz_error(const tl_attribute *a, const double v[3])
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        const tl_channel c = a->channels[i];
        const double error = c.number == TL_NUMBER_UNORM
                                 ? 2.0 * number_error(c, 0.5 * v[i] + 0.5) + u
                                 : number_error(c, v[i]);
        sum += error * error;
    }
    return turned(sqrt(sum) * margin);
}

/* On a face of the octahedron the grid of step s is one of equilateral triangles of side sqrt(2) s: a
 * step of either number moves its point by (1, 0, -1) s or (0, 1, -1) s, 60 degrees apart, and the folds
 * follow the triangles' sides, so no triangle is bent. A point is at most side/sqrt(3) from its
 * triangle's nearest corner, which is one of the four that packing tries. Seen from the centre, whose
 * distance from the face is 1/sqrt(3), that is at most sqrt(3) sqrt(2/3) s = sqrt(2) s rad.
 * Reading: each number is off by 1.5u, z = 1 - |x| - |y| by 3u and two roundings of u/2, x and y of the
 * lower half by 1.5u + 4u + u/2: sqrt(6^2 + 6^2 + 4^2) u = 9.4u along the face, 16.3u rad. */
static double octahedron_error(const tl_attribute *a, const double v[3])
{
    (void)v;
    return (sqrt(2.0) * snorm_step(a->channels[0].bits) + 16.3 * u) * margin;
}

/* The map's radius is r = 2 sin(t/2), t the angle from the axis. A step ds on the disk turns by at most
 * dt = ds / cos(t/2), which grows with r, so a step of `by` turns by no more than one straight outwards.
 * Where that would cross the rim, r = 2, beyond which lies nothing but the rim, t may become anything from
 * that of r - by to pi, and the step sideways, of at most `by` rad about the axis, turns a direction so
 * close to it by `by` times its distance. Each number is read as 4e - 2, exactly; across2 is off by 2u of
 * itself, so r by u; the roundings after that by 3u of the direction. */
static double spheremap_angle(double r)
{
    return 2.0 * asin(0.5 * fmin(fmax(r, 0.0), 2.0));
}

/* step: with what reading adds to it. */
static double spheremap_turn(double r, double step)
{
    const double rounding = 3.0 * u * margin, t = spheremap_angle(r);
    const double inner = spheremap_angle(r - step);
    return r + step < 2.0 - 0x1p-40 ? spheremap_angle(r + step) - t + rounding
                                    : fmax(pi - t, t - inner) + step * (pi - inner) + rounding;
}

static double spheremap_error(const tl_attribute *a, const double v[3])
{
    const double across = hypot(v[0], v[1]), t = atan2(across, v[2]), r = 2.0 * sin(0.5 * t);
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        const double e = 0.5 + 0.25 * r * (across > 0.0 ? v[i] / across : 1.0 - i);
        const double step = 4.0 * number_error(a->channels[i], e);
        sum += step * step;
    }
    return spheremap_turn(r, sqrt(sum) + 2.0 * u);
}

static double (*const normal_errors[TL_NORMAL_CODE_COUNT])(const tl_attribute *,
                                                           const double v[3]) = {
    [TL_NORMAL_XYZ] = xyz_error,
    [TL_NORMAL_OCTAHEDRON] = octahedron_error,
    [TL_NORMAL_SPHEREMAP] = spheremap_error,
};

/* Of normals in view space: there and back is the matrix's defect, and rotating back in float is off by
 * 3u of each row's length, sqrt(27) u. */
static double rotation_error(const tl_camera *camera, enum tl_layout_name layout)
{
    return tl_layouts[layout].normal_space == TL_NORMALS_IN_VIEW
               ? turned(rotation_defect(camera) + 5.2 * u * margin)
               : 0.0;
}

double tl_normal_bound(const tl_camera *camera,
                       enum tl_layout_name layout,
                       const double normal[3])
{
    const tl_layout *l = &tl_layouts[layout];
    double v[3] = {normal[0], normal[1], normal[2]};
    if (l->normal_space == TL_NORMALS_IN_VIEW)
        tl_camera_view_direction(camera, normal, v);
    const double length = length_of(v);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return fmin(normal_errors[l->normal.code](&l->normal, v) + rotation_error(camera, layout),
                pi);
}

/* --- colours and exponents (kernels/color_code.h) -------------------------------------------------- */

static double rgb_error(const tl_attribute *a, const double c[3], int channel)
{
    return number_error(a->channels[channel], c[channel]);
}

/* The root is off by h, its square by (2 sqrt(c) + h) h, and cut at 1; squaring rounds once. */
static double squared_error(const tl_attribute *a, const double c[3], int channel)
{
    const double root = sqrt(c[channel]), h = number_error(a->channels[channel], root);
    const double high = fmin(root + h, 1.0 + 2.0 * u), low = fmax(root - h, 0.0);
    return fmax(high * high - c[channel], c[channel] - low * low) + u * high * high * margin;
}

static double least_of(const double c[3])
{
    return fmin(c[0], fmin(c[1], c[2]));
}

static double greatest_of(const double c[3])
{
    return fmax(c[0], fmax(c[1], c[2]));
}

/* Every channel is within half the spread of the middle, which is what is stored. */
static double gray_error(const tl_attribute *a, const double c[3], int channel)
{
    const double middle = 0.5 * (least_of(c) + greatest_of(c));
    return fabs(c[channel] - middle) + number_error(a->channels[0], middle);
}

/* Half a unit of the exponent that the greatest channel has: 9 bits below it, twice that where its
 * mantissa would round to 512, and never below 2^-24. Reading is exact. */
static double shared_error(const tl_attribute *a, const double c[3], int channel)
{
    (void)a;
    (void)channel;
    int exponent = -15;
    frexp(greatest_of(c), &exponent);
    if (exponent < -15 || greatest_of(c) == 0.0)
        exponent = -15;
    if (ldexp(greatest_of(c), 9 - exponent) >= 511.5)
        exponent++;
    return ldexp(0.5, exponent - 9);
}

static double (*const color_errors[TL_COLOR_CODE_COUNT])(const tl_attribute *,
                                                         const double c[3],
                                                         int channel) = {
    [TL_COLOR_RGB] = rgb_error,
    [TL_COLOR_SQUARED] = squared_error,
    [TL_COLOR_GRAY] = gray_error,
    [TL_COLOR_SHARED] = shared_error,
};

static double plain_error(const tl_attribute *a, double value)
{
    return number_error(a->channels[0], value);
}

/* 1 + e = 2^((t - 1) L), L = log2(10001): t off by h is a factor of 2^(hL). Reading rounds t - 1 by u/2
 * and its product with L, itself rounded, by 2u: L (u/2 + 2u) ln 2 = 23.1u of 1 + e at most. The polynomial
 * and its roundings are 4u + 3u of the power's mantissa, which is 1/2 or more: 14u (specular.h). The last
 * fma: u of e. */
static const double logarithm_read = 38.1 * 0x1p-24;

static double logarithm_error(const tl_attribute *a, double exponent)
{
    const double L = TL_LOG2_MOST_LOBE, lobe = 1.0 + exponent, t = log2(lobe) / L;
    const double h = number_error(a->channels[0], t);
    const double high = exp2(fmin(t + h, 1.0) * L), low = exp2(fmax(t - h, 0.0) * L);
    return fmax(high - lobe, lobe - low) + logarithm_read * high * margin;
}

static double (*const value_errors[TL_VALUE_CODE_COUNT])(const tl_attribute *, double) = {
    [TL_VALUE_PLAIN] = plain_error,
    [TL_VALUE_LOGARITHM] = logarithm_error,
};

/* --- planes ---------------------------------------------------------------------------------------- */

/* Where the attribute of a plane stands in a layout, and which of its channels the plane is; -1: it has one
 * value. */
static const struct {
    size_t attribute;
    int channel;
} planes[TL_PLANE_COUNT] = {
#define COLOR(first, name)                                                                    \
    [first] = {offsetof(tl_layout, name), 0}, [(first) + 1] = {offsetof(tl_layout, name), 1}, \
    [(first) + 2] = {offsetof(tl_layout, name), 2}
    [TL_DEPTH] = {offsetof(tl_layout, depth), -1},
    COLOR(TL_NORMAL_X, normal),
    COLOR(TL_ALBEDO_R, albedo),
    COLOR(TL_SPECULAR_R, specular),
    [TL_SHININESS] = {offsetof(tl_layout, shininess), -1},
    [TL_METALLIC] = {offsetof(tl_layout, metallic), -1},
    [TL_ROUGHNESS] = {offsetof(tl_layout, roughness), -1},
    [TL_OCCLUSION] = {offsetof(tl_layout, occlusion), -1},
    COLOR(TL_EMISSIVE_R, emissive),
    [TL_BRDF] = {offsetof(tl_layout, brdf), -1},
    COLOR(TL_TANGENT_X, tangent),
#undef COLOR
};

static const tl_attribute *attribute_of(enum tl_layout_name layout, enum tl_plane plane)
{
    return (const tl_attribute *)((const char *)&tl_layouts[layout] + planes[plane].attribute);
}

double tl_value_bound(enum tl_layout_name layout, enum tl_plane plane, const double values[3])
{
    const tl_attribute *a = attribute_of(layout, plane);
    assert(plane >= TL_ALBEDO_R && plane <= TL_BRDF && a->code != 0);
    return planes[plane].channel < 0 ? value_errors[a->code](a, values[0])
                                     : color_errors[a->code](a, values, planes[plane].channel);
}

double tl_tangent_bound(enum tl_layout_name layout, const double tangent[3])
{
    const tl_attribute *a = &tl_layouts[layout].tangent;
    const double length = length_of(tangent);
    const double unit[3] = {tangent[0] / length, tangent[1] / length, tangent[2] / length};
    return normal_errors[a->code](a, unit);
}

static void depth_range(const tl_camera *camera,
                        const tl_attribute *a,
                        double *low,
                        double *high)
{
    const tl_channel c = a->channels[0];
    *high = number_limit(c);
    *low = c.number == TL_NUMBER_FLOAT24 ? 0.0 : -*high;
    if (TL_IS_NEARNESS(a->code)) {
        *low = (double)camera->near;
        *high = (double)camera->far;
    }
}

void tl_layout_range(const tl_camera *camera,
                     enum tl_layout_name layout,
                     enum tl_plane plane,
                     double *low,
                     double *high)
{
    const tl_attribute *a = attribute_of(layout, plane);
    const int channel =
        planes[plane].channel < 0 || a->code == TL_COLOR_GRAY ? 0 : planes[plane].channel;
    *low = 0.0;
    *high = number_limit(a->channels[channel]);
    if (plane == TL_DEPTH) {
        depth_range(camera, a, low, high);
    } else if (plane <= TL_NORMAL_Z || plane >= TL_TANGENT_X) {
        *low = -1.0;
        *high = 1.0;
    } else if (plane == TL_SHININESS && a->code == TL_VALUE_LOGARITHM) {
        *high = TL_MOST_SHININESS;
    } else if (plane >= TL_EMISSIVE_R && a->code == TL_COLOR_SHARED) {
        *high = TL_MOST_SHARED;
    }
}

/* --- summary ---------------------------------------------------------------------------------------- */

/* Of depth, in that corner of the image which is farthest from its centre. */
static double corner_error(const tl_camera *camera, enum tl_layout_name layout, double depth)
{
    const bool parallel = camera->projection == TL_ORTHOGRAPHIC;
    const double scale = parallel ? 1.0 : depth;
    const double x = fmax(fabs((double)camera->left), fabs((double)camera->right));
    const double y = fmax(fabs((double)camera->bottom), fabs((double)camera->top));
    const double view[3] = {x * scale, y * scale, -depth};
    double bound[3];
    tl_position_bound(camera, layout, view, bound);
    return parallel ? bound[2] : bound[2] / depth;
}

static double far_surface(const tl_camera *camera)
{
    return isinf(camera->far) ? TL_FAR_OF_NONE * fabs((double)camera->near)
                              : (double)camera->far;
}

/* Over all normals up to the angle `farthest` from the view axis: every error but the spheremap's is
 * largest where all components are; that one's grows outwards as long as a step fits on the disk. */
static double worst_normal(const tl_camera *camera, enum tl_layout_name layout, double farthest)
{
    const tl_attribute *a = &tl_layouts[layout].normal;
    const double ones[3] = {1.0, 1.0, 1.0};
    double worst = 0.0;
    if (a->code == TL_NORMAL_SPHEREMAP) {
        const double step =
            4.0 * hypot(number_error(a->channels[0], 1.0), number_error(a->channels[1], 1.0)) +
            2.0 * u;
        worst = spheremap_turn(fmin(2.0 * sin(0.5 * farthest), 2.0 - step), step);
    } else {
        worst = normal_errors[a->code](a, ones);
    }
    return worst + rotation_error(camera, layout);
}

/* Of one plane, where all channels are `value`; 0 where it is not stored. */
static double plane_error(enum tl_layout_name layout, enum tl_plane plane, double value)
{
    const double values[3] = {value, value, value};
    return attribute_of(layout, plane)->code ? tl_value_bound(layout, plane, values) : 0.0;
}

/* The largest of its three planes. */
static double color_error(enum tl_layout_name layout, enum tl_plane first, double value)
{
    double worst = 0.0;
    for (int i = 0; i < 3; i++)
        worst = fmax(worst, plane_error(layout, (enum tl_plane)((int)first + i), value));
    return worst;
}

/* A logarithm's is a factor, whatever the exponent; a number's is the same all over an octave, so that it
 * counts most where that begins. */
static double worst_shininess(enum tl_layout_name layout)
{
    const tl_attribute *a = &tl_layouts[layout].shininess;
    double worst = 0.0;
    if (a->code == TL_VALUE_LOGARITHM) {
        const double h = number_error(a->channels[0], 1.0);
        return exp2(h * TL_LOG2_MOST_LOBE) * (1.0 + logarithm_read * margin) - 1.0;
    }
    for (double e = 1.0; e <= TL_MOST_SHININESS; e *= 2.0)
        worst = fmax(worst, plane_error(layout, TL_SHININESS, e * (1.0 + 0x1p-20)) / (1.0 + e));
    return worst;
}

tl_layout_errors tl_layout_errors_of(const tl_camera *camera, enum tl_layout_name layout)
{
    return (tl_layout_errors){
        .depth_near = corner_error(camera, layout, (double)camera->near),
        .depth_far = corner_error(camera, layout, far_surface(camera)),
        .normal = worst_normal(camera, layout, 0.5 * pi),
        .any_normal = worst_normal(camera, layout, pi),
        .albedo = color_error(layout, TL_ALBEDO_R, 1.0),
        .specular = color_error(layout, TL_SPECULAR_R, 1.0),
        .specular_is_gray = tl_layouts[layout].specular.code == TL_COLOR_GRAY,
        .shininess = worst_shininess(layout),
        .metallic = plane_error(layout, TL_METALLIC, 1.0),
        .roughness = plane_error(layout, TL_ROUGHNESS, 1.0),
        .occlusion = plane_error(layout, TL_OCCLUSION, 1.0),
        .emissive = color_error(layout, TL_EMISSIVE_R, 1.0),
    };
}
