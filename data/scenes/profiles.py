"""Luminaires of our own as IES files, one for each edition and each symmetry, and a wall that they wash."""

import json
import math

from . import shapes
from .document import Document

EDITIONS = {1986: "", 1991: "IESNA91", 1995: "IESNA:LM-63-1995", 2002: "IESNA:LM-63-2002", 2019: "IES:LM-63-2019"}


def steps(first, last, step):
    return [first + step * i for i in range(round((last - first) / step) + 1)]


def bump(angle, middle, width):
    """A smooth hill, 1 in the middle and 0 from `width` on."""
    off = abs(angle - middle) / width
    return math.cos(0.5 * math.pi * off) ** 2 if off < 1.0 else 0.0


# Name, edition, what it is, vertical and horizontal angles, candela by both, and what differs: factors, tilt.
def downlight(c, v):
    return 1200.0 * bump(v, 0, 55) + 260.0 * bump(v, 34, 9)


def washer(c, v):
    """Throws its light towards C0, up the wall."""
    side = 0.5 + 0.5 * math.cos(math.radians(c))
    return 80.0 * bump(v, 0, 80) + 1500.0 * side ** 3 * bump(v, 62, 45)


def linear(c, v):
    """Up and down, wide across its length, narrow along it."""
    across = math.sin(math.radians(c)) ** 2
    down = (300.0 + 500.0 * across) * bump(v, 0, 60.0 + 25.0 * across)
    return down + (150.0 + 400.0 * across) * bump(v, 130, 40)


def street(c, v):
    """Along the street to both sides, and more before it than behind: alike beside the plane 90-270."""
    along = abs(math.cos(math.radians(c)))
    before = 0.65 + 0.35 * math.sin(math.radians(c))
    return 200.0 * bump(v, 0, 90) + 1800.0 * before * along ** 2 * bump(v, 64, 22)


def uplight(c, v):
    return 900.0 * bump(v, 180, 60)


def star(c, v):
    """Five arms, which have no symmetry that files know."""
    arm = 0.5 + 0.5 * math.cos(math.radians(5.0 * (c - 20.0) + 0.8 * v))
    return 60.0 * bump(v, 0, 120) + 1400.0 * arm ** 4 * bump(v, 70, 50)


UNEVEN = [0, 2.5, 5, 7.5, 10, 15, 20, 22.5, 25, 27.5, 30, 32.5, 35, 37.5, 40, 42.5, 45, 50, 55, 60, 70, 80, 90]
LUMINAIRES = (
    ("downlight", 1995, "a narrow downlight with a ring around it", UNEVEN, [0], downlight, {}),
    ("washer", 2002, "a wall washer", steps(0, 90, 2.5), steps(0, 180, 10), washer, {"multiplier": 2.0}),
    ("linear", 1991, "a pendant that shines up and down", steps(0, 180, 5), steps(0, 90, 15), linear,
     {"ballast": 0.9, "lamp": 0.95}),
    ("street", 2002, "a street light", steps(0, 90, 2.5), steps(90, 270, 7.5), street, {}),
    ("uplight", 1986, "an uplight", steps(90, 180, 5), [0], uplight, {"tilt": True}),
    ("star", 2019, "five arms", steps(0, 120, 4) + [180], steps(0, 360, 6), star, {"absolute": True}),
)


def between(angles, values, at):
    for i in range(len(angles) - 1):
        if at <= angles[i + 1]:
            share = (at - angles[i]) / (angles[i + 1] - angles[i])
            return values[i] + share * (values[i + 1] - values[i])
    return values[-1]


def lumens(vertical, horizontal, candela):
    """A plain sum: middles of half degrees down, and planes by the share of the circle that they stand for."""
    total = weights = 0.0
    for i, c in enumerate(horizontal):
        before = c - horizontal[i - 1] if i > 0 else 0.0
        behind = horizontal[i + 1] - c if i + 1 < len(horizontal) else 0.0
        weight = 1.0 if len(horizontal) == 1 else 0.5 * (before + behind)
        ring, step = 0.0, 0.5
        for k in range(round((vertical[-1] - vertical[0]) / step)):
            v = vertical[0] + (k + 0.5) * step
            ring += between(vertical, candela[i], v) * math.sin(math.radians(v)) * math.radians(step)
        total += weight * ring
        weights += weight
    return 2.0 * math.pi * total / weights


def rows(numbers, per_row):
    for i in range(0, len(numbers), per_row):
        yield " ".join(numbers[i:i + per_row])


def luminaire(name, edition, what, vertical, horizontal, candela, more):
    """Lines of a file; the lumens are those of a lamp that loses none of them."""
    written = [["%.1f" % candela(c, v) for v in vertical] for c in horizontal]
    factor = more.get("multiplier", 1.0) * more.get("ballast", 1.0) * more.get("lamp", 1.0)
    flux = lumens(vertical, horizontal, [[factor * float(text) for text in plane] for plane in written])
    lines = [EDITIONS[edition]] if edition > 1986 else []
    lines += ["[TEST] none: computed by data/scenes/profiles.py"] if edition > 1986 else [what]
    lines += ["[MANUFAC] tilelight", "[LUMINAIRE] " + what] if edition > 1986 else []
    lines += ["TILT=INCLUDE", "1", "3", "0 45 90", "1.0 0.97 0.93"] if "tilt" in more else ["TILT=NONE"]
    claimed = "-1" if "absolute" in more else "%.3f" % flux
    lines.append("1 %s %g %d %d 1 2 0 0 0" % (claimed, more.get("multiplier", 1.0), len(vertical), len(horizontal)))
    lines.append("%g %g 20" % (more.get("ballast", 1.0), more.get("lamp", 1.0)))
    lines += rows(["%g" % v for v in vertical], 12)
    lines += rows(["%g" % c for c in horizontal], 12)
    for plane in written:
        lines += rows(plane, 12)
    return ("\r\n".join(lines) + "\r\n").encode("ascii")


def wall():
    """A wall of 12 x 4 m, a floor, and a ceiling before it."""
    scene = Document()
    plaster = scene.add_material("plaster", base=(0.75, 0.74, 0.72), rough=0.9)
    boards = scene.add_material("boards", base=(0.35, 0.3, 0.26), rough=0.7)
    for name, material, corner, right, up in (
            ("wall", plaster, (-6, 0, 0), (12, 0, 0), (0, 4, 0)),
            ("floor", boards, (-6, 0, 5), (12, 0, 0), (0, 0, -5)),
            ("ceiling", plaster, (-6, 4, 0), (12, 0, 0), (0, 0, 5))):
        mesh = scene.primitive(shapes.rectangle(corner, right, up), material)
        scene.add_node(name, mesh=scene.add_mesh(name, mesh))
    scene.add_node("camera", translation=(0, 1.9, 8.2), camera=scene.append("cameras", {
        "type": "perspective", "name": "camera", "perspective": {"yfov": 0.66, "znear": 0.5, "zfar": 30.0}}))
    return scene


def lights():
    """One luminaire of each kind, 60 cm before the wall, side by side."""
    out = []
    for k, (name, _, _, _, _, _, more) in enumerate(LUMINAIRES):
        lamp = {"type": "point", "name": name, "position": [-4.9 + 1.96 * k, 2.4, 0.6], "range": 12,
                "profile": name + ".ies", "up": [0, 0, -1], "group": "upper" if name == "uplight" else "lower"}
        if name in ("street", "star"):
            lamp["up"] = [1, 0, 0]
        if name == "linear":
            lamp["up"] = [0, 0, -1]
        lamp["color"] = [1, 0.9, 0.78] if k % 2 == 0 else [0.85, 0.92, 1]
        lamp["intensity"] = 0.004
        out.append(lamp)
    return {"tilelight": 1, "ambient": [0.01, 0.01, 0.012], "lights": out}


def files():
    out = {row[0] + ".ies": luminaire(*row) for row in LUMINAIRES}
    out["wall.lights.json"] = (json.dumps(lights(), indent=2) + "\n").encode()
    out.update(wall().embedded("wall"))
    return out
