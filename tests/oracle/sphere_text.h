/* The text of sphere.c, over `number`. CALL(name): the function of that number's library; SUM: as wide_sum;
 * NAME(name): what is defined here; SPAN: what holds two of them. */

static number NAME(sum3)(number a, number b, number c)
{
    const number terms[] = {a, b, c};
    return SUM(terms, 3);
}

static void NAME(widen)(SPAN *s, number slope)
{
    s->low = slope < s->low ? slope : s->low;
    s->high = slope > s->high ? slope : s->high;
}

/* Where the circle crosses a plane of constant depth, both sides: the roots of
 * x^2 - 2 c x + c^2 + (depth - plane)^2 - r^2, the smaller one by the product of both. */
static void NAME(add_plane)(
    SPAN *s, number c, number depth, number r, number plane, int orthographic)
{
    const number half2 = NAME(sum3)(r, depth, -plane) * NAME(sum3)(r, -depth, plane);
    const number terms[] = {c * c, depth * depth, plane * plane, -2 * depth * plane, -r * r};
    const number scale = orthographic ? 1 : plane;
    if (half2 < 0)
        return;
    const number larger = c + CALL(copysign)(CALL(sqrt)(half2), c);
    NAME(widen)(s, larger / scale);
    NAME(widen)(s, larger == 0 ? 0 : SUM(terms, 5) / larger / scale);
}

/* D^2 - r^2, by the difference that is exact where it is small. */
static number NAME(tangent_length2)(number c, number depth, number r)
{
    const number x = CALL(fabs)(c), y = CALL(fabs)(depth);
    const number more = x > y ? x : y, less = x > y ? y : x;
    return (more - r) * (more + r) + less * less;
}

/* A tangent that is steeper than 45 degrees, up or down: its angle from the axis across is taken as the
 * difference of the smaller ones of two pairs of angles. */
static number NAME(angle_from_across)(
    number c, number depth, number r, number length, number theta, number phi)
{
    const int is_narrow =
        2 * r < length; /* then phi is the smaller one of itself and its rest */
    if (theta + phi > 0)
        return is_narrow ? CALL(atan2)(depth, c) - phi : CALL(atan2)(length, r) - theta;
    return is_narrow ? CALL(atan2)(depth, -c) + phi
                     : CALL(atan2)(-c, -depth) - CALL(atan2)(length, r);
}

/* The tangent above the disc, whose angle from the axis ahead is theta + phi. */
static void NAME(add_upper_tangent)(
    SPAN *s, number c, number depth, number r, number near, number far, number sign)
{
    const number length2 = NAME(tangent_length2)(c, depth, r);
    if (length2 <= 0 || (c >= 0 && depth <= r)) /* the eye is inside; the point is not ahead */
        return;
    const number length = CALL(sqrt)(length2);
    const number theta = CALL(atan2)(c, depth), phi = CALL(atan2)(r, length);
    const number ahead = theta + phi;
    number at, slope, sine, cosine;
    if (CALL(fabs)(ahead) <= (number)0.78) {
        CALL(sincos)(ahead, &sine, &cosine);
        at = length * cosine;
        slope = sine / cosine;
    } else {
        const number across = NAME(angle_from_across)(c, depth, r, length, theta, phi);
        CALL(sincos)(across, &sine, &cosine);
        at = length * sine;
        slope = (ahead > 0 ? 1 : -1) * cosine / sine;
    }
    if (at >= near && at <= far)
        NAME(widen)(s, sign * slope);
}

static SPAN NAME(span)(
    number c, number depth, number r, number near, number far, int orthographic)
{
    SPAN s = {INFINITY, -INFINITY, 0};
    s.empty = NAME(sum3)(depth, r, -near) < 0 ||
              (!isinf((double)far) && NAME(sum3)(depth, -r, -far) > 0);
    if (s.empty)
        return s;
    NAME(add_plane)(&s, c, depth, r, near, orthographic);
    if (!isinf((double)far))
        NAME(add_plane)(&s, c, depth, r, far, orthographic);
    if (!orthographic) {
        NAME(add_upper_tangent)(&s, c, depth, r, near, far, 1);
        NAME(add_upper_tangent)(&s, -c, depth, r, near, far, -1);
    } else if (depth >= near && depth <= far) {
        NAME(widen)(&s, c - r);
        NAME(widen)(&s, c + r);
    }
    return s;
}
