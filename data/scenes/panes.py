"""Ten panes of coloured glass that overlap and run through each other, before a wall with stripes and around a
post, which do not blend. All of them send out their colour and reflect nothing, so that what is seen can be
computed from the planes that the panes lie in.
"""

from . import shapes
from .document import Document

# Colour (linear), alpha, place, pitch and yaw in degrees, width and height in metres; from left to right.
PANES = (
    ((0.9, 0.1, 0.1), 0.1, (-1.9, 0.5, -4.4), (8, 24), (1.8, 2.2)),
    ((0.95, 0.5, 0.05), 0.189, (-1.3, -0.4, -3.6), (-12, -30), (1.7, 1.6)),
    ((0.9, 0.85, 0.1), 0.278, (-0.8, 0.6, -5.2), (20, 12), (2.2, 1.9)),
    ((0.4, 0.8, 0.15), 0.367, (-0.35, -0.2, -4.1), (-5, 42), (2.0, 2.4)),
    ((0.1, 0.75, 0.35), 0.456, (0.05, 0.35, -4.3), (14, -38), (2.1, 1.7)),
    ((0.05, 0.7, 0.7), 0.544, (0.45, -0.5, -5.0), (-22, 6), (2.4, 1.5)),
    ((0.1, 0.45, 0.9), 0.633, (0.9, 0.25, -3.8), (6, 33), (1.5, 2.0)),
    ((0.3, 0.2, 0.85), 0.722, (1.3, -0.3, -4.6), (-9, -18), (1.9, 2.1)),
    ((0.65, 0.15, 0.75), 0.811, (1.7, 0.45, -4.0), (17, 27), (1.4, 1.8)),
    ((0.9, 0.2, 0.5), 0.9, (2.1, -0.15, -5.4), (-14, -9), (1.8, 2.3)),
)
FILE_ORDER = (6, 1, 8, 3, 0, 9, 4, 7, 2, 5)  # unlike that of depth, of place and of opacity
WALL = ((0.32, 0.3, 0.27), (0.0, -0.2, -8.0), (9.0, 4.4))
STRIPES = tuple(((0.75, 0.72, 0.65), (-3.6 + 1.2 * k, -0.2, -7.9), (0.4, 4.4)) for k in range(7))
POST = ((0.08, 0.08, 0.09), (0.55, 0.0, -4.35), (0.28, 5.0))


def document():
    scene = Document()
    scene.extensions.add("KHR_materials_unlit")
    sheet = scene.primitive(shapes.rectangle((-0.5, -0.5, 0), (1, 0, 0), (0, 1, 0)), None)

    def add(name, color, place, size, turn=(0, 0), alpha=None):
        more = {"alphaMode": "BLEND"} if alpha else {}
        material = scene.add_material(name, base=color, alpha=alpha or 1.0, doubleSided=True,
                                      extensions={"KHR_materials_unlit": {}}, **more)
        scene.add_node(name, mesh=scene.add_mesh(name, {**sheet, "material": material}),
                       translation=place, rotation=shapes.quaternion(*turn), scale=(*size, 1.0))

    add("wall", *WALL)
    for k, stripe in enumerate(STRIPES):
        add("stripe %d" % k, *stripe)
    for k in FILE_ORDER:
        color, alpha, place, turn, size = PANES[k]
        add("pane %d" % k, color, place, size, turn, alpha)
    add("post", *POST)
    scene.add_node("camera", camera=scene.append("cameras", {
        "type": "perspective", "name": "camera",
        "perspective": {"yfov": 0.85, "znear": 0.5, "zfar": 20.0}}))
    return scene


def files():
    return document().embedded("panes")
