"""Scenes of objects in glTF, OBJ and STL; objects that move, copies of a mesh, targets in the water and errors of navigation
in the dataset. Their images: tests/golden; what is refused: test_refusals.py."""
import json
import math
import pathlib
import shutil

from sandbox import (SONARSIM, Composed, Sandbox, box_gltf, box_mesh, digest, gltf, numbers_of, obj, png, relative_difference,
                     sheet_mesh, triangles_of)

OBJECT = "{name: a, file: %s, position_m: [5, 0.25, 0.5], rpy_deg: [0, 0, 30]%s}"
FISH = ("{name: fish, file: crate.gltf, material: steel, trajectory: {waypoints: [{position_m: [4, -2, 1]}, "
        "{position_m: [4, 2, 1]}], speed_m_s: 4, rate_hz: 0.7}}")
PARTICLES = ("  particles:\n    - {name: fish, target_strength_db: 0, count: 1, position_m: "
             "[4, 0.5, 0.6], drift_m_s: [0, 0.5, 0]}\n")
OBJ_HEAD = "mtllib a.mtl\no crate\nusemtl Concrete\n"
CALIBRATED = ("    noise:\n      add_sigma: 0.05\n      mult_sigma: 0.1\n      range_lambda_m: 0.02\n", "    model: calibrated\n")


def text_stl(points, faces):
    return "solid crate\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % tuple(points[k]) for k in f) +
        "endloop\nendfacet\n" for f in faces) + "endsolid crate\n"


class Objects(Composed):
    def assert_images(self, expected=None):
        """Renders; the images are those that are expected, and are returned."""
        self.assert_renders("--overwrite")
        images = {name: own for name, own in digest(self.out).items() if name.endswith((".npy", ".png"))}
        self.assertGreater(len(images), 6)
        self.assertEqual(images, expected or images)
        return images

    def test_the_same_bytes_as_one_gltf(self):
        """World (x, y, z) is (x, z, -y) in glTF; a turn about the world's z is one about glTF's y."""
        half = math.sqrt(0.5)
        self.write("whole.gltf", gltf([{"name": "floor", "mesh": 0}, {"name": "a", "mesh": 1, "translation": [4.25, 0.5, -1.125]},
             {"name": "b", "mesh": 1, "translation": [6.5, 0.75, 0.5], "scale": [1.5, 1.5, 1.5]},
             {"name": "c", "mesh": 1, "translation": [5.0, 0.625, 2.5], "rotation": [0, half, 0, half]}], [sheet_mesh(), box_mesh()]))
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
        for name, content, keys in (("a.obj", obj(*shape, OBJ_HEAD).replace("a.mtl", "../../../etc/passwd"), ""),
                ("mm.obj", obj([(1000 * x, -1000 * z, 1000 * y) for x, y, z in points], faces, OBJ_HEAD), ", units: mm, up: z"),
                ("a.STL", text_stl(*shape), ", material: Concrete")):
            with self.subTest(name=name):
                self.write(name, content)
                self.objects(OBJECT % (name, keys))
                self.assert_images(whole)
                # An .mtl is not read: nothing in the file can name another that is then opened.
                self.assertNotIn("passwd", json.dumps(self.dataset()))

    def test_everywhere(self):
        """scene.file, scatter, preview and inspect take them, too; an STL has no material, and names are in any encoding."""
        self.write("floor.obj", obj(*triangles_of(sheet_mesh(10.0, 1)), OBJ_HEAD).encode().replace(b"o crate", b"o Stra\xdfe\x1b[2J"))
        self.write("a.stl", text_stl(*triangles_of(box_mesh())))
        self.scene("  scatter:\n    - {name: mine, files: [a.stl], material: steel, count: 2, area_min_m: [2, -4], "
                   "area_max_m: [8, 4]}\n", head="  file: floor.obj\n  materials: materials.csv\n")
        self.succeeds("preview", "mission.yaml", "--out", "preview.png")
        self.assert_renders()
        reported = self.reported("inspect", "floor.obj")
        self.assertEqual(reported["materials"], [{"name": "Concrete", "triangles": 2}])
        self.assertEqual(reported["instances"], [{"name": "Stra\\xdfe\\x1b[2J", "triangles": 2}])
        self.objects(OBJECT % ("a.stl", ""))
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml", "--out", "new"), "mission.yaml:7:7: 'a' has no "
                            "material in ", "a.stl; write material: NAME for an object", "scene.material_default")

    def test_without_the_modules(self):
        """A start needs neither libassimp nor OpenImageIO. A mission that does says what to install."""
        self.assertNotRegex(self.run_program("ldd", SONARSIM).stdout, "assimp|OpenImageIO")
        if pathlib.Path("/usr/local/lib/sonarsim").exists():
            self.skipTest("an installed module takes the place of a missing one")
        own = self.folder / "deep/er/bin/sonarsim"
        own.parent.mkdir(parents=True)
        shutil.copy(SONARSIM, own)
        self.write("crate.stl", text_stl(*triangles_of(box_mesh())))
        self.write("bed.png", png([[1, 2], [3, 4]]))

        def inspect(*arguments):
            done = self.run_program(own, "inspect", *arguments, code=None)
            return f"{done.returncode} {done.stderr}"
        self.assertRegex(inspect("crate.gltf"), "^0 ")
        self.assertRegex(inspect("crate.stl"), "^2 .*crate.stl: cannot be read: .*install libassimp-dev")
        self.assertRegex(inspect("bed.png", "--pixel-m", "1"), "^2 .*bed.png: cannot be read: .*install libopenimageio-dev")
        self.write("deep/er/lib/sonarsim/libsonarsim_meshes.so", "no library")
        self.assertRegex(inspect("crate.stl"), r"^2 .*cannot be loaded \(.*\); install libassimp-dev")


class Moving(Composed):
    def test_poses_and_boxes_at_every_ping(self):
        self.objects(FISH)
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [objects]\n")
        self.assert_renders()
        self.assertIsNone(self.boxes()["fish"])
        visible = 0
        for k in range(6):
            meta = self.meta(k)
            pose, sonar = meta["T_world_object"]["fish"], meta["T_world_sensor"]
            self.assert_near(pose["position_m"], (4, -2 + 0.8 * k, 1))
            for one in self.objects_of(k):
                self.assertEqual(one.get("T_world_object"), pose if one["name"] == "fish" else None)
                if one["name"] == "fish":
                    visible += 1
                    # A cube of 1 m that is turned against the sonar as the world is.
                    box = one["box_sensor"]
                    self.assert_near(box["size_m"], (1, 1, 1), 1e-6)
                    self.assertAlmostEqual(math.hypot(*box["position_m"]), math.dist(pose["position_m"], sonar["position_m"]),
                                           places=9)
                    x, y, z, w = sonar["quaternion_xyzw"]
                    self.assert_near(box["quaternion_xyzw"], (-x, -y, -z, w))
        self.assertGreater(visible, 1)
        self.assertEqual(len({v for k, v in digest(self.out).items() if "polar" in k}), 6)

    def test_large_coordinates_lose_nothing_where_all_moves(self):
        def image(x, y):
            self.write("fish.txt", f"0 {x + 4} {y - 1} 0 0 0 0 1\n2 {x + 4} {y + 1} 0 0 0 0 1\n")
            self.write("mission.yaml", "scene: {materials: materials.csv, objects: [{name: fish, file: crate.gltf, "
                       "material: steel, trajectory: {file: fish.txt}}]}\n"
                       f"trajectory: {{waypoints: [{{position_m: [{x}, {y}, 0]}}, {{position_m: [{x + 0.3}, {y}, 0]}}], "
                       "rate_hz: 3, speed_m_s: 0.5}\nengine: rays\n"
                       "sensors: {fls: {kind: imaging, azimuth_bins: 32, range_max_m: 8, range_bins: 100}}\n"
                       "output: {folder: out, fan: false, labels: [clean]}\n")
            self.assertNotIn("W01", self.assert_renders("--overwrite").stderr)
            return numbers_of(self.out / "fls/clean/000001.npy")
        self.assertLess(relative_difference(image(500000, 6000000), image(0, 0)), 1e-3)


class Copies(Composed):
    CRATES = ("position_m: [4.25, 1.5, 0.5]", "position_m: [6.5, -0.5, 0.75], scale: 1.5",
              "position_m: [5, -2.5, 0.625], rpy_deg: [0, 0, 30]")

    def render_crates(self, files, plates=()):
        self.objects(*(f"{{name: {name}, class: crate, file: {file}, {where}}}"
                       for name, file, where in zip("abc", files, self.CRATES, strict=True)), *plates)
        self.assert_renders("--overwrite", "--set", "engine=rays")
        return self.dataset()["scene"]

    def test_shared_is_what_copied_is(self):
        """Beside 45 plates of 100,000 triangles what has one file is kept once: one mesh and three transforms are within
        rounding the picture of three crates, each of a file of its own. Few triangles are copied."""
        self.write("plate.gltf", gltf([{"name": "plate", "mesh": 0}], [sheet_mesh(half=0.2, cells=224)]))
        plates = [f"{{name: p{k}, class: plate, file: plate.gltf, position_m: [{-8 + k % 5}, {k // 5 - 4}, 0.5]}}" for k in range(45)]
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")
        own = [f"crate{k}.gltf" for k in range(3)]
        for name in own:
            self.write(name, (self.folder / "crate.gltf").read_bytes())
        images, boxes, warnings = [], [], []
        for files, expected in ((["crate.gltf"] * 3, (128, 2, 48)), (own, (128 + 3 * 12, 1, 45))):
            scene = self.render_crates(files, plates)
            self.assertEqual((scene["triangles"], scene["shared_meshes"], scene["copies"]), expected)
            boxes.append(self.boxes())
            images.append(numbers_of(self.out / "fls/polar/000000.npy"))
            warnings.append([line for line in self.succeeds("validate", "mission.yaml", "--set", "engine=rays")
                             .stderr.splitlines() if "W" in line])
        self.assertNotEqual(images[0], images[1])
        self.assertLess(relative_difference(*images), 1e-3)
        self.assertEqual(warnings[0], warnings[1])
        self.assertEqual(list(boxes[0]), list(boxes[1]))
        for name, copied in boxes[1].items():
            for end in ("min", "max"):
                self.assert_near(boxes[0][name][end], copied[end], 1e-5)
        few = self.render_crates(["crate.gltf"] * 3)
        self.assertEqual((few["triangles"], "copies" in few), (128 + 3 * 12, False))


class Particles(Composed):
    def setUp(self):
        super().setUp()
        self.scene(PARTICLES)
        self.edit("mission.yaml", *CALIBRATED)
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [objects]\n")

    def test_places_and_labels(self):
        self.assert_renders()
        for k in range(6):
            target = self.meta(k)["particles"]["fish_1"]
            self.assertEqual((target["count"], target["target_strength_db"]), (1, 0))
            y = 0.5 + 0.1 * k
            self.assertLess(math.dist(target["position_m"], (4, y, 0.6)), 1e-9)
            found = [one for one in self.objects_of(k) if one["name"] == "fish_1"]
            self.assertEqual([one["class"] for one in found], ["fish"])
            # From (0, 0, 2) to the place.
            self.assertAlmostEqual(found[0]["range_m"], (16 + y * y + 1.96) ** 0.5, delta=0.1)

    def test_a_mount_that_is_drawn_receives_what_its_pings_receive(self):
        """Astern and 20 degrees up, where the bow that points 20 degrees down turns the sonar."""
        self.edit("mission.yaml", "position_m: [4, 0.5, 0.6]", "position_m: [-4, 0.5, 3.4]")
        self.add("\nvary: [{key: sensors.fls.mount.rpy_deg.2, uniform: [175, 185], per: ping}]\n")
        self.assert_renders()
        self.assertEqual(list(self.meta(3)["particles"]), ["fish_1"])


class Others(Sandbox):
    def test_images_do_not_depend_on_navigation(self):
        def positions(name):
            return [tuple(map(float, line.split()[1:4])) for line in (self.out / name).read_text().splitlines()[1:]]
        self.add("\nvehicle:\n  motion: {position_m: [0, 0, 0.2], turn_deg: [3, 2, 1], period_s: 4}\n")
        self.assert_renders()
        images, truth = digest(self.out / "fls/polar"), positions("trajectory.tum")
        self.assertEqual(len({z for _, _, z in truth}), 6)
        self.assertFalse((self.out / "navigation.tum").exists())
        self.add("  navigation: {position_m: 0.5, heading_deg: 2}\n")
        self.assert_renders("--overwrite")
        self.assertEqual((images, truth), (digest(self.out / "fls/polar"), positions("trajectory.tum")))
        reported = positions("navigation.tum")
        self.assertNotEqual(reported, truth)
        self.assertEqual([tuple(self.meta(ping)["T_world_vehicle_reported"]["position_m"]) for ping in range(6)], reported)
        self.assert_shards_agree()
        self.write("out/navigation.tum", "0 0 0 0 0 0 0 1\n")
        self.assert_verify_finds("navigation.tum: its bytes differ")

    def test_a_narrow_beam_that_looks_far_along_track_is_done_in_time(self):
        self.write("mission.yaml", "scene: {file: box.gltf, materials: materials.csv}\ntrajectory: {file: path.csv, "
                   "rate_hz: 0.1}\nsensors: {s: {kind: sidescan, model: calibrated, elevation_deg: 160, range_max_m: 6, "
                   "range_bins: 64, instrument: {beam: {width_deg: 0.1}}}}\noutput: {folder: out}\n")
        self.assert_renders()
        self.assertTrue(all(map(math.isfinite, numbers_of(self.out / "s/waterfall.npy"))))
