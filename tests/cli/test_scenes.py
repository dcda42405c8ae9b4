"""Scenes that a mission composes: objects, scatter, motion, and what is refused."""
import base64
import json
import math
import struct
import unittest

from sandbox import Sandbox, box_gltf, digest

try:
    from PIL import Image
except ImportError:
    Image = None

SCENE = "  file: box.gltf\n  materials: materials.csv\n"
MATERIALS = "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\nsteel,7850,5890\n"


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


class Objects(Composed):
    def test_the_same_bytes_as_one_gltf(self):
        """World (x, y, z) is (x, z, -y) in glTF; a turn about the world's z is one about glTF's y."""
        half = math.sqrt(0.5)
        self.write("whole.gltf", gltf(
            [{"name": "floor", "mesh": 0},
             {"name": "a", "mesh": 1, "translation": [4.25, 0.5, -1.125]},
             {"name": "b", "mesh": 1, "translation": [6.5, 0.75, 0.5], "scale": [1.5, 1.5, 1.5]},
             {"name": "c", "mesh": 1, "translation": [5.0, 0.625, 2.5],
              "rotation": [0, half, 0, half]}], [floor_mesh(), box_mesh()]))
        self.scene("  file: whole.gltf\n  materials: materials.csv\n")
        self.assert_renders()
        whole = self.images()
        self.assertGreater(len(whole), 6)
        self.objects(["{name: a, file: crate.gltf, position_m: [4.25, 1.125, 0.5]}",
                      "{name: b, file: crate.gltf, position_m: [6.5, -0.5, 0.75], scale: 1.5}",
                      "{name: c, file: crate.gltf, position_m: [5, -2.5, 0.625], "
                      "rpy_deg: [0, 0, 90]}"])
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), whole)

    def test_a_scene_of_objects_alone(self):
        self.scene("  file: floor.gltf\n  materials: materials.csv\n")
        self.assert_renders()
        whole = self.images()
        self.objects(["{file: floor.gltf}"], "  materials: materials.csv\n")
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), whole)

    def test_units_and_up_mend_a_file(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5], rpy_deg: [0, 0, 30]}"])
        self.assert_renders()
        whole = self.images()
        # 500 mm either way, and z up: the cube is the same after a quarter turn about x.
        self.write("mm.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh(500.0)]))
        self.objects(["{name: a, file: mm.gltf, units: mm, position_m: [5, 0, 0.5], "
                      "rpy_deg: [0, 0, 30]}"])
        self.assert_renders("--overwrite")
        self.assertEqual(sorted(self.images()), sorted(whole))

    def test_rests_on_the_bottom(self):
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [floor_mesh(slope=0.1)]))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 100], place: on_bottom}"])
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")
        self.assert_renders()
        # Its lower edge at x = 5.5 touches the slope: 0.55 m, and the box reaches 1 m above that.
        box = self.dataset()["labels"]["instances"][1]["box_world_m"]
        self.assertAlmostEqual(box["min"][2], 0.55, places=4)
        self.assertAlmostEqual(box["max"][2], 1.55, places=4)

    def test_materials_by_other_names(self):
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh()],
                                      ("0137_Black",)))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5]}"])
        self.refused("materials.csv", "0137_Black")
        for cure in ("material: steel", 'materials_map: {"0137_Black": steel}'):
            self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5], " + cure + "}"])
            self.assert_renders("--overwrite")
        by_map = self.images()
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5]}"],
                     "  file: floor.gltf\n  materials: materials.csv\n  material_default: steel\n")
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), by_map)

    def test_exclude(self):
        self.write("two.gltf", gltf([{"name": "crate", "mesh": 0, "children": [1]},
                                     {"name": "lid", "mesh": 0, "translation": [0, 1, 0]}],
                                    [box_mesh()]))
        self.objects(["{name: a, file: two.gltf, exclude: [lid], position_m: [5, 0, 0.5]}"])
        self.assert_renders()
        without = self.images()
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5]}"])
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), without)


class Scattered(Composed):
    RULE = ("  scatter:\n    - {name: mine, files: [crate.gltf], count: 5, area_min_m: [2, -4], "
            "area_max_m: [8, 4], spacing_m: 0.2}\n")

    def setUp(self):
        super().setUp()
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" + self.RULE)
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")

    def boxes(self):
        return [one["box_world_m"] for one in self.dataset()["labels"]["instances"]
                if one["name"].startswith("mine_")]

    def test_seeded_and_apart(self):
        self.assert_renders()
        boxes = self.boxes()
        self.assertEqual(len(boxes), 5)
        for box in boxes:
            self.assertAlmostEqual(box["min"][2], 0, places=4)
            self.assertTrue(2 <= box["min"][0] and box["max"][0] <= 8)
            self.assertTrue(-4 <= box["min"][1] and box["max"][1] <= 4)
        # Crates whose centres are as far apart as their shortest side and the spacing.
        middle = [[(b["min"][k] + b["max"][k]) / 2 for k in (0, 1)] for b in boxes]
        for i, a in enumerate(middle):
            for b in middle[:i]:
                self.assertGreater(math.dist(a, b), 1.2)
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "1")
        self.assertEqual(digest(self.out), first)
        self.assert_renders("--overwrite", "--seed", "8")
        self.assertNotEqual(self.boxes(), boxes)

    def test_no_room(self):
        self.edit("mission.yaml", "count: 5", "count: 50")
        self.refused("mission.yaml:7:7", "'mine': object", "of 50 finds no room in 1000 tries",
                     "larger area, fewer or smaller objects")

    def test_area_beside_the_bottom(self):
        self.edit("mission.yaml", "area_max_m: [8, 4]", "area_max_m: [80, 4]")
        self.edit("mission.yaml", "area_min_m: [2, -4]", "area_min_m: [70, -4]")
        self.refused("mission.yaml:7:7", "0 come too near", " have no bottom below")

    def test_inverted_area(self):
        self.edit("mission.yaml", "area_min_m: [2, -4]", "area_min_m: [9, -4]")
        self.refused("mission.yaml:7:", "area_min_m must be below area_max_m")

    def test_counts(self):
        self.edit("mission.yaml", "count: 5", "count: [3, 2]")
        self.refused("mission.yaml:7:", "'count': the first number must not be above the second")
        self.edit("mission.yaml", "count: [3, 2]", "count: 1.5")
        self.refused("mission.yaml:7:", "'count' must be a whole number or two of them")


class Moving(Composed):
    def setUp(self):
        super().setUp()
        self.objects(["{name: fish, file: crate.gltf, material: steel, trajectory: {waypoints: "
                      "[{position_m: [4, -2, 1]}, {position_m: [4, 2, 1]}], speed_m_s: 4, "
                      "rate_hz: 5}}"])

    def test_poses_and_threads(self):
        self.assert_renders("-j", "1")
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "3")
        self.assertEqual(digest(self.out), first)
        for k in range(6):
            meta = json.loads((self.out / f"fls/meta/{k:06}.json").read_text())
            position = meta["T_world_object"]["fish"]["position_m"]
            for got, wanted in zip(position, (4, -2 + 0.8 * k, 1)):
                self.assertAlmostEqual(got, wanted, places=9)
        self.assertEqual(len({v for k, v in first.items() if "polar" in k}), 6)

    def test_labels_have_its_box_at_every_ping(self):
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [objects]\n")
        self.assert_renders()
        fish = self.dataset()["labels"]["instances"][1]
        self.assertEqual((fish["name"], fish["box_world_m"]), ("fish", None))
        seen = 0
        for k in range(6):
            meta = json.loads((self.out / f"fls/meta/{k:06}.json").read_text())
            objects = json.loads((self.out / f"fls/objects/{k:06}.json").read_text())["objects"]
            for one in objects:
                if one["name"] != "fish":
                    self.assertNotIn("T_world_object", one)
                    continue
                seen += 1
                self.assertEqual(one["T_world_object"], meta["T_world_object"]["fish"])
                # A cube of 1 m that is not turned: its centre is where its pose is, and it is turned
                # against the sonar as the world is.
                box = one["box_sensor"]
                for size in box["size_m"]:
                    self.assertAlmostEqual(size, 1.0, places=6)
                at = [a - b for a, b in zip(one["T_world_object"]["position_m"],
                                            meta["T_world_sensor"]["position_m"])]
                self.assertAlmostEqual(math.dist(box["position_m"], (0, 0, 0)),
                                       math.dist(at, (0, 0, 0)), places=9)
                x, y, z, w = meta["T_world_sensor"]["quaternion_xyzw"]
                for got, wanted in zip(box["quaternion_xyzw"], (-x, -y, -z, w)):
                    self.assertAlmostEqual(got, wanted, places=9)
        self.assertGreater(seen, 1)

    def test_where_it_stands_still_it_is_like_any_other(self):
        """Moving to where it is: within rounding the picture of the still object."""
        self.objects(["{name: fish, file: crate.gltf, material: steel, trajectory: {waypoints: "
                      "[{position_m: [4, 1, 1]}, {position_m: [4, 1.0000001, 1]}], "
                      "speed_m_s: 1.0e-7, rate_hz: 5}}"])
        self.assert_renders("--set", "engine=rays")
        moving = (self.out / "fls/polar/000000.npy").read_bytes()
        self.objects(["{name: fish, file: crate.gltf, material: steel, position_m: [4, 1, 1]}"])
        self.assert_renders("--overwrite", "--set", "engine=rays")
        still = (self.out / "fls/polar/000000.npy").read_bytes()
        a, b = (struct.unpack(f"<{48 * 32}f", bytes_[-4 * 48 * 32:]) for bytes_ in (moving, still))
        self.assertLess(sum(abs(x - y) for x, y in zip(a, b)) / sum(b), 1e-3)

    def test_other_engines_refuse(self):
        for engine in ("octree", "slices"):
            self.refused(f"engine: {engine} sees no objects that move; use engine: auto or engine: rays",
                         arguments=["--set", f"engine={engine}"])

    def test_too_short(self):
        self.edit("mission.yaml", "speed_m_s: 4", "speed_m_s: 8")
        self.refused("mission.yaml:7:7", "'fish' moves from 0 s to", "ping from 0 s to 1 s",
                     "let its trajectory last as long")

    def test_without_times(self):
        self.write("fish.csv", "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,0,0\n")
        self.objects(["{name: fish, file: crate.gltf, trajectory: {file: fish.csv}}"])
        self.refused("fish.csv:1", "t_s")

    def test_without_a_name(self):
        self.edit("mission.yaml", "{name: fish, file", "{file")
        self.refused("mission.yaml:7:", "an object that moves needs a name")

    def test_not_on_the_bottom(self):
        self.edit("mission.yaml", "name: fish,", "name: fish, place: on_bottom,")
        self.refused("mission.yaml:7:", "an object that moves cannot rest on the bottom")


class Shared(Composed):
    def setUp(self):
        super().setUp()
        self.objects(["{name: a, class: crate, file: crate.gltf, position_m: [4.25, 1.5, 0.5]}",
                      "{name: b, class: crate, file: crate.gltf, position_m: [6.5, -0.5, 0.75], "
                      "scale: 1.5}",
                      "{name: c, class: crate, file: crate.gltf, position_m: [5, -2.5, 0.625], "
                      "rpy_deg: [0, 0, 30]}"])
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")

    def test_shared_is_what_copied_is(self):
        """One mesh and three transforms: within rounding the picture of three crates."""
        told, images = {}, {}
        for repeats in ("copied", "shared"):
            self.assert_renders("--overwrite", "--set", "engine=rays", "--set",
                                f"scene.repeats={repeats}")
            told[repeats] = self.dataset()
            images[repeats] = struct.unpack(
                f"<{48 * 32}f", (self.out / "fls/polar/000000.npy").read_bytes()[-4 * 48 * 32:])
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "3", "--set", "scene.repeats=shared")
        self.assertEqual({k: v for k, v in digest(self.out).items() if "/polar/" in k},
                         {k: v for k, v in first.items() if "/polar/" in k})
        a, b = images["shared"], images["copied"]
        self.assertNotEqual(a, b)
        self.assertLess(sum(abs(x - y) for x, y in zip(a, b)) / sum(b), 1e-3)
        self.assertEqual(told["copied"]["scene"]["triangles"], 128 + 3 * 12)
        self.assertNotIn("copies", told["copied"]["scene"])
        use = told["shared"]["scene"]
        self.assertEqual((use["triangles"], use["shared_meshes"], use["copies"]), (128, 1, 3))
        for one, other in zip(told["shared"]["labels"]["instances"],
                              told["copied"]["labels"]["instances"]):
            for end in ("min", "max"):
                for x, y in zip(one["box_world_m"].pop(end), other["box_world_m"].pop(end)):
                    self.assertAlmostEqual(x, y, places=5)
            self.assertEqual(one, other)

    @unittest.skipIf(Image is None, "needs python3-pil")
    def test_preview_and_validate_know_copies(self):
        """The plan and the cuts show three crates, and nothing that validate judges changes."""
        lines, pictures = {}, {}
        for repeats in ("copied", "shared"):
            chosen = ("--set", "engine=rays", "--set", f"scene.repeats={repeats}")
            done = self.run_sonarsim("preview", "mission.yaml", "--out", f"{repeats}.png", *chosen)
            self.assertEqual(done.returncode, 0, done.stderr)
            picture = Image.open(self.folder / f"{repeats}.png").convert("RGB")
            # The tiles behind that of the only sonar: plan on its right, cuts below.
            tile = 612, 450
            pictures[repeats] = [picture.crop((x, y, x + tile[0], y + tile[1])).tobytes()
                                 for x, y in ((624, 30), (12, 480), (624, 480))]
            done = self.run_sonarsim("validate", "mission.yaml", *chosen)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines[repeats] = [line for line in (done.stdout + done.stderr).splitlines() if "W" in line]
        self.assertEqual(lines["shared"], lines["copied"])
        for shared, copied in zip(pictures["shared"], pictures["copied"]):
            changed = sum(a != b for a, b in zip(shared, copied))
            self.assertLess(changed, len(copied) / 1000)

    def test_small_scenes_are_copied(self):
        self.assert_renders("--set", "scene.repeats=copied")
        copied = self.images()
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), copied)

    def test_report_knows_copies(self):
        chosen = "--set", "scene.repeats=shared", "--poses", "1", "--quick"
        result = self.run_sonarsim("report", "mission.yaml", *chosen, "--json", "report.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("left out: engine: octree sees no copies", result.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["triangles"], 128 + 3 * 12)
        self.assertEqual({row["engine"] for row in report["rows"]}, {"rays"})
        self.assertLess(report["rows"][-1]["relative_l1"], 0.02)
        self.assert_refused(self.run_sonarsim("report", "mission.yaml", *chosen, "--quiet",
                                              "--engines", "slices"),
                            "mission.yaml: engine: slices sees no copies of shared meshes")

    def test_other_engines_refuse(self):
        for engine in ("octree", "slices"):
            self.refused(f"engine: {engine} sees no copies of shared meshes",
                         "scene.repeats: copied",
                         arguments=["--set", f"engine={engine}", "--set", "scene.repeats=shared"])


class BadObjects(Composed):
    def test_below_the_bottom(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, -3]}"])
        self.refused("mission.yaml:7:7: 'a' lies wholly below the bottom", "place: on_bottom")

    def test_beside_the_bottom(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [9.8, 0, 0], place: on_bottom}"])
        self.refused("mission.yaml:7:7: 'a' reaches beyond the bottom",
                     "from (-10, -10) to (10, 10)", "position_m")

    def test_scale_of_zero(self):
        self.objects(["{name: a, file: crate.gltf, scale: 0}"])
        self.refused("mission.yaml:7:42: 'scale' must be at least 1e-06, not '0'")

    def test_unknown_material(self):
        for key in ("material: steal", "materials_map: {Concrete: steal}"):
            self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5], " + key + "}"])
            self.refused("mission.yaml:7:7: unknown material 'steal' (did you mean 'steel'?)",
                         "materials.csv")

    def test_renames_what_is_not_there(self):
        self.objects(["{name: a, file: crate.gltf, materials_map: {Concreet: steel}}"])
        self.refused("mission.yaml:7:7: materials_map:", "crate.gltf has no material 'Concreet'",
                     "did you mean 'Concrete'?")

    def test_excludes_what_is_not_there(self):
        self.objects(["{name: a, file: crate.gltf, exclude: [lid]}"])
        self.refused("mission.yaml:7:7: exclude: no node of", "fits 'lid'", "sonarsim inspect")

    def test_two_of_one_name(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}",
                      "{name: a, file: crate.gltf, position_m: [7, 0, 1]}"])
        self.refused("mission.yaml:8:7: there is an object 'a' already")

    def test_buried_but_free(self):
        self.objects(["{name: a, file: crate.gltf, bury_m: 0.1}"])
        self.refused("mission.yaml:7:", "bury_m and align need place: on_bottom")

    def test_no_scene_at_all(self):
        self.scene("  materials: materials.csv\n")
        self.refused("mission.yaml:4:3: 'scene' needs the key 'file' or objects")

    def test_missing_file(self):
        self.objects(["{name: a, file: crat.gltf}"])
        self.refused("crat.gltf", "No such file", "; mission.yaml:7:7 names it")
        self.objects(["{name: a, file: crate.gltf, trajectory: {file: fish.csv}}"])
        self.refused("fish.csv", "No such file", "; mission.yaml:7:7 names it")

    def test_nothing_is_left(self):
        self.objects(["{file: crate.gltf, exclude: ['*']}"])
        self.refused("mission.yaml:7:7: 'crate.gltf': there is no surface in", "`exclude`")
        self.write("crate.gltf", '{"asset": {"version": "2.0"}}')
        self.objects(["{file: crate.gltf}"])
        self.refused("mission.yaml:7:7: 'crate.gltf': there is no surface in", "another file")
        self.scene("  file: floor.gltf\n  materials: materials.csv\n  exclude: ['*']\n")
        self.refused("mission.yaml:4:3: exclude leaves nothing of", "floor.gltf")

    def test_buried_wholly(self):
        self.objects(["{name: a, file: crate.gltf, place: on_bottom, bury_m: 1.01}"])
        self.refused("mission.yaml:7:7: 'a' lies wholly below the bottom; lower bury_m")
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" +
                   Scattered.RULE.replace("count: 5", "count: 2, bury_m: 1.01"))
        self.refused("mission.yaml:7:7: 'mine_1' lies wholly below the bottom; lower bury_m")

    def test_names_that_nothing_asks_for(self):
        """What no object needs so far is checked all the same."""
        for line, fragments in (("bottom: [flor]", ("bottom: no node of", "fits 'flor'")),
                                ("material_default: steal", ("unknown material 'steal' (did you "
                                                             "mean 'steel'?)", "materials.csv"))):
            self.scene(f"  file: floor.gltf\n  materials: materials.csv\n  {line}\n")
            self.refused("mission.yaml:4:3: ", *fragments)

    def test_empty_and_short_lists(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [1, 2]}"])
        self.refused("mission.yaml:7:47: 'position_m' must be a list of 3 numbers, not of 2")
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" +
                   Scattered.RULE.replace("[crate.gltf]", "[]"))
        self.refused("mission.yaml:7:27: 'files' must be", "not an empty list")

    def warned(self, *fragments):
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        for fragment in fragments:
            self.assertIn(fragment, result.stderr)

    def test_hidden_by_another(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}",
                      "{name: b, file: crate.gltf, scale: 0.5, position_m: [5, 0, 1]}"])
        self.warned("W21 scene: 1 object is in view but not seen", "'b'; what is named may lie behind")

    def test_a_count_of_zero(self):
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" +
                   Scattered.RULE.replace("count: 5", "count: 0"))
        self.warned("of 'mine' nothing is scattered, for its count is 0")

    def test_not_in_metres(self):
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh(6000.0)]))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 6001]}"])
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("crate.gltf is 1.2e+04 m long", result.stderr)
        self.assertIn("units: mm", result.stderr)
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh(0.0004)]))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}"])
        self.warned("crate.gltf is 0.0008 m long", "units: mm")
        # A unit that is proposed is one that is taken.
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [floor_mesh(0.02)]))
        self.scene("  file: floor.gltf\n  materials: materials.csv\n")
        self.warned("write scene.units: km or in\n")
        self.edit("mission.yaml", "materials.csv\n", "materials.csv\n  units: in\n")
        self.assertEqual(self.run_sonarsim("validate", "mission.yaml").returncode, 0)


class Inspect(Sandbox):
    def test_a_csv_to_fill_in(self):
        self.write("box.gltf", box_gltf(material="Con, crete"))
        result = self.run_sonarsim("inspect", "box.gltf", "--materials-csv")
        self.assertEqual(result.stdout,
                         'material,density_kg_m3,sound_speed_m_s\n"Con, crete",,\n')
        self.write("materials.csv", result.stdout)
        self.assert_refused(self.render(), "materials.csv:2: density '' is not a number")
        self.write("materials.csv", result.stdout.replace(",,", ",2400,3200"))
        self.assert_renders()
        again = self.run_sonarsim("inspect", "box.gltf", "--materials-csv", "--materials",
                                  "materials.csv")
        self.assertEqual(again.stdout, result.stdout.replace(",,", ",2400,3200"))

    def test_reflection_coefficients(self):
        """((2400 * 3200 - 997 * 1480) / (2400 * 3200 + 997 * 1480))^2 = 0.459."""
        z, water = 2400 * 3200, 997 * 1480
        reflection = ((z - water) / (z + water)) ** 2
        result = self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv")
        row = result.stdout.split("reflection\n")[1].splitlines()[0].split()
        self.assertEqual(row, ["Concrete", "2400", "3200", f"{reflection:.3f}"])
        told = json.loads(self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv",
                                            "--json").stdout)
        self.assertAlmostEqual(told["acoustics"]["Concrete"]["reflection"], reflection, places=12)
        self.write("box.gltf", box_gltf(material="Granite"))
        result = self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv")
        self.assertIn("Granite   not in materials.csv", result.stdout)

    def test_other_units(self):
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,2.4,3.2\n")
        for arguments in (["inspect", "box.gltf", "--materials", "materials.csv"],
                          ["validate", "mission.yaml"]):
            result = self.run_sonarsim(*arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("'Concrete': a density of 2.4 looks like g/cm^3", result.stderr)
            self.assertIn("a speed of sound of 3.2 looks like km/s", result.stderr)
        # Air is a gas, and says nothing of units.
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,1.2,343\n")
        self.assertNotIn("looks like", self.run_sonarsim("validate", "mission.yaml").stderr)


class WaterSurface(Sandbox):
    def test_invisible_but_for_multipath(self):
        self.assert_renders()
        plain = digest(self.out, ["dataset.json", "mission.resolved.yaml", "SHA256SUMS",
                                  "journal.txt"])
        self.edit("mission.yaml", "materials: materials.csv\n",
                  "materials: materials.csv\n  water_surface: {height_m: 0.1}\n")
        result = self.assert_renders("--overwrite")
        self.assertIn("scene.water_surface has no effect", result.stderr)
        self.assertEqual(digest(self.out, ["dataset.json", "mission.resolved.yaml", "SHA256SUMS",
                                           "journal.txt"]), plain)
        multipath = "--set", "sensors.fls.multipath.method=exact"
        self.assert_renders("--overwrite", *multipath)
        with_surface = digest(self.out)
        self.edit("mission.yaml", "  water_surface: {height_m: 0.1}\n", "")
        self.assert_renders("--overwrite", *multipath)
        self.assertNotEqual(digest(self.out)["fls/polar/000000.npy"],
                            with_surface["fls/polar/000000.npy"])

    def test_without_effect(self):
        """The sonar is at 0 m, the box around it from -2 to 2 m."""
        multipath = "--set", "sensors.fls.multipath.method=exact", "--set"
        for surface, doubt in (
                ("{height_m: -1}", "at -1 m lies below the sonar in 6 of 6 pings"),
                ("{height_m: -3}", "at -3 m lies below all of the scene: raise height_m"),
                ("{height_m: 1, roughness: 1}", "has no effect, for a roughness of 1")):
            result = self.run_sonarsim("validate", "mission.yaml", *multipath,
                                       f"scene.water_surface={surface}")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"scene.water_surface {doubt}", result.stderr)
        result = self.run_sonarsim("validate", "mission.yaml", *multipath,
                                   "scene.water_surface={height_m: 1}")
        self.assertNotIn("water_surface", result.stderr)

    def test_roughness(self):
        self.edit("mission.yaml", "materials: materials.csv\n",
                  "materials: materials.csv\n  water_surface: {height_m: 1, roughness: 2}\n")
        self.assert_refused(self.render(), "mission.yaml:6:", "'roughness' must be at most 1")


if __name__ == "__main__":
    unittest.main()
