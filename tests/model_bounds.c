#include "model_bounds.h"

#include "models.h"

/* Letters as in kernels/halfway.h; products of errors are within U. */
typedef struct met {
    const tl_oracle_surface *surface;
    wide U;
    wide light, light_off;         /* n.l, E_l */
    wide eye, eye_off;             /* n.v, E_v */
    wide light_eye, light_eye_off; /* l.v */
    wide half;                     /* the angle of n and h */
    wide length;                   /* |h| of unit vectors: 2 v.h */
    wide tan_between;              /* of v and h */
    wide sum_light;                /* sum |n_i l_i| */
    span cosine;                   /* n.l as computed, 0 and above */
} met;

static wide square(wide a)
{
    return a * a;
}

static wide least(wide a, wide b)
{
    return a < b ? a : b;
}

static wide most(wide a, wide b)
{
    return a > b ? a : b;
}

static wide sum_of_magnitudes(wide3 a, wide3 b)
{
    return fabsq(a.x * b.x) + fabsq(a.y * b.y) + fabsq(a.z * b.z);
}

/* Numbers that are not negative, `roundings` u off beside. */
static span rounded(span a, wide roundings, wide U)
{
    return (span){a.low * (1 - roundings * U), a.high * (1 + roundings * U)};
}

static met met_of(const tl_oracle_surface *s, wide u)
{
    const wide U = u * (1 + 0x1p-10Q);
    const wide3 n = wide3_unit(s->normal), l = wide3_unit(s->to_light),
                v = wide3_unit(s->to_eye);
    const wide3 h = wide3_sum(l, 1, v);
    met m = {.surface = s, .U = U};
    m.light = wide3_dot(n, l);
    m.eye = wide3_dot(n, v);
    m.light_eye = wide3_dot(l, v);
    m.sum_light = sum_of_magnitudes(n, l);
    m.light_off = (3 * m.sum_light + 9 * fabsq(m.light) + 2) * U;
    m.eye_off = (3 * sum_of_magnitudes(n, v) + 9 * fabsq(m.eye) + 2) * U;
    m.light_eye_off = (3 * sum_of_magnitudes(l, v) + 9 * fabsq(m.light_eye) + 2) * U;
    m.half = wide3_angle(n, h);
    m.length = wide3_length(h);
    m.tan_between = wide3_length(wide3_sum(l, -1, v)) / m.length;
    m.cosine = (span){most(0, m.light - m.light_off), most(0, m.light + m.light_off)};
    return m;
}

/* --- the half vector ------------------------------------------------------------------------------ */

typedef struct halfway_bounds {
    wide turn, stretch; /* of h: its angle to n, its length */
    span cos2, sin2, graze;
    int may_be_above, is_decided;
} halfway_bounds;

static wide cosine_at(wide angle)
{
    return angle < M_PI_2q ? cosq(most(0, angle)) : 0;
}

static span graze_of(const met *m, wide stretch)
{
    const wide U = m->U, vh = m->length / 2, off = (stretch + 2.5Q * U) * vh;
    return rounded((span){powq(most(0, 1 - vh - off), 5), powq(least(1, 1 - vh + off), 5)}, 9,
                   U);
}

static halfway_bounds halfway_bounds_of(const met *m)
{
    const wide U = m->U;
    halfway_bounds b;
    b.turn = (4 * m->tan_between + 2 / m->length + 2) * U;
    b.stretch = (5 + m->tan_between) * U;
    const wide near = m->half - b.turn, far = m->half + b.turn;
    const wide low = most(0, cosine_at(far) - 3 * U), high = cosine_at(near) + 3 * U;
    b.cos2 = rounded((span){square(low), square(high)}, 15, U);
    b.cos2.high = least(1, b.cos2.high);
    b.sin2 = rounded((span){square(sinq(most(0, near))), far < M_PI_2q ? square(sinq(far)) : 1},
                     10, U);
    b.sin2 = (span){most(0, b.sin2.low - 146 * U * U), least(1, b.sin2.high + 146 * U * U)};
    b.graze = graze_of(m, b.stretch);
    b.may_be_above = near < M_PI_2q + 3 * U;
    b.is_decided = !b.may_be_above || far < M_PI_2q - 3 * U;
    return b;
}

/* --- powers: kernels/specular.h --------------------------------------------------------------------- */

/* Of itself, in the exponent of e. */
static wide power_off(wide cosine, wide exponent, wide U)
{
    const wide sin2 = 1 - cosine * cosine, t = -exponent * logq(cosine);
    const wide of_square =
        sin2 < 0.2499Q ? (10 * sin2 + 146 * U) / square(cosine) : 6 / cosine + 15;
    return (exponent / 2 * of_square + 10.5Q * t + 7) * U;
}

/* Of an angle known to within a turn. Powers end at 2^-64. */
static span power_bounds(wide angle, wide turn, wide exponent, wide U)
{
    const wide low = cosine_at(angle + turn), high = cosine_at(angle - turn);
    span p = {0, 0x1p-63Q};
    if (low > 4 * U)
        p.low = most(0, powq(low, exponent) * expq(-power_off(low, exponent, U)) - 0x1p-63Q);
    if (high > 4 * U)
        p.high += powq(high, exponent) * expq(power_off(high, exponent, U));
    else if (angle - turn < M_PI_2q + 4 * U)
        p.high = 1;
    else
        p.high = 0;
    return p;
}

/* Whether a lobe about this angle is there, whatever rounding does. */
static int is_decided(wide angle, wide turn, wide U)
{
    return angle + turn < M_PI_2q - 4 * U || angle - turn > M_PI_2q + 4 * U;
}

static bounds_of_reflection plain(const met *m, int has_specular, int under_cosine)
{
    const wide U = m->U;
    bounds_of_reflection b = {.diffuse = m->cosine, .is_known = 1, .is_decided = 1};
    const wide turn = (3.5Q * m->tan_between + 2 / m->length + 2) * U;
    b.is_known = !has_specular || turn < 0.5Q;
    if (!has_specular || !b.is_known)
        return b;
    b.specular = power_bounds(m->half, turn, m->surface->exponent, U);
    b.is_decided = is_decided(m->half, turn, U);
    if (under_cosine)
        b.specular = rounded(
            (span){b.specular.low * m->cosine.low, b.specular.high * m->cosine.high}, 1, U);
    return b;
}

static bounds_of_reflection mirror(const met *m)
{
    const wide3 n = wide3_unit(m->surface->normal), l = wide3_unit(m->surface->to_light),
                none = {0, 0, 0};
    const wide3 r = wide3_sum(wide3_sum(none, 2 * m->light, n), -1, l);
    const wide turn = (6 * m->sum_light + 18 * fabsq(m->light) + 5) * m->U;
    bounds_of_reflection b = {.diffuse = m->cosine, .is_known = 1, .is_decided = 1};
    b.specular =
        power_bounds(wide3_angle(r, m->surface->to_eye), turn, m->surface->exponent, m->U);
    return b;
}

/* --- lobes of facets -------------------------------------------------------------------------------- */

/* exp(-x)/cos^4, x = slope2/cos^2; x is off by `steps` u of itself beside. */
static span gaussian_bounds(span slope2, span cos2, wide steps, wide U)
{
    const wide lower = most(cos2.low, 0x1p-20Q), upper = most(cos2.high, 0x1p-20Q);
    const span x = rounded((span){slope2.low / upper, slope2.high / lower}, steps, U);
    const span lobe = {x.high * M_LOG2Eq < 64 ? expq(-x.high) / square(upper) : 0,
                       x.low * M_LOG2Eq < 64 ? expq(-x.low) / square(lower) : 0};
    return rounded(lobe, 9, U);
}

static span magnitude_of_eye(const met *m)
{
    const wide exact = fabsq(m->eye);
    return (span){most(0, exact - m->eye_off), least(1, exact + m->eye_off)};
}

static wide smith(wide alpha2, wide cosine)
{
    return sqrtq(alpha2 + (1 - alpha2) * square(cosine));
}

static wide shown(wide light, wide eye, wide alpha2)
{
    return light / most(light * smith(alpha2, eye) + eye * smith(alpha2, light), 1e-12Q);
}

static bounds_of_reflection metal_rough(const met *m, wide f90)
{
    const wide U = m->U, alpha2 = square(m->surface->alpha), length2 = square(m->length);
    const halfway_bounds h = halfway_bounds_of(m);
    const span g = h.graze;
    bounds_of_reflection b = {.is_known = h.turn < 0.5Q, .is_decided = h.is_decided};
    b.diffuse = rounded((span){m->cosine.low * most(0, 1 - g.high * f90 * (1 + U)),
                               m->cosine.high * (1 - g.low * f90 * (1 - U))},
                        2, U);
    if (!b.is_known || !h.may_be_above)
        return b;
    wide w[2]; /* |p|^2 + alpha^2 (n.h)^2 over |h|^2 */
    for (int i = 0; i < 2; i++) {
        const wide angle = most(0, m->half + (i ? h.turn : -h.turn));
        const wide c = fabsq(cosq(angle)), exact = alpha2 * c * c + square(sinq(angle));
        const wide off = alpha2 * (6 * c + 10 * c * c) * U + 5 * U * square(sinq(angle)) +
                         146 * U * U + U * exact;
        w[i] = i ? exact + off : exact - off;
    }
    const wide clamp = length2 / 0x1p-33Q;
    const wide dim = least(1 / w[1], clamp * (1 - 2 * h.stretch)),
               bright = least(1 / w[0], clamp * (1 + 2 * h.stretch));
    const span eye = magnitude_of_eye(m);
    b.specular =
        rounded((span){alpha2 / 2 * square(dim) * shown(m->cosine.low, eye.high, alpha2),
                       alpha2 / 2 * square(bright) * shown(m->cosine.high, eye.low, alpha2)},
                16.5Q, U);
    b.grazing = rounded((span){b.specular.low * g.low, b.specular.high * g.high}, 1, U);
    return b;
}

static wide masked(wide valley, wide light, wide eye)
{
    return least(1, valley * least(eye, light)) / eye;
}

static bounds_of_reflection cook_torrance(const met *m)
{
    const wide U = m->U, alpha2 = square(m->surface->alpha);
    const halfway_bounds h = halfway_bounds_of(m);
    bounds_of_reflection b = {
        .diffuse = m->cosine, .is_known = h.turn < 0.5Q, .is_decided = h.is_decided};
    if (!b.is_known || !h.may_be_above)
        return b;
    const span slope2 = {h.sin2.low / alpha2, h.sin2.high / alpha2};
    const span facets = gaussian_bounds(slope2, h.cos2, 3.5Q, U);
    const wide low = most(0, cosine_at(m->half + h.turn) - 3 * U),
               high = cosine_at(m->half - h.turn) + 3 * U;
    const wide off = 10.5Q * U + h.stretch;
    const span eye = magnitude_of_eye(m);
    const wide dim = masked(4 * low / m->length * (1 - off), m->cosine.low,
                            most(eye.high, 0x1p-20Q)),
               bright = masked(4 * high / m->length * (1 + off), m->cosine.high,
                               most(eye.low, 0x1p-20Q));
    b.specular = rounded(
        (span){facets.low * dim / (4 * alpha2), facets.high * bright / (4 * alpha2)}, 4, U);
    b.grazing =
        rounded((span){b.specular.low * h.graze.low, b.specular.high * h.graze.high}, 1, U);
    return b;
}

/* (1/sharp^2 - 1/wide^2) p^2, p the part of sin along the axis on which the lobe is narrow. */
static span along_bounds(const met *m, const halfway_bounds *h)
{
    const tl_oracle_surface *s = m->surface;
    const wide U = m->U, alpha2 = square(s->alpha), across2 = square(s->across);
    const wide sharp2 = least(alpha2, across2), steep = fabsq(1 / alpha2 - 1 / across2);
    const wide3 n = wide3_unit(s->normal), along = wide3_unit(s->along);
    const wide3 half = wide3_unit(wide3_sum(wide3_unit(s->to_light), 1, wide3_unit(s->to_eye)));
    const wide out = wide3_dot(n, along);
    const wide3 tangent = wide3_unit(wide3_sum(along, -out, n));
    const wide3 axis = alpha2 < across2 ? tangent : wide3_cross(n, tangent);
    const wide slant = wide3_length(wide3_cross(n, along)); /* sine of n and along */
    const wide p = fabsq(wide3_dot(half, axis)), sine = sqrtq(h->sin2.high);
    const wide off = h->turn + (18 + fabsq(out) / slant) * U * sine + 150 * U * U / slant;
    const wide low = most(0, p - off), high = p + off;
    const span beside = {3 * U * square(low) / sharp2, 3 * U * square(high) / sharp2};
    return (span){most(0, steep * square(low) * (1 - 7 * U) - beside.low),
                  steep * square(high) * (1 + 7 * U) + beside.high};
}

static bounds_of_reflection ward(const met *m, int is_round)
{
    const wide U = m->U, alpha = m->surface->alpha,
               across = is_round ? alpha : m->surface->across;
    const wide wide2 = square(most(alpha, across)), area = 4 * alpha * across;
    const halfway_bounds h = halfway_bounds_of(m);
    bounds_of_reflection b = {
        .diffuse = m->cosine, .is_known = h.turn < 0.5Q, .is_decided = h.is_decided};
    if (!b.is_known || !h.may_be_above)
        return b;
    span slope2 = rounded((span){h.sin2.low / wide2, h.sin2.high / wide2}, 2, U);
    if (!is_round) {
        const span along = along_bounds(m, &h);
        slope2 = rounded((span){slope2.low + along.low, slope2.high + along.high}, 1, U);
    }
    const span lobe = gaussian_bounds(slope2, h.cos2, 2.5Q, U);
    const wide off = 2 * h.stretch + 3 * U, half2 = square(m->length / 2);
    const wide wider = most(least(1, half2 * (1 + off)), 0x1p-20Q),
               narrower = most(half2 * (1 - off), 0x1p-20Q);
    b.specular = rounded((span){m->cosine.low * lobe.low / (area * wider),
                                m->cosine.high * lobe.high / (area * narrower)},
                         5.5Q, U);
    return b;
}

/* --- diffuse models ----------------------------------------------------------------------------------- */

static bounds_of_reflection oren_nayar(const met *m)
{
    const wide U = m->U, sigma2 = m->surface->alpha;
    const wide flat = 1 - sigma2 / (2 * (sigma2 + 0.33Q)),
               bent = 0.45Q * sigma2 / (sigma2 + 0.09Q);
    const span eye = {most(0, m->eye - m->eye_off), most(0, least(1, m->eye + m->eye_off))};
    const span light = m->cosine;
    const wide low = m->light_eye - m->light_eye_off - light.high * eye.high,
               high = m->light_eye + m->light_eye_off - light.low * eye.low;
    const span ahead = rounded((span){most(0, low), least(1, most(0, high))}, 1, U);
    const span share = {light.low > 0 ? light.low / most(light.low, eye.high) : 0,
                        light.high > 0 ? light.high / most(light.high, eye.low) : 0};
    const span turned =
        rounded((span){bent * ahead.low * share.low, bent * ahead.high * share.high}, 10, U);
    const bounds_of_reflection b = {
        .diffuse = rounded((span){light.low * (flat - 2.5Q * U) + turned.low,
                                  light.high * (flat + 2.5Q * U) + turned.high},
                           1, U),
        .is_known = 1,
        .is_decided = 1};
    return b;
}

static wide minnaert_power(wide light, wide eye, wide k, wide sign, wide U)
{
    const wide to_light = log2q(most(light, 0x1p-24Q)), to_eye = log2q(most(eye, 0x1p-10Q));
    const wide sum = k * to_light + (k - 1) * to_eye;
    const wide off =
        (9.5Q * k * fabsq(to_light) + 11.5Q * fabsq((k - 1) * to_eye) + 2 * fabsq(sum) + 10) *
        U;
    return exp2q(sum + sign * off) * (1 + sign * 9 * U);
}

static bounds_of_reflection minnaert(const met *m)
{
    const wide k = m->surface->k, scale = (k + 1) / 2;
    const span eye = magnitude_of_eye(m);
    const wide dim = k < 1 ? eye.high : eye.low, bright = k < 1 ? eye.low : eye.high;
    bounds_of_reflection b = {.is_known = 1, .is_decided = 1};
    b.diffuse =
        (span){most(0, scale * (minnaert_power(m->cosine.low, dim, k, -1, m->U) - 0x1p-53Q)),
               scale * (minnaert_power(m->cosine.high, bright, k, 1, m->U) + 0x1p-53Q)};
    return b;
}

bounds_of_reflection tl_bounds_of_reflection(uint32_t model,
                                             const tl_oracle_surface *s,
                                             wide f0,
                                             wide u)
{
    static const bounds_of_reflection none = {.is_known = 1, .is_decided = 1};
    const met m = met_of(s, u);
    bounds_of_reflection b = none;
    if (!(m.light + m.light_off > 0))
        return none;
    switch (model) {
    case TL_MODEL_PHONG: b = plain(&m, 1, 0); break;
    case TL_MODEL_BLINN_PHONG_NORMALIZED: b = plain(&m, 1, 1); break;
    case TL_MODEL_LAMBERT: b = plain(&m, 0, 0); break;
    case TL_MODEL_PHONG_REFLECTION: b = mirror(&m); break;
    case TL_MODEL_OREN_NAYAR: b = oren_nayar(&m); break;
    case TL_MODEL_WARD: b = ward(&m, 1); break;
    case TL_MODEL_WARD_ANISOTROPIC: b = ward(&m, 0); break;
    case TL_MODEL_COOK_TORRANCE: b = cook_torrance(&m); break;
    case TL_MODEL_MINNAERT: b = minnaert(&m); break;
    case TL_MODEL_METAL_ROUGH:
        b = metal_rough(&m, tl_oracle_f90((const wide[3]){f0, f0, f0}));
        break;
    default: break;
    }
    b.is_decided &= m.light > m.light_off;
    if (!b.is_decided)
        b.specular.low = b.grazing.low = 0;
    if (!(m.light > m.light_off))
        b.diffuse.low = 0;
    return b;
}
