"""Parts of a scene and the .glb file that holds them."""
import array
import json
import struct
import sys

COMPONENT_TYPES = {"f": 5126, "H": 5123, "I": 5125}


class Part:
    """A named object: vertices in the world frame (z up, metres) and triangles by material."""

    def __init__(self, name, material):
        self.name = name
        self.material = material
        self.vertices = array.array("f")  # x, y, z as glTF has them: y up
        self.indices = {}                 # material -> array of vertex numbers

    def add(self, points, faces, material_of=None):
        """Adds points (x, y, z), rounded to 0.1 mm so that the last bit of a sine never shows, and triangles or quads of
        their numbers, which count from 0. `material_of` chooses the material of a face."""
        first = len(self.vertices) // 3
        for x, y, z in points:
            self.vertices.extend((round(x, 4) + 0.0, round(z, 4) + 0.0, 0.0 - round(y, 4)))
        for face in faces:
            numbers = self.indices.setdefault(material_of(face) if material_of else self.material, array.array("I"))
            for b, c in zip(face[1:], face[2:]):
                numbers.extend((first + face[0], first + b, first + c))

    def triangles(self):
        return sum(len(numbers) for numbers in self.indices.values()) // 3


def write_glb(path, parts):
    """One node and one mesh per part, one primitive per material of it."""
    names = sorted({material for part in parts for material in part.indices})
    binary, views, accessors, meshes = bytearray(), [], [], []

    def accessor(values, kind, count, **more):
        """Adds an array to the BIN chunk. Returns the number of its accessor."""
        if sys.byteorder == "big":
            values = values[:]
            values.byteswap()
        data = values.tobytes()
        data += b"\0" * (-len(data) % 4)
        accessors.append({"bufferView": len(views), "componentType": COMPONENT_TYPES[values.typecode],
                          "count": count, "type": kind, **more})
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary.extend(data)
        return len(accessors) - 1

    for part in parts:
        axes = [part.vertices[k::3] for k in range(3)]
        count = len(axes[0])
        positions = accessor(part.vertices, "VEC3", count, min=[*map(min, axes)], max=[*map(max, axes)])
        code = "H" if count < 65536 else "I"
        meshes.append({"name": part.name, "primitives": [{"attributes": {"POSITION": positions},
             "indices": accessor(array.array(code, numbers), "SCALAR", len(numbers)),
             "material": names.index(material)} for material, numbers in part.indices.items()]})
    document = {
        "asset": {"version": "2.0", "generator": "sonarsim make_scenes.py"},
        "scene": 0, "scenes": [{"nodes": list(range(len(parts)))}],
        "nodes": [{"name": part.name, "mesh": i} for i, part in enumerate(parts)], "meshes": meshes,
        "materials": [{"name": name, "doubleSided": True} for name in names],
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(binary), len(text), b"JSON")
    path.write_bytes(head + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
