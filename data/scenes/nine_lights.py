"""Nine lights on a table of simple bodies: one over the whole screen, two spheres, six cones.

The arrangement that the demo of Thibieroz, "Deferred Shading with Multiple Render Targets"
(ShaderX2, 2003) shows, with a scene of our own.
"""

import json
import math

from . import shapes
from .document import Document

WHOLE_SCREEN = ("whole screen", (0, 7, 2), (1.0, 0.95, 0.88), 16.0)  # no range: reaches all
SPHERES = (("left sphere", (-3.1, 0.9, 1.9), (0.15, 0.40, 1.0), 2.0, 3.6),
           ("right sphere", (3.1, 0.9, 1.9), (1.0, 0.24, 0.10), 2.0, 3.6))
CONE_COLORS = ((1.0, 0.15, 0.08), (1.0, 0.65, 0.1), (0.15, 1.0, 0.2), (0.1, 0.8, 1.0),
               (0.2, 0.25, 1.0), (1.0, 0.15, 0.75))
CONE_HEIGHT, CONE_RING, CONE_RANGE = 3.4, 3.0, 4.6
CONE_ANGLES = (0.3, 0.45)  # inner, outer half-angle, radians


def cones():
    """(name, position, colour, turn of the node as a quaternion): each leans outwards."""
    for i, color in enumerate(CONE_COLORS):
        angle = math.radians(30 + 60 * i)
        position = (CONE_RING * math.sin(angle), CONE_HEIGHT, CONE_RING * math.cos(angle))
        # A glTF light shines along -z of its node: turned down, less a lean of 11 degrees, then
        # outwards.
        turn = shapes.quaternion(-79, math.degrees(angle) + 180)
        yield "cone %d" % (i + 1), position, color, turn


def bodies():
    """(name, mesh, place, colour, metal, rough)"""
    cone = shapes.revolved([[(0.001, 0), (0.55, 0)], [(0.55, 0), (0.02, 1.3)]], 48)
    cylinder = shapes.revolved([[(0.001, 0), (0.45, 0)], [(0.45, 0), (0.45, 1.0)],
                                [(0.45, 1.0), (0.001, 1.0)]], 48)
    vase = [(0.3, 0.0), (0.42, 0.2), (0.5, 0.45), (0.42, 0.75), (0.22, 1.0), (0.2, 1.1),
            (0.3, 1.25)]
    turned_box = shapes.box(0.9, 0.9, 0.9).mapped(shapes.turn_y(30))
    return (
        ("middle sphere", shapes.sphere(0.9, 64, 32), (0, 0.9, 0), (0.92, 0.9, 0.88), 0.6, 0.42),
        ("ring", shapes.torus(1.45, 0.14, 72, 16), (0, 0.14, 0), (0.95, 0.72, 0.35), 0.6, 0.4),
        ("cone", cone, (-2.6, 0, -1.5), (0.8, 0.8, 0.8), 0.0, 0.45),
        ("cylinder", cylinder, (0, 0, -3.0), (0.75, 0.75, 0.78), 0.0, 0.3),
        ("box", turned_box, (2.6, 0.45, -1.5), (0.8, 0.78, 0.74), 0.0, 0.6),
        ("vase", shapes.revolved([smooth(vase)], 48), (-2.6, 0, 1.5), (0.85, 0.82, 0.8), 0.0, 0.25),
        ("small sphere", shapes.sphere(0.5, 48, 24), (2.6, 0.5, 1.5), (0.85, 0.85, 0.85), 0.0, 0.2),
        ("disc", shapes.torus(0.5, 0.18, 48, 16), (0, 0.18, 3.0), (0.8, 0.8, 0.82), 0.0, 0.35))


def smooth(points, steps=4):
    """A Catmull-Rom line through the points, ends doubled."""
    padded = [points[0], *points, points[-1]]
    line = []
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
        for step in range(steps):
            t = step / steps
            line.append(tuple(0.5 * (2 * q + t * (r - p) + t * t * (2 * p - 5 * q + 4 * r - s)
                                     + t ** 3 * (3 * (q - r) + s - p))
                              for p, q, r, s in zip(a, b, c, d)))
    return [*line, points[-1]]


def document():
    scene = Document()
    floor = shapes.rectangle((-7, 0, 7), (14, 0, 0), (0, 0, -14))
    stone = scene.add_material("floor", base=(0.5, 0.5, 0.5), rough=0.4)
    scene.add_node("floor", mesh=scene.add_mesh("floor", scene.primitive(floor, stone)))
    for name, mesh, place, color, metal, rough in bodies():
        # The vase is open at the top.
        material = scene.add_material(name, base=color, metal=metal, rough=rough,
                                      doubleSided=name == "vase")
        scene.add_node(name, translation=place,
                       mesh=scene.add_mesh(name, scene.primitive(mesh, material)))
    name, place, color, intensity = WHOLE_SCREEN
    scene.add_node(name, translation=place,
                   light=scene.add_light(name, "point", color, intensity))
    for name, place, color, intensity, light_range in SPHERES:
        scene.add_node(name, translation=place,
                       light=scene.add_light(name, "point", color, intensity, light_range))
    for name, place, color, turn in cones():
        light = scene.add_light(name, "spot", color, 20.0, CONE_RANGE, CONE_ANGLES)
        scene.add_node(name, translation=place, rotation=turn, light=light)
    eye = scene.append("cameras", {"type": "perspective", "name": "view", "perspective":
                                   {"yfov": 0.72, "znear": 0.1, "zfar": 60.0}})
    scene.add_node("camera", camera=eye, translation=(0, 5.6, 9.2),
                   rotation=shapes.quaternion(-29, 0))
    return scene


def ray(turn):
    """Where -z of a node goes that is turned so."""
    x, y, z, w = turn
    return -2 * (x * z + w * y), -2 * (y * z - w * x), -(1 - 2 * (x * x + y * y))


def lights():
    """The same nine as a lights file, and ambient light beside them."""
    def row(kind, name, place, color, intensity, **more):
        return {"type": kind, "name": name, "position": [round(c, 6) for c in place],
                "color": list(color), "intensity": intensity, **more}
    rows = [row("point", *WHOLE_SCREEN)]
    rows += [row("point", *sphere[:4], range=sphere[4]) for sphere in SPHERES]
    for name, place, color, turn in cones():
        rows.append(row("spot", name, place, color, 20.0, range=CONE_RANGE,
                        direction=[round(c, 6) for c in ray(turn)],
                        innerConeAngle=CONE_ANGLES[0], outerConeAngle=CONE_ANGLES[1]))
    lines = ",\n    ".join(json.dumps(row) for row in rows)
    text = '{\n  "tilelight": 1,\n  "ambient": [0.02, 0.02, 0.02],\n  "lights": [\n    %s\n  ]\n}\n'
    return (text % lines).encode()


# A model for each body (two are brushed), and white light to tell them apart by.
MODELS = (
    ("floor", "ward-anisotropic", dict(diffuse=(0.16, 0.17, 0.19), specular=(0.5, 0.5, 0.52),
                                       roughness=0.35, roughnessAcross=0.75, direction=(1, 0, 0))),
    ("middle sphere", "ward-anisotropic", dict(diffuse=(0.1, 0.07, 0.04), specular=(0.95, 0.7, 0.4),
                                               roughness=0.32, roughnessAcross=0.8)),
    ("ring", "cook-torrance", dict(diffuse=(0.05, 0.03, 0.01), specular=(1.0, 0.71, 0.29),
                                   roughness=0.45)),
    ("cone", "oren-nayar", dict(diffuse=(0.8, 0.42, 0.3), roughness=0.9)),
    ("cylinder", "ward", dict(diffuse=(0.25, 0.35, 0.6), specular=(0.4, 0.4, 0.4), roughness=0.5)),
    ("box", "lambert", dict(diffuse=(0.7, 0.68, 0.6))),
    ("vase", "metal-rough", dict(diffuse=(0.02, 0.3, 0.25), specular=(0.04, 0.04, 0.04),
                                 roughness=0.3)),
    ("small sphere", "minnaert", dict(diffuse=(0.75, 0.7, 0.62), k=0.6)),
    ("disc", "phong-reflection", dict(diffuse=(0.6, 0.1, 0.12), specular=(0.8, 0.8, 0.8),
                                      shininess=60)))
WHITE_LIGHTS = (("key", (-4, 6, 4), (1.0, 0.95, 0.88), 40), ("back", (3.5, 5, -6), (0.85, 0.92, 1.0), 28),
                ("fill", (6, 4, 6), (1, 1, 1), 11))


def models():
    """A lights file in which every body reflects by a model of its own."""
    rows = [json.dumps({"material": name, "model": model, **given}) for name, model, given in MODELS]
    lamps = [json.dumps({"type": "point", "name": name, "position": place, "color": color,
                         "intensity": intensity}) for name, place, color, intensity in WHITE_LIGHTS]
    text = ('{\n  "tilelight": 1,\n  "ambient": [0.04, 0.04, 0.045],\n  "materials": [\n    %s\n  ],\n'
            '  "lights": [\n    %s\n  ]\n}\n')
    return (text % (",\n    ".join(rows), ",\n    ".join(lamps))).encode()


def files():
    return {**document().embedded("nine-lights"), "nine-lights.lights.json": lights(),
            "nine-models.lights.json": models()}
