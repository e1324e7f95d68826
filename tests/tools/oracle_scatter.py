#!/usr/bin/env python3
"""The first lights that test_scatter.c expects, from the definition in host/gbuffer/scatter.c:
SplitMix64, the pixel's ray, the lift, the hue. Exact rationals, rounded once at the end."""
from fractions import Fraction as F

MASK = (1 << 64) - 1
WIDTH, HEIGHT, DEPTH, RANGE, SEED, COUNT = 40, 20, F(5), F(2), 77, 6


def stream(state):
    while True:
        state = (state + 0x9E3779B97F4A7C15) & MASK
        z = state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        yield z ^ (z >> 31)


def hue(share):
    """Red, yellow, green, cyan, blue, magenta: corners of the cube, straight lines between."""
    corners = [(1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1), (1, 0, 1), (1, 0, 0)]
    at = share * 6
    whole = int(at)
    return [a + (b - a) * (at - whole) for a, b in zip(corners[whole], corners[whole + 1])]


bits = stream(SEED)
pixels = [(next(bits) >> 32) * (WIDTH * HEIGHT) >> 32 for _ in range(COUNT)]
for pixel in pixels:
    x = (-1 + F(2) * (pixel % WIDTH + F(1, 2)) / WIDTH) * DEPTH
    y = (F(1, 2) - (pixel // WIDTH + F(1, 2)) / HEIGHT) * DEPTH
    lift = (F(5, 100) + F(55, 100) * F(next(bits) >> 11, 1 << 53)) * RANGE
    colour = hue(F(next(bits) >> 11, 1 << 53))
    numbers = [x, y, -DEPTH + lift], colour
    print("    {" + ", ".join("{" + ", ".join(f"{float(v):.9e}f" for v in n) + "}" for n in numbers) + "},")
