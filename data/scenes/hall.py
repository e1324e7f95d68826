"""A columned hall lit by several hundred lanterns, each a point light of limited range.

The nave runs along z from 2 to -42, columns at x = +-NAVE, aisles beyond. Every lantern is one
node with its mesh and its light; meshes and lights are shared.
"""

import math

from . import hall_textures, shapes
from .document import Document

NAVE, AISLE = 4.0, 7.6        # m, from the middle to the columns and to the outer walls
BAY, BAYS, FRONT = 4.0, 11, 2.0
SPRING, CORNICE = 4.4, 7.0    # m, where the arches and where the vault begin
BACK = FRONT - BAY * BAYS
# name: colour, candela, range in m, radius of the globe
LANTERNS = {
    "candle": ((1.0, 0.58, 0.22), 0.9, 3.4, 0.10),
    "amber": ((1.0, 0.40, 0.10), 0.9, 3.4, 0.10),
    "rose": ((1.0, 0.20, 0.28), 0.9, 3.4, 0.10),
    "brazier": ((1.0, 0.46, 0.16), 3.0, 5.0, 0.17),
    "ice": ((0.25, 0.50, 1.0), 0.8, 3.2, 0.06),
    "teal": ((0.10, 0.80, 0.75), 0.8, 3.2, 0.06),
    "cove": ((0.20, 0.30, 1.0), 1.6, 4.6, 0.06),
    "pendant": ((1.0, 0.72, 0.45), 3.2, 6.0, 0.20)}


def materials(scene):
    """By name. Textures come from hall_textures."""
    def textures(name, color=True):
        uri = "hall-%s-%%s.png" % name
        surface = scene.add_texture(uri % "surface")
        found = {"metallicRoughnessTexture": surface, "occlusionTexture": surface,
                 "normalTexture": scene.add_texture(uri % "normal")}
        if color:
            found["baseColorTexture"] = scene.add_texture(uri % "color")
        return found
    made = {
        "floor": scene.add_material("floor", metal=1.0, **textures("floor")),
        "masonry": scene.add_material("masonry", metal=1.0, **textures("stone")),
        "vault": scene.add_material("vault", base=(0.62, 0.60, 0.64), metal=1.0,
                                    **textures("coffer", color=False)),
        "marble": scene.add_material("marble", base=(0.80, 0.77, 0.72), rough=0.38),
        # Half metal: under point lights alone a pure metal is black but for its highlights.
        "brass": scene.add_material("brass", base=(0.91, 0.66, 0.32), metal=0.5, rough=0.42)}
    for name, (color, *_) in LANTERNS.items():
        made[name] = scene.add_material(name, base=(0.1, 0.1, 0.1), rough=0.9, emissive=color,
                                        strength=2.0)
    return made


def column():
    """Fluted shaft between a moulded base and capital: (stone, brass rings)."""
    def round_line(radius, y0, y1, out):
        """A half-round moulding."""
        return [(radius + out * math.sin(math.pi * i / 6),
                 y0 + (y1 - y0) * (1 - math.cos(math.pi * i / 6)) / 2) for i in range(7)]
    def flute(angle):
        return 1.0 - 0.05 * abs(math.sin(angle * 8)) ** 0.8
    # A shaft swells by a little over its lower third and thins towards the top.
    shaft = [(0.42 - 0.05 * t * t + 0.01 * math.sin(math.pi * t), 0.5 + 3.2 * t)
             for t in (i / 6 for i in range(7))]
    stone = shapes.revolved([shaft], 64, flute)
    stone.add(shapes.revolved([round_line(0.50, 0.25, 0.42, 0.07),
                               [(0.46, 0.42), (0.43, 0.50)]], 48))
    bell = [(0.37 + 0.2 * t * t * t, 3.82 + 0.4 * t) for t in (i / 6 for i in range(7))]
    stone.add(shapes.revolved([bell], 48))
    stone.add(shapes.box(1.15, 0.25, 1.15).moved(0, 0.125, 0))
    stone.add(shapes.box(1.2, 0.18, 1.2).moved(0, 4.31, 0))
    brass = shapes.revolved([round_line(0.385, 3.68, 3.82, 0.05)], 48)
    return stone, brass


def add_columns(scene, made):
    stone, brass = column()
    mesh = scene.add_mesh("column", scene.primitive(stone, made["marble"]),
                          scene.primitive(brass, made["brass"]))
    for side in (-1, 1):
        for bay in range(BAYS + 1):
            scene.add_node("column %s %d" % ("left" if side < 0 else "right", bay), mesh=mesh,
                           translation=(side * NAVE, 0, FRONT - BAY * bay))


def add_arcades(scene, made):
    """Walls over the columns: per bay a spandrel and the moulded band of its arch. They go 2 cm
    into the capitals, so that no two surfaces share a plane."""
    wall = shapes.spandrel(BAY / 2, 1.45, CORNICE - SPRING, 0.8, 24)
    wall.uvs = [(u / 2, v / 2) for u, v in wall.uvs]
    band = shapes.arch_band(1.38, 0.22, 0.96, 24)
    cornice = shapes.box(BAY, 0.22, 1.2).moved(0, CORNICE - SPRING - 0.11, 0)
    mesh = scene.add_mesh("arcade", scene.primitive(wall, made["masonry"], uvs=True),
                          scene.primitive(band.add(cornice), made["marble"]))
    quarter = math.sqrt(0.5)
    for side in (-1, 1):
        for bay in range(BAYS):
            scene.add_node("arcade %s %d" % ("left" if side < 0 else "right", bay), mesh=mesh,
                           translation=(side * NAVE, SPRING - 0.02, FRONT - BAY * (bay + 0.5)),
                           rotation=(0, side * -quarter, 0, quarter))


def add_vault(scene, made):
    """A barrel over the nave, a rib over each pair of columns."""
    def barrel(u, v):
        angle = math.pi * u
        return NAVE * math.cos(angle), CORNICE + NAVE * math.sin(angle), FRONT - BAY * v
    bay = shapes.surface(barrel, 40, 1, (9.0, 3.0))
    rib = shapes.arch_band(NAVE - 0.28, 0.3, 0.5, 40)
    bay_mesh = scene.add_mesh("vault", scene.primitive(bay, made["vault"], uvs=True))
    rib_mesh = scene.add_mesh("rib", scene.primitive(rib, made["marble"]))
    for i in range(BAYS + 1):
        scene.add_node("rib %d" % i, mesh=rib_mesh, translation=(0, CORNICE, FRONT - BAY * i))
        if i < BAYS:
            scene.add_node("vault %d" % i, mesh=bay_mesh, translation=(0, 0, -BAY * i))


def add_shell(scene, made):
    """Floor, outer walls, aisle ceilings, end walls."""
    length, width = FRONT - BACK, 2 * AISLE
    floor = shapes.rectangle((-AISLE, 0, FRONT), (width, 0, 0), (0, 0, -length),
                             (width / 2, length / 2))
    walls = shapes.rectangle((-AISLE, 0, FRONT), (0, 0, -length), (0, CORNICE, 0),
                             (length / 2, CORNICE / 2))
    walls.add(shapes.rectangle((AISLE, 0, BACK), (0, 0, length), (0, CORNICE, 0),
                               (length / 2, CORNICE / 2)))
    top = CORNICE + NAVE
    walls.add(shapes.rectangle((-AISLE, 0, BACK), (width, 0, 0), (0, top, 0),
                               (width / 2, top / 2)))
    walls.add(shapes.rectangle((AISLE, 0, FRONT), (-width, 0, 0), (0, top, 0),
                               (width / 2, top / 2)))
    ceiling = shapes.Mesh()
    for x in (-AISLE, NAVE):
        ceiling.add(shapes.rectangle((x, CORNICE, BACK), (AISLE - NAVE, 0, 0), (0, 0, length),
                                     (3, length / 1.2)))
    scene.add_node("shell", mesh=scene.add_mesh(
        "shell",
        scene.primitive(floor, made["floor"], uvs=True, tangents=[(1.0, 0.0, 0.0, 1.0)] * 4),
        scene.primitive(walls, made["masonry"], uvs=True),
        scene.primitive(ceiling, made["vault"], uvs=True)))


def add_rose(scene, made):
    """The round window of the end wall: rings of coloured glass that glow, in a marble frame."""
    center = (0.0, CORNICE + 0.6, BACK + 0.1)
    frame = shapes.torus(2.15, 0.16, 64, 12).mapped(shapes.turn_x(90))
    frame.add(shapes.torus(1.15, 0.09, 48, 8).mapped(shapes.turn_x(90)))
    for spoke in range(12):
        turn = shapes.turn_z(30 * spoke)
        frame.add(shapes.box(0.09, 1.0, 0.12).moved(0, 1.65, 0).mapped(turn))
    primitives = [scene.primitive(frame.moved(*center), made["marble"])]
    panes = (("cove", 0, 0.0, 1.1), ("ice", 0, 1.2, 2.05), ("teal", 1, 1.2, 2.05))
    for name, first, inner, outer in panes:
        glass = shapes.Mesh()
        for pane in range(first, 12, 2 if inner > 0 else 1):
            glass.add(pane_of_glass(inner, outer, math.radians(30 * pane), math.radians(30)))
        primitives.append(scene.primitive(glass.moved(*center), made[name]))
    scene.add_node("rose window", mesh=scene.add_mesh("rose window", *primitives))


def pane_of_glass(inner, outer, start, width, steps=4):
    """A piece of a ring facing +z; from the middle it is a fan."""
    mesh = shapes.Mesh()
    for i in range(steps + 1):
        angle = start + width * i / steps
        for radius in ((inner, outer) if inner > 0 else (outer,)):
            mesh.vertex((radius * math.sin(-angle), radius * math.cos(angle), 0), (0, 0, 1))
    if inner > 0:
        for i in range(0, 2 * steps, 2):
            mesh.quad(i, i + 1, i + 3, i + 2)
    else:
        middle = mesh.vertex((0, 0, 0), (0, 0, 1))
        for i in range(steps):
            mesh.indices += [middle, i, i + 1]
    return mesh


def places():
    """(lantern, place) of every light, in the order of the file."""
    warm = ("candle", "amber", "rose")
    for bay in range(BAYS):
        z = FRONT - BAY * (bay + 0.5)
        for i in range(9):  # a string across the nave from column to column, a chain's curve
            x = (i - 4) / 4 * 3.5
            yield warm[(i + bay) % 3], (x, 5.1 - 1.1 * (1 - (x / 3.5) ** 2), z - 2.0)
        yield "pendant", (0.0, 8.3, z)
        for side in (-1, 1):
            yield "brazier", (side * 2.75, 1.08, z)
            for i in range(4):  # along the aisle's outer wall, under the ceiling and at the floor
                at = z + (i - 1.5) * BAY / 4
                yield ("ice", "teal")[(i + bay) % 2], (side * (AISLE - 0.35), 0.12, at)
                yield "cove", (side * (NAVE - 0.75), CORNICE + 0.1, at)
                if i % 2:
                    yield "cove", (side * 5.8, CORNICE - 0.4, at - 0.5)
            for i in range(3):
                yield warm[(i + bay) % 3], (side * 5.7, 3.0 - 0.35 * (1 - abs(i - 1)),
                                            z + (i - 1) * 1.3)


def lantern(kind, radius):
    """(globe, brass): a globe in two rings; a brazier has a stand, a pendant a chain."""
    globe = shapes.sphere(radius, 16, 10)
    rings = shapes.torus(radius * 0.75, radius * 0.14, 20, 6)
    brass = rings.moved(0, radius * 0.72, 0).add(rings.moved(0, -radius * 0.72, 0))
    if kind == "brazier":
        brass.add(shapes.revolved(
            [[(0.04, -0.9), (0.04, -0.25)], [(0.04, -0.25), (0.16, -0.2), (0.24, -0.1), (0.27, 0.03)],
             [(0.25, 0.03), (0.20, -0.08), (0.02, -0.12)],
             [(0.25, -1.08), (0.22, -1.02), (0.05, -0.98), (0.04, -0.9)]], 24))
    if kind == "pendant":
        brass.add(shapes.revolved([[(0.02, radius), (0.02, CORNICE + NAVE - 8.3)]], 8))
    return globe, brass


def add_lanterns(scene, made):
    meshes, lights = {}, {}
    for kind, (color, candela, light_range, radius) in LANTERNS.items():
        globe, brass = lantern(kind, radius)
        meshes[kind] = scene.add_mesh(kind, scene.primitive(globe, made[kind]),
                                      scene.primitive(brass, made["brass"]))
        lights[kind] = scene.add_light(kind, "point", color, candela, light_range)
    count = 0
    for kind, place in places():
        scene.add_node("%s %d" % (kind, count), light=lights[kind], mesh=meshes[kind],
                       translation=place)
        count += 1


def add_cameras(scene):
    for name, fov, place, turn in (("nave", 60, (1.3, 2.3, 1.0), (4.0, 5.5)),
                                   ("aisle", 65, (5.9, 1.7, 1.0), (2.0, 8.0)),
                                   ("gallery", 58, (-2.6, 6.4, -1.0), (-12.0, -8.0))):
        eye = scene.append("cameras", {"type": "perspective", "name": name, "perspective":
                                       {"yfov": round(math.radians(fov), 6), "znear": 0.1,
                                        "zfar": 80.0}})
        scene.add_node(name, camera=eye, translation=place, rotation=shapes.quaternion(*turn))


def files():
    scene = Document()
    made = materials(scene)
    add_shell(scene, made)
    add_columns(scene, made)
    add_arcades(scene, made)
    add_vault(scene, made)
    add_rose(scene, made)
    add_lanterns(scene, made)
    add_cameras(scene)
    return {**scene.separate("hall"), **hall_textures.files()}
