"""A fair in motion, four seconds that repeat: what moves by its node, what bends by its skin, what
swells by its morph targets; lights and a camera move along.

Straight, smooth and stepped curves are all there. Keys stand half a second apart.
"""

import math

from . import shapes
from .document import Document

SECONDS, KEYS = 4.0, 8
TIMES = [SECONDS * k / KEYS for k in range(KEYS + 1)]
LAMP_COLORS = ((1.0, 0.35, 0.15), (1.0, 0.8, 0.3), (0.3, 1.0, 0.4), (0.2, 0.6, 1.0), (0.8, 0.3, 1.0),
               (1.0, 0.25, 0.5))
CAROUSEL, CAROUSEL_RADIUS = (-1.6, 0, -1.2), 1.5
STALK, STALK_HEIGHT, STALK_JOINTS = (2.3, 0, -0.4), 2.4, 5
DROP = (0.55, 0.75, 1.6)


def turn(axis, degrees):
    """A quaternion."""
    half = math.radians(degrees) / 2
    return (*(c * math.sin(half) for c in axis), math.cos(half))


def smooth_keys(value_at, slope_at):
    """Values of a CUBICSPLINE curve: at each key slope in, value, slope out."""
    rows = []
    for time in TIMES:
        rows += [slope_at(time), value_at(time), slope_at(time)]
    return rows


def add_carousel(scene):
    """A platform with posts and lamps that goes round once. Returns its curves."""
    wood = scene.add_material("wood", base=(0.55, 0.3, 0.16), rough=0.45)
    brass = scene.add_material("brass", base=(0.95, 0.75, 0.4), metal=0.7, rough=0.35)
    plate = shapes.revolved([[(0.001, 0.02), (1.7, 0.02)], [(1.7, 0.02), (1.7, 0.2)],
                             [(1.7, 0.2), (0.001, 0.2)]], 64)
    roof = shapes.revolved([[(1.8, 1.75), (0.02, 2.5)], [(0.02, 2.45), (1.8, 1.7)],
                            [(1.8, 1.7), (1.8, 1.75)]], 12)
    post = shapes.revolved([[(0.05, 0.2), (0.05, 1.72)]], 16)
    children = [
        scene.add_node("platform", root=False,
                       mesh=scene.add_mesh("platform", scene.primitive(plate, wood))),
        scene.add_node("roof", root=False,
                       mesh=scene.add_mesh("roof", scene.primitive(roof, scene.add_material(
                           "canvas", base=(0.85, 0.2, 0.18), rough=0.7, doubleSided=True))))]
    posts = scene.add_mesh("post", scene.primitive(post, brass))
    bulb = shapes.sphere(0.12, 24, 12)
    for i, color in enumerate(LAMP_COLORS):
        angle = 2 * math.pi * i / len(LAMP_COLORS)
        x, z = CAROUSEL_RADIUS * math.sin(angle), CAROUSEL_RADIUS * math.cos(angle)
        children.append(scene.add_node("post %d" % i, root=False, mesh=posts, translation=(x, 0, z)))
        glow = scene.add_material("bulb %d" % i, base=(0, 0, 0), emissive=color, strength=2.0)
        children.append(scene.add_node(
            "lamp %d" % i, root=False, translation=(1.25 * x, 1.4, 1.25 * z),
            mesh=scene.add_mesh("bulb %d" % i, scene.primitive(bulb, glow)),
            light=scene.add_light("lamp %d" % i, "point", color, 2.2, 3.2)))
    carousel = scene.add_node("carousel", translation=CAROUSEL, children=children)
    turns = [turn((0, 1, 0), 360 * t / SECONDS) for t in TIMES]
    return [(carousel, "rotation", "LINEAR", TIMES, turns)]


def bend_weights(height):
    """The two joints beside a height, and how much each has."""
    at = min(max(height / STALK_HEIGHT * (STALK_JOINTS - 1), 0.0), STALK_JOINTS - 1.000001)
    low = int(at)
    return (low, low + 1, 0, 0), (1 - (at - low), at - low, 0, 0)


def add_stalk(scene):
    """A stalk that sways. Returns its curves."""
    levels = [(0.28 - 0.07 * h, STALK_HEIGHT * h / 3) for h in (3 * k / 24 for k in range(25))]
    mesh = shapes.revolved([levels, [levels[-1], (0.001, STALK_HEIGHT)]], 32)
    rows = [bend_weights(y) for _, y, _ in mesh.positions]
    material = scene.add_material("stalk", base=(0.3, 0.6, 0.25), rough=0.5)
    step = STALK_HEIGHT / (STALK_JOINTS - 1)
    joints, below = [], []
    for k in reversed(range(STALK_JOINTS)):
        place = STALK if k == 0 else (0, step, 0)
        below = [scene.add_node("joint %d" % k, root=k == 0, translation=place,
                                **({"children": below} if below else {}))]
        joints.insert(0, below[0])
    skin = scene.add_skin("stalk", joints, [(0, k * step, 0) for k in range(STALK_JOINTS)])
    scene.add_node("stalk", skin=skin, mesh=scene.add_mesh("stalk", scene.primitive(
        mesh, material, joints=[j for j, _ in rows], weights=[w for _, w in rows])))

    def curve(k):
        """Sways by 20 degrees about z, each joint a little behind the one below."""
        rate, most = 2 * math.pi / SECONDS, math.radians(20) / 2

        def value(t):
            half = most * math.sin(rate * t - 0.6 * k)
            return (0, 0, math.sin(half), math.cos(half))

        def slope(t):
            half = most * math.sin(rate * t - 0.6 * k)
            speed = most * rate * math.cos(rate * t - 0.6 * k)
            return (0, 0, speed * math.cos(half), -speed * math.sin(half))
        return (joints[k], "rotation", "CUBICSPLINE", TIMES, smooth_keys(value, slope))
    return [curve(k) for k in range(1, STALK_JOINTS)]


def add_drop(scene):
    """A ball that is pressed flat and drawn out by turns, and hops. Returns its curves."""
    ball = shapes.sphere(0.55, 48, 24)

    def scaled(wide, tall):
        mesh = ball.copy()
        mesh.positions = [(x * wide, y * tall, z * wide) for x, y, z in ball.positions]
        normals = [(x / wide, y / tall, z / wide) for x, y, z in ball.normals]
        mesh.normals = [tuple(c / math.hypot(*n) for c in n) for n in normals]
        return mesh
    material = scene.add_material("drop", base=(0.9, 0.85, 0.8), rough=0.22)
    drop = scene.add_node("drop", translation=DROP, mesh=scene.add_mesh(
        "drop", scene.primitive(ball, material, targets=(scaled(1.35, 0.6), scaled(0.75, 1.5))),
        weights=[0, 0]))
    weights, places = [], []
    for t in TIMES:
        sway = math.sin(4 * math.pi * t / SECONDS)
        weights += [(max(sway, 0.0),), (max(-sway, 0.0),)]
        places.append((DROP[0] + (0.0, 0.5)[round(t / SECONDS * 4) % 2], DROP[1], DROP[2]))
    return [(drop, "weights", "LINEAR", TIMES, weights),
            (drop, "translation", "STEP", TIMES, places)]


def add_cameras(scene):
    """One that stands and one that drives past. Returns the curves of the second."""
    lens = {"yfov": 0.8, "znear": 0.1, "zfar": 60.0}
    scene.add_node("camera", translation=(0.2, 2.6, 6.4), rotation=shapes.quaternion(-14, 0),
                   camera=scene.append("cameras", {"type": "perspective", "name": "standing",
                                                   "perspective": lens}))
    driving = scene.add_node("dolly", rotation=shapes.quaternion(-14, 0), translation=(-3, 2.6, 6),
                             camera=scene.append("cameras", {"type": "perspective", "name": "driving",
                                                             "perspective": lens}))

    def place(t):
        return (-3.0 * math.cos(2 * math.pi * t / SECONDS), 2.6, 6.0)

    def slope(t):
        return (6.0 * math.pi / SECONDS * math.sin(2 * math.pi * t / SECONDS), 0.0, 0.0)
    return [(driving, "translation", "CUBICSPLINE", TIMES, smooth_keys(place, slope))]


def document():
    scene = Document()
    floor = shapes.rectangle((-8, 0, 8), (16, 0, 0), (0, 0, -16))
    stone = scene.add_material("floor", base=(0.45, 0.45, 0.48), rough=0.5)
    scene.add_node("floor", mesh=scene.add_mesh("floor", scene.primitive(floor, stone)))
    scene.add_node("moon", rotation=shapes.quaternion(-50, 30),
                   light=scene.add_light("moon", "directional", (0.6, 0.7, 1.0), 0.35))
    curves = add_carousel(scene) + add_stalk(scene) + add_drop(scene) + add_cameras(scene)
    scene.add_animation("round", curves)
    return scene


def files():
    return document().binary("fair")
