#!/usr/bin/env python3
"""Makes host/picture/blue_noise.h: 64 x 64 ranks whose every threshold is a pattern without low frequencies.

    tests/tools/make_blue_noise.py >host/picture/blue_noise.h

R. Ulichney, "The Void-and-Cluster Method for Dither Array Generation", 1993: a tenth of the pixels, spread by
moving the tightest cluster to the largest void until that is one place; ranks below by taking clusters away,
ranks above by filling voids. Clusters and voids are what a Gaussian of 1.5 pixels sees, on a torus. Ties go to
the first, so the same ranks come out anywhere.
"""
import math

SIDE, SIGMA, SEED = 64, 1.5, 1993
REACH = 9  # px; beyond it the Gaussian is below 2e-8
WEIGHTS = [(y, x, math.exp(-(x * x + y * y) / (2 * SIGMA ** 2)))
           for y in range(-REACH, REACH + 1) for x in range(-REACH, REACH + 1)]


def first_pixels(count):
    """By a congruential generator (Numerical Recipes' constants), so that no library decides."""
    state, found = SEED, []
    while len(found) < count:
        state = (state * 1664525 + 1013904223) % 2 ** 32
        place = state >> 20
        if place not in found:
            found.append(place)
    return found


class Pattern:
    def __init__(self, places):
        self.on = [False] * (SIDE * SIDE)
        self.energy = [0.0] * (SIDE * SIDE)
        for place in places:
            self.put(place, True)

    def put(self, place, on):
        self.on[place] = on
        row, column = divmod(place, SIDE)
        for y, x, weight in WEIGHTS:
            at = (row + y) % SIDE * SIDE + (column + x) % SIDE
            self.energy[at] = round(self.energy[at] + (weight if on else -weight), 9)

    def cluster(self):
        return max((e, -i) for i, e in enumerate(self.energy) if self.on[i])[1] * -1

    def void(self):
        return min((e, i) for i, e in enumerate(self.energy) if not self.on[i])[1]


def ranks():
    count = SIDE * SIDE // 10
    pattern = Pattern(first_pixels(count))
    while True:
        cluster = pattern.cluster()
        pattern.put(cluster, False)
        void = pattern.void()
        pattern.put(void, True)
        if void == cluster:
            break
    start = [place for place in range(SIDE * SIDE) if pattern.on[place]]
    rank = [0] * (SIDE * SIDE)
    for value in range(count - 1, -1, -1):
        place = pattern.cluster()
        rank[place] = value
        pattern.put(place, False)
    pattern = Pattern(start)
    for value in range(count, SIDE * SIDE):
        place = pattern.void()
        rank[place] = value
        pattern.put(place, True)
    return rank


def main():
    print("/* Made by tests/tools/make_blue_noise.py: ranks, row by row. */")
    print("#ifndef TL_BLUE_NOISE_H\n#define TL_BLUE_NOISE_H\n\n#include <stdint.h>\n")
    print("/* clang-format off */")
    print("static const uint16_t blue_noise[%d * %d] = {" % (SIDE, SIDE))
    rank = ranks()
    for begin in range(0, SIDE * SIDE, 16):
        print("    " + ", ".join("%d" % value for value in rank[begin:begin + 16]) + ",")
    print("};\n/* clang-format on */\n\n#endif")


if __name__ == "__main__":
    main()
