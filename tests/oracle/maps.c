#include "oracle/maps.h"

tl_oracle_place tl_oracle_slide_place(
    wide3 way, wide3 right, wide3 up, wide3 ahead, wide half, int width, int height)
{
    /* Of the square from -1 to 1. */
    const wide edge = tanq(half) * wide3_dot(way, ahead);
    const wide x = wide3_dot(way, right) / edge, y = wide3_dot(way, up) / edge;
    return (tl_oracle_place){(x + 1) / 2 * width - 0.5Q, (1 - y) / 2 * height - 0.5Q};
}

tl_oracle_place tl_oracle_globe_place(
    wide3 way, wide3 right, wide3 up, wide3 ahead, int width, int height)
{
    const wide longitude = atan2q(wide3_dot(way, right), wide3_dot(way, ahead));
    const wide from_pole = wide3_angle(way, up);
    return (tl_oracle_place){(longitude / M_PIq + 1) / 2 * width - 0.5Q,
                             from_pole / M_PIq * height - 0.5Q};
}

static int bounded(int i, int count, int is_around)
{
    if (is_around)
        return (i % count + count) % count;
    return i < 0 ? 0 : i < count ? i : count - 1;
}

wide tl_oracle_shown(
    const float *values, int width, int height, int is_around, tl_oracle_place at)
{
    const int i = (int)floorq(fmaxq(-2, fminq(at.x, width + 2))),
              j = (int)floorq(fmaxq(-2, fminq(at.y, height + 2)));
    const wide a = fmaxq(0, fminq(1, at.x - i)), b = fmaxq(0, fminq(1, at.y - j));
    wide sum = 0;
    for (int k = 0; k < 4; k++) {
        const int x = bounded(i + (k & 1), width, is_around),
                  y = bounded(j + (k >> 1), height, 0);
        sum += (k & 1 ? a : 1 - a) * (k >> 1 ? b : 1 - b) * values[y * width + x];
    }
    return sum;
}

wide tl_oracle_gradient(wide3 ray, wide3 up, wide horizon, wide zenith, wide ground)
{
    const wide sine = sinq(M_PI_2q - wide3_angle(ray, up));
    return sine > 0 ? horizon + sine * (zenith - horizon) : horizon - sine * (ground - horizon);
}
