"""Pictures of the hall: floor tiles, masonry, coffers. Each repeats without a seam."""

import math

from . import png

SIZE = 256
BRASS = 3  # px, half the width of the strips between floor tiles


def noise(x, y, period, seed):
    """Smooth value noise in [0, 1] of a lattice that repeats after `period` cells."""
    def cell(i, j):
        h = (i % period * 73856093) ^ (j % period * 19349663) ^ (seed * 83492791)
        h = (h ^ (h >> 13)) * 1274126177 & 0xffffffff
        return ((h ^ (h >> 16)) & 0xffff) / 65535.0
    scale = period / SIZE
    i, j = int(x * scale), int(y * scale)
    u, v = x * scale - i, y * scale - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    upper = cell(i, j) + u * (cell(i + 1, j) - cell(i, j))
    lower = cell(i, j + 1) + u * (cell(i + 1, j + 1) - cell(i, j + 1))
    return upper + v * (lower - upper)


def levels(value, count):
    """Few different values: a picture of noise stays small as a PNG."""
    return math.floor(value * count) / count


def floor_tile(x, y):
    """Which of the 2 x 2 tiles, and how far from the nearest strip, in pixels."""
    half = SIZE // 2
    column, row = x // half, y // half
    edge = min(x % half, half - 1 - x % half, y % half, half - 1 - y % half)
    return (column + row) % 2, edge


def floor_color(x, y):
    dark, edge = floor_tile(x, y)
    if edge < BRASS:
        return 0.87, 0.71, 0.40
    vein = 1 - abs(2 * noise(x, y, 8, 3) - 1) ** 0.5
    cloud = levels(0.5 * noise(x, y, 4, 1) + 0.3 * noise(x, y, 16, 2) + 0.2 * vein, 12)
    base, swing = ((0.20, 0.19, 0.22), 0.16) if dark else ((0.60, 0.56, 0.52), 0.2)
    return tuple(c + swing * cloud for c in base)


def floor_surface(x, y):
    """Occlusion, roughness, metal: dark tiles are polished, light ones worn, strips are brass."""
    dark, edge = floor_tile(x, y)
    if edge < BRASS:
        return 0.85, 0.35, 1.0
    worn = levels(noise(x, y, 8, 5), 4) * 0.12
    return min(1.0, 0.7 + edge / 40), (0.34 if dark else 0.5) + worn, 0.0


def floor_height(x, y):
    _, edge = floor_tile(x, y)
    return min(1.0, edge / 6.0)


def stone_edge(x, y):
    """Distance to the nearest joint of the masonry in pixels: courses of 64, every second one
    shifted by half a stone."""
    course = y // 64
    across = (x + (64 if course % 2 else 0)) % 128
    return min(across, 127 - across, y % 64, 63 - y % 64)


def stone_height(x, y):
    rough = levels(0.6 * noise(x, y, 16, 7) + 0.4 * noise(x, y, 64, 8), 12)
    return min(1.0, stone_edge(x, y) / 5.0) * (0.75 + 0.25 * rough)


def stone_color(x, y):
    course, shift = y // 64, 64 if (y // 64) % 2 else 0
    stone = (x + shift) % SIZE // 128 + 2 * course
    tint = (0.0, 0.05, -0.04, 0.03, -0.02, 0.04, -0.05, 0.01)[stone % 8]
    cloud = levels(noise(x, y, 16, 9), 8) * 0.08
    joint = 0.75 if stone_edge(x, y) < 2 else 1.0
    return tuple(joint * (c + tint + cloud) for c in (0.74, 0.69, 0.61))


def stone_surface(x, y):
    return min(1.0, 0.45 + stone_edge(x, y) / 12), 0.8, 0.0


def coffer_edge(x, y):
    return min(x, SIZE - 1 - x, y, SIZE - 1 - y)


def coffer_height(x, y):
    """Two steps down to a flat bottom."""
    edge = coffer_edge(x, y)
    def step(at):
        return min(1.0, max(0.0, (at + 8 - edge) / 8))
    return 0.5 * step(26) + 0.5 * step(54)


def coffer_surface(x, y):
    edge = coffer_edge(x, y)
    corner = min(abs(edge - 34), abs(edge - 62))
    return (min(1.0, 0.5 + corner / 24) if edge > 26 else 1.0), 0.7, 0.0


def files():
    return {
        "hall-floor-color.png": png.picture(SIZE, floor_color),
        "hall-floor-surface.png": png.picture(SIZE, floor_surface),
        "hall-floor-normal.png": png.normal_map(SIZE, floor_height, 3.0),
        "hall-stone-color.png": png.picture(SIZE, stone_color),
        "hall-stone-surface.png": png.picture(SIZE, stone_surface),
        "hall-stone-normal.png": png.normal_map(SIZE, stone_height, 5.0),
        "hall-coffer-surface.png": png.picture(SIZE, coffer_surface),
        "hall-coffer-normal.png": png.normal_map(SIZE, coffer_height, 18.0)}
