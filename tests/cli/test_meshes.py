"""OBJ, STL and PLY wherever glTF is read: the same images, questions about units and axes, and files that
are faulty."""
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest

from composed import Composed, box_mesh, floor_mesh, gltf
from sandbox import SONARSIM

OBJECT = "{name: a, file: %s, position_m: [5, 0.25, 0.5], rpy_deg: [0, 0, 30]%s}"


def triangles_of(mesh):
    points, indices, _ = mesh
    return points, [tuple(indices[k:k + 3]) for k in range(0, len(indices), 3)]


def obj(points, faces, material="Concrete"):
    return ("mtllib a.mtl\no crate\n" + "".join("v %g %g %g\n" % tuple(p) for p in points) +
            f"usemtl {material}\n" + "".join("f %d %d %d\n" % tuple(k + 1 for k in f) for f in faces))


def text_stl(points, faces):
    return "solid crate\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % tuple(points[k]) for k in f) +
        "endloop\nendfacet\n" for f in faces) + "endsolid crate\n"


def binary_stl(points, faces):
    return bytes(80) + struct.pack("<I", len(faces)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for k in f for x in points[k]), 0) for f in faces)


def ply(points, faces, form="ascii"):
    head = (f"ply\nformat {form} 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    if form == "ascii":
        return head + "".join("%g %g %g\n" % tuple(p) for p in points) + "".join(
            "3 %d %d %d\n" % tuple(f) for f in faces)
    return (head.encode() + b"".join(struct.pack("<3f", *p) for p in points) +
            b"".join(struct.pack("<B3i", 3, *f) for f in faces))


def drum(radius, length, sides=24):
    """Along z, from z = 0."""
    points, faces = [(0, 0, 0), (0, 0, length)], []
    for z in (0, length):
        points += [(radius * math.cos(2 * math.pi * k / sides), radius * math.sin(2 * math.pi * k / sides), z)
                   for k in range(sides)]
    for k in range(sides):
        a, b = 2 + k, 2 + (k + 1) % sides
        c, d = a + sides, b + sides
        faces += [(0, b, a), (1, c, d), (a, b, d), (a, d, c)]
    return points, faces


class Meshes(Composed):
    def put(self, name, content):
        if isinstance(content, str):
            content = content.encode()
        (self.folder / name).write_bytes(content)

    def succeeds(self, *arguments):
        result = self.run_sonarsim(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_one_shape_in_every_format(self):
        """The crate of glTF and of every other format gives the same bytes."""
        shape = triangles_of(box_mesh())
        self.objects([OBJECT % ("crate.gltf", "")])
        self.assert_renders()
        whole = self.images()
        self.assertGreater(len(whole), 6)
        for name, content, keys in (
                ("a.obj", obj(*shape), ""),
                ("a.stl", text_stl(*shape), ", material: Concrete"),
                ("b.STL", binary_stl(*shape), ", material: Concrete"),
                ("a.ply", ply(*shape), ", material: Concrete"),
                ("b.ply", ply(*shape, "binary_little_endian"), ", material: Concrete")):
            with self.subTest(name=name):
                self.put(name, content)
                self.objects([OBJECT % (name, keys)])
                self.assert_renders("--overwrite")
                self.assertEqual(self.images(), whole)

    def test_millimetres_and_z_up(self):
        points, faces = triangles_of(box_mesh())
        self.objects([OBJECT % ("crate.gltf", "")])
        self.assert_renders()
        whole = self.images()
        # glTF's (x, y, z) is (x, -z, y) with z up.
        self.put("mm.obj", obj([(1000 * x, -1000 * z, 1000 * y) for x, y, z in points], faces))
        self.objects([OBJECT % ("mm.obj", ", units: mm, up: z")])
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), whole)

    def test_everywhere(self):
        """scene.file, scatter, preview and inspect take them, too."""
        self.put("floor.obj", obj(*triangles_of(([(-10, 0, -10), (10, 0, -10), (10, 0, 10), (-10, 0, 10)],
                                                 [0, 1, 2, 0, 2, 3], 0))))
        self.put("crate.ply", ply(*triangles_of(box_mesh())))
        self.scene("  file: floor.obj\n  materials: materials.csv\n  scatter:\n    - {name: mine, files: "
                   "[crate.ply], material: steel, count: 2, area_min_m: [2, -4], area_max_m: [8, 4]}\n")
        self.succeeds("validate", "mission.yaml")
        self.succeeds("preview", "mission.yaml", "--out", "preview.png")
        self.assert_renders()
        reported = json.loads(self.succeeds("inspect", "floor.obj", "--json").stdout)
        self.assertEqual(reported["materials"], [{"name": "Concrete", "triangles": 2}])
        self.assertEqual(reported["instances"], [{"name": "crate", "triangles": 2}])

    def test_inspect_takes_units_and_up(self):
        self.put("drum.stl", text_stl(*drum(300, 900)))
        reported = json.loads(self.succeeds("inspect", "drum.stl", "--units", "mm", "--up", "z",
                                            "--json").stdout)
        self.assertAlmostEqual(reported["bounds_max_m"][2], 0.9, places=6)
        self.assertEqual(reported["questions"], [])
        reported = json.loads(self.succeeds("inspect", "drum.stl", "--json").stdout)
        self.assertEqual(reported["questions"], [
            "it is 900 m long: millimetres? units: mm",
            "drum.stl lies on its side with y up and would stand with z up: does its z point up? up: z"])
        text = self.succeeds("inspect", "drum.stl").stdout
        self.assertIn("question: it is 900 m long: millimetres? units: mm", text)
        self.assertIn("--units mm and --up z", text)
        for arguments, fragment in ((["--units", "yard"], "--units"), (["--up", "x"], "--up")):
            result = self.run_sonarsim("inspect", "drum.stl", *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(fragment, result.stderr)

    def test_no_material(self):
        """An STL has none: the message names the keys of the mission that give one."""
        self.put("a.stl", text_stl(*triangles_of(box_mesh())))
        self.objects([OBJECT % ("a.stl", "")])
        self.refused("mission.yaml:7:7: 'a' has no material in ", "a.stl; write material: NAME for an object",
                     "scene.material_default")
        self.scene("  file: a.stl\n  materials: materials.csv\n  material_default: steel\n")
        self.succeeds("validate", "mission.yaml")

    def test_the_anchor_of_the_scripts(self):
        """An OBJ in millimetres with z up, of several groups, resting on the bottom."""
        scripts = pathlib.Path(__file__).resolve().parents[2] / "scripts"
        subprocess.run([sys.executable, "-B", scripts / "make_scenes.py", "anchor", "--out", self.folder],
                       check=True, capture_output=True)
        reported = json.loads(self.succeeds("inspect", "anchor.obj", "--units", "mm", "--up", "z",
                                        "--json").stdout)
        self.assertEqual([part["name"] for part in reported["instances"]], ["shank", "head", "shackle"])
        self.assertEqual([round(x, 3) for x in reported["bounds_max_m"]], [0.346, 0.390, 1.245])
        self.objects(["{name: anchor, file: anchor.obj, units: mm, up: z, position_m: [4, 1, 0], "
                      "place: on_bottom, bury_m: 0.05}"])
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")
        self.assert_renders()
        box = self.dataset()["labels"]["instances"][1]["box_world_m"]
        self.assertAlmostEqual(box["min"][2], -0.05, places=5)
        self.assertAlmostEqual(box["max"][2], 1.195, places=5)

    def test_a_mission_asks(self):
        """In millimetres the drum is 900 m long: beyond the bottom, or around the blind sonar."""
        self.put("drum.stl", text_stl(*drum(300, 900)))
        keys = "file: drum.stl, material: steel, position_m: [5, 0, 1]"
        self.objects(["{name: a, place: on_bottom, " + keys + "}"])
        self.refused("mission.yaml:7:7: 'a' reaches beyond the bottom",
                     "; 'a' is 900 m long: millimetres? units: mm")
        self.objects(["{name: a, " + keys + "}"], "  materials: materials.csv\n")
        self.edit("mission.yaml", "path.csv", "far.csv")
        (self.folder / "far.csv").write_text("t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n"
                                             "0,0,0,1700,0,0,0\n1,1,0,1700,0,0,0\n")
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"W04 scene: it is 600 x 900 x 600 m; .*scene\.units: mm")
        self.assertRegex(result.stderr, r"W01 .*drum.stl lies on its side .* up: z")
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [floor_mesh(2000.0)]))
        self.scene("  file: floor.gltf\n  materials: materials.csv\n")
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertRegex(result.stderr, r"W04 scene: it is 4000 x .*scene\.units: mm")
        self.objects(["{name: a, units: mm, up: z, " + keys + "}"])
        self.edit("mission.yaml", "far.csv", "path.csv")
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertNotIn("millimetres", result.stderr)
        self.assertNotIn("on its side", result.stderr)

    def test_faulty_files(self):
        shape = triangles_of(box_mesh())
        whole = ply(*shape, "binary_little_endian")
        for name, content, *fragments in (
                ("a.obj", "", "is not a valid OBJ"),
                ("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "vertex index out of range"),
                ("a.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "there is no surface in"),
                ("a.stl", binary_stl(*shape)[:-10], "12 triangles", "copy or export it again"),
                ("a.stl", text_stl(*shape)[:-20], "no endsolid"),
                ("a.ply", whole[:-1], "'face'", "number 12 of 12", "copy or export the file again"),
                ("a.ply", whole.replace(b"vertex 8", b"vertex 4000000000"), "copy or export"),
                ("a.ply", whole[:-1] + b"\x7f", "is out of range"),
                ("a.ply", whole.replace(b"property float y\n", b""), "")):
            with self.subTest(name=name, content=content[:40]):
                self.put(name, content)
                self.objects([OBJECT % (name, ", material: steel")])
                self.refused(name, *fragments)

    def test_names_in_any_encoding(self):
        """Latin-1 and control characters become text that JSON and a terminal can have."""
        self.put("a.obj", obj(*triangles_of(box_mesh())).encode().replace(b"o crate", b"o Stra\xdfe\x1b[2J"))
        reported = json.loads(self.succeeds("inspect", "a.obj", "--json").stdout)
        self.assertEqual(reported["instances"], [{"name": "Stra\\xdfe\\x1b[2J", "triangles": 12}])

    def test_an_mtl_is_not_read(self):
        """Nothing in the file can name another that is then opened."""
        self.put("crate.obj", obj(*triangles_of(box_mesh())).replace("a.mtl", "../../../etc/passwd"))
        self.objects([OBJECT % ("crate.obj", "")])
        self.assert_renders()
        self.assertNotIn("passwd", json.dumps(self.dataset()))

    def test_without_the_module(self):
        """A start does not need libassimp. A mission that does says what to install."""
        libraries = subprocess.run(["ldd", SONARSIM], capture_output=True, text=True, check=True).stdout
        self.assertNotIn("assimp", libraries)
        if pathlib.Path("/usr/local/lib/sonarsim").exists():
            self.skipTest("an installed module takes the place of a missing one")
        own = self.folder / "deep/er/bin/sonarsim"
        own.parent.mkdir(parents=True)
        shutil.copy(SONARSIM, own)
        self.put("crate.stl", text_stl(*triangles_of(box_mesh())))
        for arguments, code in ((["inspect", "crate.gltf"], 0), (["inspect", "crate.stl"], 2)):
            result = subprocess.run([own, *arguments], cwd=self.folder, capture_output=True, text=True,
                                    check=False)
            self.assertEqual(result.returncode, code, result.stderr)
        self.assertTrue(re.search(r"crate.stl: cannot be read: .*install libassimp-dev", result.stderr),
                        result.stderr)
        module = self.folder / "deep/er/lib/sonarsim/libsonarsim_meshes.so"
        module.parent.mkdir(parents=True)
        module.write_text("no library")
        result = subprocess.run([own, "inspect", "crate.stl"], cwd=self.folder, capture_output=True,
                                text=True, check=False)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertTrue(re.search(r"cannot be loaded \(.*\); install libassimp-dev", result.stderr),
                        result.stderr)


if __name__ == "__main__":
    unittest.main()
