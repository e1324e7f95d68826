"""One scene of what goes wrong: lights and surfaces at the edges of what formulas allow.

The first camera stands at EYE and looks along -z without a turn, so that what is said of a light's
place in view space holds to the bit.
"""

import math

from . import png, shapes
from .document import TRIANGLE_FAN, TRIANGLE_STRIP, Document

EYE = (0.0, 1.5, 0.0)
NEAR, FAR = 0.5, 40.0

# name, place, colour, candela, range in m (None: reaches everything)
POINTS = (
    ("camera inside", (0.25, 1.75, -0.5), (1.0, 0.9, 0.8), 0.6, 3.0),
    ("camera on the skin", (0.0, 1.5, -4.0), (0.9, 1.0, 0.9), 1.5, 4.0),
    ("behind the camera", (0.5, 2.0, 2.0), (0.7, 0.8, 1.0), 8.0, 6.0),
    ("beside the camera", (3.0, 1.5, 0.0), (1.0, 0.6, 0.4), 6.0, 5.0),
    ("on the floor", (-1.0, 0.0, -3.0), (1.0, 0.3, 0.2), 0.5, 1.5),
    ("on a corner", (1.25, 0.5, -3.75), (0.3, 0.6, 1.0), 0.2, 1.0),
    ("tiny range", (0.0, 0.004, -2.0), (0.2, 1.0, 0.2), 0.001, 0.01),
    ("huge range", (-30.0, 60.0, -30.0), (0.8, 0.9, 1.0), 1500.0, 1.0e6),
    ("no range", (20.0, 30.0, 10.0), (1.0, 0.95, 0.9), 400.0, None),
    ("across the far plane", (4.0, 3.0, -41.0), (1.0, 0.5, 0.1), 60.0, 12.0),
    ("before the near plane", (0.0, 1.5, -0.2), (1.0, 0.0, 1.0), 1.0, 0.25),
    ("pokes through the near plane", (0.1, 1.4, -0.3), (1.0, 0.0, 1.0), 0.2, 0.25),
    ("out of view", (-60.0, 1.0, -5.0), (1.0, 0.0, 1.0), 5.0, 8.0),
    ("no intensity", (0.0, 1.0, -3.0), (1.0, 1.0, 1.0), 0.0, 5.0),
    ("first of two in one place", (-3.0, 1.0, -5.0), (1.0, 0.8, 0.2), 1.0, 2.5),
    ("second of two in one place", (-3.0, 1.0, -5.0), (0.2, 0.4, 1.0), 1.0, 2.5))


def letter_f():
    """A body without mirror symmetry."""
    parts = (((0.15, 0.8, 0.15), (0, 0.4, 0)), ((0.35, 0.14, 0.15), (0.25, 0.73, 0)),
             ((0.25, 0.14, 0.15), (0.2, 0.42, 0)))
    mesh = shapes.Mesh()
    for size, place in parts:
        mesh.add(shapes.box(*size).moved(*place))
    return mesh


def with_zero_areas():
    """A square, and triangles of no area: a point three times, a vertex twice, three in line."""
    mesh = shapes.rectangle((-0.3, 0, 0), (0.6, 0, 0), (0, 0.6, 0))
    a = mesh.vertex((0.5, 0.0, 0.0), (0, 0, 1))
    b = mesh.vertex((0.5, 0.3, 0.0), (0, 0, 1))
    c = mesh.vertex((0.5, 0.6, 0.0), (0, 0, 1))
    mesh.indices += [a, a, a, a, b, b, a, b, c]
    return mesh


def strip():
    """A wave, as a triangle strip."""
    mesh = shapes.Mesh()
    for i in range(17):
        x, lift = i / 16, 0.08 * math.sin(i * math.pi / 4)
        for y in (0.5, 0.0):
            mesh.vertex((x, y, lift), (-0.5 * math.cos(i * math.pi / 4), 0, 1))
    mesh.indices = list(range(34))
    return mesh


def fan():
    """A disc, as a triangle fan."""
    mesh = shapes.Mesh()
    mesh.vertex((0, 0.3, 0), (0, 0, 1))
    for i in range(13):
        angle = 2 * math.pi * i / 12
        mesh.vertex((0.3 * math.cos(angle), 0.3 + 0.3 * math.sin(angle), 0), (0, 0, 1))
    mesh.indices = list(range(14))
    return mesh


def leaf_picture():
    """32 x 32, round holes: alpha goes from 0 to 1 across the cutoff."""
    def pixel(x, y):
        distance = math.hypot(x % 16 - 7.5, y % 16 - 7.5)
        return 0.25, 0.6, 0.2, min(1.0, max(0.0, (distance - 3.0) / 4.0))
    rows = [bytes(png.byte(c) for x in range(32) for c in pixel(x, y)) for y in range(32)]
    return png.encode(rows, 32, 32, 6, level=0)


def bump_picture():
    """16 x 16: one round bump, as a normal map."""
    def height(x, y):
        return max(0.0, 1 - math.hypot(x - 7.5, y - 7.5) / 7)
    return png.normal_map(16, height, 4.0, level=0)


def add_ground(scene):
    """Floor from behind the camera to beyond the far plane, a wall seen edge-on, a tower that the
    far plane cuts, and things before and across the near plane."""
    stone = scene.add_material("stone", base=(0.5, 0.5, 0.48), rough=0.7)
    def body(name, mesh, *place):
        scene.add_node(name, translation=place,
                       mesh=scene.add_mesh(name, scene.primitive(mesh, stone)))
    body("floor", shapes.rectangle((-12, 0, 6), (24, 0, 0), (0, 0, -66)), 0, 0, 0)
    body("grazing wall", shapes.box(0.4, 1.4, 12.0), 2.4, 0.7, -12)
    # One part in ten thousand off the line of sight.
    body("edge-on", shapes.rectangle((0, 0, 0), (0.0008, 0, -8), (0, 0.4, 0)), -0.0002, 1.3, -8)
    body("across the far plane", shapes.box(3.0, 5.0, 8.0), 6, 2.5, -40)
    body("beyond the far plane", shapes.box(4.0, 9.0, 2.0), -6, 4.5, -48)
    body("before the near plane", shapes.box(0.05, 0.05, 0.05), 0.03, 1.52, -0.3)
    body("across the near plane", shapes.box(0.03, 0.03, 0.6), -0.38, 1.3, -0.5)
    body("thinner than a pixel", shapes.box(0.002, 2.0, 0.002), -1.6, 1.0, -6)


def add_materials_row(scene):
    """Spheres of every end of roughness and metal."""
    ball = shapes.sphere(0.28, 40, 20)
    for i, (metal, rough) in enumerate(((0, 0), (0, 1), (0.5, 0.5), (1, 0), (1, 1))):
        name = "metal %g rough %g" % (metal, rough)
        material = scene.add_material(name, base=(0.9, 0.6, 0.3), metal=metal, rough=rough)
        scene.add_node(name, translation=((i - 2) * 0.75, 0.28, -4.6),
                       mesh=scene.add_mesh(name, scene.primitive(ball, material)))


def add_primitives_row(scene):
    """Every way to say triangles, and vertex colours."""
    paint = scene.add_material("paint", base=(0.8, 0.8, 0.85), rough=0.5)
    both = scene.add_material("both sides", base=(0.8, 0.5, 0.5), rough=0.5, doubleSided=True)
    loose = shapes.sphere(0.25, 12, 8).unindexed()
    cube = shapes.box(0.5, 0.5, 0.5)
    colors = [tuple(255 if p > 0 else 30 for p in place) for place in cube.positions]
    rows = (
        ("no indices", scene.primitive(loose, paint, indexed=False), (-1.9, 0.25, -3.6)),
        ("strip", scene.primitive(strip(), both, mode=TRIANGLE_STRIP), (-1.5, 0.0, -3.9)),
        ("fan", scene.primitive(fan(), paint, mode=TRIANGLE_FAN, indexed=False), (0.1, 0.0, -3.6)),
        ("vertex colours", scene.primitive(cube, paint, colors=colors), (1.0, 0.25, -4.0)),
        ("zero areas", scene.primitive(with_zero_areas(), paint), (1.7, 0.0, -3.6)))
    for name, primitive, place in rows:
        scene.add_node(name, translation=place, mesh=scene.add_mesh(name, primitive))


def add_sheets(scene):
    """Seen from behind: double-sided and single-sided (which is not there); with holes; and a
    normal map where texture coordinates have no direction."""
    leaf = scene.add_texture(picture=leaf_picture())
    bump = scene.add_texture(picture=bump_picture())
    behind = shapes.rectangle((0.35, 0, 0), (-0.7, 0, 0), (0, 0.9, 0))
    front = shapes.rectangle((-0.4, 0, 0), (0.8, 0, 0), (0, 0.9, 0), (2, 2))
    no_uv = front.copy()
    no_uv.uvs = [(0.5, 0.25)] * len(no_uv.uvs)
    red, plain = (0.8, 0.3, 0.2), (0.7, 0.7, 0.7)
    rows = (
        ("double-sided from behind", behind, -2.6, dict(base=red, rough=0.6, doubleSided=True)),
        ("single-sided from behind", behind, -1.7, dict(base=(1, 0, 1), rough=0.6)),
        ("mask", front, -0.7, dict(baseColorTexture=leaf, rough=0.6, alphaMode="MASK",
                                   alphaCutoff=0.5, doubleSided=True)),
        ("bump", front, 0.4, dict(base=plain, rough=0.4, normalTexture=bump)),
        ("bump without direction", no_uv, 1.5, dict(base=plain, rough=0.4, normalTexture=bump)),
        ("glows", front, 2.6, dict(base=(0, 0, 0), emissive=(1.0, 0.5, 0.1), strength=4.0)))
    for name, mesh, x, material in rows:
        primitive = scene.primitive(mesh, scene.add_material(name, **material), uvs=True)
        scene.add_node(name, translation=(x, 0.0, -6.0), mesh=scene.add_mesh(name, primitive))


def add_scaled(scene):
    """One mesh under nodes that mirror, stretch and shrink it."""
    blue = scene.add_material("letters", base=(0.35, 0.5, 0.85), rough=0.4)
    mesh = scene.add_mesh("letter", scene.primitive(letter_f(), blue))
    rows = (("as it is", -3.6, (1, 1, 1)), ("mirrored", -3.9, (-1, 1, 1)),
            ("mirrored in all", -4.9, (-1, -1, -1)), ("stretched", 3.4, (0.5, 2.0, 3.0)),
            ("shrunk", 3.1, (1e-3, 1e-3, 1e-3)))
    for name, x, scale in rows:
        y = 0.8 if scale[1] < 0 else 0.0
        scene.add_node(name, mesh=mesh, translation=(x, y, -7.0), scale=scale)
    # A mirror below a mirror: the two undo each other.
    child = scene.add_node("mirrored twice", root=False, mesh=mesh, scale=(-1, 1, 1))
    scene.add_node("mirror", children=[child], translation=(4.4, 0.0, -7.0), scale=(-1, 1, 1))


def add_lights(scene):
    for name, place, color, intensity, light_range in POINTS:
        light = scene.add_light(name, "point", color, intensity, light_range)
        scene.add_node(name, translation=place, light=light)
    moon = scene.add_light("moon", "directional", (0.6, 0.7, 1.0), 0.15)
    scene.add_node("moon", rotation=shapes.quaternion(-50, 30), light=moon)
    # Along the floor: no surface faces it.
    level = scene.add_light("level with the floor", "directional", (1.0, 0.0, 0.0), 0.2)
    scene.add_node("level with the floor", rotation=shapes.quaternion(0, 90), light=level)
    cone = scene.add_light("spot of half a turn", "spot", (1.0, 1.0, 0.6), 5.0, 4.0,
                           (0.0, round(math.pi / 2, 6)))
    scene.add_node("spot of half a turn", translation=(3.0, 2.5, -5.0),
                   rotation=shapes.quaternion(-90, 0), light=cone)


def add_cameras(scene):
    front = scene.append("cameras", {"type": "perspective", "name": "front", "perspective":
                                     {"yfov": 1.0, "znear": NEAR, "zfar": FAR}})
    endless = scene.append("cameras", {"type": "perspective", "name": "endless", "perspective":
                                       {"yfov": 0.6, "znear": 0.01}})
    above = scene.append("cameras", {"type": "orthographic", "name": "above", "orthographic":
                                     {"xmag": 6.0, "ymag": 3.375, "znear": 0.5, "zfar": 9.0}})
    scene.add_node("front", camera=front, translation=EYE)
    scene.add_node("endless", camera=endless, translation=(0, 3.0, 5.0),
                   rotation=shapes.quaternion(-10, 0))
    scene.add_node("above", camera=above, translation=(0, 6.0, -4.5),
                   rotation=shapes.quaternion(-90, 0))


def files():
    scene = Document()
    for add in (add_ground, add_materials_row, add_primitives_row, add_sheets, add_scaled,
                add_lights, add_cameras):
        add(scene)
    return scene.binary("hard-cases")
