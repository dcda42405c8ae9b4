"""Scenes that a mission composes: a floor, a crate, and a sonar that looks at them."""
import base64
import json
import struct

from sandbox import Sandbox, digest

MATERIALS = "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\nsteel,7850,5890\n"
SCATTER = ("  scatter:\n    - {name: mine, files: [crate.gltf], count: 5, area_min_m: [2, -4], "
           "area_max_m: [8, 4], spacing_m: 0.2}\n")


def gltf(nodes, meshes, materials=("Concrete",)):
    """Nodes as glTF has them over meshes of (points, indices, material)."""
    data, views, accessors, out = b"", [], [], []
    for points, indices, material in meshes:
        parts = (b"".join(struct.pack("<3f", *p) for p in points),
                 struct.pack(f"<{len(indices)}I", *indices))
        for part, kind, code, count in ((parts[0], "VEC3", 5126, len(points)),
                                        (parts[1], "SCALAR", 5125, len(indices))):
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
            accessors.append({"bufferView": len(views) - 1, "componentType": code,
                              "count": count, "type": kind})
            data += part
        out.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 2},
                                    "indices": len(accessors) - 1, "material": material}]})
    return json.dumps({
        "asset": {"version": "2.0"}, "nodes": nodes, "meshes": out,
        "materials": [{"name": name} for name in materials],
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}]})


def floor_mesh(half=10.0, slope=0.0, cells=8):
    """A floor in glTF's axes (y up) that rises by `slope` along x."""
    axis = [half * (2 * k / cells - 1) for k in range(cells + 1)]
    points = [(x, slope * x, z) for z in axis for x in axis]
    indices = []
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            indices += [a, a + 1, a + cells + 2, a, a + cells + 2, a + cells + 1]
    return points, indices, 0


def box_mesh(half=0.5, material=0):
    points = [tuple((1 if i >> k & 1 else -1) * half for k in range(3)) for i in range(8)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [i for a, b, c, d in quads for i in (a, b, c, a, c, d)], material


class Composed(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("materials.csv", MATERIALS)
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [floor_mesh()]))
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh()]))
        self.write("path.csv", "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n"
                   + "".join(f"{0.2 * i:.1f},0,0,2,0,20,{3 * i}\n" for i in range(6)))
        self.edit("mission.yaml", "range_max_m: 6", "range_max_m: 9")
        self.scene("  file: floor.gltf\n  materials: materials.csv\n")

    def scene(self, text):
        mission = (self.folder / "mission.yaml").read_text()
        start, end = mission.index("scene:\n"), mission.index("\ntrajectory:") + 1
        self.write("mission.yaml", mission[:start] + "scene:\n" + text + mission[end:])

    def objects(self, text, scene="  file: floor.gltf\n  materials: materials.csv\n"):
        self.scene(scene + "  objects:\n" + "".join(f"    - {line}\n" for line in text))

    def refused(self, *fragments, arguments=()):
        for command in ("validate", "render"):
            with self.subTest(command=command):
                self.assert_refused(self.run_sonarsim(command, "mission.yaml", *arguments),
                                    *fragments)
                self.assertFalse(self.out.exists(), "a refused mission leaves no folder")

    def images(self):
        return {k: v for k, v in digest(self.out).items() if k.endswith((".npy", ".png"))}
