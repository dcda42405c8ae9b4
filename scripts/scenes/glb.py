"""Parts of a scene and the .glb file that holds them."""
import array
import json
import struct
import sys


class Part:
    """A named object: vertices in the world frame (z up, metres) and triangles by material."""

    def __init__(self, name, material):
        self.name = name
        self.material = material
        self.vertices = array.array("f")  # x, y, z as glTF has them: y up
        self.indices = {}                 # material -> array of vertex numbers

    def add_vertex(self, x, y, z):
        """Adds a vertex, rounded to 0.1 mm so that the last bit of a sine never shows. Returns its number."""
        self.vertices.extend((round(x, 4) + 0.0, round(z, 4) + 0.0, 0.0 - round(y, 4)))
        return len(self.vertices) // 3 - 1

    def add_triangle(self, a, b, c, material=None):
        material = material or self.material
        if material not in self.indices:
            self.indices[material] = array.array("I")
        self.indices[material].extend((a, b, c))

    def add_quad(self, a, b, c, d, material=None):
        self.add_triangle(a, b, c, material)
        self.add_triangle(a, c, d, material)

    def triangles(self):
        return sum(len(numbers) for numbers in self.indices.values()) // 3


def little_endian(values):
    if sys.byteorder == "big":
        values = values[:]
        values.byteswap()
    return values.tobytes()


class Buffer:
    """The BIN chunk, with the views and accessors into it."""

    def __init__(self):
        self.chunks = []
        self.size = 0
        self.views = []
        self.accessors = []

    def add(self, data, component_type, count, kind, **more):
        data += b"\0" * (-len(data) % 4)
        self.views.append({"buffer": 0, "byteOffset": self.size, "byteLength": len(data)})
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component_type,
                               "count": count, "type": kind, **more})
        self.chunks.append(data)
        self.size += len(data)
        return len(self.accessors) - 1

    def add_positions(self, vertices):
        axes = [vertices[k::3] for k in range(3)]
        return self.add(little_endian(vertices), 5126, len(vertices) // 3, "VEC3",
                        min=[min(axis) for axis in axes], max=[max(axis) for axis in axes])

    def add_indices(self, numbers, vertex_count):
        if vertex_count < 65536:
            return self.add(little_endian(array.array("H", numbers)), 5123, len(numbers), "SCALAR")
        return self.add(little_endian(numbers), 5125, len(numbers), "SCALAR")


def write_glb(path, parts):
    """One node and one mesh per part, one primitive per material of it. Returns the size."""
    names = sorted({material for part in parts for material in part.indices})
    buffer = Buffer()
    meshes = []
    for part in parts:
        positions = buffer.add_positions(part.vertices)
        count = len(part.vertices) // 3
        meshes.append({"name": part.name, "primitives": [
            {"attributes": {"POSITION": positions},
             "indices": buffer.add_indices(numbers, count),
             "material": names.index(material)} for material, numbers in part.indices.items()]})
    document = {
        "asset": {"version": "2.0", "generator": "sonarsim make_scenes.py"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(parts)))}],
        "nodes": [{"name": part.name, "mesh": i} for i, part in enumerate(parts)],
        "meshes": meshes,
        "materials": [{"name": name, "doubleSided": True} for name in names],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": buffer.size}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + buffer.size)
    with open(path, "wb") as file:
        file.write(head + struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", buffer.size, b"BIN\0"))
        file.writelines(buffer.chunks)
    return 12 + 8 + len(text) + 8 + buffer.size
