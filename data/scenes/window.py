"""Light through pictures, for the hall: a window with coloured panes that a spot projects, a pierced lantern
around a lamp, a lamp that fades by a table of its own."""

import json
import math

from . import png

WINDOW, LANTERN = 128, 128  # px; the lantern is twice as wide as high

RED, BLUE, AMBER, CLEAR = (0.95, 0.25, 0.2), (0.25, 0.4, 0.95), (1.0, 0.75, 0.25), (1.0, 0.97, 0.9)
LEAD = (0.0, 0.0, 0.0)


def window(x, y):
    """Two lights with pointed arches under a round one; panes as diamonds."""
    u, v = (x + 0.5) / WINDOW - 0.5, (y + 0.5) / WINDOW - 0.5  # v down
    if math.hypot(u, v + 0.24) < 0.105:  # the round light
        petals = math.cos(6 * math.atan2(v + 0.24, u))
        return AMBER if math.hypot(u, v + 0.24) > 0.03 + 0.05 * (petals > 0.0) else RED
    side = abs(u) - 0.125
    arch = abs(side) + max(0.0, -0.06 - v) * 0.75  # narrower above the springing
    if not (-0.22 < v < 0.36 and arch < 0.095):
        return LEAD
    a, b = (u + v) / 0.062, (u - v) / 0.062
    if min(abs(a - round(a)), abs(b - round(b))) < 0.07:
        return LEAD
    return (CLEAR, BLUE, CLEAR, RED)[(math.floor(a) + 2 * math.floor(b)) % 4]


def lantern(x, y):
    """Rows of holes; dark at the poles, the strut at the seam."""
    longitude, latitude = (x + 0.5) / LANTERN * 24.0, (y + 0.5) / (LANTERN / 2) * 12.0
    if not 2.0 < latitude < 10.0:
        return (0.02, 0.02, 0.02)
    row = math.floor(latitude)
    u, v = (longitude + 0.5 * (row % 2)) % 1.0 - 0.5, latitude % 1.0 - 0.5
    return (1.0, 0.9, 0.7) if math.hypot(u, v) < 0.34 else (0.02, 0.02, 0.02)


def lights():
    window_spot = {"type": "spot", "name": "window", "position": [-5, 8.5, -6],
                   "direction": [0.55, -0.7, -0.2], "color": [1, 0.96, 0.88], "intensity": 900, "range": 30,
                   "innerConeAngle": 0.44, "outerConeAngle": 0.45, "texture": "window.png"}
    lamp = {"type": "point", "name": "lantern", "position": [1.2, 1.6, -13.5], "color": [1, 0.8, 0.5],
            "intensity": 40, "range": 14, "texture": "lantern.png", "ambient": 0.02}
    fading = {"type": "point", "name": "rings", "position": [0, 3, -26], "color": [0.35, 0.6, 1],
              "intensity": 1.2, "range": 9, "falloff": "lut",
              "lut": [1, 1, 0.9, 0.2, 0.75, 0.15, 0.5, 0.1, 0.25, 0]}
    day = {"type": "directional", "name": "day", "direction": [0.3, -1, -0.4], "color": [0.7, 0.8, 1],
           "intensity": 0.03}
    return {"tilelight": 1, "ambient": [0.02, 0.022, 0.03],
            "sky": {"type": "gradient", "zenith": [0.05, 0.12, 0.4], "horizon": [0.5, 0.6, 0.8],
                    "ground": [0.05, 0.05, 0.05]},
            "lights": [window_spot, lamp, fading, day]}


def files():
    rows = [bytes(png.byte(c) for x in range(LANTERN) for c in lantern(x, y)) for y in range(LANTERN // 2)]
    return {"window.png": png.picture(WINDOW, window),
            "lantern.png": png.encode(rows, LANTERN, LANTERN // 2, 2),
            "window.lights.json": (json.dumps(lights(), indent=2) + "\n").encode()}
