"""glTF 2.0 documents, in the three containers that the format has."""

import base64
import json
import struct

FLOAT, UINT16, UINT32, UINT8 = 5126, 5123, 5125, 5121
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN = 4, 5, 6
CODES = {FLOAT: "f", UINT16: "H", UINT32: "I", UINT8: "B"}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Document:
    """Collects objects; each `add_...` returns the index of what it added."""

    def __init__(self):
        self.buffer = bytearray()
        self.extensions = set()
        self.lists = {}
        self.lights = []
        self.roots = []

    def append(self, kind, item):
        self.lists.setdefault(kind, []).append(item)
        return len(self.lists[kind]) - 1

    def add_accessor(self, rows, component, target=None, normalized=False, bounds=False):
        """rows: [count][1 to 4, or 16]. Each accessor has a view of its own, aligned to 4 bytes."""
        code = CODES[component]
        packed = [struct.pack("<%d%s" % (len(row), code), *row) for row in rows]
        stride = len(packed[0])
        if target == ARRAY_BUFFER and stride % 4:  # vertex attributes start at multiples of 4
            packed = [row + bytes(-stride % 4) for row in packed]
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": sum(map(len, packed))}
        if target:
            view["target"] = target
        if target == ARRAY_BUFFER and stride % 4:
            view["byteStride"] = len(packed[0])
        self.buffer += b"".join(packed)
        self.buffer += bytes(-len(self.buffer) % 4)
        accessor = {"bufferView": self.append("bufferViews", view), "componentType": component,
                    "count": len(rows), "type": KINDS[len(rows[0])]}
        if normalized:
            accessor["normalized"] = True
        if bounds:  # of the values as stored: a bound that is off by a rounding is invalid
            stored = [struct.unpack("<%d%s" % (len(row), code), data[:stride])
                      for row, data in zip(rows, packed)]
            accessor["min"] = [min(column) for column in zip(*stored)]
            accessor["max"] = [max(column) for column in zip(*stored)]
        return self.append("accessors", accessor)

    def primitive(self, mesh, material, uvs=False, colors=None, tangents=None, mode=TRIANGLES,
                  indexed=True, joints=None, weights=None, targets=()):
        """joints, weights: [vertices][4], of a skin. targets: meshes of the same shape, whose positions and
        normals take the place of the mesh's as their weights grow."""
        if mode == TRIANGLES:
            mesh.check()
        attributes = {
            "POSITION": self.add_accessor(mesh.positions, FLOAT, ARRAY_BUFFER, bounds=True),
            "NORMAL": self.add_accessor(mesh.normals, FLOAT, ARRAY_BUFFER)}
        if uvs:
            attributes["TEXCOORD_0"] = self.add_accessor(mesh.uvs, FLOAT, ARRAY_BUFFER)
        if tangents:
            attributes["TANGENT"] = self.add_accessor(tangents, FLOAT, ARRAY_BUFFER)
        if colors:
            attributes["COLOR_0"] = self.add_accessor(colors, UINT8, ARRAY_BUFFER, normalized=True)
        if joints:
            attributes["JOINTS_0"] = self.add_accessor(joints, UINT8, ARRAY_BUFFER)
            attributes["WEIGHTS_0"] = self.add_accessor(weights, FLOAT, ARRAY_BUFFER)
        primitive = {"attributes": attributes, "material": material}
        if targets:
            primitive["targets"] = [
                {"POSITION": self.add_accessor(differences(to.positions, mesh.positions), FLOAT,
                                               ARRAY_BUFFER, bounds=True),
                 "NORMAL": self.add_accessor(differences(to.normals, mesh.normals), FLOAT,
                                             ARRAY_BUFFER)} for to in targets]
        if indexed:
            component = UINT16 if len(mesh.positions) < 65536 else UINT32
            primitive["indices"] = self.add_accessor([(i,) for i in mesh.indices], component,
                                                     ELEMENT_ARRAY_BUFFER)
        if mode != TRIANGLES:
            primitive["mode"] = mode
        return primitive

    def add_mesh(self, name, *primitives, **more):
        return self.append("meshes", {"name": name, "primitives": list(primitives), **more})

    def add_skin(self, name, joints, places):
        """joints: nodes; places: where each stands, unturned, in the mesh's own space."""
        matrices = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1) for x, y, z in places]
        return self.append("skins", {"name": name, "joints": joints,
                                     "inverseBindMatrices": self.add_accessor(matrices, FLOAT)})

    def add_animation(self, name, curves):
        """curves: (node, path, interpolation, times, values); values as the interpolation wants them."""
        samplers, channels = [], []
        for node, path, interpolation, times, values in curves:
            samplers.append({"input": self.add_accessor([(t,) for t in times], FLOAT, bounds=True),
                             "output": self.add_accessor(values, FLOAT),
                             "interpolation": interpolation})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})
        return self.append("animations", {"name": name, "samplers": samplers, "channels": channels})

    def add_material(self, name, base=(1, 1, 1), metal=0.0, rough=1.0, alpha=1.0, emissive=None,
                     strength=None, **more):
        surface = {"baseColorFactor": [*base, alpha], "metallicFactor": metal,
                   "roughnessFactor": rough}
        for texture in ("baseColorTexture", "metallicRoughnessTexture"):
            if texture in more:
                surface[texture] = {"index": more.pop(texture)}
        material = {"name": name, "pbrMetallicRoughness": surface}
        for texture in ("normalTexture", "occlusionTexture", "emissiveTexture"):
            if texture in more:
                material[texture] = {"index": more.pop(texture)}
        if emissive:
            material["emissiveFactor"] = list(emissive)
        if strength:
            material["extensions"] = {"KHR_materials_emissive_strength":
                                      {"emissiveStrength": strength}}
            self.extensions.add("KHR_materials_emissive_strength")
        material.update(more)
        return self.append("materials", material)

    def add_texture(self, uri=None, picture=None):
        """A PNG by its file name, or by its bytes, which go into the buffer. One sampler for all:
        repeated, mipmapped."""
        if "samplers" not in self.lists:
            self.append("samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497,
                                     "wrapT": 10497})
        if uri:
            image = self.append("images", {"uri": uri})
        else:
            view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(picture)}
            self.buffer += picture + bytes(-len(picture) % 4)
            image = self.append("images", {"bufferView": self.append("bufferViews", view),
                                           "mimeType": "image/png"})
        return self.append("textures", {"sampler": 0, "source": image})

    def add_light(self, name, kind, color, intensity, light_range=None, cone=None):
        light = {"name": name, "type": kind, "color": list(color), "intensity": intensity}
        if light_range is not None:
            light["range"] = light_range
        if cone:
            light["spot"] = {"innerConeAngle": cone[0], "outerConeAngle": cone[1]}
        self.lights.append(light)
        self.extensions.add("KHR_lights_punctual")
        return len(self.lights) - 1

    def add_node(self, name, light=None, root=True, **fields):
        node = {"name": name, **fields}
        for key in ("translation", "rotation", "scale"):
            if key in node:
                node[key] = [round(value, 6) for value in node[key]]
        if light is not None:
            node["extensions"] = {"KHR_lights_punctual": {"light": light}}
        index = self.append("nodes", node)
        if root:
            self.roots.append(index)
        return index

    def json(self, uri):
        """uri: where the buffer is, or None in a .glb."""
        buffer = {"byteLength": len(self.buffer)}
        if uri:
            buffer["uri"] = uri
        document = {"asset": {"version": "2.0", "generator": "data/make_scenes.py"}}
        if self.extensions:
            document["extensionsUsed"] = sorted(self.extensions)
        if self.lights:
            document["extensions"] = {"KHR_lights_punctual": {"lights": self.lights}}
        document.update({"scene": 0, "scenes": [{"nodes": self.roots}], "buffers": [buffer]})
        for kind in sorted(self.lists):
            document[kind] = self.lists[kind]
        return document

    def separate(self, name):
        """name.gltf and name.bin."""
        return {name + ".gltf": text(self.json(name + ".bin")), name + ".bin": bytes(self.buffer)}

    def embedded(self, name):
        """name.gltf with its buffer inside."""
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.buffer).decode()
        return {name + ".gltf": text(self.json(uri))}

    def binary(self, name):
        """name.glb."""
        document = json.dumps(self.json(None), separators=(",", ":")).encode()
        document += b" " * (-len(document) % 4)
        length = 12 + 8 + len(document) + 8 + len(self.buffer)
        return {name + ".glb": struct.pack("<4sII", b"glTF", 2, length)
                + struct.pack("<I4s", len(document), b"JSON") + document
                + struct.pack("<I4s", len(self.buffer), b"BIN\0") + bytes(self.buffer)}


def differences(rows, others):
    return [tuple(a - b for a, b in zip(row, other)) for row, other in zip(rows, others)]


def text(document):
    """One line per object of the outer lists: readable, and small differences show as such."""
    lines = []
    for key, value in document.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            rows = ",\n    ".join(json.dumps(row) for row in value)
            lines.append("  %s: [\n    %s\n  ]" % (json.dumps(key), rows))
        else:
            lines.append("  %s: %s" % (json.dumps(key), json.dumps(value)))
    return ("{\n" + ",\n".join(lines) + "\n}\n").encode()
