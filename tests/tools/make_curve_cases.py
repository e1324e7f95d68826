#!/usr/bin/env python3
"""Writes tests/curve_cases.h: curves between keys, by other formulas than raster/model/curves.c has, in 60
digits. Rotations by the exponential of a share of the logarithm of the rotation that leads from one key
to the next; splines by de Casteljau's algorithm on Bezier points; keys are floats, as in files."""
import struct
from mpmath import mp, mpf, acos, atan2, cos, sin, sqrt

mp.dps = 60


def f32(x):
    return struct.unpack("f", struct.pack("f", float(x)))[0]


def unit(q):
    length = sqrt(sum(c * c for c in q))
    return [c / length for c in q]


def times(a, b):  # x y z w
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]


def turn(axis, angle):
    axis = unit([mpf(c) for c in axis])
    return [c * sin(angle / 2) for c in axis] + [cos(angle / 2)]


def power(q, share):
    """q as a rotation by at most half a turn, by a share of its angle."""
    if q[3] < 0:
        q = [-c for c in q]
    length = sqrt(sum(c * c for c in q[:3]))
    if length == 0:
        return [mpf(0)] * 3 + [mpf(1)]
    angle = atan2(length, q[3])
    return [c / length * sin(share * angle) for c in q[:3]] + [cos(share * angle)]


def between_rotations(a, b, t):
    a, b = unit(a), unit(b)
    return times(power(times(b, [-a[0], -a[1], -a[2], a[3]]), t), a)


def between_cubic(v0, out0, in1, v1, t, span):
    """Tangents are three times the legs of the Bezier polygon."""
    points = [v0, v0 + span * out0 / 3, v1 - span * in1 / 3, v1]
    while len(points) > 1:
        points = [(1 - t) * p + t * q for p, q in zip(points, points[1:])]
    return points[0]


def sample(kind, rotates, keys, time):
    at = [mpf(k[0]) for k in keys]
    time = mpf(time)
    values = [[[mpf(c) for c in part] for part in k[1:]] for k in keys]
    mid = 1 if kind == "TL_CUBIC" else 0
    k = max([i for i, t in enumerate(at) if t <= time], default=None)
    if k is None or k == len(keys) - 1 or kind == "TL_STEP":
        out = values[k or 0][mid]
    else:
        span = at[k + 1] - at[k]
        t = (time - at[k]) / span
        if kind == "TL_CUBIC":
            out = [between_cubic(a, b, c, d, t, span) for a, b, c, d in
                   zip(values[k][1], values[k][2], values[k + 1][0], values[k + 1][1])]
        elif rotates:
            out = between_rotations(values[k][0], values[k + 1][0], t)
        else:
            out = [(1 - t) * a + t * b for a, b in zip(values[k][0], values[k + 1][0])]
    return unit(out) if rotates else out


X, Z, D = (1, 0, 0), (0, 0, 1), (1, 2, -3)
I = (0, 0, 0, 1)


def quats(*keys):
    return [(t, q) for t, q in keys]


def neg(q):
    return [-c for c in q]


near = turn(D, mpf("0.7"))
RAMP = [(0.25, (1, -2, 5)), (1, (3, 4, 5)), (1.5, (-7, 0.1, 1e6))]
SPLINE = [(1, (9, 9, 9), (0, 1, -1), (2, -3, 0.5)), (3, (-1, 4, 0), (5, 1, 1e3), (0, 0, -2)),
          (3.5, (7, 1, 1), (5, 0, 0), (9, 9, 9))]
SPIN = [(0, (0, 0, 0, 0), I, (0, 0, 0.5, 0)),
        (2, (0.25, 0, 0, -0.5), (0, 0, 0.6, 0.8), (0, 0, 0, 0))]
CASES = [
    ("linear, before the first key", "TL_LINEAR", 0, RAMP, [0, 0.2499]),
    ("linear, on and between keys", "TL_LINEAR", 0, RAMP, [0.25, 0.3, 0.75, 1, 1.0001, 1.49]),
    ("linear, behind the last key", "TL_LINEAR", 0, RAMP, [1.5, 1.6, 1e9]),
    ("linear, one key", "TL_LINEAR", 0, RAMP[1:2], [0, 1, 2]),
    ("step", "TL_STEP", 0, RAMP, [0, 0.25, 0.99999, 1, 1.49999, 1.5, 7]),
    ("linear, late and close keys", "TL_LINEAR", 0, [(1e6, (1, 2, 3)), (1e6 + 0.0625, (2, 4, 7))],
     [1e6 + 0.015625]),
    ("cubic", "TL_CUBIC", 0, SPLINE, [0, 1, 1.5, 2, 2.9, 3, 3.25, 3.4999, 3.5, 4]),
    ("a quarter turn", "TL_LINEAR", 1, quats((0, I), (2, turn(Z, mp.pi / 2))), [0.1, 0.5, 1, 1.9, 2]),
    ("half a turn", "TL_LINEAR", 1, quats((0, I), (1, (0, 1, 0, 0))), [0.125, 0.5, 0.75]),
    ("between two axes", "TL_LINEAR", 1, quats((0, turn(X, 2)), (1, turn(D, -1))), [0.1, 0.5, 0.9]),
    ("the long way, stored", "TL_LINEAR", 1, quats((0, turn(X, 2)), (1, neg(turn(D, -1)))), [0.1, 0.5, 0.9]),
    ("a tiny angle", "TL_LINEAR", 1, quats((0, near), (1, turn(D, mpf("0.70001")))), [0.25, 0.5]),
    ("the least angle of floats", "TL_LINEAR", 1, quats((0, (0, 0, 0, 1)), (1, (1e-38, 0, 0, 1))), [0.5]),
    ("no angle", "TL_LINEAR", 1, quats((0, near), (1, near)), [0.25, 0.5]),
    ("almost antipodal", "TL_LINEAR", 1, quats((0, near), (1, neg(turn(D, mpf("0.70001"))))), [0.25, 0.5]),
    ("antipodal", "TL_LINEAR", 1, quats((0, near), (1, neg(near))), [0.25, 0.5]),
    ("almost half a turn", "TL_LINEAR", 1, quats((0, I), (1, turn(D, mp.pi - mpf("1e-6")))), [0.25, 0.5]),
    ("keys that are not of length 1", "TL_LINEAR", 1,
     quats((0, (0, 0, 0, 2)), (1, (0, 0, 0.707, 0.707))), [0, 0.25, 0.5, 1]),
    ("stepped rotation", "TL_STEP", 1, quats((0, (0, 0, 0, 2)), (1, (0, 3, 0, 0))), [0.5, 1]),
    ("cubic rotation", "TL_CUBIC", 1, SPIN, [0, 0.5, 1, 1.75, 2]),
]


def text(v):
    """As few digits as come back to the same double."""
    return repr(float(v))


def main():
    print("/* Made by tests/tools/make_curve_cases.py. */\n#ifndef TL_CURVE_CASES_H\n#define TL_CURVE_CASES_H\n")
    print('#include "curves.h"\n')
    print("enum { CURVE_KEYS = 3, CURVE_VALUES = 36 };\n")
    print("/* Keys and, at a time, what the curve is and how large what adds up to it gets. */")
    print("static const struct {\n    const char *name;\n    enum tl_interpolation interpolation;\n"
          "    bool rotates;\n    size_t key_count, width;\n    float times[CURVE_KEYS], values[CURVE_VALUES];\n"
          "    double time, expected[4], sizes[4];\n} curve_cases[] = {")
    for name, kind, rotates, keys, moments in CASES:
        keys = [(f32(k[0]),) + tuple(tuple(f32(c) for c in part) for part in k[1:]) for k in keys]
        span = max([1.0] + [b[0] - a[0] for a, b in zip(keys, keys[1:])])
        sizes = [1 if rotates else span * max(abs(part[i]) for k in keys for part in k[1:])
                 for i in range(len(keys[0][1]))]
        for moment in moments:
            out = sample(kind, rotates, keys, moment)
            flat = [c for k in keys for part in k[1:] for c in part]
            print(f'    {{"{name}", {kind}, {"true" if rotates else "false"}, {len(keys)}, {len(keys[0][1])},')
            print("     {" + ", ".join(text(k[0]) + "f" for k in keys) + "},")
            print("     {" + ", ".join(text(c) + "f" for c in flat) + "},")
            print("     " + text(moment) + ", {" + ", ".join(text(c) for c in out) + "}, {" + ", ".join(text(c) for c in sizes) + "}},")
    print("};\n\n#endif")


main()
