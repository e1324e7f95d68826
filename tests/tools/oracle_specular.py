"""Prints tests/specular_cases.h: cos^e = (n.h / (|n| |h|))^e on exact inputs, with 50 digits.
It shares no step with kernels/specular.h, which never takes this cosine near the peak."""
import random
import re
import struct

from mpmath import mp, mpf, nstr, sqrt

mp.dps = 50


def f32(v):
    return [struct.unpack("f", struct.pack("f", c))[0] for c in v]


def unit(v):
    return f32([c / sum(c * c for c in v) ** 0.5 for c in v])


def specular(n, h, e):
    dot = lambda a, b: sum(mpf(x) * mpf(y) for x, y in zip(a, b))
    cos = dot(n, h) / sqrt(dot(n, n) * dot(h, h))
    return nstr(max(cos, mpf(0)) ** e, 20) if cos**e > 1e-300 else "0.0"


def c_vector(v):
    return "{" + ", ".join(re.sub(r"\.?0*p", "p", c.hex()) + "f" for c in v) + "}"


Z = [0.0, 0.0, 1.0]
N = unit([1.0, -2.0, 3.0])
CASES = [
    ("h is n", Z, Z, 10000),
    ("h is n, tilted, longer", N, [1.75 * c for c in N], 10000),
    ("exponent 0", N, Z, 0),
    ("exponent 0, grazing", Z, [1.0, 0.0, 2.0**-60], 0),
    ("h off n by less than 1 - n.h sees", Z, [2.0**-13, 0.0, 1.0], 10000),
    ("h below the surface", Z, [0.5, 0.0, -1.0], 1),
    ("h in the surface", Z, [1.0, 0.0, 0.0], 1),
    ("h almost in the surface, exponent 1", Z, [1.0, 0.0, 2.0**-20], 1),
    ("sin^2 just below 1/4", Z, [0.5773, 0.0, 1.0], 7),
    ("sin^2 just above 1/4", Z, [0.5774, 0.0, 1.0], 7),
    ("cos^2 just above sqrt(1/2), where the power of two steps", Z, [0.6435, 0.0, 1.0], 7),
    ("cos^2 just below sqrt(1/2)", Z, [0.6437, 0.0, 1.0], 7),
    ("below the smallest float", Z, [1.0, 0.0, 1.0], 10000),
]
random.seed(1977)
for e in (1, 10, 100, 1000, 10000):
    for spread in (0.3, 0.6):
        n = unit([random.gauss(0, 1) for _ in range(3)])
        h = [2 * (c + spread / max(e, 4) ** 0.5 * random.gauss(0, 1)) for c in n]
        CASES.append((f"random, exponent {e}, {spread} off the peak", n, h, e))

print("/* Printed by tests/tools/oracle_specular.py. clang-format off */")
for name, n, h, e in CASES:
    h = f32(h)
    print(f'{{"{name}", {c_vector(n)}, {c_vector(h)}, {e}.0f, {specular(n, h, e)}}},')
