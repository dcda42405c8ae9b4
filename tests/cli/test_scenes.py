"""Scenes that a mission composes of objects, in glTF, OBJ and STL: the same images whatever the format, the units and
the names of the materials. What is refused: test_refusals.py."""
import json
import math
import pathlib
import shutil
import subprocess
import unittest

from sandbox import SONARSIM, Composed, box_gltf, box_mesh, gltf, png, sheet_mesh

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


class Objects(Composed):
    def assert_images(self, expected=None):
        """Renders; the images are those that are expected, and are returned."""
        self.assert_renders("--overwrite")
        images = self.images()
        self.assertGreater(len(images), 6)
        self.assertEqual(images, expected or images)
        return images

    def test_the_same_bytes_as_one_gltf(self):
        """World (x, y, z) is (x, z, -y) in glTF; a turn about the world's z is one about glTF's y."""
        half = math.sqrt(0.5)
        self.write("whole.gltf", gltf(
            [{"name": "floor", "mesh": 0},
             {"name": "a", "mesh": 1, "translation": [4.25, 0.5, -1.125]},
             {"name": "b", "mesh": 1, "translation": [6.5, 0.75, 0.5], "scale": [1.5, 1.5, 1.5]},
             {"name": "c", "mesh": 1, "translation": [5.0, 0.625, 2.5],
              "rotation": [0, half, 0, half]}], [sheet_mesh(), box_mesh()]))
        self.scene(head="  file: whole.gltf\n  materials: materials.csv\n")
        whole = self.assert_images()
        crates = ("{name: a, file: crate.gltf, position_m: [4.25, 1.125, 0.5]}",
                  "{name: b, file: crate.gltf, position_m: [6.5, -0.5, 0.75], scale: 1.5}",
                  "{name: c, file: crate.gltf, position_m: [5, -2.5, 0.625], rpy_deg: [0, 0, 90]}")
        self.objects(*crates)
        self.assert_images(whole)
        # A scene of objects alone.
        self.objects("{file: floor.gltf}", *crates, head="  materials: materials.csv\n")
        self.assert_images(whole)

    def test_default_material(self):
        self.write("crate.gltf", box_gltf((0.5, 0.5, 0.5), "0137_Black"))
        line = "{name: a, file: crate.gltf, position_m: [5, 0, 0.5]%s}"
        self.objects(line % ", material: steel")
        images = self.assert_images()
        self.objects(line % "", head="  file: floor.gltf\n  materials: materials.csv\n  material_default: steel\n")
        self.assert_images(images)

    def test_one_shape_in_other_formats(self):
        """glTF's (x, y, z) is (x, -z, y) with z up. Binary STL and PLY: tests/scene/meshes."""
        shape = points, faces = triangles_of(box_mesh())
        self.objects(OBJECT % ("crate.gltf", ""))
        whole = self.assert_images()
        for name, content, keys in (
                ("a.obj", obj(*shape).replace("a.mtl", "../../../etc/passwd"), ""),
                ("mm.obj", obj([(1000 * x, -1000 * z, 1000 * y) for x, y, z in points], faces), ", units: mm, up: z"),
                ("a.STL", text_stl(*shape), ", material: Concrete")):
            with self.subTest(name=name):
                self.write(name, content)
                self.objects(OBJECT % (name, keys))
                self.assert_images(whole)
                # An .mtl is not read: nothing in the file can name another that is then opened.
                self.assertNotIn("passwd", json.dumps(self.dataset()))

    def test_everywhere(self):
        """scene.file, scatter, preview and inspect take them, too; an STL has no material, and names are in any encoding."""
        self.write("floor.obj", obj(*triangles_of(sheet_mesh(10.0, 1))).encode().replace(b"o crate", b"o Stra\xdfe\x1b[2J"))
        self.write("a.stl", text_stl(*triangles_of(box_mesh())))
        self.scene("  scatter:\n    - {name: mine, files: [a.stl], material: steel, count: 2, area_min_m: [2, -4], "
                   "area_max_m: [8, 4]}\n", head="  file: floor.obj\n  materials: materials.csv\n")
        self.succeeds("preview", "mission.yaml", "--out", "preview.png")
        self.assert_renders()
        reported = json.loads(self.succeeds("inspect", "floor.obj", "--json").stdout)
        self.assertEqual(reported["materials"], [{"name": "Concrete", "triangles": 2}])
        self.assertEqual(reported["instances"], [{"name": "Stra\\xdfe\\x1b[2J", "triangles": 2}])
        self.objects(OBJECT % ("a.stl", ""))
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml", "--out", "new"), "mission.yaml:7:7: 'a' has no "
                            "material in ", "a.stl; write material: NAME for an object", "scene.material_default")

    def test_questions_about_units(self):
        """In millimetres the post is 900 m long, beyond the bottom. Those about axes: tests/scene/standing_test.cpp."""
        self.write("post.stl", text_stl(*triangles_of(box_mesh((150, 150, 450)))))
        for options, questions in (((), ["it is 900 m long: millimetres? units: mm"]), (("--units", "mm", "--up", "z"), [])):
            reported = json.loads(self.succeeds("inspect", "post.stl", "--json", *options).stdout)
            self.assertEqual([one for one in reported["questions"] if "long" in one], questions)
        self.assertAlmostEqual(reported["bounds_max_m"][2], 0.45, places=6)
        post = "file: post.stl, material: steel, position_m: [5, 0, 1]}"
        self.objects("{name: a, place: on_bottom, " + post)
        self.refused("mission.yaml:7:7: 'a' reaches beyond the bottom", "; 'a' is 900 m long: millimetres? units: mm")
        self.objects("{name: a, units: mm, up: z, " + post)
        self.assertNotIn("millimetres", self.succeeds("validate", "mission.yaml").stderr)

    def test_without_the_modules(self):
        """A start needs neither libassimp nor OpenImageIO. A mission that does says what to install."""
        libraries = subprocess.run(["ldd", SONARSIM], capture_output=True, text=True, check=True).stdout
        self.assertNotRegex(libraries, "assimp|OpenImageIO")
        if pathlib.Path("/usr/local/lib/sonarsim").exists():
            self.skipTest("an installed module takes the place of a missing one")
        own = self.folder / "deep/er/bin/sonarsim"
        own.parent.mkdir(parents=True)
        shutil.copy(SONARSIM, own)
        self.write("crate.stl", text_stl(*triangles_of(box_mesh())))
        self.write("bed.png", png([[1, 2], [3, 4]]))

        def inspect(*arguments):
            done = subprocess.run([own, "inspect", *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
            return f"{done.returncode} {done.stderr}"
        self.assertRegex(inspect("crate.gltf"), "^0 ")
        self.assertRegex(inspect("crate.stl"), "^2 .*crate.stl: cannot be read: .*install libassimp-dev")
        self.assertRegex(inspect("bed.png", "--pixel-m", "1"), "^2 .*bed.png: cannot be read: .*install libopenimageio-dev")
        self.write("deep/er/lib/sonarsim/libsonarsim_meshes.so", "no library")
        self.assertRegex(inspect("crate.stl"), r"^2 .*cannot be loaded \(.*\); install libassimp-dev")


if __name__ == "__main__":
    unittest.main()
