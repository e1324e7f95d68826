#include "oracle/falloffs.h"

#include "oracle/cone.h"

wide tl_oracle_linear(wide distance, wide begin, wide range)
{
    if (distance >= range)
        return 0;
    return distance <= begin ? 1 : (range - distance) / (range - begin);
}

wide tl_oracle_inverse_square(wide distance, wide range)
{
    const wide least = 0.01Q, nearest = distance < least ? least : distance;
    const wide share = isinfq(range) ? 0 : distance / range;
    const wide window = 1 - powq(share, 4);
    return window > 0 ? window / (nearest * nearest) : 0;
}

wide tl_oracle_table(wide distance, wide range, const float *values, size_t count)
{
    const wide place = distance / range * (count - 1);
    const size_t i = place < count - 1 ? (size_t)place : count - 2;
    return values[i] + (place - i) * ((wide)values[i + 1] - values[i]);
}

static wide cosine_of(float half_angle)
{
    return cosq(tl_oracle_half_angle(half_angle));
}

wide tl_oracle_cone_steepness(float inner, float outer)
{
    return 1 / fmaxq(0.001Q, cosine_of(inner) - cosine_of(outer));
}

wide tl_oracle_cone(wide3 axis, wide3 way, float inner, float outer, wide *below_square)
{
    const wide cosine = cosq(wide3_angle(axis, way));
    const wide above = (cosine - cosine_of(outer)) * tl_oracle_cone_steepness(inner, outer);
    *below_square = fminq(1, fmaxq(0, above));
    return *below_square * *below_square;
}

wide tl_oracle_longitude(wide right, wide ahead)
{
    return atan2q(right, ahead) / (2 * M_PIq);
}
