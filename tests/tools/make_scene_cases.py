#!/usr/bin/env python3
"""Writes tests/scene_cases.h: what the scenes of data/ hold, read with nothing but Python's own json and struct.

Usage: tests/tools/make_scene_cases.py data/*.gltf data/*.glb >tests/scene_cases.h"""
import base64
import json
import os
import struct
import sys

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
UNIT = [[float(i == j) for j in range(4)] for i in range(4)]


class Scene:
    def __init__(self, path):
        self.folder = os.path.dirname(path)
        data, self.chunk = open(path, "rb").read(), b""
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            self.chunk, data = data[28 + length:], data[20:20 + length]
        self.json = json.loads(data)
        self.nodes = self.json["nodes"]
        self.buffers = [self.file(b["uri"]) if "uri" in b else self.chunk for b in self.json["buffers"]]

    def file(self, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri[uri.index(",") + 1:])
        return open(os.path.join(self.folder, uri), "rb").read()

    def list(self, kind):
        return self.json.get(kind, [])

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.buffers[view["buffer"]][start:start + view["byteLength"]], view.get("byteStride")

    def read(self, index):
        """The elements of an accessor, as tuples; no scene here has sparse or normalized ones."""
        a = self.json["accessors"][index]
        assert "sparse" not in a and not a.get("normalized")
        data, stride = self.view(a["bufferView"])
        form = "<%d%s" % (WIDTHS[a["type"]], CODES[a["componentType"]])
        stride = stride or struct.calcsize(form)
        return [struct.unpack_from(form, data, a.get("byteOffset", 0) + i * stride) for i in range(a["count"])]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def of_columns(c):
    return [[c[4 * j + i] for j in range(4)] for i in range(4)]


def local(node):
    if "matrix" in node:
        return of_columns(node["matrix"])
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    s, t = node.get("scale", (1, 1, 1)), node.get("translation", (0, 0, 0))
    n = (x * x + y * y + z * z + w * w) ** 0.5
    x, y, z, w = x / n, y / n, z / n, w / n
    r = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return [[r[i][j] * s[j] for j in range(3)] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]


def place_all(scene):
    """World transforms of the nodes of the default scene, by index."""
    found = {}

    def visit(index, parent):
        found[index] = product(parent, local(scene.nodes[index]))
        for child in scene.nodes[index].get("children", []):
            visit(child, found[index])
    for root in scene.json["scenes"][scene.json.get("scene", 0)]["nodes"]:
        visit(root, UNIT)
    return found


def moved(m, p):
    return tuple(sum(m[i][k] * p[k] for k in range(3)) + m[i][3] for i in range(3))


def rest_positions(scene, node, primitive):
    mesh = scene.list("meshes")[node["mesh"]]
    points = scene.read(primitive["attributes"]["POSITION"])
    for weight, target in zip(node.get("weights", mesh.get("weights", [])), primitive.get("targets", [])):
        if "POSITION" in target:
            points = [tuple(p[i] + weight * d[i] for i in range(3))
                      for p, d in zip(points, scene.read(target["POSITION"]))]
    return points


def skinned(scene, node, primitive, points, worlds):
    skin = scene.list("skins")[node["skin"]]
    binds = [of_columns(m) for m in scene.read(skin["inverseBindMatrices"])]
    joints = [product(worlds[j], bind) for j, bind in zip(skin["joints"], binds)]
    attributes = primitive["attributes"]
    out = []
    for p, js, ws in zip(points, scene.read(attributes["JOINTS_0"]), scene.read(attributes["WEIGHTS_0"])):
        each = [moved(joints[j], p) for j in js]
        out.append(tuple(sum(w * e[i] for w, e in zip(ws, each)) / sum(ws) for i in range(3)))
    return out


def indices(scene, primitive):
    if "indices" in primitive:
        return [i for i, in scene.read(primitive["indices"])]
    return list(range(scene.json["accessors"][primitive["attributes"]["POSITION"]]["count"]))


def triangle_count(scene, primitive):
    """Of a list, a strip or a fan (glTF 2.0, section 3.7.2.1); nothing else is shown."""
    length = len(indices(scene, primitive))
    return {4: length // 3, 5: length - 2, 6: length - 2}[primitive.get("mode", 4)]


def shown_primitives(scene, mesh):
    return [p for p in scene.list("meshes")[mesh]["primitives"] if p.get("mode", 4) >= 4]


def geometry(scene):
    worlds = place_all(scene)
    drawn, low, high = 0, [1e300] * 3, [-1e300] * 3
    shown = {n: scene.nodes[n] for n in worlds if "mesh" in scene.nodes[n]}
    for index, node in shown.items():
        for primitive in shown_primitives(scene, node["mesh"]):
            points = rest_positions(scene, node, primitive)
            points = skinned(scene, node, primitive, points, worlds) if "skin" in node else \
                [moved(worlds[index], p) for p in points]
            drawn += triangle_count(scene, primitive)
            for i in set(indices(scene, primitive)):
                low, high = [min(*x) for x in zip(low, points[i])], [max(*x) for x in zip(high, points[i])]
    meshes = sorted({n["mesh"] for n in shown.values()})
    primitives = [p for m in meshes for p in shown_primitives(scene, m)]
    positions = {p["attributes"]["POSITION"] for p in primitives}
    skins = {n["skin"] for n in shown.values() if "skin" in n}
    targets = [len(shown_primitives(scene, m)[0].get("targets", [])) for m in meshes]
    counts = [len(scene.list("meshes")), len(meshes), len(primitives),
              sum(triangle_count(scene, p) for p in primitives),
              sum(scene.json["accessors"][a]["count"] for a in positions), len(shown), drawn,
              0, 0, sum(t > 0 for t in targets), sum(targets),
              len(skins), sum(len(scene.list("skins")[s]["joints"]) for s in skins)]
    return counts, low, high, {p["material"] for p in primitives if "material" in p}


def materials(scene, used):
    traits = [0] * 6
    for m in (scene.list("materials")[i] for i in used):
        emits = any(f > 0 for f in m.get("emissiveFactor", [0]))
        for i, has in enumerate(["KHR_materials_unlit" in m.get("extensions", {}), m.get("alphaMode") == "MASK",
                                 m.get("alphaMode") == "BLEND", m.get("doubleSided", False), emits,
                                 "normalTexture" in m]):
            traits[i] += has
    return [len(scene.list("materials")), len(used)], traits


def textures_of(material):
    rough = material.get("pbrMetallicRoughness", {})
    uses = [rough.get("baseColorTexture"), rough.get("metallicRoughnessTexture")]
    uses += [material.get(k) for k in ("normalTexture", "occlusionTexture", "emissiveTexture")]
    return [u["index"] for u in uses if u]


def images(scene, used):
    seen = {scene.list("textures")[t]["source"] for i in used for t in textures_of(scene.list("materials")[i])}
    sizes = []
    for image in (scene.list("images")[i] for i in sorted(seen)):
        data = scene.view(image["bufferView"])[0] if "bufferView" in image else \
            scene.file(image["uri"])
        sizes.append(struct.unpack(">II", data[16:24]))  # of IHDR, which is first in every PNG
    largest = max(sizes, key=lambda s: s[0] * s[1], default=(0, 0))
    return [len(scene.list("images")), len(seen), *largest, sum(w * h for w, h in sizes)]


def animations(scene):
    ends = [max(scene.read(s["input"])[-1][0] for s in a["samplers"]) for a in scene.list("animations")]
    return len(ends), sum(len(a["channels"]) for a in scene.list("animations")), max(ends, default=0.0)


def braces(values):
    return "{%s}" % ", ".join(str(v) if isinstance(v, int) else repr(float(v)) for v in values)


def row(path):
    scene = Scene(path)
    counts, low, high, used = geometry(scene)
    shown, traits = materials(scene, used)
    worlds = place_all(scene)
    nodes = [scene.nodes[n] for n in worlds]
    cameras = sum("camera" in n for n in nodes)
    lights = sum("KHR_lights_punctual" in n.get("extensions", {}) for n in nodes)
    return ("    {\"%s\",\n     %s,\n     {%d, %d, false, %s},\n     %s,\n     %s,\n     %s,\n     %d, %d, %d, %d, %d, %r},"
            % (os.path.basename(path), braces(counts), *shown, braces(traits), braces(images(scene, used)),
               braces(low), braces(high), cameras, len(scene.list("cameras")), lights,
               *animations(scene)))


def main():
    print("/* Made by tests/tools/make_scene_cases.py of the scenes in data/. */\n#ifndef TL_SCENE_CASES_H\n"
          "#define TL_SCENE_CASES_H\n\n#include \"tilelight/scene_info.h\"\n\nstatic const struct {\n"
          "    const char *file;\n    tl_scene_meshes meshes;\n    tl_scene_materials materials;\n"
          "    tl_scene_images images;\n    double low[3], high[3];\n"
          "    size_t camera_count, file_camera_count, light_count, animation_count, curve_count;\n"
          "    double longest; /* s, of its animations */\n} scene_cases[] = {")
    for path in sys.argv[1:]:
        print(row(path))
    print("};\n\n#endif")


main()
