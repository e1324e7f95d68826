"""sky.exr: a sky to light scenes by, a map of latitude and longitude: a clear sky with a low sun, ground of light and
dark strips, and behind the viewer a wall of bright windows; with sky.lights.json, which lights by it."""

import math

from . import exr

WIDTH, HEIGHT = 256, 128
PARTS = 2  # samples of a pixel, each way
SUN = math.radians(50.0), math.radians(35.0), math.radians(2.5)  # longitude to the right, elevation, radius
LIGHTS = b"""{ "tilelight": 1,
  "model": "metal-rough",
  "sky": { "type": "image", "image": "sky.exr", "light": 1 },
  "lights": [] }
"""


def _mixed(a, b, share):
    return tuple(p + (q - p) * share for p, q in zip(a, b))


def _sun_cosine(longitude, elevation):
    to, high, _ = SUN
    return (math.sin(elevation) * math.sin(high) +
            math.cos(elevation) * math.cos(high) * math.cos(longitude - to))


def _sky(longitude, elevation):
    cosine = _sun_cosine(longitude, elevation)
    if cosine > math.cos(SUN[2]):
        return (900.0, 780.0, 560.0)
    color = _mixed((0.85, 0.95, 1.05), (0.12, 0.27, 0.65), math.sin(elevation) ** 0.6)
    glow = max(cosine, 0.0) ** 40
    return tuple(c + glow * g for c, g in zip(color, (1.6, 1.2, 0.7)))


def _windows(longitude, elevation):
    """Three tall ones and a strip above, around the middle of what is behind; None where there is none."""
    behind = math.degrees(math.remainder(longitude - math.pi, 2.0 * math.pi))
    height = math.degrees(elevation)
    if abs(behind) > 48.0 or height < -4.0 or height > 46.0:
        return None
    if height > 38.0:
        return (14.0, 15.0, 17.0) if 40.0 < height < 44.0 and abs(behind) < 44.0 else (0.05, 0.045, 0.04)
    across = (behind + 48.0) % 32.0
    return (6.0, 6.6, 7.5) if 5.0 < across < 27.0 and height > 4.0 else (0.05, 0.045, 0.04)


def _ground(longitude, elevation):
    strip = math.floor(longitude / math.radians(15.0)) % 2
    near = (0.22, 0.17, 0.11) if strip else (0.11, 0.1, 0.08)
    return _mixed((0.3, 0.28, 0.25), near, math.sin(-elevation) ** 0.5)


def _radiance(longitude, elevation):
    wall = _windows(longitude, elevation)
    if wall:
        return wall
    return _sky(longitude, elevation) if elevation > 0.0 else _ground(longitude, elevation)


def _color_at(x, y):
    total = [0.0, 0.0, 0.0]
    for part in range(PARTS * PARTS):
        across = x + (part % PARTS + 0.5) / PARTS
        down = y + (part // PARTS + 0.5) / PARTS
        color = _radiance(2.0 * math.pi * (across / WIDTH - 0.5), math.pi * (0.5 - down / HEIGHT))
        total = [t + c for t, c in zip(total, color)]
    # Rounded, so that a last bit of a library's sine shows in no file.
    return tuple(float("%.2g" % (t / PARTS ** 2)) for t in total)


def files():
    return {"sky.exr": exr.encoded(WIDTH, HEIGHT, _color_at), "sky.lights.json": LIGHTS}
